"""A signal, a dead worker, a loss that is not finite: training ends clearly, and its last checkpoint is whole."""

import os
import re
import shlex
import signal
import subprocess

import commands
import numpy as np
import pytest
import trainers
from waiting import wait_until

from physexp.analysis.data import provenance
from physexp.analysis.training import stopping, trainer

ENDLESS = 10**9  # Frames that no test waits for.


def assert_last_checkpoint_fits(run):
    """The last checkpoint is whole and finite, and the agent takes it up."""
    tensors, facts = run.checkpointer.latest()
    assert facts["versions"] == provenance.versions()
    assert all(value.isfinite().all() for value in tensors.values())
    agent = trainer.make_agent(run.config)
    agent.restore(tensors)
    assert agent.frames == int(tensors["frames"])


# Signals.


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_the_first_request_is_a_call_and_the_second_is_raised(number, monkeypatch):
    monkeypatch.setattr(stopping, "TOGETHER_SECONDS", 0.0)
    stopped = []
    with pytest.raises(stopping.Interrupted) as caught, stopping.deferred(lambda: stopped.append(1)) as requests:
        os.kill(os.getpid(), number)
        assert stopped == [1] and [request.number for request in requests] == [number]
        os.kill(os.getpid(), number)
    assert stopped == [1] and stopping.exit_status(caught.value) == 128 + number


def test_requests_that_come_together_are_one(monkeypatch):
    monkeypatch.setattr(stopping, "TOGETHER_SECONDS", 3600.0)
    stopped = []
    ended = []
    with pytest.raises(stopping.Interrupted) as caught, stopping.deferred(lambda: stopped.append(1)):
        for number in (signal.SIGTERM, signal.SIGTERM, signal.SIGHUP):
            os.kill(os.getpid(), number)
        ended.append(1)
    assert stopped == ended == [1] and caught.value.number == signal.SIGTERM


@pytest.mark.parametrize("kind", [ImportError, stopping.Interrupted])  # As MuJoCo and dm_control do.
def test_a_request_that_a_library_turns_into_its_own_error_is_a_request(kind):
    with pytest.raises(stopping.Interrupted) as caught, stopping.raised():
        try:
            os.kill(os.getpid(), signal.SIGTERM)
        except KeyboardInterrupt:
            raise kind("initialization failed") from None
    assert stopping.exit_status(caught.value) == 128 + signal.SIGTERM
    with pytest.raises(ImportError), stopping.raised():
        raise ImportError("nothing was asked for")


def test_ignored_signals_stay_ignored_and_handlers_are_put_back():
    before, ending = signal.signal(signal.SIGHUP, signal.SIG_IGN), signal.getsignal(signal.SIGTERM)
    try:
        with stopping.raised(), stopping.deferred(pytest.fail):
            os.kill(os.getpid(), signal.SIGHUP)
            assert signal.getsignal(signal.SIGTERM) is not ending
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)
    assert signal.getsignal(signal.SIGTERM) is ending, "Ray, for example, has a handler of its own"


def test_a_closed_terminal_ends_training_with_a_checkpoint(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS, checkpoint_seconds=3600.0)
    terminal, inside = os.openpty()
    with (
        subprocess.Popen(
            [trainers.PHYSEXP, *map(str, trainers.resumed(run))], preexec_fn=lambda: os.login_tty(inside)
        ) as process,
        subprocess.Popen(["cat"], stdin=terminal, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as reader,
    ):
        os.close(inside)
        os.close(terminal)
        try:
            wait_until(run.metrics, "a row of metrics, and so something on the terminal")
            reader.kill()  # The last one that has the terminal open.
            wait_until(lambda: process.poll() is not None, "the end of the trainer")
        finally:
            for member in trainers.group(process.pid):
                member.kill()
    assert process.returncode != 0
    assert int(run.checkpointer.latest()[0]["frames"]) == run.metrics()[-1]["frames"] > 0


def test_ctrl_c_writes_a_checkpoint_and_the_printed_command_goes_on(tmp_path):
    run = trainers.create(tmp_path / "its run", frames=ENDLESS, num_workers=2)
    with trainers.trainer(run) as process:
        trainers.wait_for_checkpoint(process, run, beyond=0)
        before = int(run.checkpointer.paths()[-1].stem)
        os.killpg(process.pid, signal.SIGINT)  # The terminal sends it to the whole group.
        _, errors = process.communicate()
    assert process.returncode == 130, errors
    assert "Traceback" not in errors and "interrupted" in errors
    reached = int(run.checkpointer.latest()[0]["frames"])
    assert before <= reached == run.metrics()[-1]["frames"]
    assert f"the checkpoint after {reached:,} frames: {run.checkpointer.paths()[-1]}\n" in errors
    trainers.set_frames(run, reached + 1_000)
    command = re.search("^to go on: physexp (.*)$", errors, re.MULTILINE)[1]
    done = commands.run(*shlex.split(command))
    assert done.returncode == 0 and done.stdout.splitlines()[-1] == str(run.path), done.stderr
    frames = [row["frames"] for row in run.metrics()]
    assert frames == sorted(set(frames)) and frames[-1] == int(run.checkpointer.latest()[0]["frames"])
    assert reached in frames and frames[-1] >= reached + 1_000


# Workers.


def test_a_killed_worker_ends_training_in_one_line_that_names_it(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS, num_workers=2)
    with trainers.trainer(run) as process:
        trainers.wait_for_checkpoint(process, run)
        wait_until(lambda: len(trainers.workers(process)) == 2, "both workers")
        trainers.workers(process)[0].kill()
        _, errors = process.communicate()
    assert process.returncode == 1 and "Traceback" not in errors
    line = errors.splitlines()[-1]
    assert re.search(r"worker [01] died \(exit code -9\)", line) and "is whole, --resume it" in line
    assert_last_checkpoint_fits(run)


def test_workers_do_not_outlive_a_killed_trainer(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS)
    with trainers.trainer(run) as process:
        trainers.wait_for_checkpoint(process, run)
        assert trainers.workers(process)
        process.kill()
        process.wait()
        wait_until(lambda: not trainers.workers(process), "the end of the workers of a killed trainer")


def test_a_loss_that_is_not_finite_ends_training_and_leaves_the_batch(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS)
    checkpoint = trainers.save_first_checkpoint(run, poison=True)
    content = checkpoint.read_bytes()
    with pytest.raises(RuntimeError, match=r"worker 0.*loss -?(inf|nan).*last checkpoint") as caught:
        trainer.train(run)
    assert f"(the batch is in {run.path / 'failed_batch.npz'})" in str(caught.value)
    with np.load(run.path / "failed_batch.npz") as batch:
        # One round of episodes: all arrays from which the loss is computed.
        assert {"inputs", "actions", "rewards", "lengths", "answers"} == set(batch.files)
        steps = len(batch["actions"])
        assert batch["actions"].shape == batch["rewards"].shape == (steps, trainers.NUM_ENVIRONMENTS)
        assert batch["lengths"].shape == batch["answers"].shape == (trainers.NUM_ENVIRONMENTS,)
        assert batch["lengths"].max() == steps
        assert len(batch["inputs"]) == batch["lengths"].sum()
    assert run.checkpointer.paths() == [checkpoint] and checkpoint.read_bytes() == content
