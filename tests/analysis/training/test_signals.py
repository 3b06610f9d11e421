"""Requests to end: Ctrl-C, SIGTERM and SIGHUP, wherever they come from and however often."""

import os
import signal
import subprocess
import sys
import textwrap

import pytest
import trainers
from trainers import PHYSEXP
from waiting import wait_until

from physexp.analysis.training import stopping

ENDLESS = 10**9


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_the_first_request_is_a_call_and_the_second_is_raised(number):
    stopped = []
    interruption = stopping.Interruption(lambda: stopped.append(1), together_seconds=0)
    with pytest.raises(stopping.Interrupted) as caught, interruption:
        os.kill(os.getpid(), number)
        assert stopped == [1] and interruption.happened.number == number
        os.kill(os.getpid(), number)
    assert stopped == [1]
    assert stopping.exit_status(caught.value) == 128 + number
    assert stopping.exit_status(KeyboardInterrupt()) == 130


def test_requests_that_come_together_are_one():
    stopped = []
    with stopping.Interruption(lambda: stopped.append(1), together_seconds=3600.0):
        for number in (signal.SIGTERM, signal.SIGTERM, signal.SIGHUP):
            os.kill(os.getpid(), number)
    assert stopped == [1]


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


def test_what_was_ignored_stays_ignored_and_handlers_are_put_back():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with stopping.raised(), stopping.Interruption(pytest.fail) as interruption:
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
            os.kill(os.getpid(), signal.SIGHUP)
        assert interruption.happened is None
    finally:
        signal.signal(signal.SIGHUP, before)
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_sigterm_to_all_processes_writes_a_checkpoint(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS, checkpoint_seconds=3600.0)
    with trainers.trainer(run) as process:
        # No checkpoint is due: what is there in the end was written because of the signal.
        wait_until(run.metrics, "a row of metrics, and so something to keep")
        os.killpg(process.pid, signal.SIGTERM)
        _, errors = process.communicate()
    assert process.returncode == 128 + signal.SIGTERM, errors
    assert errors.splitlines()[-1] == "physexp: interrupted" and "Traceback" not in errors
    assert run.checkpointer.latest() is not None


def test_a_lost_terminal_ends_training_with_a_checkpoint(tmp_path):
    run = trainers.create(tmp_path / "run", frames=ENDLESS, checkpoint_seconds=3600.0)
    command = [PHYSEXP, "train", "which_is_heavier", "features", "--run-dir", run.path, "--resume"]
    terminal, inside = os.openpty()
    with (
        subprocess.Popen(list(map(str, command)), preexec_fn=lambda: os.login_tty(inside)) as process,
        subprocess.Popen(["cat"], stdin=terminal, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as reader,
    ):
        os.close(inside)
        os.close(terminal)
        try:
            wait_until(run.metrics, "a row of metrics, and so something on the terminal")
            reader.kill()  # The last one that has the terminal open.
            wait_until(lambda: process.poll() is not None, "the end of the trainer")
            assert process.returncode == 128 + signal.SIGHUP
        finally:
            for member in trainers.group(process.pid):
                member.kill()
    assert int(run.checkpointer.latest()[0]["frames"]) == run.metrics()[-1]["frames"] > 0


def test_a_command_that_trains_nothing_ends_with_one_line():
    code = """
        import os, signal, sys
        from physexp import cli
        from physexp.cli import tasks

        tasks.Doctor.run = lambda self: (os.kill(os.getpid(), signal.SIGTERM), signal.pause())
        sys.argv = ["physexp", "doctor"]
        cli.main()
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (128 + signal.SIGTERM, "physexp: interrupted\n")
