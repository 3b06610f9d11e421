"""The parameter server of A3C on a cluster: one process that keeps the variables that all workers share."""

import dataclasses
import time

import numpy as np
import torch

from physexp.agents import core, learning, networks
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c_learning


@dataclasses.dataclass
class Traffic:
    """What the parameter server has done so far.

    Attributes:
      updates: gradients applied.
      dropped: gradients that were too old.
      busy_seconds: time spent on exchanges, s.
      bytes_in: size of the gradients and actions received.
      bytes_out: size of the variables sent.
    """

    updates: int = 0
    dropped: int = 0
    busy_seconds: float = 0.0
    bytes_in: int = 0
    bytes_out: int = 0


@dataclasses.dataclass(frozen=True)
class Taken:
    """What the parameter server hands to the driver.

    Attributes:
      updates: the updates since the last call of `take`.
      rounds: how many each worker has played.
      is_done: whether all frames have been trained on.
    """

    updates: list[core.Update]
    rounds: list[int]
    is_done: bool


@dataclasses.dataclass(frozen=True)
class Reply:
    """What the parameter server answers to a worker.

    Attributes:
      pulled: where training stands.
      variables: the network's parameters and buffers by name, as arrays: they are sent without being copied, tensors
        are not.
      goes_on: whether the worker is to play another round.
    """

    pulled: a3c_learning.Pulled
    variables: dict[str, np.ndarray]
    goes_on: bool


class ParameterServer:
    """Keeps the variables. It handles one call at a time, so nobody reads half an update."""

    def __init__(self, network: networks.RecurrentActorCritic, tensors, config: config_lib.A3CConfig):
        """Takes up variables.

        Args:
          network: any network of their shapes.
          tensors: what `Variables.save` returned.
          config: the agent's configuration.
        """
        torch.set_num_threads(1)
        self._variables, self._config = learning.Variables(network, config.num_workers), config
        self._variables.restore(tensors)
        self._updates: list[core.Update] = []
        self._traffic = Traffic()
        self._is_stopped = False

    def exchange(
        self, worker: int, seed: int, gradient: np.ndarray | None, contribution: a3c_learning.Contribution | None
    ) -> Reply:
        """Applies what a worker has learned, if anything, and gives it the newest variables of the network.

        Args:
          worker: index of the worker.
          seed: of its environments.
          gradient: float32 [P], an array beside the contribution.
          contribution: the rest of it, without gradients; None from a worker that has just started.
        """
        start = time.perf_counter()
        if contribution is not None and gradient is not None:
            self._apply(seed, gradient, contribution)
        pulled = a3c_learning.pull(self._variables, worker)
        variables = {name: value.numpy().copy() for name, value in self._variables.network.state_dict().items()}
        self._traffic.bytes_out += sum(value.nbytes for value in variables.values())
        self._traffic.busy_seconds += time.perf_counter() - start
        return Reply(pulled, variables, not self._is_done() and not self._is_stopped)

    def _apply(self, seed: int, gradient: np.ndarray, contribution: a3c_learning.Contribution) -> None:
        gradients = _split(torch.from_numpy(gradient.copy()), self._variables.network)
        contribution = dataclasses.replace(contribution, gradients=gradients)
        counters = a3c_learning.push(self._variables, contribution, self._config.max_staleness)
        self._traffic.bytes_in += gradient.nbytes + contribution.episodes.actions.nbytes
        if counters is None:
            self._traffic.dropped += 1
        else:
            self._traffic.updates += 1
            self._updates.append(contribution.update(seed, counters))

    def restore(self, tensors) -> None:
        """Takes up what `save` returned."""
        self._variables.restore(tensors)

    def take(self) -> Taken:
        """Returns what has happened since this was called last."""
        updates, self._updates = self._updates, []
        return Taken(updates, self._variables.rounds.tolist(), self._is_done())

    def save(self) -> dict[str, torch.Tensor]:
        """Returns copies of all variables, by name."""
        return self._variables.save()

    def traffic(self) -> Traffic:
        """Returns what has been done so far."""
        return self._traffic

    def stop(self) -> None:
        """Lets every worker end with the update that it is at."""
        self._is_stopped = True

    def _is_done(self) -> bool:
        return int(self._variables.frames) >= self._config.frames


def _split(vector: torch.Tensor, network: torch.nn.Module) -> list[torch.Tensor]:
    """Returns the parts of a vector, each in the shape of a parameter."""
    parameters = list(network.parameters())
    parts = torch.split(vector, [parameter.numel() for parameter in parameters])
    return [part.view_as(parameter) for part, parameter in zip(parts, parameters, strict=True)]
