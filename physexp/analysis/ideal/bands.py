"""Things that may be joined by bands, and a few clamps: which pairs are joined?

A pull moves all things that bands connect to the pulled one, directly or through others, except through things that
clamps hold. Pulls alone thus reveal the connected components, not the bands.
"""

from collections.abc import Sequence
import itertools

import numpy as np

from physexp.analysis.ideal import resting


class Clamped(resting.Apparatus):
    """N things. Interaction k pulls thing k; interaction N + k clamps it, or frees it if it is clamped.

    A single clamp moves from thing to thing. If there are more, all in use, a further clamp is not put on. Bit b of a
    label says that pair b is joined, in the order of `itertools.combinations`. Bit k of a setting says that thing k is
    clamped.
    """

    def __init__(self, num_things: int, weights: Sequence[float] | np.ndarray, clamps: int = 1):
        """Takes N, the probabilities of the labels, [L = 2^(N (N - 1) / 2)], and the number of clamps."""
        super().__init__(weights, num_interactions=2 * num_things, start=(resting.mask(np.greater(weights, 0)), 0))
        self._num_things, self._clamps = num_things, clamps
        pairs, labels = list(itertools.combinations(range(num_things), 2)), np.arange(len(self.weights))
        self._joined = np.tile(np.eye(num_things, dtype=int), (len(labels), 1, 1))  # [L, N, N]
        for bit, (i, j) in enumerate(pairs):
            self._joined[:, i, j] = self._joined[:, j, i] = labels >> bit & 1
        renamings = []  # Those that leave the probabilities as they are.
        for things in map(np.array, itertools.permutations(range(num_things))):
            new = np.argsort(things)
            graphs = sum(self._joined[:, new[i], new[j]] << bit for bit, (i, j) in enumerate(pairs))
            if np.array_equal(self.weights[graphs], self.weights):
                renamings.append(np.concatenate([things, num_things + things, 2 * num_things + graphs]))
        self._renamings = np.array(renamings)  # The former number of each action, [R, 2 N + L].

    def readings(self, setting):
        """Returns the things that have moved, as bit masks; moving a clamp moves none."""
        free = ~resting.bits(setting, self._num_things)
        moved = np.linalg.matrix_power(self._joined * np.outer(free, free), self._num_things - 1) > 0  # [L, N, N]
        pulls = (moved @ (1 << np.arange(self._num_things))).T
        return np.concatenate([pulls, np.zeros_like(pulls)])

    def set_by(self, setting, interaction, reading):
        """Returns the things that are clamped after an interaction."""
        if interaction < self._num_things:
            return setting
        thing = 1 << interaction - self._num_things
        if (setting ^ thing).bit_count() <= self._clamps:
            return setting ^ thing
        return thing if self._clamps == 1 else setting

    def canonical(self, state):
        """Returns the first of the states under all renamings, in the order of their bits."""
        possible, setting = state
        marks = resting.bits(possible << self._num_things | setting, self._num_things + len(self.weights))
        renamed = marks[self._renamings[:, self._num_things :] - self._num_things]
        first = min(range(len(renamed)), key=lambda number: renamed[number].tobytes())
        found = resting.mask(renamed[first])
        return (found >> self._num_things, found % 2**self._num_things), self._renamings[first]
