"""The interfaces of an agent, as in Acme: an actor chooses actions, a learner improves variables."""

import abc
from collections.abc import Mapping
from typing import Any

import dm_env


class Actor(abc.ABC):
    """Chooses actions in one environment and watches what follows."""

    @abc.abstractmethod
    def select_action(self, observation: Mapping[str, Any]) -> int:
        """Returns an action for an observation of the environment's observation spec."""

    @abc.abstractmethod
    def observe_first(self, timestep: dm_env.TimeStep) -> None:
        """Notes the first timestep of an episode."""

    @abc.abstractmethod
    def observe(self, action: int, next_timestep: dm_env.TimeStep) -> None:
        """Notes an action and the timestep that followed."""

    @abc.abstractmethod
    def update(self) -> None:
        """Brings the actor's variables up to date."""


class Learner(abc.ABC):
    """Improves variables from experience."""

    @abc.abstractmethod
    def step(self) -> dict[str, float]:
        """Performs one update; returns its metrics."""

    def run(self, num_steps: int) -> None:
        """Performs many updates."""
        for _ in range(num_steps):
            self.step()

    @abc.abstractmethod
    def get_variables(self) -> dict[str, Any]:
        """Returns a copy of the network's variables by name."""

    @abc.abstractmethod
    def save(self) -> dict[str, Any]:
        """Returns all that `restore` needs to continue as if nothing had happened: tensors by name."""

    @abc.abstractmethod
    def restore(self, state: Mapping[str, Any]) -> None:
        """Takes up what `save` returned."""
