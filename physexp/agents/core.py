"""The interfaces of agents, as in Acme: actors, learners and agents, their environments, updates and errors.

Imports nothing heavy.
"""

import abc
from collections.abc import Callable, Generator, Mapping
import dataclasses
from typing import TYPE_CHECKING, Any, Protocol

import dm_env
from dm_env import specs
import numpy as np

if TYPE_CHECKING:  # torch takes a second to import, and here only annotations name it.
    import torch

    from physexp.agents import rounds


class Specs(Protocol):
    """Observations and actions of a task, for which a network is made."""

    @property
    def num_interactions(self) -> int:
        """Returns how many actions are interactions; they come first, labels after them."""

    @property
    def is_told(self) -> bool:
        """Returns whether the first observation of an episode tells which question is asked."""

    @property
    def step_limit(self) -> int:
        """Returns how many actions an episode may have."""

    def observation_spec(self) -> Mapping[str, specs.Array]:
        """Returns the spec of each array that one environment observes, by name."""

    def action_spec(self) -> specs.DiscreteArray:
        """Returns the spec of an action."""


class Batch(Specs, Protocol):
    """Environments that play side by side, B of them, each its own episode."""

    @property
    def num_environments(self) -> int:
        """Returns B."""

    @property
    def correct_answers(self) -> np.ndarray:
        """Returns the right labels of the current episodes, int64 [B]; never observable."""

    @property
    def num_questions(self) -> int:
        """Returns how many questions an episode has, K; it ends with the answer to the last one."""

    def reset(self, *, episode: int | None = None) -> dm_env.TimeStep:
        """Starts the episode of an index, or the next one, in every environment; returns arrays [B, ...]."""

    def step(self, actions: np.ndarray, environments: np.ndarray) -> dm_env.TimeStep:
        """Takes actions, int64 [N], in the environments of sorted indices, int64 [N]; returns arrays [N, ...]."""

    def close(self) -> None:
        """Frees what the environments hold."""


EnvironmentFactory = Callable[[int, int, int], Batch]
"""Makes a batch from its seed, its number of environments and its number of threads."""


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

    def update(self) -> None:  # noqa: B027
        """Updates the actor's variables, after each step; by default they are fixed."""


class EpisodicActor(Actor):
    """An actor that remembers an episode, and refuses a loop that leaves out `observe_first` or `observe`."""

    _is_playing = False
    _has_chosen = False  # Whether `observe` has not been called yet for the last action.

    def observe_first(self, timestep: dm_env.TimeStep) -> None:
        """Begins an episode."""
        self._begin(timestep)
        self._is_playing, self._has_chosen = True, False

    def select_action(self, observation: Mapping[str, Any]) -> int:
        """Returns an action; raises RuntimeError after a missing `observe_first` or `observe`."""
        self._check(self._is_playing)
        if self._has_chosen:
            raise RuntimeError(
                "the actor does not know how its last action ended; call observe(action, timestep) after each step"
            )
        action = self._choose(observation)
        self._has_chosen = True
        return action

    def observe(self, action: int, next_timestep: dm_env.TimeStep) -> None:
        """Notes an action and the timestep that followed; raises RuntimeError after a missing `observe_first`."""
        self._check(self._is_playing and not next_timestep.first())
        self._note(action, next_timestep)
        self._is_playing, self._has_chosen = not next_timestep.last(), False

    @staticmethod
    def _check(has_begun: bool) -> None:
        if not has_begun:
            raise RuntimeError(
                "the actor does not know that an episode has begun; call observe_first(timestep) after each reset"
            )

    @abc.abstractmethod
    def _begin(self, timestep: dm_env.TimeStep) -> None:
        """Forgets the episode before."""

    @abc.abstractmethod
    def _choose(self, observation: Mapping[str, Any]) -> int:
        """Returns an action."""

    @abc.abstractmethod
    def _note(self, action: int, next_timestep: dm_env.TimeStep) -> None:
        """Notes an action and the timestep that followed."""


class Learner(abc.ABC):
    """Improves variables from experience."""

    @abc.abstractmethod
    def step(self) -> dict[str, float]:
        """Performs one update; returns its metrics."""


@dataclasses.dataclass(frozen=True)
class Update:
    """The result of one update.

    Attributes:
      seed: of the batch of environments that it learned from.
      episode: index of the episode that each of those environments played.
      metrics: of the learner, with those that its configuration declares; `updates` and `frames` are counted over all
        workers.
      episodes: the episodes it learned from, for records.
    """

    seed: int
    episode: int
    metrics: dict[str, float]
    episodes: "rounds.Round"


class Agent(abc.ABC):
    """Acts and learns until it has trained for its configured number of frames.

    Attributes:
      variables: `learning.Variables`, all that training changes.
    """

    variables: Any
    _is_stopping = False

    @property
    def frames(self) -> int:
        """Returns the environment steps trained on."""
        return int(self.variables.frames)

    @abc.abstractmethod
    def updates(self) -> Generator[Update | None, None, None]:
        """Trains until `frames` or `stop`; yields each update, or None if none came in time; raises AgentError."""

    def stop(self) -> None:
        """Ends training after the current update; may be called by a signal's handler."""
        self._is_stopping = True

    def save(self) -> "dict[str, torch.Tensor]":
        """Returns a consistent copy of all variables by name, between two updates."""
        tensors: dict[str, torch.Tensor] = self.variables.save()
        return tensors

    def restore(self, tensors: "Mapping[str, torch.Tensor]") -> None:
        """Restores the result of `save`, before `updates`; raises ValueError if it does not fit the configuration."""
        self.variables.restore(tensors)


class AgentError(RuntimeError):
    """Training cannot go on; `batch` holds the arrays of the round that caused it, if one did."""

    def __init__(self, message: str, batch: dict[str, Any] | None = None):
        super().__init__(message)
        self.batch = batch


class DivergedError(AgentError):
    """The loss or its gradient is not finite."""


class WorkerError(AgentError):
    """A worker has died."""


class DamagedError(ValueError):
    """A file has changed since it was written."""
