"""A start is checked before anything is written, and one that fails leaves nothing behind."""

import os
import re
import shutil
import signal
import sys

import commands
import folders
import pytest
import torch
import trainers
from waiting import wait_until

from physexp import cli
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer
from physexp.cli import demo

TASK = ("which_is_heavier", "features")
ROW = {**dict.fromkeys(run_lib.METRICS, 0.5), "frames": 7}


def refusal(capsys, *arguments):
    """The one line with which `physexp` refuses arguments, with exit status 2; it runs in this process."""
    with pytest.raises(SystemExit) as ended:
        cli.run([str(argument) for argument in arguments])
    output, errors = capsys.readouterr()
    assert ended.value.code == 2 and output == "" and errors.count("\n") == 1, errors
    return errors


def small(**agent):
    """PPO plays in the process that trains: no other has to start."""
    agent = trainers.SMALL["ppo"].replace(**{"frames": 2_000, "checkpoint_seconds": 0.01, **agent})
    return config_lib.TrainConfig(domain=TASK[0], task=TASK[1], task_kwargs={"difficulty": 10.0}, agent=agent)


# Checks.


def without_tensorboard(monkeypatch):
    monkeypatch.setitem(sys.modules, "tensorboard", None)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == "tensorboard" else sys)


def without_gpu(monkeypatch):
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)


def without_gl(monkeypatch):
    monkeypatch.setenv("MUJOCO_GL", "disable")


def on_a_full_disk(monkeypatch):
    usage = shutil.disk_usage(".")
    monkeypatch.setattr(shutil, "disk_usage", lambda path: usage._replace(free=1_000_000))


@pytest.mark.parametrize(
    ("surroundings", "words", "message"),
    [
        (without_tensorboard, [*TASK, "--tensorboard"], "tensorboard is not installed; pip install 'physexp["),
        (without_gpu, [*TASK, "--device", "cuda"], "device is cuda, but torch finds no GPU here; choose cpu or auto"),
        (without_gl, ["towers", "fist_pixels"], "no pixels can be drawn with MUJOCO_GL=disable"),
        (None, [*TASK, "--agent", "a3c", "--num-workers", 9_999], "num_workers is 9999; this machine has "),
        # A3C's LSTM alone, 4 x 100 x 200 weights of 4 bytes with two statistics of each, takes 0.96 MB, thrice 2.9 MB.
        (on_a_full_disk, [*TASK, "--agent", "a3c"], "has 1.0 MB of free space, and checkpoints need"),
    ],
)
def test_an_obstacle_is_told_before_anything_is_made(surroundings, words, message, tmp_path, monkeypatch, capsys):
    if surroundings is not None:
        surroundings(monkeypatch)
    assert message in refusal(capsys, "train", *words, "--run-dir", tmp_path / "deep" / "run")
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("place", ["file", "file/run"])
def test_a_run_dir_that_is_a_file_or_below_one_is_told(place, tmp_path, capsys):
    (tmp_path / "file").write_text("mine")
    assert "is a file or lies below one" in refusal(capsys, "train", *TASK, "--run-dir", tmp_path / place)
    assert folders.contents(tmp_path) == {"file": b"mine"}


# Starts that come to nothing.


@pytest.fixture
def starting(tmp_path):
    """`physexp train` in a new folder with its worker, which plays long episodes of slow physics before it learns."""
    options = ["--agent", "a3c", "--num-workers", 1, "--envs-per-worker", 3000, "--frames", 10**9]
    with commands.start("train", "towers/fist_features", *options, "--run-dir", tmp_path / "a" / "run") as process:
        (worker,) = wait_until(lambda: trainers.workers(process), "a worker")
        yield process, worker


def test_a_worker_that_dies_before_the_first_update_leaves_no_folder(starting, tmp_path):
    process, worker = starting
    worker.kill()
    _, errors = process.communicate()
    assert process.returncode == 1 and errors.count("\n") == 1, errors
    assert "worker 0 died" in errors and "there is no checkpoint yet" in errors and "whole" not in errors
    assert os.listdir(tmp_path) == []


def test_ctrl_c_before_anything_was_learned_leaves_no_folder(starting, tmp_path):
    process, _ = starting
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate()
    assert process.returncode == 130 and "Traceback" not in errors, errors
    assert "no checkpoint" in errors and "the same command starts anew" in errors
    assert os.listdir(tmp_path) == []


# Resuming.


@pytest.mark.parametrize(
    "option, message",
    [
        (["--frames", 9000], "frames is 9000, and in {} it is 2000; leave it out"),
        (["--agent", "a3c"], "agent is a3c, and in {} it is ppo; leave it out"),
        (["--variation", 0.5], "variation is 0.5, and in {} it is not chosen; leave it out"),
    ],
)
def test_a_resumed_run_refuses_other_options_than_its_own(option, message, tmp_path, capsys):
    run = run_lib.Run(tmp_path / "run")
    run.create(small())
    line = refusal(capsys, "train", *TASK, "--run-dir", run.path, "--resume", *option)
    assert message.format(run.path) in line


def test_records_without_a_checkpoint_are_moved_aside_by_a_new_start(tmp_path, capsys):
    run = run_lib.Run(tmp_path / "run")
    run.create(small())
    run.append_metrics(ROW)  # As a kill leaves it in the first minute.
    before = folders.contents(run.path)
    line = refusal(capsys, "train", *TASK, "--run-dir", run.path, "--resume")
    assert "holds no checkpoint to resume from; leave out --resume to start anew" in line
    assert folders.contents(run.path) == before
    told = []
    trainer.train(run, tell=told.append, start=small(seed=1))
    assert folders.contents(run.path / "superseded-1") == before
    assert told == [f"the records of an earlier attempt without a checkpoint are now in {run.path / 'superseded-1'}"]
    assert run.config.agent.seed == 1 and run.is_finished and 7 not in [row["frames"] for row in run.metrics()]


def test_a_finished_run_says_so_when_it_is_resumed(tmp_path, capsys):
    run = run_lib.Run(tmp_path / "run")
    run.create(small(frames=100))
    trainer.train(run)
    cli.run(["train", *TASK, "--run-dir", str(run.path), "--resume"])
    assert f"{run.path} has had its 100 frames; to train longer, train anew with more" in capsys.readouterr().err


# The demo.


def test_the_demo_refuses_a_folder_with_another_run(tmp_path, capsys):
    run = run_lib.Run(tmp_path / "run")
    run.create(small())
    run.append_metrics(ROW)
    before = folders.contents(tmp_path)
    line = refusal(capsys, "demo", "--run-dir", run.path)
    assert "holds a run that is no demo's; choose another --run-dir" in line
    assert folders.contents(tmp_path) == before


def test_the_demo_moves_an_earlier_one_aside_and_judges_its_agent(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(demo, "FRAMES", 100)  # Too few to learn anything from.
    monkeypatch.setattr(demo, "EPISODES", 10)
    run = run_lib.Run(tmp_path / "demo")
    run.create(demo.config())
    run.append_metrics({**ROW, "frames": 100})
    checkpoint = run.checkpointer.save({"frames": torch.tensor(100)}, {})
    before = folders.contents(run.path)
    demo.Demo(run_dir=run.path).run()
    assert folders.contents(run.path / "superseded-1") == before and run.is_finished and not checkpoint.exists()
    printed = capsys.readouterr()
    assert "the agent" in printed.err and "chance is 12.5%" in printed.err
    assert re.search(r"--frames \d+ or more", printed.err)
    assert f"{0.95**3:.4f}" in printed.out and "score: " in printed.out  # Three pushes halve eight forces to one.
    assert {"learning_curve.png", "replay.rrd", "score"} <= {path.name for path in run.path.iterdir()}
