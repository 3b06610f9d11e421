"""Things that may be joined by bands, and one clamp: which pairs are joined?

A pull moves all things that bands connect to the pulled one, directly or through others, except through the thing that
the clamp holds. Pulls alone thus reveal the connected components, not the bands.
"""

from collections.abc import Sequence
import itertools

import numpy as np

from physexp.analysis.ideal import resting


class Clamped(resting.Apparatus):
    """N things. Interaction k pulls thing k; interaction N + k clamps it, or frees it if it is clamped.

    Bit b of a label says that pair b is joined, in the order of `itertools.combinations`. A setting is the thing that
    is clamped, or None.
    """

    def __init__(self, num_things: int, weights: Sequence[float] | np.ndarray):
        """Takes N and the probabilities of the labels, [2^(N (N - 1) / 2)]."""
        self._num_things = num_things
        super().__init__(weights, num_interactions=2 * num_things, start=(resting.mask(np.greater(weights, 0)), None))

    def readings(self, setting):
        """Returns the things that have moved, as bit masks; moving the clamp moves none."""
        things, labels = range(self._num_things), range(len(self.weights))
        pulls = [[sum(1 << k for k in self.moved(label, setting, pulled)) for label in labels] for pulled in things]
        return np.concatenate([pulls, np.zeros_like(pulls)])

    def moved(self, label: int, clamped: int | None, pulled: int) -> set[int]:
        """Returns the things that move when one is pulled."""
        pairs = itertools.combinations(range(self._num_things), 2)
        bands = [set(pair) for bit, pair in enumerate(pairs) if label >> bit & 1]
        found = {pulled} - {clamped}
        for _ in range(self._num_things - 1):  # The longest path.
            found = found.union(*(band for band in bands if band & found)) - {clamped}
        return found

    def set_by(self, setting, interaction, reading):
        """Returns the thing that is clamped after an interaction, or None."""
        thing = interaction - self._num_things
        return setting if thing < 0 else None if thing == setting else thing
