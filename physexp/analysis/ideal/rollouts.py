"""Plays episodes with many single actors side by side, for example ideal experimenters."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import dm_env
import numpy as np

from physexp import suite
from physexp.agents import core


def play_round(
    actors: Sequence[core.Actor], batch: core.Batch, episode: int
) -> Iterator[tuple[np.ndarray, np.ndarray, dm_env.TimeStep]]:
    """Plays the episode of an index with each of N actors, in N environments side by side.

    Yields:
      Of each step, the indices of the M environments whose episodes are not over, int64 [M]; the actions there, int64
      [M]; and the time steps after them, a TimeStep of arrays [M, ...].
    """
    rows, timesteps = np.arange(len(actors)), _separate(batch.reset(episode=episode))
    for actor, timestep in zip(actors, timesteps, strict=True):
        actor.observe_first(timestep)
    while len(rows):
        playing = [actors[row] for row in rows.tolist()]
        seen = zip(playing, timesteps, strict=True)
        actions = np.array([actor.select_action(timestep.observation) for actor, timestep in seen], np.int64)
        after = batch.step(actions, rows)
        yield rows, actions, after
        timesteps = _separate(after)
        for actor, action, timestep in zip(playing, actions.tolist(), timesteps, strict=True):
            actor.observe(action, timestep)
            actor.update()
        rows = rows[after.step_type != dm_env.StepType.LAST]
        timesteps = [timestep for timestep in timesteps if not timestep.last()]


def play(
    actors: Sequence[core.Actor], domain: str, task: str, task_kwargs: Mapping[str, Any], num_episodes: int, seed: int
) -> tuple[np.ndarray, np.ndarray]:
    """Plays some episodes with each of N actors, in environments of a seed.

    Returns:
      Final rewards and numbers of actions, [num_episodes, N] each.
    """
    batch = suite.load_batch(domain, task, len(actors), {**task_kwargs, "random": seed})
    rewards, lengths = np.zeros((num_episodes, len(actors))), np.zeros((num_episodes, len(actors)), np.int64)
    for episode in range(num_episodes):
        for rows, _, after in play_round(actors, batch, episode):
            rewards[episode, rows] = after.reward
            lengths[episode, rows] += 1
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
