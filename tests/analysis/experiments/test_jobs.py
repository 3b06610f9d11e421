"""Jobs in processes of their own: one that is killed, or hangs, takes no other with it."""

from concurrent import futures
import os
from pathlib import Path
import signal
import time

import pytest
from waiting import wait_until

from physexp.analysis.experiments import jobs
from physexp.analysis.training import stopping


def wait_for(tell, path):
    tell(f"started {os.getpid()}")
    while not path.exists():
        time.sleep(0.01)


def until_asked(tell, path):
    asked = []
    with stopping.Interruption(lambda: asked.append(1)) as interruption:
        tell(f"started {os.getpid()}")
        while not asked:
            time.sleep(0.01)
    path.write_text("a checkpoint")
    raise interruption.happened


def find_nothing(tell, path):
    path.read_text()


def begun(lines):
    return [int(line.split()[1]) for line in lines if line.startswith("started")]


def result_of(future):
    wait_until(future.done, "the end of a job")
    return future.result()


def test_a_killed_job_fails_alone(tmp_path):
    lines = []
    with jobs.Processes(wait_for, 2, lines.append) as pool:
        pending = [pool.submit(f"job {index}", tmp_path / "go") for index in range(2)]
        wait_until(lambda: len(begun(lines)) == 2, "two jobs")
        os.kill(begun(lines)[0], signal.SIGKILL)
        (first, *_), _ = futures.wait(pending, return_when=futures.FIRST_COMPLETED)
        with pytest.raises(jobs.Failed, match=r"its process died without a word \(exit code -9\)"):
            first.result()
        (tmp_path / "go").touch()
        (other,) = set(pending) - {first}
        assert other.result() is None


def test_what_a_job_raises_is_told_even_if_it_is_an_error_of_files(tmp_path):
    with jobs.Processes(find_nothing, 1, print) as pool, pytest.raises(FileNotFoundError, match="no such folder"):
        result_of(pool.submit("one", tmp_path / "no such folder" / "file"))


def test_a_stopped_job_is_told_of_and_killed_when_all_are_asked_to_end(tmp_path):
    lines = []
    with jobs.Processes(until_asked, 1, lines.append, silent_seconds=3.0, stop_seconds=0.5) as pool:
        future, waiting = (pool.submit(name, tmp_path / name) for name in ("one", "two"))
        wait_until(lambda: begun(lines), "a job")
        (pid,) = begun(lines)
        os.kill(pid, signal.SIGSTOP)
        wait_until(lambda: f"one (process {pid}) has given no sign of life for 3 s" in lines, "a line")
        pool.stop()
        with pytest.raises(jobs.Failed, match="it was killed"):
            result_of(future)
        assert f"one (process {pid}) did not end within 0 s, and was killed" in lines
        with pytest.raises(futures.CancelledError):
            result_of(waiting)
    assert not Path(f"/proc/{pid}").exists()


def test_jobs_ignore_signals_and_end_in_order_when_their_parent_asks(tmp_path):
    lines = []
    with jobs.Processes(until_asked, 1, lines.append) as pool:
        future = pool.submit("one", tmp_path / "saved")
        wait_until(lambda: begun(lines), "a job")
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # As a terminal and a scheduler send them.
            os.kill(begun(lines)[0], number)
        pool.stop()
        with pytest.raises(stopping.Interrupted):
            result_of(future)
    assert (tmp_path / "saved").read_text() == "a checkpoint"


def test_leaving_at_once_leaves_no_process(tmp_path):
    lines = []
    with pytest.raises(stopping.Interrupted), jobs.Processes(wait_for, 1, lines.append) as pool:
        pool.submit("one", tmp_path / "never")
        wait_until(lambda: begun(lines), "a job")
        os.kill(begun(lines)[0], signal.SIGSTOP)
        raise stopping.Interrupted(signal.SIGTERM)
    assert not Path(f"/proc/{begun(lines)[0]}").exists()
