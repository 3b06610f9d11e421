"""Plays episodes with many single actors side by side, for example ideal experimenters."""

from collections.abc import Iterator, Mapping, Sequence
import dataclasses
from typing import Any

import dm_env
import numpy as np

from physexp import suite
from physexp.agents import core


@dataclasses.dataclass(frozen=True)
class Step:
    """A step of the M environments whose episodes are not over.

    Attributes:
      rows: their indices, int64 [M].
      observation: the observations before the actions, arrays [M, ...].
      actions: the actions, int64 [M].
      after: the time steps after them, a TimeStep of arrays [M, ...].
    """

    rows: np.ndarray
    observation: Mapping[str, np.ndarray]
    actions: np.ndarray
    after: dm_env.TimeStep


def play_round(actors: Sequence[core.Actor], batch: core.Batch, episode: int) -> Iterator[Step]:
    """Plays the episode of an index with each of N actors, in N environments side by side; yields its steps."""
    rows, before = np.arange(len(actors)), batch.reset(episode=episode)
    timesteps = _separate(before)
    for actor, timestep in zip(actors, timesteps, strict=True):
        actor.observe_first(timestep)
    while len(rows):
        seen = zip(rows.tolist(), timesteps, strict=True)
        actions = np.array([actors[i].select_action(timestep.observation) for i, timestep in seen], np.int64)
        after = batch.step(actions, rows)
        yield Step(rows, before.observation, actions, after)
        timesteps = _separate(after)
        for i, action, timestep in zip(rows.tolist(), actions.tolist(), timesteps, strict=True):
            actors[i].observe(action, timestep)
            actors[i].update()
        going = after.step_type != dm_env.StepType.LAST
        rows, timesteps = rows[going], [timestep for timestep in timesteps if not timestep.last()]
        before = after._replace(observation={name: value[going] for name, value in after.observation.items()})


def play(
    actors: Sequence[core.Actor],
    domain: str,
    task: str,
    task_kwargs: Mapping[str, Any],
    num_episodes: int,
    seed: int,
) -> tuple[np.ndarray, np.ndarray]:
    """Plays some episodes with each of N actors, in environments of a seed.

    Returns:
      Final rewards and numbers of actions, [num_episodes, N] each.
    """
    batch = suite.load_batch(domain, task, len(actors), {**task_kwargs, "random": seed})
    rewards, lengths = np.zeros((num_episodes, len(actors))), np.zeros((num_episodes, len(actors)), np.int64)
    for episode in range(num_episodes):
        for step in play_round(actors, batch, episode):
            rewards[episode, step.rows] = step.after.reward
            lengths[episode, step.rows] += 1
    batch.close()
    return rewards, lengths


def _separate(timesteps: dm_env.TimeStep) -> list[dm_env.TimeStep]:
    """Returns the time steps of single environments."""
    return [
        dm_env.TimeStep(
            dm_env.StepType(timesteps.step_type[i]),
            timesteps.reward[i],
            timesteps.discount[i],
            {name: value[i] for name, value in timesteps.observation.items()},
        )
        for i in range(len(timesteps.step_type))
    ]
