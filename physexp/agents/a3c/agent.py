"""The agent: processes that act and learn asynchronously on shared variables (Mnih et al., 2016)."""

from collections.abc import Callable
import contextlib
import ctypes
import dataclasses
import queue
import threading
import time
import traceback
from typing import Any

import torch
from torch import multiprocessing

from physexp.agents import acting, devices, learning, processes
from physexp.agents import agent as agent_lib
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c

_LOCK_SECONDS = 5.0  # To get the lock that is held for milliseconds.
_TICK_SECONDS = 1.0  # The most that counts as time between two looks at the workers.


class WorkerError(learning.AgentError):
    """A worker has died."""


@dataclasses.dataclass(frozen=True)
class Patience:
    """How long is waited for a worker, s. Rounds of images take the longest: half a minute on a slow machine.

    Attributes:
      silent: until a line says that it has not ended its round.
      locked: while it keeps the shared variables to itself; then training ends.
      told: when training ends, until a line says for whom it waits.
      stop: when training ends, for the round that it is at; then it is killed.
    """

    silent: float = 120.0
    locked: float = 60.0
    told: float = 10.0
    stop: float = 120.0


class A3C(agent_lib.Agent):
    """Runs the workers and hands out what they do.

    A worker's state between updates is one number, the rounds it has played: environments start their episodes, and
    actions their random numbers, from it. So a checkpoint is the shared variables and nothing else.
    """

    def __init__(
        self,
        make_environment: agent_lib.EnvironmentFactory,
        config: config_lib.A3CConfig,
        report: Callable[[str], None] = lambda line: None,
        patience: Patience = Patience(),
    ):
        """Prepares the shared variables; the workers start with `updates`.

        Args:
          make_environment: called in each worker; must be picklable.
          config: the configuration.
          report: called with a line when a worker falls silent, is back, or is killed.
          patience: how long is waited for a worker.
        """
        self._make_environment, self._config = make_environment, config
        self._report, self._patience = report, patience
        self._context = multiprocessing.get_context("spawn")
        self._stopping = self._context.RawValue(ctypes.c_bool, False)  # Without a lock, that a worker might keep.
        environment = make_environment(config.seed, 1, 1)
        network = agent_lib.initial_network(environment, config)
        environment.close()
        self.shared = a3c.SharedMemory(
            learning.Variables(network, config.num_workers), self._context.Lock(), config.max_staleness
        )
        self._received: queue.SimpleQueue[agent_lib.Update | WorkerError] = queue.SimpleQueue()
        self._workers: list[_Worker] = []
        self._watch = _Watch(self.shared, [], patience, report)
        self._awaited: list[_Worker] = []
        self._whole = True  # Whether the variables are: a worker may have died in the middle of an update.

    @property
    def frames(self):
        return self.shared.variables.frames.item()

    def save(self):
        """As `Agent.save`; raises WorkerError if a worker has died, or keeps the variables to itself."""
        if not self._whole:
            raise WorkerError("a worker was killed in the middle of an update")
        while not self.shared.lock.acquire(timeout=_TICK_SECONDS):
            self._check_workers()  # One that was killed while it held the lock never gives it back.
            self._watch.look()
        try:
            return self.shared.variables.save()
        finally:
            self.shared.lock.release()

    def restore(self, tensors):
        self.shared.restore(tensors)
        self._whole = True

    def updates(self, poll_seconds=0.5):
        """As `Agent.updates`; when a worker dies, the others are ended."""
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
                if isinstance(update, WorkerError):
                    raise update
                self._watch.look()
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
        self._workers = [_Worker(index) for index in range(self._config.num_workers)]
        with processes.inherited_by_workers():
            for worker in self._workers:
                worker.start(
                    self._context, self._received, self._make_environment, self._config, self.shared, self._stopping
                )
        self._watch = _Watch(self.shared, self._workers, self._patience, self._report)

    def _check_workers(self) -> None:
        for worker in self._workers:
            if not worker.killed and worker.process.exitcode not in (None, 0):
                raise WorkerError(f"worker {worker.index} died without a word (exit code {worker.process.exitcode})")

    def _hurry(self) -> None:
        """Ends training with the rounds that are under way, and kills those who do not end theirs."""
        for worker in self._workers:
            if not worker.is_heard():
                continue
            left = self._patience.stop - self._watch.idle(worker)
            if left <= 0:
                self._kill(worker)
            elif self._watch.idle(worker) >= self._patience.told and worker not in self._awaited:
                self._awaited.append(worker)
                self._report(f"waiting for {worker.name} to end its round, {left:.0f} s at most")

    def _kill(self, worker: "_Worker") -> None:
        """Kills a worker, but never in the middle of an update."""
        if not self.shared.lock.acquire(timeout=_TICK_SECONDS):
            return  # It holds the lock, or another one does: the next look tells.
        try:
            worker.killed = True
            processes.kill(worker.process)
        finally:
            self.shared.lock.release()
        self._report(f"{worker.name} did not end its round within {self._patience.stop:.0f} s, and was killed")

    def _end(self) -> None:
        """Kills whoever is left: what they have learned is in the variables."""
        self.stop()
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


class _Worker:
    """A worker's process, and the thread that receives what it sends.

    Each has its own pipe: in one that they share, what is sent by one that was stopped blocks all others.
    """

    def __init__(self, index: int):
        self.index, self.killed = index, False
        self.process: Any = None
        self._listener = threading.Thread(target=self._listen, daemon=True)

    @property
    def name(self) -> str:
        return f"worker {self.index} (process {self.process.pid})"

    def start(self, context, received, *arguments) -> None:
        self._receiver, sender = context.Pipe(duplex=False)
        self._received = received
        self.process = context.Process(
            target=_work, args=(self.index, *arguments, sender), name=f"physexp worker {self.index}", daemon=True
        )
        self.process.start()
        sender.close()  # So that the pipe ends with the worker.
        self._listener.start()

    def is_heard(self) -> bool:
        """Whether it runs, or has sent what was not received yet."""
        return self._listener.is_alive()

    def end(self) -> None:
        if self.process is not None:
            processes.kill(self.process)

    def _listen(self) -> None:
        with self._receiver, contextlib.suppress(EOFError, OSError):  # It was killed, perhaps while it was sending.
            while True:
                self._received.put(self._receiver.recv())


class _Watch:
    """Knows how long each worker has been at its round.

    What counts is time in which this process ran, too: when all of them were stopped and go on, nobody was silent.
    """

    def __init__(
        self, shared: a3c.SharedMemory, workers: list[_Worker], patience: Patience, report: Callable[[str], None]
    ):
        self._shared, self._workers, self._patience, self._report = shared, workers, patience, report
        self._rounds = self._shared.variables.rounds.tolist()
        self._idle, self._since = [0.0] * len(workers), [time.time()] * len(workers)
        self._told: set[int] = set()
        self._held, self._holding = 0.0, (-1, 0, 0)
        self._looked = time.monotonic()

    def idle(self, worker: _Worker) -> float:
        """For how long it has been at its round, s."""
        return self._idle[worker.index]

    def look(self) -> None:
        """Looks at all of them.

        Raises:
          WorkerError: if one keeps the variables to itself.
        """
        now = time.monotonic()
        passed, self._looked = min(now - self._looked, _TICK_SECONDS), now
        for worker in self._workers:
            self._look_at(worker, passed)
        variables, holder = self._shared.variables, int(self._shared.holder)
        holding = (holder, int(variables.rounds[holder]), int(variables.updates))
        self._held = self._held + passed if holder >= 0 and holding == self._holding else 0.0
        self._holding = holding
        if self._held >= self._patience.locked:
            raise WorkerError(
                f"{self._workers[holder].name} has kept the others from the shared variables for "
                f"{self._patience.locked:.0f} s"
            )

    def _look_at(self, worker: _Worker, passed: float) -> None:
        index, rounds = worker.index, int(self._shared.variables.rounds[worker.index])
        if rounds != self._rounds[index]:
            if index in self._told:
                self._told.remove(index)
                self._report(f"{worker.name} is back")
            self._rounds[index], self._idle[index], self._since[index] = rounds, 0.0, time.time()
        else:
            self._idle[index] += passed
        if self._idle[index] >= self._patience.silent and index not in self._told and worker.is_heard():
            self._told.add(index)
            since = time.strftime("%H:%M:%S", time.localtime(self._since[index]))
            others = any(other.is_heard() and other.index not in self._told for other in self._workers)
            self._report(
                f"{worker.name} has been silent since {since}; training "
                f"{'goes on with the others' if others else 'waits'}"
            )


def _work(index, make_environment, config, shared, stopping, sender) -> None:
    """A worker's process: updates until all frames are done or it is told to stop."""
    processes.begin()
    torch.set_num_threads(1)
    seed = agent_lib.worker_seed(config.seed, index)
    shared.record = lambda contribution, counters: sender.send(
        agent_lib.Update(seed, contribution.metrics | counters, contribution.episodes)
    )
    try:
        work(index, make_environment, config, shared, lambda: stopping.value)
    except learning.DivergedError as error:
        sender.send(WorkerError(f"worker {index}: {error}", error.batch))
    except Exception as error:
        sender.send(WorkerError(f"worker {index}: {error!r}\n{traceback.format_exc()}"))


def work(
    index: int,
    make_environment: agent_lib.EnvironmentFactory,
    config: config_lib.A3CConfig,
    shared: a3c.Shared,
    is_stopped: Callable[[], bool],
) -> None:
    """What a worker does: updates of the shared variables, until all frames are done or it is stopped."""
    environment = make_environment(agent_lib.worker_seed(config.seed, index), config.envs_per_worker, 1)
    network = agent_lib.make_network(environment, config)
    network.to(devices.choose(config.device, network.sees_images))

    def play(number: int) -> acting.Round:
        generator = agent_lib.round_generator(config.seed, index, number)
        return acting.play_round(network, environment, number, generator, differentiable=True)

    learner = a3c.A3CLearner(network, shared, play, index, config)
    frames = shared.pull(network, index).frames
    while frames < config.frames and not is_stopped():
        frames = int(learner.step()["frames"])
