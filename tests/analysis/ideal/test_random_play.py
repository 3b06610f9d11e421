"""Bounds on the return of random interactions, against made worlds that can be solved exactly."""

import functools
import math

from made_worlds import COUNTS, PATTERNS, MadeWorld
import numpy as np
import pytest

from physexp.analysis.ideal import histories, random_play, search

LABELS = np.array(COUNTS) - 1


def nothing_or_all(sequence):
    """Action 0 reveals the label, any other nothing."""
    return LABELS if 0 in sequence else [0] * PATTERNS


def test_one_interaction_is_enough_if_it_reveals_the_label():
    found = random_play.bounds(histories.Histories(MadeWorld(1, nothing_or_all), 0.5), 0.9)
    assert found["at_once"] == pytest.approx(2 / 5 - 1)
    assert found["random_value"] == pytest.approx(0.9) and found["random_bound"] == pytest.approx(0.9)


def test_one_of_two_actions_that_reveals_the_label_is_drawn_in_time():
    # It is drawn first after k interactions with probability 1 / 2^k. Knowing the sequence does not help.
    found = random_play.bounds(histories.Histories(MadeWorld(2, nothing_or_all), 0.5), 0.9)
    steps = np.arange(1, 60)
    mean, square = (0.5**steps @ 0.9 ** (power * steps) for power in (1, 2))
    assert found["random_value"] == pytest.approx(found["random_bound"])
    assert abs(found["random_bound"] - mean) < 5 * math.sqrt((square - mean**2) / 64)


def bits(sequence):
    """Action 0 reveals whether the label is below 2, action 1 whether it is odd, action 2 nothing."""
    values = np.zeros(PATTERNS)
    if 0 in sequence:
        values += LABELS < 2
    if 1 in sequence:
        values += 2 * (LABELS % 2)
    return values


def exact(discount, step_limit):
    """Returns the return of random interactions in the world of bits, with the best answers at the best moment."""
    prior = MadeWorld(3, bits).prior

    def chances(group):
        members = list(group)
        weights = np.bincount(LABELS[members], prior[members], minlength=5)
        return weights / weights.sum()

    @functools.cache
    def value(told, group, steps):
        answer = 2 * chances(group).max() - 1
        if steps == 1:
            return answer
        expected = 0.0
        for action in range(3):
            seen = np.array(bits((*told, action)))
            for reading in set(seen[list(group)]):
                part = tuple(k for k in group if seen[k] == reading)
                share = prior[list(part)].sum() / prior[list(group)].sum()
                expected += share * value(tuple(sorted({*told, action})), part, steps - 1) / 3
        return max(answer, discount * expected)

    return value((), tuple(range(PATTERNS)), step_limit)


@pytest.mark.parametrize("discount, step_limit", [(0.9, 12), (0.5, 4)])
def test_the_exact_value_lies_between_the_bounds(discount, step_limit):
    found = random_play.bounds(histories.Histories(MadeWorld(3, bits, step_limit), 0.5), discount)
    error = 5 * 0.25 / math.sqrt(64)  # Five standard errors: sequences differ by less than a quarter from their mean.
    expected = exact(discount, step_limit)
    assert found["random_value"] <= found["random_bound"] + 1e-12
    assert found["random_value"] - error < expected < found["random_bound"] + error


def test_they_are_in_the_summary_of_the_return_alone():
    world = MadeWorld(1, nothing_or_all)
    assert "random_value" in search.Solution(world, 0.5, 0.9).summary()
    assert "random_value" not in search.Solution(world, 0.5, 0.9, "time").summary()
