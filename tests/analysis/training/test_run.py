"""A run's folder: one trainer at a time, and no record lost."""

import json
import os
import resource
import signal

import folders
import pytest
import torch

from physexp.agents.a3c import config as a3c
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

COLUMNS = [*run_lib.METRICS, *a3c.A3CConfig.metrics]


def make_config(seed=0):
    return config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=a3c.A3CConfig(seed=seed))


def row(frames):
    return {**dict.fromkeys(COLUMNS, 0.5), "frames": frames}


def frames_of(run):
    return [entry["frames"] for entry in run.metrics()]


def checkpoint(run, frames=10):
    return run.checkpointer.save({"frames": torch.tensor(frames), "network/w": torch.ones(2)}, {})


@pytest.fixture
def run(tmp_path):
    made = run_lib.Run(tmp_path / "run")
    made.create(make_config())
    return made


# Starting.


def test_a_start_that_fails_removes_the_folders_that_it_made(tmp_path):
    (tmp_path / "mine").mkdir()
    run = run_lib.Run(tmp_path / "mine" / "deep" / "run")
    with pytest.raises(RuntimeError, match="no GPU"), run.locked():
        run.create(make_config())
        try:
            raise RuntimeError("no GPU")
        finally:
            run.discard()
    assert os.listdir(tmp_path) == ["mine"] and os.listdir(tmp_path / "mine") == []


def test_a_disk_that_is_full_from_the_start_leaves_nothing(tmp_path):
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))  # A configuration has more bytes.
    try:
        with pytest.raises(OSError, match="config.json"):
            run_lib.Run(tmp_path / "run").create(make_config())
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert list(tmp_path.iterdir()) == []


def test_an_attempt_without_a_checkpoint_is_moved_aside_by_a_new_start(run):
    assert run.create(make_config(seed=1)) is None, "nothing was recorded, so nothing is moved"
    run.append_metrics(row(10))
    run.append_episodes(10, run_lib.EPISODES.empty_table())
    before = folders.contents(run.path)
    moved = run.create(make_config(seed=2))
    assert moved == run.path / "superseded-1" and folders.contents(moved) == before
    assert run.config.agent.seed == 2 and run.metrics() == []
    run.append_metrics(row(20))
    assert run.create(make_config(seed=3)) == run.path / "superseded-2"
    assert folders.contents(moved) == before


@pytest.mark.parametrize("kept", ["a checkpoint", "an agent"])
def test_a_run_with_a_checkpoint_or_an_agent_is_not_started_anew(kept, run):
    checkpoint(run)
    if kept == "an agent":
        run.keep_agent_only()
    before = folders.contents(run.path)
    with pytest.raises(ValueError, match="already holds a run; add --resume"):
        run.create(make_config(seed=1))
    assert folders.contents(run.path) == before


def test_only_a_run_with_a_checkpoint_or_without_records_is_resumed(run):
    run.check_resumable()
    run.append_metrics(row(10))
    with pytest.raises(ValueError, match="no checkpoint to resume from; leave out --resume to start anew"):
        run.check_resumable()
    checkpoint(run)
    run.check_resumable()
    run.keep_agent_only()
    with pytest.raises(ValueError, match="is finished and has kept its agent alone; evaluate it"):
        run.check_resumable()


# Records.


def test_rewinding_removes_later_records_and_a_torn_row(run):
    for frames in (10, 20, 30):
        run.append_metrics(row(frames))
        run.append_episodes(frames, run_lib.EPISODES.empty_table())
    with open(run.path / "metrics.csv", "a") as file:
        file.write("1,7")  # Torn by a crash: its frames look small.
    run.rewind(20)
    run.append_metrics(row(25))
    assert frames_of(run) == [10, 20, 25]
    assert sorted(os.listdir(run.path / "episodes.parquet")) == [f"part-{frames:015d}.parquet" for frames in (10, 20)]
    run.rewind(-1)
    assert run.metrics() == [] and os.listdir(run.path / "episodes.parquet") == []


def test_whole_rows_are_read_wherever_a_kill_tears_the_metrics(tmp_path):
    run = run_lib.Run(tmp_path)
    run.append_metrics(row(10))
    run.append_metrics(row(20))
    content = (tmp_path / "metrics.csv").read_bytes()
    ends = [end + near for end in range(len(content)) if content[end : end + 1] == b"\n" for near in (0, 1)]
    for size in sorted({*range(0, len(content), 11), *ends}):
        (tmp_path / "metrics.csv").write_bytes(content[:size])
        expected = [10.0, 20.0][: max(0, content[:size].count(b"\n") - 1)]
        assert frames_of(run) == expected
        run.rewind(20)
        run.append_metrics(row(30))
        assert frames_of(run) == [*expected, 30.0]
        assert (tmp_path / "metrics.csv").read_bytes().startswith(content[: content.index(b"\n") + 1])


@pytest.mark.parametrize(
    ("content", "words"),
    [("frames,loss\n1,2\n1,a\n", "line 3 is no row of 2 numbers"), ("\0\n", "its first line names no")],
)
def test_damaged_metrics_are_named_in_one_line_and_left_alone(content, words, run):
    (run.path / "metrics.csv").write_text(content)
    for read in (run.metrics, lambda: run.rewind(-1)):
        with pytest.raises(ValueError, match=f"^{run.path}/metrics.csv is damaged: {words}") as caught:
            read()
        assert "\n" not in str(caught.value)
    assert (run.path / "metrics.csv").read_text() == content


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"envs_per_worker": 256', '"envs_per_worker": -1', "is damaged: envs_per_worker is -1"),
        ('"format": 1', '"format": 99', "has format 99; this version reads format 1"),
    ],
)
def test_a_configuration_out_of_range_or_of_another_format_is_refused(old, new, words, run):
    path = run.path / "config.json"
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(ValueError, match=f"^{path} {words}"):
        _ = run.config


def test_a_run_keeps_its_configuration_and_the_versions(tmp_path):
    run = run_lib.Run(tmp_path / "deep" / "run")
    with pytest.raises(ValueError, match="holds no run"):
        _ = run.config
    run.create(make_config(seed=2**62))
    assert run_lib.Run(run.path).config == make_config(seed=2**62)
    content = json.loads((run.path / "config.json").read_text())
    assert {"python", "physexp", "mujoco", "dm-control", "torch", "numpy"} <= set(content["versions"])


# The lock.


def test_a_trainer_whose_lock_file_is_removed_leaves_the_next_ones_alone(run):
    with run.locked():
        run.check_lock()
        (run.path / ".lock").unlink()
        other = run_lib.Run(run.path)
        with other.locked():
            with pytest.raises(RuntimeError, match=r"\.lock was removed, or the folder moved"):
                run.check_lock()
            run.discard()
            assert run.config == make_config(), "the configuration is the other trainer's"
            other.check_lock()
        assert not (run.path / ".lock").exists()


def test_partial_files_of_a_killed_trainer_are_removed_by_the_next(run):
    run.append_episodes(10, run_lib.EPISODES.empty_table())
    for folder in (run.path, run.path / "episodes.parquet", run.path / "replays"):
        folder.mkdir(exist_ok=True)
        (folder / ".0123456789abcdef.tmp").write_text("half")
    (run.path / "replays" / "000000000001000.rrd").write_text("whole")
    with run.locked():
        assert not list(run.path.rglob("*.tmp"))
    assert os.listdir(run.path / "replays") == ["000000000001000.rrd"]
