"""What an agent is to those who train it: it hands out what its updates did, and can be saved, restored and stopped."""

import abc
from collections.abc import Callable, Generator, Mapping
import dataclasses
from typing import Any

import numpy as np
import torch

from physexp.agents import acting, learning, networks
from physexp.agents import config as config_lib

# Makes a batch of environments from its seed, its number of environments and its number of threads.
EnvironmentFactory = Callable[[int, int, int], Any]


class VariablesLostError(learning.AgentError):
    """What was learned since the last checkpoint is lost; restored from it, training can go on."""


@dataclasses.dataclass(frozen=True)
class Update:
    """What one update did.

    Attributes:
      seed: of the batch of environments that it learned from.
      metrics: figures of the learner; `updates` and `frames` are counted over all workers, `rounds` is the index of the
        episodes.
      episodes: the episodes it learned from, for records.
    """

    seed: int
    metrics: dict[str, float]
    episodes: acting.Round


class Agent(abc.ABC):
    """Acts and learns until it has had its frames."""

    @property
    @abc.abstractmethod
    def frames(self) -> int:
        """Environment steps trained on."""

    @abc.abstractmethod
    def updates(self, poll_seconds: float = 0.5) -> Generator[Update | None, None, None]:
        """Trains until `frames` are reached or `stop` is called; yields each update, or None when none came in time.

        Raises:
          AgentError: if training cannot go on.
        """

    @abc.abstractmethod
    def stop(self) -> None:
        """Asks it to end after the update it is at; may be called by a signal's handler."""

    @abc.abstractmethod
    def save(self) -> dict[str, torch.Tensor]:
        """A consistent copy of all variables by name, between two updates."""

    @abc.abstractmethod
    def restore(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Takes up what `save` returned; call it before `updates`.

        Raises:
          ValueError: if the tensors do not fit this configuration.
        """


def make_network(environment, config: config_lib.AgentConfig) -> networks.RecurrentActorCritic:
    """A network for an environment's specs, its weights drawn from the configuration's seed."""
    with torch.random.fork_rng():
        torch.manual_seed(config.seed)
        return networks.RecurrentActorCritic(
            environment.observation_spec(), environment.action_spec().num_values, **hyperparameters(config)
        )


def initial_network(environment, config: config_lib.AgentConfig) -> networks.RecurrentActorCritic:
    """The network that training starts from: with the policy that it is to prefer, and calibrated."""
    network = make_network(environment, config)
    network.prefer(config.action_prior)
    if config.relative_pixels:
        network.calibrate(acting.as_tensors(environment.reset().observation))
    return network


def hyperparameters(config: config_lib.AgentConfig) -> dict[str, Any]:
    """What a configuration says of the network, as its keyword arguments."""
    return {"lstm_units": config.lstm_units, "observation_scale": config.observation_scale}


def worker_seed(seed: int, worker: int) -> int:
    """The seed of a worker's environments."""
    return int(np.random.SeedSequence([seed, worker]).generate_state(1, np.uint32)[0])


def round_generator(seed: int, worker: int, number: int) -> np.random.Generator:
    """The source of the actions in a round: a pure function, so that a run that is resumed plays the same rounds."""
    return np.random.default_rng([seed, worker, number])
