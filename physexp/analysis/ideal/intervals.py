"""Comparisons: labels are ordered, and test l is passed if the right label is at most l."""

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
