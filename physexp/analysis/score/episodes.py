"""Plays single episodes of a task and records them."""

from collections.abc import Sequence
import dataclasses

import dm_env
import numpy as np

from physexp import suite
from physexp.agents import core


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


def play(environment: suite.Environment, actor: core.Actor, number: int) -> Episode:
    """Plays the episode of an index."""
    environment.task.next_episode = number
    timesteps: list[dm_env.TimeStep] = [environment.reset()]
    actions: list[int] = []
    actor.observe_first(timesteps[0])
    while not timesteps[-1].last():
        actions.append(actor.select_action(timesteps[-1].observation))
        timesteps.append(environment.step(actions[-1]))
        actor.observe(actions[-1], timesteps[-1])
        actor.update()
    return _recorded(environment, actions, timesteps)


def replay(environment: suite.Environment, actions: Sequence[int], number: int) -> Episode:
    """Plays the episode of an index with given actions.

    Raises:
      ValueError: if one of them is no action, or the episode does not end with the last of them.
    """
    environment.task.next_episode = number
    timesteps = [environment.reset()]
    for action in actions:
        if timesteps[-1].last():
            raise ValueError(f"the episode ends after {len(timesteps) - 1} of its {len(actions)} actions")
        timesteps.append(environment.step(action))
    if not timesteps[-1].last():
        raise ValueError(f"the episode goes on after its {len(actions)} actions; some are missing")
    return _recorded(environment, actions, timesteps)


def _recorded(environment: suite.Environment, actions: Sequence[int], timesteps: list[dm_env.TimeStep]) -> Episode:
    rewards = np.array([timestep.reward for timestep in timesteps[1:]], float)
    return Episode(environment.task.hidden, np.array(actions, np.int64), rewards, timesteps)
