"""What can be known is checked before anything is trained or written, and a start that fails leaves nothing behind."""

import os
import re
import shutil
import signal
import sys

import commands
import folders
import pandas as pd
import pytest
import torch
import trainers
from waiting import wait_until

from physexp.analysis.training import config as config_lib
from physexp.analysis.training import metrics as metrics_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer
from physexp import cli
from physexp.cli import demo

TASK = ("which_is_heavier", "features")


def refusal(capsys, *arguments):
    """The one line with which `physexp` refuses arguments, with exit status 2; it runs in this process."""
    with pytest.raises(SystemExit) as ended:
        cli.run([str(argument) for argument in arguments])
    output, errors = capsys.readouterr()
    assert ended.value.code == 2 and output == "" and errors.count("\n") == 1, errors
    return errors


def small(**agent):
    """PPO plays in the process that trains: nothing has to start."""
    agent = trainers.SMALL["ppo"].replace(**{"frames": 2_000, "checkpoint_seconds": 0.01, **agent})
    return config_lib.TrainConfig(domain=TASK[0], task=TASK[1], task_kwargs={"difficulty": 10.0}, agent=agent)


# Checks.


def test_a_missing_extra_is_told_before_anything_is_made(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "tensorboard", None)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == "tensorboard" else sys)
    line = refusal(capsys, "train", *TASK, "--run-dir", tmp_path / "run", "--tensorboard")
    assert "tensorboard is not installed; pip install 'physexp[" in line
    assert os.listdir(tmp_path) == []


@pytest.mark.skipif(torch.cuda.is_available(), reason="there is a GPU here")
@pytest.mark.parametrize("agent", ["a3c", "belief", "ppo"])
def test_a_gpu_that_is_not_there_is_told_before_anything_is_made(agent, tmp_path, capsys):
    options = ("--agent", agent, "--device", "cuda", "--tensorboard")
    line = refusal(capsys, "train", *TASK, "--run-dir", tmp_path / "deep" / "run", *options)
    assert line == "physexp: device is cuda, but torch finds no GPU here; choose cpu or auto\n"
    assert os.listdir(tmp_path) == []


def test_a_missing_gl_library_is_told_before_anything_is_made(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("MUJOCO_GL", "disable")
    line = refusal(capsys, "train", "towers", "fist_pixels", "--run-dir", tmp_path / "run")
    assert "no pixels can be drawn with MUJOCO_GL=disable" in line and "install" in line
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("place", ["file", "file/run"])
def test_a_run_dir_that_is_a_file_or_below_one_is_told(place, tmp_path, capsys):
    (tmp_path / "file").write_text("mine")
    assert "is a file or lies below one" in refusal(capsys, "train", *TASK, "--run-dir", tmp_path / place)
    assert folders.contents(tmp_path) == {"file": b"mine"}


def test_a_disk_without_room_for_checkpoints_is_told_before_training(tmp_path, monkeypatch, capsys):
    usage = shutil.disk_usage(tmp_path)
    monkeypatch.setattr(shutil, "disk_usage", lambda path: usage._replace(free=1_000_000))
    line = refusal(capsys, "train", *TASK, "--run-dir", tmp_path / "run", "--agent", "a3c")
    # Its LSTM alone, 4 x 100 x 200 weights of 4 bytes with two statistics of each, takes 0.96 MB, thrice 2.9 MB.
    assert "has 1.0 MB of free space, and checkpoints need" in line and "make room, or choose another folder" in line
    assert os.listdir(tmp_path) == []


# Starts that come to nothing.


@pytest.fixture
def starting(tmp_path):
    """`physexp train` in a new folder, and its worker, as soon as that is there: many episodes before it learns.

    Many more than by default: what takes the test a moment to see takes the worker much longer.
    """
    options = [
        "--agent",
        "a3c",
        "--num-workers",
        1,
        "--frames",
        10**9,
        "--run-dir",
        tmp_path / "a" / "run",
        "--envs-per-worker",
        3000,
    ]
    with commands.start("train", *TASK, *options) as process:
        (worker,) = wait_until(lambda: trainers.workers(process), "a worker")
        yield process, worker


def test_a_worker_that_dies_before_it_has_learned_anything_leaves_no_folder(starting, tmp_path):
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


@pytest.mark.parametrize(
    "option, said",
    [
        (["--frames", 9000], "frames is 9000, and in {} it is 2000; leave it out"),
        (["--agent", "a3c"], "agent is a3c, and in {} it is ppo; leave it out"),
        (["--replay-every", 9000], "replay_every is 9000, and in {} it is 0; leave it out"),
        (["--difficulty", 3], "difficulty is 3, and in {} it is 10; leave it out"),
        (["--variation", 0.5], "variation is 0.5, and in {} it is not chosen; leave it out"),
    ],
)
def test_options_that_a_run_was_not_begun_with_are_not_ignored_when_it_goes_on(option, said, tmp_path, capsys):
    run = run_lib.Run(tmp_path / "run")
    run.create(small())
    line = refusal(capsys, "train", *TASK, "--run-dir", run.path, "--resume", *option)
    assert said.format(run.path) in line


def test_records_without_a_checkpoint_are_not_resumed_but_moved_aside_by_a_new_start(tmp_path, capsys):
    run = run_lib.Run(tmp_path / "run")
    run.create(small())
    # As a kill leaves it in the first minute.
    run.append_metrics({**dict.fromkeys(metrics_lib.METRICS, 0.5), "frames": 7})
    before = folders.contents(run.path)
    line = refusal(capsys, "train", *TASK, "--run-dir", run.path, "--resume")
    assert "holds no checkpoint to resume from; leave out --resume to start anew" in line
    assert folders.contents(run.path) == before
    told = []
    trainer.train(run, tell=told.append, start=small(seed=1))
    assert folders.contents(run.path / "superseded-1") == before
    assert told == [f"the records of an earlier attempt without a checkpoint are now in {run.path / 'superseded-1'}"]
    assert run.config.agent.seed == 1 and run.is_finished and 7 not in pd.DataFrame(run.metrics()).frames.tolist()
    run.keep_agent_only()
    before = folders.contents(run.path)
    line = refusal(capsys, "train", *TASK, "--run-dir", run.path, "--resume")
    assert "is finished and has kept its agent alone; evaluate it" in line
    assert folders.contents(run.path) == before


def test_a_run_that_has_had_its_frames_says_so_when_it_is_to_go_on(tmp_path, capsys):
    run = run_lib.Run(tmp_path / "run")
    run.create(small(frames=100))
    trainer.train(run)
    assert run.is_finished
    cli.run(["train", *TASK, "--run-dir", str(run.path), "--resume"])
    assert f"{run.path} has had its 100 frames; to train longer, train anew with more" in capsys.readouterr().err


# The demo.


def test_the_demo_refuses_a_folder_with_another_run_and_changes_nothing(tmp_path, capsys):
    run = run_lib.Run(tmp_path / "run")
    run.create(small())
    run.append_metrics({**dict.fromkeys(metrics_lib.METRICS, 0.5), "frames": 7})
    before = folders.contents(tmp_path)
    line = refusal(capsys, "demo", "--run-dir", run.path)
    assert "holds a run that is no demo's; choose another --run-dir" in line
    assert folders.contents(tmp_path) == before


def test_a_demo_in_the_folder_of_an_earlier_one_moves_that_aside_and_tells_that_nothing_was_learned(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr(demo, "config", lambda: small(frames=100))  # Too few to learn anything from.
    monkeypatch.setattr(demo, "EPISODES", 10)
    run = run_lib.Run(tmp_path / "demo")
    run.create(demo.config())
    run.append_metrics({**dict.fromkeys(metrics_lib.METRICS, 0.5), "frames": 100})
    checkpoint = run.checkpointer.save({"frames": torch.tensor(100)}, {})
    before = folders.contents(run.path)
    demo.run(run.path)
    assert folders.contents(run.path / "superseded-1") == before and run.is_finished and not checkpoint.exists()
    errors = capsys.readouterr().err
    assert "the agent" in errors and "chance is 25.0%" in errors and re.search(r"--frames \d+ or more", errors)
