"""The counterfeit-coin problem, with a cost for each placing instead of each weighing.

One of N things is odd, heavier or lighter than the others, which are equal. Each interaction puts one thing on the left
pan of a balance, on the right one or aside, and the balance then shows which pan is heavier. The odd thing differs by
less than a thing weighs, so pans with unequal numbers of things reveal nothing.
"""

import numpy as np

from physexp.analysis.ideal import resting

SIDES = (0, -1, 1)
"""The sides on which a thing can lie: aside, on the left pan or on the right one.

Interaction 3 k + p puts thing k on the side of index p. Label 2 k says that thing k is heavier, 2 k + 1 that it is
lighter. A setting has the side of each thing.
"""


class Scale(resting.Apparatus):
    """A balance and N things, which all lie aside at first; all possible labels are equally likely."""

    def __init__(self, num_things: int, num_suspects: int):
        """Takes N, at least 2, and the number of things that may be odd, the first ones, at least 1."""
        self._num_things = num_things
        possible = resting.mask(np.arange(2 * num_things) < 2 * num_suspects)
        super().__init__(np.ones(2 * num_things), len(SIDES) * num_things, start=(possible, (0,) * num_things))

    def readings(self, setting):
        """Returns the tilt of the balance: -1 to the left, 0, or 1 to the right."""
        sides = np.repeat(np.array([setting]), self.num_interactions, axis=0)
        interactions = np.arange(self.num_interactions)
        sides[interactions, interactions // len(SIDES)] = np.tile(SIDES, self._num_things)
        surplus = np.sign(sides.sum(axis=1))  # Of things on the right pan.
        of_odd = np.repeat(sides, 2, axis=1) * np.tile([1, -1], self._num_things)
        return np.where(surplus[:, None] == 0, of_odd, surplus[:, None])

    def set_by(self, setting, interaction, reading):
        """Returns the sides of the things after an interaction."""
        thing, place = divmod(interaction, len(SIDES))
        return (*setting[:thing], SIDES[place], *setting[thing + 1 :])

    def canonical(self, state):
        """Returns the state with things sorted by their possible labels and their side."""
        possible, setting = state
        kinds = [(possible >> 2 * thing & 3, side) for thing, side in enumerate(setting)]
        order = sorted(range(self._num_things), key=kinds.__getitem__)
        actions = [len(SIDES) * thing + place for thing in order for place in range(len(SIDES))]
        actions += [self.num_interactions + 2 * thing + sign for thing in order for sign in range(2)]
        labels = sum(kinds[thing][0] << 2 * place for place, thing in enumerate(order))
        return (labels, tuple(kinds[thing][1] for thing in order)), actions
