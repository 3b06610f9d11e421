"""The counterfeit-coin problem, with a cost for each placing instead of each weighing.

One of N things is odd, heavier or lighter than the others, which are equal. Each interaction puts one thing on the left
pan of a balance, on the right one or aside, and the balance then shows which pan is heavier. The odd thing differs by
less than a thing weighs, so pans with unequal numbers of things reveal nothing.
"""

from collections.abc import Sequence
import itertools

import numpy as np

from physexp.analysis.ideal import resting

SIDES = (0, -1, 1)
"""The sides on which a thing can lie: aside, on the left pan or on the right one.

Interaction 3 k + p puts thing k on the side of index p; one more, 3 N, releases a balance that is held. Label 2 k says
that thing k is heavier, 2 k + 1 that it is lighter. A setting has the side of each thing, and for each thing whether a
question asks about it: is the odd one among those, no or yes?
"""

_SWAPPED = ((0, 1, 2, 3), (0, 2, 1, 3))  # The bits of a thing's two hypotheses, and with heavier and lighter swapped.


class Scale(resting.Apparatus):
    """A balance and N things, which all lie aside at first; all possible hypotheses are equally likely."""

    def __init__(
        self,
        num_things: int,
        num_suspects: int,
        is_held: bool = False,
        asked: Sequence[bool] | np.ndarray | None = None,
    ):
        """Makes a balance.

        Args:
          num_things: N, at least 2.
          num_suspects: how many things may be odd, at least 1, the first ones.
          is_held: whether it must be released.
          asked: the things that a question asks about, bool [N]; None if it asks for the hypothesis.
        """
        self._num_things, self._num_placings, self._is_held = num_things, len(SIDES) * num_things, is_held
        self._is_told = asked is not None
        possible = resting.mask(np.arange(2 * num_things) < 2 * num_suspects)
        setting = (0,) * num_things, tuple([False] * num_things if asked is None else map(bool, asked))
        super().__init__(np.ones(2 * num_things), self._num_placings + is_held, (possible, setting))

    def posterior(self, state):
        """Returns the probabilities of the labels, or of no and yes if a question is told."""
        chances = self.chances(state)
        if not self._is_told:
            return chances
        _, (_, asked) = state
        yes = chances @ np.repeat(asked, 2)
        return np.array([1 - yes, yes])

    def readings(self, setting):
        """Returns the tilt of the balance: -1 to the left, 0, or 1 to the right; 0 while it is held."""
        if self._is_held:
            return np.concatenate([np.zeros((self._num_placings, len(self.weights)), int), self._tilts(setting[:1])])
        return self._tilts([self.set_by(setting, placing, None)[0] for placing in range(self._num_placings)])

    def _tilts(self, settings: Sequence[tuple[int, ...]]) -> np.ndarray:
        """Returns the tilt of the free balance for some sides of the things and each hypothesis, int [settings, H]."""
        sides = np.array(settings)
        surplus = np.sign(sides.sum(axis=1))  # Of things on the right pan.
        of_odd = np.repeat(sides, 2, axis=1) * np.tile([1, -1], self._num_things)
        return np.where(surplus[:, None] == 0, of_odd, surplus[:, None])

    def set_by(self, setting, interaction, reading):
        """Returns the setting after an interaction."""
        if interaction == self._num_placings:
            return setting
        (sides, asked), (thing, place) = setting, divmod(interaction, len(SIDES))
        return (*sides[:thing], SIDES[place], *sides[thing + 1 :]), asked

    def canonical(self, state):
        """Returns the state with things sorted by their possible hypotheses, their side, and the question.

        If a question is told, it is the first of the states in which heavier and lighter are swapped or not, and the
        question is negated or not: their values are equal.
        """
        possible, (sides, asked) = state
        found = []
        for swapped, is_negated in itertools.product(range(2), repeat=2) if self._is_told else [(0, False)]:
            suspected = [_SWAPPED[swapped][possible >> 2 * thing & 3] for thing in range(self._num_things)]
            kinds = list(zip(suspected, sides, (each ^ is_negated for each in asked), strict=True))
            order = sorted(range(self._num_things), key=kinds.__getitem__)
            found.append(([kinds[thing] for thing in order], order, is_negated))
        kinds, order, is_negated = min(found)
        actions = [len(SIDES) * thing + place for thing in order for place in range(len(SIDES))]
        actions += [self._num_placings] * self._is_held
        if self._is_told:
            actions += [self.num_interactions + is_negated, self.num_interactions + 1 - is_negated]
        else:
            actions += [self.num_interactions + 2 * thing + sign for thing in order for sign in range(2)]
        possible = sum(bits << 2 * place for place, (bits, _, _) in enumerate(kinds))
        _, *setting = zip(*kinds, strict=True)
        return (possible, tuple(setting)), actions
