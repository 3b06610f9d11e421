"""The ideal experimenter of ordered labels, against a search over sets of labels and by hand."""

import functools

import numpy as np
import pytest
from seeds import fresh_seed

from physexp.analysis.ideal import intervals, resting


def skewed(size, skew):
    """Returns probabilities of `size` labels, decreasing for a skew above 1: Beta(1, skew) in equal parts."""
    return np.diff(1 - (1 - np.arange(size + 1) / size) ** skew)


def solve(prior, discount, step_limit):
    return resting.Solution(intervals.Thresholds(prior), discount, step_limit)


def between(low, high):
    """Returns the information state in which the labels from one to another are possible."""
    return sum(1 << label for label in range(low, high + 1)), None


def search(prior, discount, step_limit, tests, choose):
    """Returns the expected return by a search over sets of labels, bit masks, without using their order.

    Args:
      prior, discount, step_limit: as for `solve`.
      tests: for each test the set of labels that pass it, a bit mask.
      choose: combines the values of all tests: `max`, or `mean` for random ones.
    """

    @functools.cache
    def chance(labels):
        return sum(share for label, share in enumerate(prior) if labels >> label & 1)

    @functools.cache
    def value(labels, steps):
        likeliest = max(share for label, share in enumerate(prior) if labels >> label & 1)
        answer = 2 * likeliest / chance(labels) - 1
        if steps == 1:
            return max(answer, -1)  # One more test, and the episode ends unanswered.
        expected = []
        for test in tests:
            parts = [part for part in (labels & test, labels & ~test) if chance(part) > 0]
            expected.append(sum(chance(part) / chance(labels) * value(part, steps - 1) for part in parts))
        return max(answer, discount * choose(expected))

    return value((1 << len(prior)) - 1, step_limit)


def thresholds(size):
    """Returns the tests: labels 0 to l pass test l."""
    return [(1 << level + 1) - 1 for level in range(size)]


def mean(values):
    return sum(values) / len(values)


PRIORS = {
    "the default of threshold": skewed(8, 2.0),
    "steep": skewed(8, 5.0),
    "two labels": np.array([0.7, 0.3]),
    "few and many": np.array([0.4, 0.02, 0.3, 0.01, 0.27]),
    "impossible labels": np.array([0.5, 0.0, 0.0, 0.25, 0.25, 0.0]),
    "sixteen": skewed(16, 3.0),
}


@pytest.mark.parametrize("discount", [0.3, 1.0])
@pytest.mark.parametrize("prior", PRIORS.values(), ids=PRIORS.keys())
def test_a_search_over_sets_of_labels_finds_the_same_values(prior, discount):
    solution = solve(prior, discount, 12)
    tests = thresholds(len(prior))
    assert solution.value == pytest.approx(search(prior, discount, 12, tests, max), abs=1e-9)
    assert solution.random_value == pytest.approx(search(prior, discount, 12, tests, mean), abs=1e-9)


def test_the_search_agrees_for_random_priors():
    generator = np.random.default_rng(fresh_seed())
    for _ in range(20):
        size, step_limit = int(generator.integers(2, 9)), int(generator.integers(1, 8))
        prior, discount = generator.dirichlet(np.full(size, 0.5)), float(generator.uniform(0.2, 1))
        solution = solve(prior, discount, step_limit)
        assert solution.value == pytest.approx(search(prior, discount, step_limit, thresholds(size), max), abs=1e-9)
        at_random = search(prior, discount, step_limit, thresholds(size), mean)
        assert solution.random_value == pytest.approx(at_random, abs=1e-9)


def test_halving_finds_one_of_eight_equally_likely_labels_in_three_tests():
    solution = solve(np.full(8, 1 / 8), 0.95, 30)
    assert solution.value == pytest.approx(0.95**3)
    assert solution.summary() == {
        "value": pytest.approx(0.95**3),
        "bound": solution.value,
        "at_once": pytest.approx(2 / 8 - 1),
        "random_value": solution.random_value,
        "accuracy": pytest.approx(1.0),
        "mean_interactions": pytest.approx(3.0),
        "histogram": {0: 0.0, 1: 0.0, 2: 0.0, 3: pytest.approx(1.0)},
    }
    assert solution.action(between(0, 7), 0) == 3
    assert solution.action(between(4, 7), 1) == 5
    assert solution.action(between(6, 6), 3) == 8 + 6


def test_three_labels_by_hand():
    # Test 0 first: 0.9 (0.5 + 0.5 * 0.9) = 0.855, for the other two labels are worth 0.9 with one more test, and 0.2 at
    # once. Test 1 first: 0.9 (0.8 * 0.9 + 0.2) = 0.828. At once: 0.
    # Tests at random: two labels, a, are told apart by one test of three, a = 0.3 (1 + 2 a) = 0.75. All three, r, are
    # divided by tests 0 and 1: r = 0.3 ((0.5 + 0.5 a) + (0.8 a + 0.2) + r) = 0.3 (0.875 + 0.8 + r) = 0.5025 / 0.7.
    solution = solve([0.5, 0.3, 0.2], 0.9, 200)
    assert solution.value == pytest.approx(0.855)
    assert solution.at_once == pytest.approx(0.0)
    assert solution.random_value == pytest.approx(0.5025 / 0.7)
    assert [solution.action(between(0, 2), 0), solution.action(between(1, 2), 1)] == [0, 1]


def test_a_skewed_prior_is_split_by_probability_and_not_by_rank():
    # Labels 0, 1 and 2 have 15, 13 and 11 of 64: test 1 is passed by 28, nearer to a half than the 39 that pass test 2.
    solution = solve(PRIORS["the default of threshold"], 0.95, 30)
    assert solution.action(between(0, 7), 0) == 1
    assert solution.value == pytest.approx(0.8685, abs=1e-4)
    assert solution.summary()["mean_interactions"] == pytest.approx(2.766, abs=1e-3)


@pytest.mark.parametrize(("skew", "discount"), [(2.0, 0.95), (2.0, 0.7)])
def test_played_episodes_earn_the_value(skew, discount):
    prior = skewed(8, skew)
    solution = solve(prior, discount, 30)
    interactions, right = solution.play(np.arange(8))  # Each label once.
    earned = discount**interactions * np.where(right, 1, -1)
    assert prior @ earned == pytest.approx(solution.value, abs=1e-12)
    summary = solution.summary()
    assert prior @ interactions == pytest.approx(summary["mean_interactions"], abs=1e-12)
    assert prior @ right == pytest.approx(summary["accuracy"], abs=1e-12)


def test_expensive_tests_look_for_one_label_at_a_time():
    # n equally likely labels at gamma 0.1, times n: w(1) = 1 and w(n) = 0.1 (1 + w(n - 1)), so w(2) = 0.2, w(3) = 0.12,
    # w(4) = 0.112, ... w(8) = 0.1111112. Halves would be worth 8 * 0.001.
    assert solve(np.full(8, 1 / 8), 0.1, 30).value == pytest.approx(0.1111112 / 8)


def test_the_best_guess_is_given_in_the_last_step():
    # Three steps leave two tests, and one of two labels to be guessed: its chance is a half, worth 0.
    solution = solve(np.full(8, 1 / 8), 0.95, 3)
    assert solution.value == pytest.approx(0.0, abs=1e-12)
    assert solve(np.full(8, 1 / 8), 0.95, 1).value == pytest.approx(2 / 8 - 1)


def test_a_certain_loss_is_delayed():
    # In two steps there is time for one test, after which each answer is right once in four: -0.5, but a step later.
    assert solve(np.full(8, 1 / 8), 0.1, 2).value == pytest.approx(-0.05)


def test_an_impossible_reading_is_refused():
    with pytest.raises(ValueError, match=r"after interaction 6 the reading is 0; expected one of \[1\]"):
        intervals.Thresholds(np.full(8, 1 / 8)).after(between(2, 4), 6, 0)
