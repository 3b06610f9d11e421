"""Whatever stops a run, it says so clearly, and nothing before the last checkpoint is lost."""

import dataclasses
import functools
import os
import re
import resource
import shlex
import signal

import commands
import numpy as np
import pytest
import torch
import trainers
from waiting import wait_until

from physexp.analysis.data import provenance
from physexp.analysis.training import trainer

ENDLESS = 10**9  # Frames that no test waits for.


def assert_last_checkpoint_fits(run):
    """The last checkpoint is whole, finite, and one that the agent takes up."""
    tensors, facts = run.checkpointer.latest()
    assert facts["versions"] == provenance.versions()
    assert all(value.isfinite().all() for value in tensors.values())
    config = run.config
    agent = trainer.make_agent(config)
    agent.restore(tensors)
    assert agent.frames == int(tensors["frames"])


def test_a_loss_that_is_not_a_number_stops_training_and_leaves_the_batch(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS)
    checkpoint = trainers.save_first_checkpoint(run, poison=True)
    content = checkpoint.read_bytes()
    with pytest.raises(RuntimeError, match="worker 0.*loss -?(inf|nan).*failed_batch.npz.*last checkpoint") as caught:
        trainer.train(run)
    path = re.search(r"\S+failed_batch\.npz", str(caught.value)).group()
    assert path == str(run.path / "failed_batch.npz")
    with np.load(path) as batch:
        # One round of 32 episodes: everything needed to compute the loss again.
        assert {"inputs", "actions", "rewards", "lengths", "answers"} == set(batch.files)
        steps = len(batch["actions"])
        assert batch["lengths"].shape == batch["answers"].shape == (32,) and batch["lengths"].max() == steps
        assert batch["actions"].shape == batch["rewards"].shape == (steps, 32)
        assert len(batch["inputs"]) == batch["lengths"].sum()
    assert run.checkpointer.paths() == [checkpoint]
    assert checkpoint.read_bytes() == content


def test_a_killed_worker_stops_training_at_once_and_is_named(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS, num_workers=2)
    with trainers.trainer(run) as process:
        # Both have to be at it: a worker that still imports would be the easier case.
        wait_until(lambda: both_have_played(run), "rounds of both workers")
        victims = trainers.workers(process)
        assert len(victims) == 2
        victims[0].kill()
        _, errors = process.communicate()
    assert process.returncode == 1
    assert re.search(r"worker [01]\b.*(died|killed)", errors), errors
    assert "Traceback" not in errors
    assert_last_checkpoint_fits(run)


def both_have_played(run):
    try:
        found = run.checkpointer.latest()
    except OSError:  # Replaced while it was read.
        return False
    return found is not None and bool((found[0]["rounds"] > 0).all())


def test_workers_do_not_outlive_a_killed_trainer(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS)
    with trainers.trainer(run) as process:
        trainers.wait_for_checkpoint(process, run)
        assert trainers.workers(process)
        process.kill()
        process.wait()
        wait_until(lambda: not trainers.workers(process), "the end of the workers of a killed trainer")


def test_a_full_disk_stops_training_with_a_message_and_keeps_the_last_checkpoint(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS)
    checkpoint = trainers.save_first_checkpoint(run)
    content = checkpoint.read_bytes()
    # A checkpoint is three times the parameters; the kernel refuses files of more than half of it.
    limit = len(content) // 2
    small_files = functools.partial(resource.setrlimit, resource.RLIMIT_FSIZE, (limit, limit))
    with trainers.trainer(run, first=small_files) as process:
        _, errors = process.communicate()
    assert process.returncode in (1, 2)
    assert "Traceback" not in errors
    assert str(run.path) in errors.splitlines()[-1], errors
    assert run.checkpointer.paths() == [checkpoint]
    assert checkpoint.read_bytes() == content
    assert_last_checkpoint_fits(run)
    names = sorted(path.name for path in (run.path / "checkpoints").iterdir())
    assert [name for name in names if name.endswith(".tmp")] == [], "a failed write leaves no litter"


def test_ctrl_c_writes_a_checkpoint_and_resuming_finishes(tmp_path):
    run = trainers.create(tmp_path / "its run", frames=ENDLESS, num_workers=2)
    with trainers.trainer(run) as process:
        trainers.wait_for_checkpoint(process, run, beyond=0)
        before = int(run.checkpointer.paths()[-1].stem)
        os.killpg(process.pid, signal.SIGINT)  # The terminal sends it to the whole group.
        _, errors = process.communicate()
    assert process.returncode == 130, errors
    assert "Traceback" not in errors and "interrupted" in errors
    tensors, _ = run.checkpointer.latest()
    reached = int(tensors["frames"])
    assert before < reached, "Ctrl-C writes what was learned since the last checkpoint"
    assert run.metrics()[-1]["frames"] == reached
    (last,) = [path for path in run.checkpointer.paths() if int(path.stem) == reached]
    assert f"the checkpoint after {reached:,} frames: {last}\n" in errors
    trainers.set_frames(run, reached + 1_000)
    command = re.search("^to go on: physexp (.*)$", errors, re.MULTILINE)[1]
    done = commands.run(*shlex.split(command))
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == str(run.path)
    tensors, _ = run.checkpointer.latest()
    assert int(tensors["frames"]) >= reached + 1_000
    frames = [row["frames"] for row in run.metrics()]
    assert frames == sorted(set(frames)) and frames[-1] == int(tensors["frames"])
    assert reached in frames


def test_a_checkpoint_of_another_network_is_refused(tmp_path):
    run = trainers.create(tmp_path / "run")
    trainers.save_first_checkpoint(run)
    config = run.config
    other = trainer.make_agent(dataclasses.replace(config, agent=config.agent.replace(num_workers=2)))
    with pytest.raises(ValueError, match="does not fit the configuration: rounds"):
        other.restore(run.checkpointer.latest()[0])
    fewer = {name: value for name, value in run.checkpointer.latest()[0].items() if name != "rounds"}
    same = trainer.make_agent(config)
    with pytest.raises(ValueError, match="rounds"):
        same.restore(fewer)
    same.restore(run.checkpointer.latest()[0])
    assert torch.equal(same.save()["rounds"], torch.tensor([0]))
