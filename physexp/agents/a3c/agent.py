"""The agent: processes that act and learn asynchronously on shared variables (Mnih et al., 2016)."""

from collections.abc import Callable, Iterator
import contextlib
import os
import queue
import signal
import threading
import time
import traceback
from typing import Any

import torch
from torch import multiprocessing

from physexp.agents import acting, devices, learning
from physexp.agents import agent as agent_lib
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c

_STOP_SECONDS = 120.0  # For an update that is under way to finish.


class WorkerError(learning.AgentError):
    """A worker has died."""


class A3C(agent_lib.Agent):
    """Runs the workers and hands out what they do.

    A worker's state between updates is one number, the rounds it has played: environments start their episodes, and
    actions their random numbers, from it. So a checkpoint is the shared variables and nothing else.
    """

    def __init__(self, make_environment: agent_lib.EnvironmentFactory, config: config_lib.A3CConfig):
        """Prepares the shared variables; the workers start with `updates`.

        Args:
          make_environment: called in each worker; must be picklable.
          config: the configuration.
        """
        self._make_environment, self._config = make_environment, config
        self._context = multiprocessing.get_context("spawn")
        self._stopping = self._context.Event()
        self._updates = self._context.Queue()
        environment = make_environment(config.seed, 1, 1)
        network = agent_lib.initial_network(environment, config)
        environment.close()
        self.shared = a3c.SharedMemory(
            learning.Variables(network, config.num_workers), self._context.Lock(), config.max_staleness
        )
        self._workers: list[Any] = []

    @property
    def frames(self):
        return self.shared.variables.frames.item()

    def save(self):
        """As `Agent.save`; raises WorkerError if a worker has died."""
        while not self.shared.lock.acquire(timeout=1.0):
            self._check_workers()  # One that was killed while it held the lock never gives it back.
        try:
            return self.shared.variables.save()
        finally:
            self.shared.lock.release()

    def restore(self, tensors):
        self.shared.restore(tensors)

    def updates(self, poll_seconds=0.5):
        """As `Agent.updates`; when a worker dies, the others are stopped."""
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

    def stop(self):
        self._stopping.set()

    def _start(self) -> None:
        for index in range(self._config.num_workers):
            worker = self._context.Process(
                target=_work,
                args=(index, self._make_environment, self._config, self.shared, self._stopping, self._updates),
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


def _work(index, make_environment, config, shared, stopping, updates) -> None:
    """A worker's process: updates until all frames are done or it is told to stop."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Also when it was started by another thread than the main one.
    torch.set_num_threads(1)
    parent = multiprocessing.parent_process()
    try:
        for update in work(index, make_environment, config, shared, stopping.is_set):
            if parent is not None and not parent.is_alive():  # Killed: nobody is left to stop this worker.
                updates.cancel_join_thread()
                return
            updates.put(update)
    except learning.DivergedError as error:
        updates.put(WorkerError(f"worker {index}: {error}", error.batch))
    except Exception as error:
        updates.put(WorkerError(f"worker {index}: {error!r}\n{traceback.format_exc()}"))


def work(index: int, make_environment: agent_lib.EnvironmentFactory, config: config_lib.A3CConfig, shared: a3c.Shared,
         is_stopped: Callable[[], bool]) -> Iterator[agent_lib.Update]:  # fmt: skip
    """What a worker does: updates of the shared variables, until all frames are done or it is stopped."""
    seed = agent_lib.worker_seed(config.seed, index)
    environment = make_environment(seed, config.envs_per_worker, 1)
    network = agent_lib.make_network(environment, config)
    network.to(devices.choose(config.device, network.sees_images))

    def play(number: int) -> acting.Round:
        generator = agent_lib.round_generator(config.seed, index, number)
        return acting.play_round(network, environment, number, generator, differentiable=True)

    learner = a3c.A3CLearner(network, shared, play, index, config)
    frames = shared.pull(network, index).frames
    while frames < config.frames and not is_stopped():
        metrics = learner.step()
        yield agent_lib.Update(seed, metrics, learner.last_round.record())
        frames = int(metrics["frames"])
