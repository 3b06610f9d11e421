"""The selection of episodes for a replay."""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from physexp.agents import networks
from physexp.analysis.data import episodes
from physexp.analysis.training import callbacks, playing
from physexp.analysis.training import config as config_lib

Selection = Literal["any", "wrong", "right", "longest", "hardest"]
Instance = tuple[int, int, Sequence[int]]
"""Seed, index and actions of an episode."""

_MAX_EPISODES = 10_000  # Played in search of enough.


def select(
    network: networks.RecurrentNetwork,
    config: config_lib.TrainConfig,
    count: int,
    selection: Selection = "any",
    interaction: str = "learned",
    seed: int = playing.SEED,
    tell: callbacks.Tell = callbacks.ignore,
) -> list[Instance]:
    """Plays episodes, see `playing.play`, and returns `count` that fit; fewer if 10,000 episodes do not hold as many.

    A selection is of the first episodes, the first wrong or right ones, those with the most interactions, or the
    hardest: by the task's hardness, or else by this agent's mean number of interactions. `tell` is called with a line
    before episodes are played.

    Raises:
      ValueError: if count is below one, or no episode of 10,000 fits.
    """
    if count < 1:
        raise ValueError(f"episodes is {count}; give a number >= 1")
    task, size = config.load_task(), count if selection == "any" else max(count, 256)
    while True:
        if selection != "any":
            tell(f"playing {size:,} episodes, for those that are {selection}")
        played = playing.play(network, config, size, interaction, seed=seed)
        order = _order(played, selection, task.hardness(played.hidden))
        if len(order) >= count or size >= _MAX_EPISODES:
            break
        size = min(4 * size, _MAX_EPISODES)
    if not len(order):
        raise ValueError(f"none of {size} episodes is {selection}; choose another selection")
    return [(int(played.seed[k]), int(played.episode[k]), played.actions_of(k).tolist()) for k in order[:count]]


def _order(played: episodes.Episodes, selection: Selection, hardness: np.ndarray | None) -> np.ndarray:
    """Returns the indices of the episodes that fit a selection, the best first."""
    if selection == "any":
        return np.arange(len(played))
    if selection in ("right", "wrong"):
        return np.flatnonzero((played.right == 1) == (selection == "right"))
    if selection == "longest":
        hardness = played.interactions
    elif hardness is None:  # Mean number of interactions on each hidden property.
        _, kinds = np.unique(played.hidden, axis=0, return_inverse=True)
        hardness = (np.bincount(kinds, played.interactions) / np.bincount(kinds))[kinds]
    return np.argsort(-hardness, kind="stable")
