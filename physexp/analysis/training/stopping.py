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
    """This process was asked to end, by the signal `number`."""

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
    requests: list[Interrupted] = []

    def receive(request: Interrupted) -> None:
        requests.append(request)
        raise request

    with _received(receive):
        try:
            yield
        except (Exception, KeyboardInterrupt) as error:
            if requests:
                raise Interrupted(requests[0].number) from error
            raise


@contextlib.contextmanager
def deferred(stop: Callable[[], None]) -> Iterator[list[Interrupted]]:
    """Context in which the first request to end calls `stop`, and is raised at its end; a second one is raised at once.

    Yields the requests so far.
    """
    requests: list[Interrupted] = []

    def receive(request: Interrupted) -> None:
        requests.append(request)
        if len(requests) > 1:
            raise request
        stop()

    with _received(receive):
        yield requests
    if requests:
        raise requests[0]


@contextlib.contextmanager
def _received(receive: Callable[[Interrupted], None]) -> Iterator[None]:
    """Context in which requests call a function; signals that were ignored, as by `nohup`, stay ignored."""
    last = -math.inf

    def handle(number, frame):
        nonlocal last
        now = time.monotonic()
        if now - last >= TOGETHER_SECONDS:
            last = now
            receive(Interrupted(number))

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
