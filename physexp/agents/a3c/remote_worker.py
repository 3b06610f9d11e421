"""A worker on a cluster: an actor of Ray that acts, learns and exchanges gradients for parameters."""

from collections.abc import Callable
import dataclasses
from typing import Any

import numpy as np
import ray
import torch

from physexp.agents import core, starting
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c_learning
from physexp.agents.a3c import parameter_server
from physexp.agents.a3c import worker as worker_lib


class RemoteVariables(a3c_learning.Shared):
    """A worker's access to the variables that a parameter server keeps.

    With `overlaps`, the worker plays the next round while its gradient is sent, with the variables that came last: it
    reads the answer one round later.
    """

    def __init__(self, server, seed: int, overlaps: bool):
        """Connects to a parameter server; `seed` is that of the worker's environments."""
        self._server, self._seed, self._overlaps = server, seed, overlaps
        self._reply: parameter_server.Reply | None = None  # The last that was looked at.
        self._sent: Any = None  # What has not been answered yet, or not been looked at.
        self._episode = 0

    @property
    def goes_on(self) -> bool:
        """Returns whether another round is wanted."""
        return self._reply is None or self._reply.goes_on

    def pull(self, network, worker):
        if self._reply is None:
            self._reply = self._answer(self._send(worker, None, None))
            self._episode = self._reply.pulled.episode
        network.load_state_dict({name: torch.tensor(value) for name, value in self._reply.variables.items()})
        return dataclasses.replace(self._reply.pulled, episode=self._episode)

    def push(self, contribution):
        vector = torch.cat([gradient.flatten().cpu() for gradient in contribution.gradients]).numpy()
        sent = self._send(contribution.worker, vector, dataclasses.replace(contribution, gradients=[]))
        self._episode += 1
        before, self._sent = (self._sent, sent) if self._overlaps else (sent, None)
        if before is not None:
            self._reply = self._answer(before)
        assert self._reply is not None  # Parameters were pulled before anything could be learned.
        return {"frames": self._reply.pulled.frames, "updates": self._reply.pulled.updates}

    def save(self):
        return ray.get(self._server.save.remote())

    def restore(self, tensors):
        ray.get(self._server.restore.remote(tensors))
        self._reply = self._sent = None

    def flush(self) -> None:
        """Waits until everything that was sent has arrived."""
        if self._sent is not None:
            self._reply, self._sent = self._answer(self._sent), None

    def _send(self, worker: int, gradient: np.ndarray | None, contribution: a3c_learning.Contribution | None):
        return self._server.exchange.remote(worker, self._seed, gradient, contribution)

    def _answer(self, sent) -> parameter_server.Reply:
        try:
            return ray.get(sent)
        except ray.exceptions.RayActorError as error:
            raise server_died(error) from None


class Worker:
    """Acts and learns."""

    def ready(self) -> None:
        """Returns once the worker's process runs."""

    def run(
        self,
        server,
        index: int,
        make_environment: core.EnvironmentFactory,
        config: config_lib.A3CConfig,
        versions: dict[str, str],
        find_versions: Callable[[], dict[str, str]],
    ) -> None:
        """Works until all frames are done or the server stops it.

        Args:
          server: the parameter server.
          index: of the worker.
          make_environment: makes a batch.
          config: the agent's configuration.
          versions: what is installed on the driver's machine.
          find_versions: says what is installed on this one.

        Raises:
          AgentError: if this machine has other versions than the driver's, or the loss is not finite.
          VariablesLostError: if the server dies.
        """
        own = find_versions()
        differing = [f"{name} {own[name]}, not {versions[name]}" for name in versions if own[name] != versions[name]]
        if differing:
            raise core.AgentError(
                f"{ray.util.get_node_ip_address()} has {', '.join(differing)}; install the "
                "versions of the machine that trains"
            )
        torch.set_num_threads(1)
        # Alone, a worker learns the same as on one machine: it waits for what it has learned.
        shared = RemoteVariables(server, starting.worker_seed(config.seed, index), overlaps=config.num_workers > 1)
        worker_lib.work(index, make_environment, config, shared, lambda: not shared.goes_on)
        shared.flush()


def server_died(error: Exception) -> core.VariablesLostError:
    """Returns what is raised where Ray finds no parameter server."""
    return core.VariablesLostError(f"the parameter server has died: {first_line(error)}")


def first_line(error: Exception) -> str:
    """Returns the first line of what Ray says."""
    return next(line.strip() for line in str(error).splitlines() if line.strip())
