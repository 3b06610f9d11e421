"""The counterfeit-coin problem, with a cost for each placing instead of each weighing.

One of N things is odd, heavier or lighter than the others, which are equal. Each interaction puts one thing on the left
pan of a balance, on the right one or aside, and the balance then shows which pan is heavier. The odd thing differs by
less than a thing weighs, so pans with unequal numbers of things reveal nothing.
"""

import numpy as np

from physexp.analysis.ideal import resting

SIDES = (0, -1, 1)
"""The sides on which a thing can lie: aside, on the left pan or on the right one.

Interaction 3 k + p puts thing k on the side of index p; one more, 3 N, releases a balance that is held. Label 2 k says
that thing k is heavier, 2 k + 1 that it is lighter. A setting has the side of each thing.
"""


class Scale(resting.Apparatus):
    """A balance and N things, which all lie aside at first; all possible labels are equally likely."""

    def __init__(self, num_things: int, num_suspects: int, is_held: bool = False):
        """Takes N, at least 2, the number of things that may be odd, the first ones, at least 1, and if it is held."""
        self._num_things, self._num_placings, self._is_held = num_things, len(SIDES) * num_things, is_held
        possible = resting.mask(np.arange(2 * num_things) < 2 * num_suspects)
        start = (possible, (0,) * num_things)
        super().__init__(np.ones(2 * num_things), self._num_placings + is_held, start)

    def readings(self, setting):
        """Returns the tilt of the balance: -1 to the left, 0, or 1 to the right; 0 while it is held."""
        if self._is_held:
            return np.concatenate([np.zeros((self._num_placings, len(self.weights)), int), self._tilts([setting])])
        return self._tilts([self.set_by(setting, placing, None) for placing in range(self._num_placings)])

    def _tilts(self, settings: list[tuple[int, ...]]) -> np.ndarray:
        """Returns the tilt of the free balance in some settings, for each label, int [settings, L]."""
        sides = np.array(settings)
        surplus = np.sign(sides.sum(axis=1))  # Of things on the right pan.
        of_odd = np.repeat(sides, 2, axis=1) * np.tile([1, -1], self._num_things)
        return np.where(surplus[:, None] == 0, of_odd, surplus[:, None])

    def set_by(self, setting, interaction, reading):
        """Returns the sides of the things after an interaction."""
        if interaction == self._num_placings:
            return setting
        thing, place = divmod(interaction, len(SIDES))
        return (*setting[:thing], SIDES[place], *setting[thing + 1 :])

    def canonical(self, state):
        """Returns the state with things sorted by their possible labels and their side."""
        possible, setting = state
        kinds = [(possible >> 2 * thing & 3, side) for thing, side in enumerate(setting)]
        order = sorted(range(self._num_things), key=kinds.__getitem__)
        actions = [len(SIDES) * thing + place for thing in order for place in range(len(SIDES))]
        actions += [self._num_placings] * self._is_held
        actions += [self.num_interactions + 2 * thing + sign for thing in order for sign in range(2)]
        labels = sum(kinds[thing][0] << 2 * place for place, thing in enumerate(order))
        return (labels, tuple(kinds[thing][1] for thing in order)), actions
