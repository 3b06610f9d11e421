"""The counterfeit-coin problem, where it is not weighing that costs, but laying things on.

Of N things one is odd, heavier or lighter than the others, which are alike. Each interaction puts one thing on the left
pan of a balance, on the right one or aside, and the balance then tells which pan is heavier. The odd thing's difference
is less than a thing weighs, so that pans with unequal numbers tell nothing.
"""

import numpy as np

from physexp import checks
from physexp.analysis.ideal import resting

SIDES = (0, -1, 1)
"""Where things lie, that is aside, on the left pan or on the right one.

Interaction 3 k + p puts thing k in the place of index p.
Label 2 k says that thing k is heavier, 2 k + 1 that it is lighter. A setting has the side of each thing.
"""

MOST_THINGS = 12


class Scale(resting.Apparatus):
    """A balance and N things, which all lie aside at first; all labels that are possible are equally likely."""

    def __init__(self, num_things: int, num_suspects: int):
        """Takes N, from 2 to `MOST_THINGS`, and how many of the things may be odd, the first ones, from 1 to N.

        Raises:
          ValueError: for another number.
        """
        self._num_things = checks.integer("num_things", num_things, 2, MOST_THINGS)
        suspects = checks.integer("num_suspects", num_suspects, 1, num_things)
        possible = resting.mask(np.arange(2 * num_things) < 2 * suspects)
        super().__init__(np.ones(2 * num_things), len(SIDES) * num_things, start=(possible, (0,) * num_things))

    def readings(self, setting):
        """Returns to which side the balance tilts: -1 to the left, 0 or 1."""
        sides = np.repeat(np.array([setting]), self.num_interactions, axis=0)
        interactions = np.arange(self.num_interactions)
        sides[interactions, interactions // len(SIDES)] = np.tile(SIDES, self._num_things)
        surplus = np.sign(sides.sum(axis=1))  # Of things on the right pan.
        of_odd = np.repeat(sides, 2, axis=1) * np.tile([1, -1], self._num_things)
        return np.where(surplus[:, None] == 0, of_odd, surplus[:, None])

    def set_by(self, setting, interaction):
        thing, place = divmod(interaction, len(SIDES))
        return (*setting[:thing], SIDES[place], *setting[thing + 1 :])

    def alike(self, state):
        """Returns the state in which things are sorted by what is known of them and where they lie.

        Of things that are alike in both it does not matter which is which.
        """
        possible, setting = state
        kinds = [(possible >> 2 * thing & 3, side) for thing, side in enumerate(setting)]
        order = sorted(range(self._num_things), key=kinds.__getitem__)
        meant = [len(SIDES) * thing + place for thing in order for place in range(len(SIDES))]
        meant += [self.num_interactions + 2 * thing + sign for thing in order for sign in range(2)]
        labels = sum(kinds[thing][0] << 2 * place for place, thing in enumerate(order))
        return (labels, tuple(kinds[thing][1] for thing in order)), meant
