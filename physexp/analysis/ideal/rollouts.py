"""Plays episodes with actors that are not networks, and thus cannot decide for many environments at once."""

from collections.abc import Mapping, Sequence
from typing import Any

import dm_env
import numpy as np

from physexp import suite
from physexp.agents import core


def play(
    actors: Sequence[core.Actor],
    domain: str,
    task: str,
    task_kwargs: Mapping[str, Any],
    num_episodes: int,
    seed: int,
) -> tuple[np.ndarray, np.ndarray]:
    """Plays episodes with actors side by side, each in an environment of its own.

    Args:
      actors: N of them.
      domain, task, task_kwargs: what they play, as for `suite.load`, without a seed.
      num_episodes: of each actor.
      seed: of the environments.

    Returns:
      Final rewards and numbers of actions, [num_episodes, N] each.
    """
    batch = suite.load_batch(domain, task, len(actors), {**task_kwargs, "random": seed})
    rewards, lengths = np.zeros((num_episodes, len(actors))), np.zeros((num_episodes, len(actors)), np.int64)
    for episode in range(num_episodes):
        timesteps = dict(enumerate(_separate(batch.reset(episode=episode))))
        for i, timestep in timesteps.items():
            actors[i].observe_first(timestep)
        while timesteps:
            actions = {i: actors[i].select_action(timestep.observation) for i, timestep in timesteps.items()}
            following = batch.step(np.array(list(actions.values())), np.array(list(actions)))
            timesteps = dict(zip(actions, _separate(following), strict=True))
            for i, timestep in timesteps.items():
                actors[i].observe(actions[i], timestep)
                actors[i].update()
                rewards[episode, i] = timestep.reward
                lengths[episode, i] += 1
            timesteps = {i: timestep for i, timestep in timesteps.items() if not timestep.last()}
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
