"""Watches workers, in processes or on a cluster, and reports those that have not ended their round for long."""

from collections.abc import Callable, Collection, Sequence
import dataclasses
import time

TICK_SECONDS = 1.0
"""The longest time that counts between two looks, since nobody was silent while all processes were stopped."""


@dataclasses.dataclass(frozen=True)
class Patience:
    """Time limits for workers, s. Rounds of images take the longest: half a minute on a slow machine.

    Attributes:
      silent: for a round; a worker that takes longer is reported.
      stop: for the round under way when training ends; a worker that takes longer is killed.
    """

    silent: float = 120.0
    stop: float = 120.0


class Clock:
    """Measures the time between ticks, without the time in which this process did not run."""

    def __init__(self):
        self._looked = time.monotonic()

    def tick(self) -> float:
        """Returns the seconds since it was called last, `TICK_SECONDS` at most."""
        now = time.monotonic()
        passed, self._looked = min(now - self._looked, TICK_SECONDS), now
        return passed


class Watch:
    """Measures for how long each worker has been at its round; reports those that fall silent or resume."""

    def __init__(
        self, rounds: Sequence[int], name: Callable[[int], str], patience: Patience, tell: Callable[[str], None]
    ):
        """Starts watching.

        Args:
          rounds: how many each worker has played.
          name: names a worker, from its index.
          patience: how long is waited.
          tell: called with lines.
        """
        self._rounds, self._name, self._patience, self._tell = list(rounds), name, patience, tell
        self._idle, self._since = [0.0] * len(rounds), [time.time()] * len(rounds)
        self._silent: set[int] = set()
        self._clock = Clock()

    def idle(self, worker: int) -> float:
        """Returns for how long a worker has been at its round, s."""
        return self._idle[worker]

    def look(self, rounds: Sequence[int], running: Collection[int]) -> None:
        """Looks at all workers.

        Args:
          rounds: how many each has played.
          running: those that are at work.
        """
        passed = self._clock.tick()
        for worker, played in enumerate(rounds):
            if played != self._rounds[worker] and worker in self._silent:
                self._silent.remove(worker)
                self._tell(f"{self._name(worker)} is back")
            if played != self._rounds[worker] or worker not in running:
                self._rounds[worker], self._idle[worker], self._since[worker] = played, 0.0, time.time()
                continue
            self._idle[worker] += passed
            if self._idle[worker] >= self._patience.silent and worker not in self._silent:
                self._silent.add(worker)
                since = time.strftime("%H:%M:%S", time.localtime(self._since[worker]))
                goes_on = "goes on with the others" if set(running) - self._silent else "waits"
                self._tell(f"{self._name(worker)} has been silent since {since}; training {goes_on}")
