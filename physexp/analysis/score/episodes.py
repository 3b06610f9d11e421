"""Plays single episodes of a task and records them."""

from collections.abc import Sequence
import dataclasses

import dm_env
import numpy as np

from physexp import suite
from physexp.agents import core, environment_loop


@dataclasses.dataclass(frozen=True)
class Episode:
    """An episode of T actions.

    Attributes:
      hidden: the hidden property, which no actor observes, [...].
      actions: int64 [T].
      rewards: float64 [T].
      timesteps: before each action and at the end, T + 1 of them.
      observations: empty: ideal experimenters judge an episode by its hidden property and actions.
    """

    hidden: np.ndarray
    actions: np.ndarray
    rewards: np.ndarray
    timesteps: list[dm_env.TimeStep]
    observations: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)


class _Recorder:
    """Observes an episode and keeps all of it."""

    def observe_first(self, environment: dm_env.Environment, timestep: dm_env.TimeStep) -> None:
        self.timesteps, self.actions = [timestep], []  # type: list[dm_env.TimeStep], list[int]

    def observe(self, environment: dm_env.Environment, timestep: dm_env.TimeStep, action: int) -> None:
        self.timesteps.append(timestep)
        self.actions.append(action)

    def get_metrics(self) -> dict[str, float]:
        return {}


class _Repeater(core.Actor):
    """Takes the actions of an episode again."""

    def __init__(self, actions: Sequence[int]):
        self._actions, self._next = actions, iter(actions)

    def observe_first(self, timestep):
        """Does nothing."""

    def select_action(self, observation):
        action = next(self._next, None)
        if action is None:
            raise ValueError(f"the episode goes on after its {len(self._actions)} actions; some are missing")
        return action

    def observe(self, action, next_timestep):
        """Does nothing."""


def play(environment: suite.Environment, actor: core.Actor, number: int) -> Episode:
    """Plays the episode of an index."""
    recorder = _Recorder()
    environment.task.next_episode = number
    environment_loop.EnvironmentLoop(environment, actor, [recorder]).run_episode()
    rewards = np.array([timestep.reward for timestep in recorder.timesteps[1:]], float)
    return Episode(environment.task.hidden, np.array(recorder.actions, np.int64), rewards, recorder.timesteps)


def replay(environment: suite.Environment, actions: Sequence[int], number: int) -> Episode:
    """Plays the episode of an index with given actions.

    Raises:
      ValueError: if one of them is no action, or the episode does not end with the last of them.
    """
    played = play(environment, _Repeater(actions), number)
    if len(played.actions) < len(actions):
        raise ValueError(f"the episode ends after {len(played.actions)} of its {len(actions)} actions")
    return played
