"""A3C's agent: processes that act and learn asynchronously on shared variables (Mnih et al., 2016)."""

from collections.abc import Callable
import ctypes
import dataclasses
import queue

from physexp.agents import core, learning, processes, starting
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c_learning
from physexp.agents.a3c import watching
from physexp.agents.a3c import worker as worker_lib

_LOCK_SECONDS = 5.0  # To get the lock that is held for milliseconds.


@dataclasses.dataclass(frozen=True)
class Patience(watching.Patience):
    """Time limits for workers, s.

    Attributes:
      locked: for one hold of the lock of the shared variables; after it, training ends with an error.
      told: for the last rounds when training ends; after it, a line says which workers are waited for.
    """

    locked: float = 60.0
    told: float = 10.0


class A3C(core.Agent):
    """Runs the workers and yields their updates.

    A worker's state between updates is one number, the rounds it has played: environments start their episodes, and
    actions their random numbers, from it. So a checkpoint is the shared variables and nothing else.
    """

    def __init__(
        self,
        make_environment: core.EnvironmentFactory,
        config: config_lib.A3CConfig,
        tell: Callable[[str], None] = lambda line: None,
        patience: Patience = Patience(),
    ):
        """Prepares the shared variables; the workers start with `updates`.

        Args:
          make_environment: called in each worker; must be picklable.
          config: the configuration.
          tell: called with a line when a worker falls silent, is back, or is killed.
          patience: how long is waited for a worker.
        """
        self._make_environment, self._config = make_environment, config
        self._tell, self._patience = tell, patience
        self._context = processes.spawning()
        self._stopping = self._context.RawValue(ctypes.c_bool, False)  # Without a lock, that a worker might keep.
        environment = make_environment(config.seed, 1, 1)
        network = starting.initial_network(environment, config)
        environment.close()
        self.shared = a3c_learning.SharedMemory(
            learning.Variables(network, config.num_workers), self._context.Lock(), config.max_staleness
        )
        self._received: queue.SimpleQueue[core.Update | core.WorkerError] = queue.SimpleQueue()
        self._workers: list[worker_lib.Worker] = []
        self._start_watching()
        self._whole = True  # Whether the variables are: a worker may have died in the middle of an update.

    @property
    def frames(self):
        return self.shared.variables.frames.item()

    def save(self):
        """Does what `Agent.save` says; raises WorkerError if a worker has died, or keeps the variables to itself."""
        if not self._whole:
            raise core.WorkerError("a worker was killed in the middle of an update")
        while not self.shared.lock.acquire(timeout=watching.TICK_SECONDS):
            self._check_workers()  # One that was killed while it held the lock never gives it back.
            self._look()
        try:
            return self.shared.variables.save()
        finally:
            self.shared.lock.release()

    def restore(self, tensors):
        self.shared.restore(tensors)
        self._whole = True

    def updates(self, poll_seconds=0.5):
        """Does what `Agent.updates` says; when a worker dies, the others are ended."""
        try:
            self._start()
            while True:
                running = any(worker.is_heard() for worker in self._workers)
                self._check_workers()
                try:
                    update = self._received.get(timeout=poll_seconds if running else 0.01)
                except queue.Empty:
                    if not running:
                        break
                    update = None
                if isinstance(update, core.WorkerError):
                    raise update
                self._look()
                if self._stopping.value or self.frames >= self._config.frames:
                    self._hurry()
                yield update
            for worker in self._workers:
                worker.process.join(self._patience.stop)
            self._check_workers()
        finally:
            self._end()

    def stop(self):
        self._stopping.value = True

    def _start(self) -> None:
        self._received = queue.SimpleQueue()
        self._workers = [worker_lib.Worker(index) for index in range(self._config.num_workers)]
        with processes.inherited_by_workers():
            for worker in self._workers:
                worker.start(
                    self._context, self._received, self._make_environment, self._config, self.shared, self._stopping
                )
        self._start_watching()

    def _start_watching(self) -> None:
        rounds = self.shared.variables.rounds.tolist()
        self._watch = watching.Watch(rounds, lambda index: self._workers[index].name, self._patience, self._tell)
        self._lock_watch = _LockWatch(self.shared)
        self._awaited: set[int] = set()  # Workers of which a line says that they are waited for.

    def _look(self) -> None:
        """Looks at the workers; raises WorkerError if one keeps the variables to itself."""
        running = [worker.index for worker in self._workers if worker.is_heard()]
        self._watch.look(self.shared.variables.rounds.tolist(), running)
        holder, held = self._lock_watch.look()
        if held >= self._patience.locked:
            raise core.WorkerError(
                f"{self._workers[holder].name} has kept the others from the shared variables for "
                f"{self._patience.locked:.0f} s"
            )

    def _check_workers(self) -> None:
        """Raises WorkerError if a worker has died of itself."""
        for worker in self._workers:
            if not worker.is_killed and worker.process.exitcode not in (None, 0):
                raise core.WorkerError(
                    f"worker {worker.index} died without a word (exit code {worker.process.exitcode})"
                )

    def _hurry(self) -> None:
        """Ends training with the rounds that are under way, and kills those who do not end theirs."""
        for worker in self._workers:
            if not worker.is_heard():
                continue
            idle = self._watch.idle(worker.index)
            left = self._patience.stop - idle
            if left <= 0:
                self._kill(worker)
            elif idle >= self._patience.told and worker.index not in self._awaited:
                self._awaited.add(worker.index)
                self._tell(f"waiting for {worker.name} to end its round, {left:.0f} s at most")

    def _kill(self, worker: worker_lib.Worker) -> None:
        """Kills a worker, but never in the middle of an update."""
        if not self.shared.lock.acquire(timeout=watching.TICK_SECONDS):
            return  # It holds the lock, or another one does: the next look tells.
        try:
            worker.is_killed = True
            worker.end()
        finally:
            self.shared.lock.release()
        self._tell(f"{worker.name} did not end its round within {self._patience.stop:.0f} s, and was killed")

    def _end(self) -> None:
        """Kills whoever is left: what they have learned is in the variables."""
        if not self._workers:
            return
        self._whole = False
        try:
            self._whole = self.shared.lock.acquire(timeout=_LOCK_SECONDS)
        finally:
            for worker in self._workers:
                worker.end()
            self.shared.lock.acquire(block=False)  # Whoever held it, we or a dead worker, gives it back.
            self.shared.lock.release()
            self.shared.holder.fill_(-1)
            self._workers = []


class _LockWatch:
    """Measures for how long one worker has held the lock of the shared variables in one go."""

    def __init__(self, shared: a3c_learning.SharedMemory):
        self._shared = shared
        self._held, self._holding = 0.0, (-1, 0, 0)
        self._clock = watching.Clock()

    def look(self) -> tuple[int, float]:
        """Returns the worker that holds the lock, -1 for none, and for how long it has, s."""
        passed, variables, holder = self._clock.tick(), self._shared.variables, int(self._shared.holder)
        holding = (holder, int(variables.rounds[holder]), int(variables.updates))
        self._held = self._held + passed if holder >= 0 and holding == self._holding else 0.0
        self._holding = holding
        return holder, self._held
