"""What episodes of Which is Heavier are seen by: how many blocks they have looked at, and their mass gap."""

from collections.abc import Callable

import numpy as np

from physexp.suite.domains import which_is_heavier

_FEWEST = 20  # Episodes that something is drawn of.
_EDGES = np.linspace(0, 1, 11)
GAPS = (_EDGES[1:] + _EDGES[:-1]) / 2
"""The middles of the bins of mass gaps, [10]."""


def counted(frame):
    """Returns a DataFrame of episodes with `blocks`, the number that were poked, in place of `actions`."""
    poked = [len({action for action in actions if action < which_is_heavier.NUM_BLOCKS}) for actions in frame.actions]
    return frame.drop(columns="actions").assign(blocks=poked)


def by_gap(
    gaps: np.ndarray, values: np.ndarray, statistic: Callable[[np.ndarray], float] = np.mean, fewest: int = _FEWEST
) -> np.ndarray:
    """Returns a statistic of the values in each bin of mass gaps, [10]; NaN where there are fewer than the fewest."""
    bins = np.digitize(gaps, _EDGES[1:-1])
    chosen = [values[bins == number] for number in range(len(GAPS))]
    return np.array([statistic(each) if len(each) >= fewest else np.nan for each in chosen])
