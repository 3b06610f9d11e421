"""As many processes work side by side as there are cores for them, in no more memory than there is."""

import os

import psutil
import pytest

from physexp.agents import processes


@pytest.mark.parametrize(
    ("quota", "cores"),
    [
        ("max 100000", 64),
        ("200000 100000", 2),
        ("250000 100000", 2),
        ("50000 100000", 1),  # Half a core's time: one process is the least.
        ("9900000 100000", 64),  # More than there are.
    ],
)
def test_a_containers_quota_counts_beside_the_cores_that_there_are(quota, cores, tmp_path, monkeypatch):
    (tmp_path / "cpu.max").write_text(f"{quota}\n")
    monkeypatch.setattr(processes, "_QUOTA", tmp_path / "cpu.max")
    monkeypatch.setattr(os, "sched_getaffinity", lambda pid: set(range(64)))
    assert processes.num_cores() == cores


def test_without_a_container_all_cores_count(tmp_path, monkeypatch):
    monkeypatch.setattr(processes, "_QUOTA", tmp_path / "none")
    assert processes.num_cores() == len(os.sched_getaffinity(0))


@pytest.mark.parametrize("limit, memory", [("1000000\n", 1_000_000), ("max\n", None), (f"{2**62}\n", None)])
def test_memory_is_what_a_containers_limit_leaves_of_the_machines(tmp_path, monkeypatch, limit, memory):
    monkeypatch.setattr(processes, "_MOST_MEMORY", tmp_path / "memory.max")
    installed = psutil.virtual_memory().total
    assert processes.memory() == pytest.approx(installed, rel=1e-3)
    (tmp_path / "memory.max").write_text(limit)
    assert processes.memory() == pytest.approx(memory or installed, rel=1e-3)
