"""The ideal experimenter of the counterfeit-coin problem, against a search over sets of labels and by hand."""

import functools
import itertools
import math
import types

import ideals
import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.analysis.ideal import counterfeit, resting

SIDES = (0, -1, 1)


def solve(num_things, num_suspects, discount, step_limit):
    return resting.solve(counterfeit.Scale(num_things, num_suspects), discount, step_limit)


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


@pytest.mark.parametrize(
    "things, suspects, discount, step_limit",
    [
        (2, 2, 0.9, 8),
        (3, 2, 0.95, 9),
        (4, 3, 0.5, 8),
        (4, 2, 1.0, 7),
        (5, 5, 0.95, 5),
    ],
)
def test_a_search_over_sets_of_labels_finds_the_same_values(things, suspects, discount, step_limit):
    solution = solve(things, suspects, discount, step_limit)
    assert solution.value == pytest.approx(search(things, suspects, discount, step_limit, max), abs=1e-9)
    assert solution.random_value == pytest.approx(search(things, suspects, discount, step_limit, mean), abs=1e-9)


def test_one_suspect_of_two_by_hand():
    # Two placings, and the tilt tells heavier from lighter: gamma^2. At once, one of two labels is a guess, worth 0.
    solution = solve(2, 1, 0.9, 10)
    assert solution.value == pytest.approx(0.81)
    assert solution.at_once == 0
    assert solution.summary()["histogram"] == {0: 0.0, 1: 0.0, 2: 1.0}


def test_two_things_cannot_be_told_apart():
    # One is heavier, or the other lighter: after a weighing two labels are left, worth 0. At once 2 / 4 - 1 is less.
    assert solve(2, 2, 0.9, 10).value == pytest.approx(0.0)


def test_one_thing_is_weighed_against_one_first():
    solution = ideals.of("balance")
    scale = solution.apparatus
    first = solution.action(scale.start, 0)
    second = solution.action(scale.after(scale.start, first, np.sign(SIDES[first % 3])), 1)
    assert {SIDES[first % 3], SIDES[second % 3]} == {-1, 1} and first // 3 != second // 3


def test_played_episodes_earn_the_value():
    solution = ideals.of("balance")
    labels = np.random.default_rng(fresh_seed()).integers(12, size=100_000)
    interactions, right = solution.play(labels)
    earned = 0.95**interactions * np.where(right, 1, -1)
    assert abs(earned.mean() - solution.value) <= 5 * earned.std() / math.sqrt(len(earned))


@pytest.mark.parametrize("difficulty", [1, 3])
def test_it_is_always_right_and_its_beliefs_are_the_posterior(difficulty):
    solution = ideals.of("balance", difficulty=difficulty)
    environment = suite.load("balance", "features", {"difficulty": difficulty, "random": fresh_seed()})
    actor = solution.actor()
    expected = solution.summary()
    for _ in range(12):
        timestep = environment.reset()
        actor.observe_first(timestep)
        actions = []
        while not timestep.last():
            actions.append(actor.select_action(timestep.observation))
            timestep = environment.step(actions[-1])
            actor.observe(actions[-1], timestep)
        assert timestep.reward == 1  # It is always right.
        assert expected["histogram"][len(actions) - 1] > 0
        episode = types.SimpleNamespace(hidden=environment.task.hidden, actions=np.array(actions), observations={})
        beliefs = solution.beliefs(episode)
        np.testing.assert_allclose(beliefs.sum(axis=1), 1)
        assert (beliefs[:, environment.task.correct_answer] > 0).all()
        assert beliefs[-1, environment.task.correct_answer] == 1
        assert beliefs[0].max() == pytest.approx(1 / (2 * (7 - difficulty)))
