"""The cores and the memory that processes may use, with the limits of control groups."""

import os

import psutil
import pytest

from physexp.agents import processes

INSTALLED = psutil.virtual_memory().total
BOTH = "4:cpu,cpuacct:{0}\n3:memory:{0}\n0::/elsewhere\n"  # Version 1, and a version 2 that has no controllers.


@pytest.fixture
def groups(tmp_path, monkeypatch):
    """Returns a function that makes control groups: the entry in /proc, and files with their content."""
    monkeypatch.setattr(processes, "_OWN_GROUPS", tmp_path / "cgroup")
    monkeypatch.setattr(processes, "_GROUPS", tmp_path / "mounted")
    monkeypatch.setattr(os, "sched_getaffinity", lambda pid: set(range(64)))

    def make(own, files):
        (tmp_path / "cgroup").write_text(own)
        for name, content in files.items():
            path = tmp_path / "mounted" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"{content}\n")

    return make


@pytest.mark.parametrize(
    ("own", "files", "cores"),
    [
        ("0::/\n", {"cpu.max": "250000 100000"}, 2),
        ("0::/\n", {"cpu.max": "50000 100000"}, 1),  # Half a core's time: one process is the least.
        ("0::/a/b\n", {"a/b/cpu.max": "max 100000", "a/cpu.max": "300000 100000"}, 3),
        (BOTH.format("/a/b"), {"cpu/a/cpu.cfs_quota_us": 400_000, "cpu/a/cpu.cfs_period_us": 100_000}, 4),
        # A container that sees its own group mounted as the outermost, and its path as the host has it.
        (BOTH.format("/docker/7"), {"cpu/cpu.cfs_quota_us": 200_000, "cpu/cpu.cfs_period_us": 100_000}, 2),
    ],
)
def test_cores_are_limited_by_quotas_of_control_groups(own, files, cores, groups):
    groups(own, files)
    assert processes.num_cores() == cores


@pytest.mark.parametrize(
    ("own", "files", "memory"),
    [
        ("0::/\n", {"memory.max": "max"}, INSTALLED),
        ("0::/a/b\n", {"a/b/memory.max": 2_000_000, "a/memory.max": 1_000_000}, 1_000_000),
        (BOTH.format("/a"), {"memory/a/memory.limit_in_bytes": 1_000_000}, 1_000_000),
        (BOTH.format("/docker/7"), {"memory/memory.limit_in_bytes": 1_000_000}, 1_000_000),
    ],
)
def test_memory_is_limited_by_control_groups(own, files, memory, groups):
    groups(own, files)
    assert processes.memory() == pytest.approx(memory, rel=1e-3)


def test_a_system_without_control_groups_has_all_cores_and_memory(groups, monkeypatch):
    monkeypatch.delattr(os, "sched_getaffinity")  # As on macOS.
    assert processes.num_cores() == os.cpu_count()
    assert processes.memory() == pytest.approx(INSTALLED, rel=1e-3)
