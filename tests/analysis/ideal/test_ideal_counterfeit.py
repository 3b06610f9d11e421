"""The ideal experimenter of the counterfeit-coin problem, against a search over sets of labels and by hand."""

import functools
import itertools

from physexp.analysis.ideal import counterfeit, resting

SIDES = (0, -1, 1)


def solve(num_things, num_suspects, discount, step_limit):
    return resting.Solution(counterfeit.Scale(num_things, num_suspects), discount, step_limit)


def search(num_things, num_suspects, discount, step_limit, choose):
    """Returns the expected return by a search over places and sets of labels, with numbers for the weights.

    Args:
      num_things, num_suspects, discount, step_limit: as for `solve`.
      choose: combines the values of all interactions: `max`, or `mean` for random ones.
    """
    weights = {
        (thing, sign): [1 + 0.3 * sign * (thing == other) for other in range(num_things)]
        for thing in range(num_suspects)
        for sign in (1, -1)
    }

    @functools.cache
    def parts(places, labels):
        found = {}
        for label in labels:
            surplus = round(sum(SIDES[place] * weight for place, weight in zip(places, weights[label], strict=True)), 6)
            found.setdefault((surplus > 0) - (surplus < 0), []).append(label)
        return [(len(part) / len(labels), frozenset(part)) for part in found.values()]

    @functools.cache
    def value(places, labels, steps):
        answer = 2 / len(labels) - 1
        if steps == 1:
            return answer
        expected = []
        for thing, place in itertools.product(range(num_things), range(3)):
            moved = (*places[:thing], place, *places[thing + 1 :])
            expected.append(sum(chance * value(moved, part, steps - 1) for chance, part in parts(moved, labels)))
        return max(answer, discount * choose(expected))

    return value((0,) * num_things, frozenset(weights), step_limit)


def mean(values):
    return sum(values) / len(values)
