"""Plays single episodes of a task and keeps all of them, with any choice of actions."""

from collections.abc import Callable, Sequence
import dataclasses

import dm_env
import numpy as np

from physexp import suite
from physexp.agents import core

Act = Callable[[int, dm_env.TimeStep], int]
"""Returns an action for the number of the step and a time step; it sees all but the last one of an episode."""


@dataclasses.dataclass(frozen=True)
class Episode:
    """An episode of T actions.

    Attributes:
      hidden: the hidden property, which is told to no actor, [...].
      actions: int64 [T].
      rewards: float64 [T].
      timesteps: before each action and at the end, T + 1 of them.
      observations: empty, since ideal experimenters judge an episode by its hidden property and actions.
    """

    hidden: np.ndarray
    actions: np.ndarray
    rewards: np.ndarray
    timesteps: list[dm_env.TimeStep]
    observations: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)


def play(
    environment: suite.BatchEnvironment, act: Act, number: int | None = None, hidden: np.ndarray | None = None
) -> Episode:
    """Plays an episode.

    Args:
      environment: a batch of one.
      act: chooses the actions.
      number: the episode's index; by default the one after the current.
      hidden: its hidden property, [...]; by default that of the index.
    """
    timesteps = [_single(environment.reset(episode=number, hidden=None if hidden is None else hidden[None]))]
    actions: list[int] = []
    while not timesteps[-1].last():
        actions.append(act(len(actions), timesteps[-1]))
        timesteps.append(_single(environment.step(np.array(actions[-1:]))))
    rewards = np.array([timestep.reward for timestep in timesteps[1:]], float)
    return Episode(environment.hidden[0], np.array(actions, np.int64), rewards, timesteps)


def again(environment: suite.BatchEnvironment, number: int, actions: Sequence[int]) -> Episode:
    """Plays the actions of an episode again.

    Args:
      environment: a batch of one.
      number: the episode's index.
      actions: all of them.

    Raises:
      ValueError: if the episode does not end with the last of them.
    """
    left = iter([*actions, None])

    def act(step: int, timestep: dm_env.TimeStep) -> int:
        if (action := next(left)) is None:
            raise ValueError(f"episode {number} goes on after its {len(actions)} actions")
        return action

    played = play(environment, act, number)
    if len(played.actions) < len(actions):
        raise ValueError(f"episode {number} ends after {len(played.actions)} of its {len(actions)} actions")
    return played


def chosen_by(actor: core.Actor) -> Act:
    """Returns an actor's choice of actions; it sees all but the last time step of an episode."""
    action: int | None = None

    def act(step: int, timestep: dm_env.TimeStep) -> int:
        nonlocal action
        show(actor, action if step else None, timestep)
        action = int(actor.select_action(timestep.observation))
        return action

    return act


def show(actor: core.Actor, action: int | None, timestep: dm_env.TimeStep) -> None:
    """Shows an actor a time step, and the action that led to it, None for the first."""
    if action is None:
        actor.observe_first(timestep)
    else:
        actor.observe(action, timestep)
        actor.update()


def _single(timestep: dm_env.TimeStep) -> dm_env.TimeStep:
    """Returns the time step of the only environment of a batch, as `suite.load` has it."""
    is_first = timestep.step_type[0] == dm_env.StepType.FIRST
    return dm_env.TimeStep(
        dm_env.StepType(int(timestep.step_type[0])),
        None if is_first else float(timestep.reward[0]),
        None if is_first else float(timestep.discount[0]),
        {name: value[0] for name, value in timestep.observation.items()},  # Stepping made a copy of its own.
    )
