"""Tests that compare: labels are in order, and test l is passed if the right one is at most l."""

from collections.abc import Sequence

import numpy as np

from physexp import checks
from physexp.analysis.ideal import resting


class Thresholds(resting.Apparatus):
    """L tests, each of which tells a single bit; the last one tells nothing, since every label passes it."""

    def __init__(self, prior: Sequence[float] | np.ndarray):
        """Takes the probabilities of the labels in their order, [L], L >= 2.

        Raises:
          ValueError: if they are no such probabilities.
        """
        chances = np.asarray(prior, np.float64)
        if chances.ndim != 1 or len(chances) < 2 or not (chances >= 0).all() or abs(chances.sum() - 1) > 1e-9:
            raise ValueError(f"prior is {checks.shown(prior)}; give two or more probabilities whose sum is 1")
        super().__init__(chances, num_interactions=len(chances), start=(resting.mask(chances > 0), None))

    def readings(self, setting):
        """Returns whether each test is passed, 0 or 1."""
        return np.tri(len(self.weights), dtype=np.int64)
