"""A3C's agent: processes that act and learn asynchronously on shared variables (Mnih et al., 2016)."""

import collections
from collections.abc import Generator, Iterator
import contextlib
from multiprocessing import connection, process
from typing import Any

import torch

from physexp.agents import core, learning, processes, starting
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c_learning

_POLL_SECONDS = 0.5  # At most until the caller looks for signals and checkpoints, without any update.
_LOCK_SECONDS = 0.01  # Between looks at the workers while one of them holds the lock.


class A3C(core.Agent):
    """Runs the workers and yields their updates.

    A worker's state between two updates is the number of rounds that it has played: its environments start their
    episodes, and its actions their random numbers, from that. So a checkpoint is the shared variables alone.
    """

    def __init__(self, make_environment: core.EnvironmentFactory, config: config_lib.A3CConfig):
        """Prepares the shared variables; `updates` starts the workers, each of which makes its environments."""
        self._make_environment, self._config = make_environment, config
        environment = make_environment(config.seed, 1, 1)
        network = starting.initial_network(environment, config)
        environment.close()
        self.variables = learning.Variables(network, config.num_workers).share_memory()
        self._context = processes.spawning()
        self._lock = self._context.Lock()  # Held while the variables are read or written.
        self._workers: dict[connection.Connection[None, Any], process.BaseProcess] = {}  # By the pipe each writes to.
        self._received: collections.deque[core.Update] = collections.deque()

    def save(self) -> dict[str, torch.Tensor]:
        """Returns a copy of all variables between two updates; raises WorkerError if a worker has died."""
        with self._locked():
            return super().save()

    def updates(self) -> Generator[core.Update | None, None, None]:
        """Yields each update; when a worker dies, raises WorkerError and ends the others."""
        try:
            self._start()
            while self._workers:
                self._receive(_POLL_SECONDS)
                if self._is_stopping:
                    with self._locked():  # So that no worker is killed in the middle of an update.
                        self._kill()
                if not self._received:
                    yield None
                while self._received:
                    yield self._received.popleft()
        finally:
            self._kill()
            self._workers.clear()

    def _start(self) -> None:
        with processes.inherited_by_workers():
            for index in range(self._config.num_workers):
                receiver, sender = self._context.Pipe(duplex=False)
                arguments = (index, self._make_environment, self._config, self.variables, self._lock, sender)
                started = self._context.Process(
                    target=a3c_learning.run, args=arguments, name=f"worker {index}", daemon=True
                )
                self._workers[receiver] = started
                started.start()
                sender.close()  # The worker has the only open end, so the pipe ends when it does.

    @contextlib.contextmanager
    def _locked(self) -> Iterator[None]:
        """Context in which no worker reads or writes the variables."""
        while not self._lock.acquire(timeout=_LOCK_SECONDS):
            if not self._workers:
                raise core.WorkerError("a worker was killed in the middle of an update")
            self._receive()  # The worker that holds the lock may wait for room in its pipe, or have died.
        try:
            yield
        finally:
            self._lock.release()

    def _receive(self, seconds: float = 0.0) -> None:
        """Receives the messages of workers; raises WorkerError if one has failed or died."""
        ready = connection.wait(list(self._workers), seconds)
        for pipe in [pipe for pipe in self._workers if pipe in ready]:
            try:
                message = pipe.recv()
            except (EOFError, OSError):
                ended = self._workers.pop(pipe)
                ended.join()
                if ended.exitcode and not self._is_stopping:
                    raise core.WorkerError(f"{ended.name} died (exit code {ended.exitcode})") from None
                continue
            if isinstance(message, core.WorkerError):
                raise message
            self._received.append(message)

    def _kill(self) -> None:
        for started in self._workers.values():
            processes.kill(started)
