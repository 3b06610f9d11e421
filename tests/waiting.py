"""Waits for states in tests, for as long as processes make progress, on a slow machine too; imports little."""

import contextlib
import os
import signal
import subprocess
import tempfile
import time

import psutil

_IDLE_SECONDS = 60.0  # The longest time without any progress.
_BUSY_SECONDS = 600.0  # The most processor time that the processes may use; it does not depend on the load.


class Patience:
    """Watches processes; over when they have idled for long, or used much time in vain."""

    def __init__(self, pid: int | None = None):
        """Watches `pid`, its descendants and the group that it leads; by default all descendants of this process.

        A process that is forked from the server of `commands` is in its parent's group, but is no descendant of it.
        """
        self._pid = pid
        self._used: dict[int, float] = {}
        self._look()
        self._first, self._last_progress = self._total(), time.monotonic()
        self._next_look = self._last_progress + 1.0

    def is_over(self) -> bool:
        """Whether to give up; looks at the processes once a second."""
        now = time.monotonic()
        if now < self._next_look:
            return False
        before = self._total()
        self._look()
        if self._total() > before + 0.03 * (now - self._next_look + 1.0):  # Less is only polling.
            self._last_progress = now
        self._next_look = now + 1.0
        return now - self._last_progress > _IDLE_SECONDS or self._total() - self._first > _BUSY_SECONDS

    def __str__(self):
        idle = time.monotonic() - self._last_progress
        return f"{self._total() - self._first:.0f} s of processor time used, the last {idle:.0f} s ago"

    def _look(self) -> None:
        try:
            root = psutil.Process(self._pid or os.getpid())
            watched = root.children(recursive=True) + (self._group() if self._pid else [])
        except psutil.NoSuchProcess:
            return
        for process in watched:
            try:
                times = process.cpu_times()
            except psutil.NoSuchProcess:
                continue
            self._used[process.pid] = times.user + times.system

    def _group(self) -> list[psutil.Process]:
        found = []
        for process in psutil.Process().children(recursive=True):
            with contextlib.suppress(ProcessLookupError):
                if self._pid in (process.pid, os.getpgid(process.pid)):
                    found.append(process)
        return found

    def _total(self) -> float:
        return sum(self._used.values())


def wait_until(condition, name, pid=None):
    """Waits until a condition is true, and returns its value; fails if `Patience` is over."""
    patience = Patience(pid)
    while not (seen := condition()):
        assert not patience.is_over(), f"waited in vain for {name}: {patience}"
        time.sleep(0.02)
    return seen


def run(command, **kwargs) -> str:
    """Runs a program to its end and returns its output; fails if the program does, or makes no progress."""
    with tempfile.TemporaryFile("w+", errors="replace") as written:

        def so_far():
            written.seek(0)
            return written.read()

        with subprocess.Popen(
            list(map(str, command)), stdout=written, stderr=written, start_new_session=True, **kwargs
        ) as process:
            try:
                wait_until(lambda: process.poll() is not None, f"the end of {command}", pid=process.pid)
            except AssertionError as error:
                raise AssertionError(f"{error}; it wrote: {so_far()}") from None
            finally:
                if process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)
        assert process.returncode == 0, f"{command} ended with status {process.returncode}; it wrote: {so_far()}"
        return so_far()
