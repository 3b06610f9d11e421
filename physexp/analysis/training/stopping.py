"""Requests to end: Ctrl-C, SIGTERM from a scheduler or a container, SIGHUP from a terminal that is gone."""

from collections.abc import Callable, Iterator
import contextlib
import math
import os
import signal
import stat
import threading
import time

from physexp.agents import processes

TOGETHER_SECONDS = 1.0
"""Requests that come this close are one, since many a sender writes to a process and then to its whole group."""

_signals: tuple[signal.Signals, ...] = processes.STOP_SIGNALS  # Those that are requests, in this process.


class Interrupted(KeyboardInterrupt):
    """This process was asked to end.

    Attributes:
      number: the signal's.
    """

    def __init__(self, number: int):
        super().__init__(number)
        self.number = number


def exit_status(error: KeyboardInterrupt) -> int:
    """Returns the exit status after a signal: 128 and its number, as 130 for Ctrl-C."""
    return 128 + getattr(error, "number", signal.SIGINT)


@contextlib.contextmanager
def raised() -> Iterator[None]:
    """A context in which a request to end raises Interrupted, in the main thread.

    Code that it comes upon, such as the import of a library, may turn it into an error of its own: an error that
    leaves the context after a request is raised as Interrupted, too.
    """
    heard: list[int] = []

    def hear(number: int) -> None:
        heard.append(number)
        _raise(number)

    with _heard(hear, TOGETHER_SECONDS):
        try:
            yield
        except (Exception, KeyboardInterrupt) as error:  # Of the kind, too, but without its number.
            if heard:
                raise Interrupted(heard[0]) from error
            raise


class Interruption:
    """A context that turns the first request to end into a call; the second raises Interrupted.

    Attributes:
      happened: what to raise when all is in order; None when nobody has asked.
    """

    def __init__(self, stop: Callable[[], None], together_seconds: float = TOGETHER_SECONDS):
        self._stop = stop
        self._handling = _heard(self._hear, together_seconds)
        self.happened: Interrupted | None = None

    def __enter__(self):
        self._handling.__enter__()
        return self

    def __exit__(self, *raised_now):
        self._handling.__exit__(*raised_now)

    def _hear(self, number: int) -> None:
        if self.happened is not None:
            _raise(number)
        self.happened = Interrupted(number)
        self._stop()


def obey(wait: Callable[[], object]) -> None:
    """Lets a child's process be asked by its parent, and by nobody else.

    Args:
      wait: returns when the parent asks; called in a thread of its own.
    """
    global _signals
    _signals = (signal.SIGUSR1,)
    signal.signal(signal.SIGUSR1, lambda number, frame: _raise(number))

    def pass_on() -> None:
        with contextlib.suppress(EOFError, OSError):  # The parent is gone, without having asked.
            wait()
            os.kill(os.getpid(), signal.SIGUSR1)

    threading.Thread(target=pass_on, daemon=True).start()


def _raise(number: int) -> None:
    raise Interrupted(number)


@contextlib.contextmanager
def _heard(hear: Callable[[int], None], together_seconds: float) -> Iterator[None]:
    """A context in which requests to end are heard; those that were ignored, by `nohup` for one, stay ignored."""
    last = -math.inf

    def handle(number, frame):
        nonlocal last
        now = time.monotonic()
        if now - last >= together_seconds:
            last = now
            _let_go_of_a_terminal_that_is_gone()
            hear(number)

    previous = {}
    if threading.current_thread() is threading.main_thread():
        for number in _signals:
            if signal.getsignal(number) is not signal.SIG_IGN:
                previous[number] = signal.signal(number, handle)
    try:
        yield
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)


def _let_go_of_a_terminal_that_is_gone() -> None:
    """Lets what is still to be said go nowhere, where saying it would fail: a checkpoint is yet to be written."""
    for descriptor in (1, 2):
        with contextlib.suppress(OSError):  # It may be closed.
            if stat.S_ISCHR(os.fstat(descriptor).st_mode) and not os.isatty(descriptor):
                null = os.open(os.devnull, os.O_WRONLY)
                os.dup2(null, descriptor)
                os.close(null)
