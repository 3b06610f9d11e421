"""Comparisons: labels are ordered, and test l is passed if the right label is at most l.

A test may destroy what it tests.
"""

from collections.abc import Sequence

import numpy as np

from physexp.analysis.ideal import resting


class Thresholds(resting.Apparatus):
    """L tests with one bit of result each; every label passes the last one, which thus reveals nothing."""

    def __init__(self, prior: Sequence[float] | np.ndarray):
        """Takes the probabilities of the labels in their order, [L], L >= 2."""
        super().__init__(prior, num_interactions=len(prior), start=(resting.mask(np.greater(prior, 0)), None))

    def readings(self, setting):
        """Returns the results of the tests: 1 if passed, otherwise 0."""
        return np.tri(len(self.weights), dtype=np.int64)


class Specimens(Thresholds):
    """The same tests of K equal specimens, one after another: a test that is passed destroys the specimen.

    Readings and settings are the number of specimens that are destroyed. With none left, tests reveal nothing.
    """

    def __init__(self, prior: Sequence[float] | np.ndarray, num_specimens: int):
        """Takes the probabilities of the labels in their order, [L], L >= 2, and K, at least 1."""
        super().__init__(prior)
        self._num_specimens, self.start = num_specimens, (self.start[0], 0)

    def readings(self, setting):
        return np.minimum(setting + super().readings(setting), self._num_specimens)

    def set_by(self, setting, interaction, reading):
        return reading
