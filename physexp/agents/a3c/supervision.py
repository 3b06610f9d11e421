"""Supervises A3C's workers on a cluster: places them, sets them to work, and restarts those that die."""

from collections.abc import Callable, Collection
import time
from typing import Any

import ray

from physexp.agents import core
from physexp.agents.a3c import remote_worker

_POLL_SECONDS = 0.1  # Between looks at what the workers have done.
_MAX_DEATHS = 5  # Of a worker, with no update of anybody in between.


class Workers:
    """The workers: some are running, others are coming, that is, have not been placed or are being started again.

    Attributes:
      restarts: how often one that had died was started again.
    """

    def __init__(self, num_workers: int, run: Callable[[Any, int], Any], tell: Callable[[str], None]):
        """Asks the cluster for workers.

        Args:
          num_workers: how many.
          run: sets a worker, an actor with an index, to work; returns Ray's reference.
          tell: called with a line when one has died.
        """
        make_worker = ray.remote(num_cpus=1, max_restarts=-1)(remote_worker.Worker)
        self._actors: list[Any] = [make_worker.remote() for _ in range(num_workers)]
        self._run, self._tell = run, tell
        self._running: dict[Any, int] = {}
        self._coming: dict[Any, int] = {}
        self._deaths = [0] * num_workers
        self.restarts = 0
        for index in range(num_workers):
            self._revive(index)

    @property
    def running(self) -> Collection[int]:
        """Returns the indices of those that are at work."""
        return self._running.values()

    @property
    def coming(self) -> Collection[int]:
        """Returns the indices of those that have not been placed, or are being started again."""
        return self._coming.values()

    def look(self, is_stopping: bool) -> None:
        """Waits a moment; sets those to work that have been placed, and starts those again that have died.

        Args:
          is_stopping: leave those that have died where they are.

        Raises:
          AgentError: if a worker cannot go on, or nobody has learned anything over several deaths of one.
        """
        changed, _ = ray.wait([*self._running, *self._coming], timeout=_POLL_SECONDS)
        for reference in changed:
            if reference in self._running:
                index = self._running.pop(reference)
                if not self._has_ended(reference, index, is_stopping):
                    self._revive(index)
            else:
                self._start(reference, self._coming.pop(reference))

    def forgive(self) -> None:
        """Resets the count of deaths, after an update."""
        self._deaths = [0] * len(self._deaths)

    def kill(self) -> None:
        """Ends all of them at once."""
        for actor in self._actors:
            ray.kill(actor)

    def _start(self, reference, index: int) -> None:
        """Sets a worker to work that has answered, or asks it again."""
        try:
            ray.get(reference)
        except ray.exceptions.RayActorError:
            time.sleep(_POLL_SECONDS)
            self._revive(index)
        else:
            self._running[self._run(self._actors[index], index)] = index

    def _revive(self, index: int) -> None:
        """Calls a worker, so that Ray restarts it if it has died."""
        self._coming[self._actors[index].ready.remote()] = index

    def _has_ended(self, reference, index: int, is_stopping: bool) -> bool:
        """Returns whether a worker has ended of itself; False if it has died and is to work again."""
        try:
            ray.get(reference)
        except ray.exceptions.RayActorError as error:
            if is_stopping:
                return True
            self._count_death(index, remote_worker.first_line(error))
            return False
        except core.VariablesLostError as error:
            raise _cause(error) from None
        except core.AgentError as error:
            raise core.WorkerError(f"worker {index}: {_cause(error)}", _cause(error).batch) from None
        except ray.exceptions.RayTaskError as error:
            raise core.WorkerError(f"worker {index}: {error}") from None
        return True

    def _count_death(self, index: int, what: str) -> None:
        self.restarts += 1
        self._deaths[index] += 1
        if self._deaths[index] > _MAX_DEATHS:
            raise core.WorkerError(
                f"worker {index} has died {self._deaths[index]} times, and nobody has learned anything meanwhile: "
                f"{what}"
            ) from None
        self._tell(f"worker {index} has died ({what}) and is started again; {self.restarts} so far")


class RoomWatch:
    """Reports how many workers find no room on the cluster."""

    def __init__(self, num_workers: int, patience_seconds: float, tell: Callable[[str], None]):
        """Starts watching; a line comes when workers have found no room for as long as patience lasts."""
        self._num_workers, self._patience_seconds, self._tell = num_workers, patience_seconds, tell
        self._without_room = 0
        self._crowded = time.monotonic()  # Since when some have no room.

    def look(self, coming: Collection[int]) -> None:
        """Looks at those that have not been placed."""
        now = time.monotonic()
        if not coming:
            self._crowded, self._without_room = now, 0
        elif now - self._crowded >= self._patience_seconds and len(coming) != self._without_room:
            self._without_room = len(coming)
            processors = ray.cluster_resources().get("CPU", 0)
            self._tell(
                f"{len(coming)} of {self._num_workers} workers find no room on the cluster, which has "
                f"{processors:g} processors; they join when there is some"
            )


def _cause(error: Any) -> core.AgentError:
    """Returns what a worker raised: Ray wraps it."""
    return error.cause
