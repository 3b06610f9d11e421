"""Requests to end: Ctrl-C, SIGTERM from a scheduler or a container, SIGHUP from a closed terminal."""

from collections.abc import Callable, Iterator
import contextlib
import math
import signal
import threading
import time

from physexp.agents import processes

TOGETHER_SECONDS = 1.0
"""Signals that arrive this close count as one: many senders signal a process and then its whole group."""


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
    """Context in which a request to end raises Interrupted, in the main thread.

    A library may turn the exception into an error of its own, as imports of MuJoCo do. So an error that leaves the
    context after a request is raised as Interrupted, too.
    """
    received: list[int] = []

    def receive(number: int) -> None:
        received.append(number)
        _raise(number)

    with _handled(receive):
        try:
            yield
        except (Exception, KeyboardInterrupt) as error:
            if received:
                raise Interrupted(received[0]) from error
            raise


class Interruption(contextlib.AbstractContextManager):
    """Context in which the first request to end calls a function, and the second raises Interrupted.

    Attributes:
      happened: the exception to raise once everything is saved; None if there was no request.
    """

    def __init__(self, stop: Callable[[], None]):
        """Calls `stop` at the first request."""
        self._stop, self._handling = stop, _handled(self._receive)
        self.happened: Interrupted | None = None

    def __enter__(self):
        self._handling.__enter__()
        return self

    def __exit__(self, *error):
        self._handling.__exit__(*error)

    def _receive(self, number: int) -> None:
        if self.happened is not None:
            _raise(number)
        self.happened = Interrupted(number)
        self._stop()


def _raise(number: int) -> None:
    raise Interrupted(number)


@contextlib.contextmanager
def _handled(receive: Callable[[int], None]) -> Iterator[None]:
    """Context in which requests call a function; signals that were ignored, as by `nohup`, stay ignored."""
    last = -math.inf

    def handle(number, frame):
        nonlocal last
        now = time.monotonic()
        if now - last >= TOGETHER_SECONDS:
            last = now
            receive(number)

    previous = {}
    if threading.current_thread() is threading.main_thread():
        for number in processes.STOP_SIGNALS:
            if signal.getsignal(number) is not signal.SIG_IGN:
                previous[number] = signal.signal(number, handle)
    try:
        yield
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
