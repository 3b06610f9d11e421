"""The ideal experimenters of apparatuses that rest, against a search over sets of labels and by hand."""

import functools
import itertools
import statistics

import ideals
import numpy as np
import pytest
from seeds import fresh_seed

from physexp.analysis.ideal import bands, counterfeit, intervals, resting


def search(chances, moves, setting, discount, step_limit, choose, means=lambda label: label):
    """Returns the expected return by a search over sets of labels and settings.

    Args:
      chances: the probability of each label.
      moves: returns, for a setting, the next setting, or the function from the reading to it, and the function from a
        label to the reading, of each interaction.
      setting: the first one.
      discount, step_limit: as for `resting.Solution`.
      choose: combines the values of all interactions: `max`, or `fmean` for random ones.
      means: returns the right answer for a label.
    """
    chances = {label: chance for label, chance in chances.items() if chance > 0}

    @functools.cache
    def share(labels):
        return sum(chances[label] for label in labels)

    @functools.cache
    def parts(labels, setting):
        found = []
        for following, reading in moves(setting):
            groups = {}
            for label in labels:
                groups.setdefault(reading(label), []).append(label)
            after = following if callable(following) else lambda seen, following=following: following
            found.append([(frozenset(group), after(seen)) for seen, group in groups.items()])
        return found

    @functools.cache
    def value(labels, setting, steps):
        groups = {}
        for label in labels:
            groups.setdefault(means(label), []).append(label)
        answer = 2 * max(map(share, map(frozenset, groups.values()))) / share(labels) - 1
        if steps == 1:
            return answer
        expected = [
            sum(share(part) / share(labels) * value(part, following, steps - 1) for part, following in found)
            for found in parts(labels, setting)
        ]
        return max(answer, discount * choose(expected))

    return value(frozenset(chances), setting, step_limit)


def agree(apparatus, world, discount, step_limit):
    """Asserts that a solution has the values of a search; a world is the first three arguments of `search`."""
    solution = resting.Solution(apparatus, discount, step_limit)
    assert solution.value == pytest.approx(search(*world, discount, step_limit, max), abs=1e-9)
    at_random = search(*world, discount, step_limit, statistics.fmean)
    assert solution.compared()["random_value"] == pytest.approx(at_random, abs=1e-9)


def levels(prior):
    """Ordered labels: test l is passed if the label is at most l."""
    tests = [(None, lambda label, level=level: label <= level) for level in range(len(prior))]
    return dict(enumerate(prior)), lambda setting: tests, None


def specimens_of(prior, num_specimens):
    """The same tests of several specimens, of which each test that is passed destroys one."""

    def moves(left):
        for level in range(len(prior)):
            yield left.__sub__, lambda label, level=level: int(left > 0 and label <= level)

    return dict(enumerate(prior)), moves, num_specimens


def coins(num_things, num_suspects, is_held):
    """One suspect is heavier or lighter; an interaction puts a thing aside, on the left pan or on the right one.

    The tilt is seen at once, or only if one more interaction asks for it.
    """

    def moves(sides):
        for thing, side in itertools.product(range(num_things), (0, -1, 1)):
            moved = (*sides[:thing], side, *sides[thing + 1 :])
            yield moved, (lambda label: None) if is_held else functools.partial(tilt, moved)
        if is_held:
            yield sides, functools.partial(tilt, sides)

    def tilt(sides, label):
        odd, sign = label
        return np.sign(round(sum(side * (1 + 0.3 * sign * (thing == odd)) for thing, side in enumerate(sides)), 6))

    labels = itertools.product(range(num_suspects), (1, -1))
    return dict.fromkeys(labels, 1 / (2 * num_suspects)), moves, (0,) * num_things


def graphs(weights, num_things, num_clamps):
    """A pull of a thing moves all that bands connect to it, except through clamped ones."""
    pairs = list(itertools.combinations(range(num_things), 2))

    def moves(clamped):
        for thing in range(num_things):
            yield clamped, functools.partial(moved, clamped, thing)
            yield clamp(clamped, thing), lambda graph: None

    def clamp(clamped, thing):
        if thing in clamped or len(clamped) < num_clamps:
            return clamped ^ {thing}
        return frozenset({thing}) if num_clamps == 1 else clamped

    def moved(clamped, pulled, graph):
        found, frontier = set(), [pulled]
        while frontier:
            thing = frontier.pop()
            if thing not in clamped and thing not in found:
                found.add(thing)
                frontier += [other for pair in graph if thing in pair for other in pair]
        return frozenset(found)

    labels = [frozenset(pair for bit, pair in enumerate(pairs) if label >> bit & 1) for label in range(2 ** len(pairs))]
    return dict(zip(labels, weights, strict=True)), moves, frozenset()


OF_THRESHOLD = np.diff(1 - (1 - np.arange(9) / 8) ** 2)  # At the default difficulty.
IMPOSSIBLE_LABELS = [0.5, 0.0, 0.0, 0.25, 0.25, 0.0]
PRIORS = [OF_THRESHOLD, IMPOSSIBLE_LABELS, [0.4, 0.02, 0.3, 0.01, 0.27], np.diff(1 - (1 - np.arange(17) / 16) ** 3)]


def test_a_search_over_sets_of_levels_finds_the_same_values():
    generator = np.random.default_rng(fresh_seed())
    drawn = [generator.dirichlet(np.full(size, 0.5)) for size in generator.integers(2, 9, size=10)]
    for prior in [*PRIORS, *drawn]:
        discount, step_limit = float(generator.choice([0.3, 1.0, generator.uniform(0.2, 1)])), generator.integers(1, 13)
        agree(intervals.Thresholds(prior), levels(prior), discount, int(step_limit))


@pytest.mark.parametrize(
    "things, suspects, discount, step_limit, is_held",
    [
        (3, 2, 0.95, 9, False),
        (4, 3, 0.5, 8, False),
        (4, 2, 1.0, 7, False),
        (3, 3, 0.98, 12, True),
        (4, 2, 1.0, 7, True),
    ],
)
def test_a_search_over_placings_of_coins_finds_the_same_values(things, suspects, discount, step_limit, is_held):
    agree(counterfeit.Scale(things, suspects, is_held), coins(things, suspects, is_held), discount, step_limit)


@pytest.mark.parametrize("suspects, step_limit, is_held", [(3, 5, False), (2, 6, True)])
def test_a_search_finds_the_same_values_where_a_question_is_told(suspects, step_limit, is_held):
    """It asks whether the odd thing is among some; it is drawn from one question, its negation, and another one."""
    first, second = np.array([True, False, False, True]), np.array([False, False, True, False])
    told = [counterfeit.Scale(4, suspects, is_held, asked) for asked in (first, ~first, second)]
    solution = resting.Solution(told[0], 0.95, step_limit, told=told)
    for found, choose in ((solution.value, max), (solution.compared()["random_value"], statistics.fmean)):
        one, other = (
            search(*coins(4, suspects, is_held), 0.95, step_limit, choose, lambda label, asked=asked: asked[label[0]])
            for asked in (first, second)
        )
        assert found == pytest.approx((2 * one + other) / 3, abs=1e-9)
    interactions, right, shares = solution.outcomes()
    assert shares @ (0.95**interactions * np.where(right, 1, -1)) == pytest.approx(solution.value, abs=1e-9)


UNEQUAL = [0.3, 0.2, 0.1, 0.1, 0.1, 0.1, 0.05, 0.05]
RARE = np.exp2([-label.bit_count() for label in range(64)]) / 1.5**6  # Two are joined with probability 1 / 3.


@pytest.mark.parametrize(
    "weights, things, clamps, step_limit",
    [(np.full(8, 1 / 8), 3, 1, 10), (UNEQUAL, 3, 1, 10), (UNEQUAL, 3, 2, 10), (RARE, 4, 2, 5)],
)
def test_a_search_over_sets_of_graphs_finds_the_same_values(weights, things, clamps, step_limit):
    agree(bands.Clamped(things, weights, clamps), graphs(weights, things, clamps), 0.9, step_limit)


@pytest.mark.parametrize(
    "prior, specimens, step_limit",
    [(np.full(16, 1 / 16), 2, 16), (np.full(8, 1 / 8), 1, 10), ([0.4, 0.1, 0.3, 0.2], 3, 5)],
)
def test_a_search_over_tests_that_destroy_finds_the_same_values(prior, specimens, step_limit):
    agree(intervals.Specimens(prior, specimens), specimens_of(prior, specimens), 0.95, step_limit)


def test_the_only_specimen_is_tested_from_the_lowest_level_on():
    # Labels 0 to 7 take 1, 2 ... 7 tests and again 7, for what fails the seventh test is the last label.
    solution = resting.Solution(intervals.Specimens(np.full(8, 1 / 8), 1), 0.95, 10)
    assert solution.value == pytest.approx(statistics.fmean(0.95**count for count in (1, 2, 3, 4, 5, 6, 7, 7)))
    assert [solution.action((255 & ~(2**level - 1), 0), level) for level in range(7)] == list(range(7))


def solve(prior, discount, step_limit):
    return resting.Solution(intervals.Thresholds(prior), discount, step_limit)


def between(low, high):
    """Returns the information state in which the levels from one to another are possible."""
    return sum(1 << label for label in range(low, high + 1)), None


def test_halving_finds_one_of_eight_equally_likely_labels_in_three_tests():
    solution = solve(np.full(8, 1 / 8), 0.95, 30)
    assert solution.value == pytest.approx(0.95**3)
    assert solution.summary() == {
        "value": pytest.approx(0.95**3),
        "bound": solution.value,
        "at_once": pytest.approx(2 / 8 - 1),
        "random_value": pytest.approx(solution.compared()["random_value"]),
        "accuracy": pytest.approx(1.0),
        "mean_interactions": pytest.approx(3.0),
        "histogram": {0: 0.0, 1: 0.0, 2: 0.0, 3: pytest.approx(1.0)},
    }
    assert solution.action(between(0, 7), 0) == 3
    assert solution.action(between(4, 7), 1) == 5
    assert solution.action(between(6, 6), 3) == 8 + 6


def test_labels_may_be_more_than_an_integer_of_numpy_has_bits():
    apparatus = intervals.Thresholds(np.full(100, 1 / 100))
    state = apparatus.after(apparatus.start, 89, 0)
    np.testing.assert_allclose(apparatus.posterior(state), [0] * 90 + [1 / 10] * 10)


def test_three_labels_by_hand():
    # Test 0 first: 0.9 (0.5 + 0.5 * 0.9) = 0.855, for the other two labels are worth 0.9 with one more test, and 0.2 at
    # once. Test 1 first: 0.9 (0.8 * 0.9 + 0.2) = 0.828. At once: 0.
    # Tests at random: two labels, a, are told apart by one test of three, a = 0.3 (1 + 2 a) = 0.75. All three, r, are
    # divided by tests 0 and 1: r = 0.3 ((0.5 + 0.5 a) + (0.8 a + 0.2) + r) = 0.3 (0.875 + 0.8 + r) = 0.5025 / 0.7.
    solution = solve([0.5, 0.3, 0.2], 0.9, 200)
    assert solution.value == pytest.approx(0.855)
    assert solution.compared() == {"at_once": pytest.approx(0.0), "random_value": pytest.approx(0.5025 / 0.7)}
    assert [solution.action(between(0, 2), 0), solution.action(between(1, 2), 1)] == [0, 1]


@pytest.mark.parametrize(
    ("discount", "step_limit", "value"),
    [
        # n labels at gamma 0.1, times n: w(1) = 1 and w(n) = 0.1 (1 + w(n - 1)), one label at a time, so w(2) = 0.2,
        # w(3) = 0.12, w(4) = 0.112, ... w(8) = 0.1111112. Halves would be worth 8 * 0.001.
        (0.1, 30, 0.1111112 / 8),
        (0.95, 3, 0.0),  # Two tests, and one of two labels to be guessed.
        (0.95, 1, 2 / 8 - 1),
        (0.1, 2, -0.05),  # One test, after which each answer is right once in four: -0.5, but a step later.
    ],
)
def test_eight_equally_likely_labels_by_hand(discount, step_limit, value):
    assert solve(np.full(8, 1 / 8), discount, step_limit).value == pytest.approx(value, abs=1e-12)


def test_played_episodes_earn_the_value():
    solution = solve(OF_THRESHOLD, 0.95, 30)
    interactions, right, shares = solution.outcomes()
    np.testing.assert_allclose(shares, OF_THRESHOLD)
    assert shares @ (0.95**interactions * np.where(right, 1, -1)) == pytest.approx(solution.value, abs=1e-12)


def test_an_impossible_reading_is_refused():
    with pytest.raises(ValueError, match=r"after interaction 6 the reading is 0; expected one of \[1\]"):
        intervals.Thresholds(np.full(8, 1 / 8)).after(between(2, 4), 6, 0)


def test_a_latch_costs_one_action_for_each_weighing():
    # Two placings make a new weighing, and its result is seen with the second one, or after a release.
    free, held = (ideals.of("balance", latch=latch).outcomes() for latch in (False, True))
    np.testing.assert_array_equal(np.sort(held[0]), np.sort(free[0] * 3 // 2))
    assert free[1].all() and held[1].all()


def test_it_clamps_only_if_pulls_leave_several_graphs():
    """By hand: pull 0. If it moves alone, pull 1. If one other moves, the graph is known. If both move, four are left.

    In these, one pair may be missing. Each of three clamps reveals one pair: clamp 0 and pull 1, then clamp 1 and pull
    0, then clamp 2 and pull 0 reveal whether 1-2, 0-2, 0-1 is missing; the first missing pair ends the search.
    """
    solution = ideals.of("strings")
    interactions, right, _ = solution.outcomes()
    assert right.all()
    # None and 1-2: two pulls. 0-1 and 0-2: one. Rows of three: 3, 5 or 7; the ring, 7.
    assert sorted(interactions) == [1, 1, 2, 2, 3, 5, 7, 7]
    assert solution.value == pytest.approx(sum(0.95**count for count in (1, 1, 2, 2, 3, 5, 7, 7)) / 8)
    for graph in range(8):
        state, clamps = solution.apparatus.start, 0
        for step in range(interactions[graph]):
            action = solution.action(state, step)
            clamps += action >= 3
            reading = solution.apparatus.readings(state[1])[action, graph]
            state = solution.apparatus.after(state, action, reading)
        assert (clamps > 0) == (graph in (3, 5, 6, 7))  # Two bands, or three.
