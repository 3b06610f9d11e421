"""Jobs in processes of their own, some at a time: one that is killed or hangs fails, and the others go on."""

from collections.abc import Callable
from concurrent import futures
import contextlib
import threading
import time
from typing import Any

from physexp.agents import processes
from physexp.analysis.training import callbacks, stopping

_BEAT_SECONDS = 1.0  # Between two signs of life of a job.
_LEAVE_SECONDS = 30.0  # For a process that has said its last word.


class Failed(RuntimeError):
    """A job's process has died."""


class Processes:
    """Runs jobs; a context that leaves no process behind.

    A job that is asked to end gets stopping.Interrupted, or a call where it has an Interruption.
    """

    def __init__(
        self,
        work: Callable,
        num_processes: int,
        tell: callbacks.Tell,
        silent_seconds: float = 60.0,
        stop_seconds: float = 300.0,
    ):
        """Starts nothing yet.

        Args:
          work: does a job: called in a process, with something to call with lines, and the job's arguments.
          num_processes: how many at a time.
          tell: called with lines: those of jobs, and one when a job is silent, or killed.
          silent_seconds: without a sign of life, until a line says so.
          stop_seconds: for a job to end that was asked to, before it is killed.
        """
        self._work, self._tell = work, tell
        self._silent_seconds, self._stop_seconds = silent_seconds, stop_seconds
        self._context = processes.spawning()
        self._threads = futures.ThreadPoolExecutor(num_processes)
        self._starting = threading.Lock()
        self._stopping = self._killing = False

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._stopping = self._killing = True  # Nobody waits for those that still run.
        self._threads.shutdown(cancel_futures=True)

    def submit(self, name: str, *arguments) -> futures.Future:
        """Runs a job as soon as there is room; the future raises what it raised, or Failed."""
        return self._threads.submit(self._run, name, arguments)

    def stop(self) -> None:
        """Asks all jobs to end; may be called by a signal's handler."""
        self._stopping = True

    def _run(self, name: str, arguments: tuple) -> None:
        if self._stopping:
            raise futures.CancelledError
        ours, theirs = self._context.Pipe()
        process = self._context.Process(target=_begin, args=(theirs, self._work, arguments), name=name)
        with self._starting, processes.stop_signals_blocked():
            process.start()
        theirs.close()
        try:
            error = self._follow(f"{name} (process {process.pid})", ours)
            process.join(_LEAVE_SECONDS)
        except (EOFError, OSError):
            process.join(_LEAVE_SECONDS)
            raise Failed(f"its process died without a word (exit code {process.exitcode})") from None
        finally:
            processes.kill(process)
            ours.close()
        if error is not None:
            raise error

    def _follow(self, name: str, job) -> BaseException | None:
        """Listens to a job until it is done; returns what it raised."""
        silent, stopping_for, told, asked = 0.0, 0.0, False, False
        while True:
            if self._stopping and not asked:
                asked = True
                job.send(None)
            start = time.monotonic()
            if job.poll(_BEAT_SECONDS / 5):
                kind, content = job.recv()
                silent = 0.0
                if told:
                    told = False
                    self._tell(f"{name} is back")
                if kind == "line":
                    self._tell(content)
                elif kind == "end":
                    return content
            passed = min(time.monotonic() - start, _BEAT_SECONDS)  # More, and this process was stopped as well.
            silent, stopping_for = silent + passed, stopping_for + passed if asked else 0.0
            if silent >= self._silent_seconds and not told:
                told = True
                self._tell(f"{name} has given no sign of life for {silent:.0f} s")
            if self._killing or stopping_for >= self._stop_seconds:
                if not self._killing:
                    self._tell(f"{name} did not end within {self._stop_seconds:.0f} s, and was killed")
                raise Failed("it was killed")


def _begin(parent, work: Callable, arguments: tuple) -> None:
    """A job's process."""
    processes.begin()
    stopping.obey(parent.recv)
    sending = threading.Lock()

    def send(kind: str, content: Any = None) -> None:
        with sending, contextlib.suppress(BrokenPipeError):  # The parent has died, and so does this process.
            parent.send((kind, content))

    def beat() -> None:
        while True:
            send("beat")
            time.sleep(_BEAT_SECONDS)

    threading.Thread(target=beat, daemon=True).start()
    try:
        work(lambda line: send("line", line), *arguments)
        outcome = None
    except BaseException as error:
        outcome = error
    try:
        send("end", outcome)
    except Exception:  # It cannot be pickled.
        send("end", RuntimeError(repr(outcome)))
