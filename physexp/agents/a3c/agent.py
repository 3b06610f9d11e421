"""The agent: processes that act and learn asynchronously on shared variables (Mnih et al., 2016)."""

from collections.abc import Callable, Iterator
import contextlib
import dataclasses
import os
import queue
import signal
import threading
import time
import traceback
from typing import Any

import numpy as np
import torch
from torch import multiprocessing

from physexp.agents import devices, networks
from physexp.agents.a3c import acting, learning
from physexp.agents.a3c import config as config_lib

# Makes a worker's batch of environments from its seed, its number of environments and its number of threads.
EnvironmentFactory = Callable[[int, int, int], Any]

_STOP_SECONDS = 120.0  # For an update that is under way to finish.


class WorkerError(RuntimeError):
    """A worker has died; `round` holds the episodes it choked on, where it could say."""

    def __init__(self, message: str, episodes: acting.Round | None = None):
        super().__init__(message)
        self.round = episodes


@dataclasses.dataclass(frozen=True)
class Update:
    """What one update did.

    Attributes:
      worker: who made it.
      metrics: figures of the learner; `updates` and `frames` are counted over all workers.
      episodes: the episodes it learned from, observations left out.
    """

    worker: int
    metrics: dict[str, float]
    episodes: acting.Round


def make_network(environment, config: config_lib.A3CConfig) -> networks.RecurrentActorCritic:
    """A network for an environment's specs, its weights drawn from the configuration's seed."""
    with torch.random.fork_rng():
        torch.manual_seed(config.seed)
        return networks.RecurrentActorCritic(
            environment.observation_spec(), environment.action_spec().num_values, **hyperparameters(config)
        )


def hyperparameters(config: config_lib.A3CConfig) -> dict[str, Any]:
    """What a configuration says of the network, as its keyword arguments."""
    return {"lstm_units": config.lstm_units, "observation_scale": config.observation_scale}


class A3C:
    """Runs the workers and hands out what they do.

    A worker's state between updates is one number, the rounds it has played: environments start their episodes, and
    actions their random numbers, from it. So a checkpoint is the shared variables and nothing else.
    """

    def __init__(self, make_environment: EnvironmentFactory, config: config_lib.A3CConfig):
        """Prepares the shared variables; the workers start with `updates`.

        Args:
          make_environment: called in each worker; must be picklable.
          config: the configuration.
        """
        self._make_environment, self._config = make_environment, config
        environment = make_environment(config.seed, 1, 1)
        self._context = multiprocessing.get_context("spawn")
        self._lock = self._context.Lock()
        self._stopping = self._context.Event()
        self._updates = self._context.Queue()
        network = make_network(environment, config)
        network.prefer(config.action_prior)
        if config.relative_pixels:
            network.calibrate(acting.as_tensors(environment.reset().observation))
        self.variables = learning.SharedVariables(network, config.num_workers)
        environment.close()
        self._workers: list[Any] = []

    @property
    def frames(self) -> int:
        """Environment steps trained on."""
        return int(self.variables.frames)

    def save(self) -> dict[str, torch.Tensor]:
        """A consistent copy of the shared variables, between two updates.

        Raises:
          WorkerError: if a worker has died.
        """
        while not self._lock.acquire(timeout=1.0):
            self._check_workers()  # One that was killed while it held the lock never gives it back.
        try:
            return {name: value.clone() for name, value in self.variables.tensors().items()}
        finally:
            self._lock.release()

    def restore(self, tensors: dict[str, torch.Tensor]) -> None:
        """Takes up what `save` returned; call it before `updates`.

        Raises:
          ValueError: if the tensors do not fit this configuration.
        """
        own = self.variables.tensors()
        unfit = [name for name in own if name not in tensors or tensors[name].shape != own[name].shape]
        if unfit or set(tensors) != set(own):
            raise ValueError(f"the checkpoint does not fit the configuration: it differs in {unfit or 'its names'}")
        for name, value in own.items():
            value.copy_(tensors[name])

    def updates(self, poll_seconds: float = 0.5) -> Iterator[Update | None]:
        """Trains until `frames` are reached or `stop` is called; yields each update, or None when none came in time.

        Raises:
          WorkerError: if a worker dies; the others are stopped.
        """
        self._start()
        try:
            while True:
                running = any(worker.is_alive() for worker in self._workers)
                self._check_workers()
                try:
                    update = self._updates.get(timeout=poll_seconds if running else 0.01)
                except queue.Empty:
                    if not running:
                        return
                    yield None
                    continue
                if isinstance(update, WorkerError):
                    raise update
                yield update
        finally:
            self._end()

    def stop(self) -> None:
        """Asks the workers to finish the update they are at."""
        self._stopping.set()

    def _start(self) -> None:
        for index in range(self._config.num_workers):
            worker = self._context.Process(
                target=_work,
                args=(index, self._make_environment, self._config, self.variables, self._lock, self._stopping,
                      self._updates),
                name=f"physexp worker {index}",
                daemon=True,
            )  # fmt: skip
            self._workers.append(worker)
        with _inherited_by_workers():
            for worker in self._workers:
                worker.start()

    def _check_workers(self) -> None:
        for index, worker in enumerate(self._workers):
            if worker.exitcode not in (None, 0):
                raise WorkerError(f"worker {index} died without a word (exit code {worker.exitcode})")

    def _end(self) -> None:
        self._stopping.set()
        deadline = time.monotonic() + _STOP_SECONDS
        for worker in self._workers:
            while worker.is_alive() and time.monotonic() < deadline:
                try:  # A worker ends only when what it has put into the queue is taken out.
                    self._updates.get(timeout=0.05)
                except queue.Empty:
                    worker.join(0.05)
                if any(other.exitcode not in (None, 0) for other in self._workers):
                    deadline = min(deadline, time.monotonic() + 2.0)  # The dead one may hold the lock.
            if worker.is_alive():
                worker.terminate()
                worker.join()
        self._workers = []


@contextlib.contextmanager
def _inherited_by_workers():
    """What processes inherit that are started here: one thread for torch, and no ear for Ctrl-C.

    The terminal sends Ctrl-C to every process; it is the parent that asks the workers to stop.
    """
    threads = os.environ.get("OMP_NUM_THREADS")
    os.environ["OMP_NUM_THREADS"] = "1"  # Read when a worker imports torch.
    in_main = threading.current_thread() is threading.main_thread()
    handler = signal.signal(signal.SIGINT, signal.SIG_IGN) if in_main else None
    try:
        yield
    finally:
        if in_main:
            signal.signal(signal.SIGINT, handler)
        if threads is None:
            del os.environ["OMP_NUM_THREADS"]
        else:
            os.environ["OMP_NUM_THREADS"] = threads


def _work(index, make_environment, config, shared, lock, stopping, updates) -> None:
    """A worker's process: updates until all frames are done or it is told to stop."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Also when it was started by another thread than the main one.
    torch.set_num_threads(1)
    parent = multiprocessing.parent_process()
    try:
        environment = make_environment(worker_seed(config.seed, index), config.envs_per_worker, 1)
        network = make_network(environment, config)
        network.to(devices.choose(config.device, network.sees_images))
        rounds = _rounds(index, network, environment, config, shared)
        learner = learning.A3CLearner(network, shared, lock, rounds, index, config)
        while not stopping.is_set() and int(shared.frames) < config.frames:
            metrics = learner.step()
            if parent is not None and not parent.is_alive():  # Killed: nobody is left to stop this worker.
                updates.cancel_join_thread()
                return
            updates.put(Update(index, metrics, dataclasses.replace(learner.last_round, inputs=None)))
    except learning.DivergedError as error:
        updates.put(WorkerError(f"worker {index}: {error}", error.round))
    except Exception as error:
        updates.put(WorkerError(f"worker {index}: {error!r}\n{traceback.format_exc()}"))


def _rounds(index, network, environment, config, shared) -> Iterator[acting.Round]:
    """Rounds of episodes; each follows from its number alone."""
    while True:
        number = int(shared.rounds[index])
        generator = np.random.default_rng([config.seed, index, number])
        yield acting.play_round(network, environment, number, generator, differentiable=True)


def worker_seed(seed: int, index: int) -> int:
    """The seed of a worker's environments."""
    return int(np.random.SeedSequence([seed, index]).generate_state(1, np.uint32)[0])
