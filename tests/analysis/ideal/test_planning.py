"""The returns of experimenters with less planning, against independently written trees, and by hand."""

import functools
import math
import statistics

import ideals
from made_worlds import COUNTS, PATTERNS, PRIOR, MadeWorld
import numpy as np
import pytest

from physexp.analysis.ideal import base, histories, intervals, planning

LABELS = np.array(COUNTS) - 1


def opened(sequence):
    """Action 1 reveals the label, but only after action 0, which reveals nothing."""
    return LABELS if 0 in sequence and sequence[-1] == 1 else np.zeros(PATTERNS)


def told_next(sequence):
    """Action 2 reveals little, and spoils what the others would reveal together."""
    first = LABELS > 1 if sequence[-1] == 0 else LABELS % 2
    return (LABELS == 0) if sequence[-1] == 2 else np.zeros(PATTERNS) if 2 in sequence else first


def tree(tells, num_actions, discount, step_limit):
    """Returns the returns of all experimenters, from sequences of actions and the hypotheses that they leave."""

    def labels(group):
        weights = np.bincount(LABELS[list(group)], PRIOR[list(group)], minlength=5)
        return weights / PRIOR[list(group)].sum()

    def answer(group):
        return 2 * labels(group).max() - 1

    @functools.cache
    def split(sequence, group):
        seen = np.array(tells(sequence))[list(group)]
        found = [
            tuple(one for one, is_so in zip(group, seen == reading, strict=True) if is_so) for reading in set(seen)
        ]
        return [(PRIOR[list(part)].sum() / PRIOR[list(group)].sum(), part) for part in found]

    def information(sequence, group):
        """The mutual information of reading and label: the mean log ratio of posterior and prior."""
        before, bits = labels(group), 0.0
        for share, part in split(sequence, group):
            after = labels(part)
            bits += share * sum(p * math.log2(p / q) for p, q in zip(after, before, strict=True) if p > 0)
        return bits

    @functools.cache
    def plan(sequence, group, steps):
        """The best return of at most some interactions and an answer, and its first interactions."""
        worths = [
            discount
            * sum(share * plan((*sequence, k), part, steps - 1)[0] for share, part in split((*sequence, k), group))
            for k in range(num_actions if steps else 0)
        ]
        best = max([answer(group), *worths])
        return best, [k for k, worth in enumerate(worths) if worth > best - 1e-10 and best > answer(group) + 1e-10]

    def greedy(sequence, group, left):
        bits = [information((*sequence, k), group) for k in range(num_actions)]
        return [k for k, one in enumerate(bits) if one > max(bits) - 1e-10]

    def earned(choose, join, sequence=(), group=tuple(range(PATTERNS)), left=step_limit):
        chosen = choose(sequence, group, left) if left > 1 and answer(group) < 1 else []
        worths = []
        for k in chosen:
            after = [(share, (*sequence, k), part) for share, part in split((*sequence, k), group)]
            worths.append(discount * sum(share * earned(choose, join, *state, left - 1) for share, *state in after))
        return max(answer(group), join(worths)) if chosen else answer(group)

    mean = statistics.fmean
    ahead = {
        f"lookahead_{steps}": earned(lambda s, g, left, k=steps: plan(s, g, min(k, left - 1))[1], mean)
        for steps in planning.HORIZONS
    }
    return {"greedy": earned(greedy, mean), "greedy_lucky": earned(greedy, max), **ahead}


def returns(tells, num_actions, discount, step_limit):
    return planning.returns(histories.Histories(MadeWorld(num_actions, tells), 0.5), discount, step_limit)


@pytest.mark.parametrize(("tells", "num_actions"), [(opened, 2), (told_next, 3)])
@pytest.mark.parametrize(("discount", "step_limit"), [(0.9, 6), (0.6, 3)])
def test_a_tree_finds_the_same_returns(tells, num_actions, discount, step_limit):
    found = returns(tells, num_actions, discount, step_limit)
    assert found.pop("floor") == pytest.approx(-0.6 * discount ** (step_limit - 1))
    assert found.pop("planning_error") == 0
    assert found == pytest.approx(tree(tells, num_actions, discount, step_limit), abs=1e-9)


@pytest.mark.parametrize("at_once", [-1.0, -0.6, 0.0, 0.3])
def test_the_floor_is_the_best_of_all_ways_to_play_without_looking(at_once):
    answers = [0.9**number * at_once for number in range(6)]  # After so many interactions, of six actions at most.
    silence = -(0.9**5)
    assert base.floor(at_once, 0.9, 6) == pytest.approx(max(*answers, silence))


def test_a_step_that_reveals_nothing_is_drawn_unless_it_is_planned():
    # In three steps: action 0, then 1, then the label, 0.9^2 = 0.81. Action 1 first leaves only an answer that is right
    # twice in five, later: 0.9^2 * -0.6. Either is drawn by those that see no use of action 0. So they earn the mean,
    # except that after action 0 all take action 1.
    found = returns(opened, 2, 0.9, 3)
    assert found["greedy"] == found["lookahead_1"] == pytest.approx((0.81 - 0.81 * 0.6) / 2)
    assert found["greedy_lucky"] == found["lookahead_2"] == pytest.approx(0.81)


def test_states_that_are_hardly_reached_bound_the_error():
    apparatus = intervals.Thresholds(np.full(8, 1 / 8))
    exact, rough = (planning.returns(apparatus, 0.9, 9, negligible) for negligible in (0.0, 0.02))
    assert exact["planning_error"] == 0 < rough["planning_error"]
    for name in ("greedy", "lookahead_1", "lookahead_2"):
        assert rough[name] <= exact[name] <= rough[name] + rough["planning_error"]


@pytest.mark.parametrize(
    ("domain", "task", "scores"),  # Of greedy, lucky, and of looking 1, 2 and 4 interactions ahead.
    [
        ("which_is_heavier", "features", (1, 1, 1, 1, 1)),
        ("threshold", "features", (1, 1, 0.986, 0.995, 1)),
        ("balance", "features", (0.905, 1, 0.330, 0.878, 1)),
        ("crush", "features", (0.626, 0.626, 0.510, 0.968, 0.994)),
        ("strings", "features", (0.924, 1, 0.829, 1, 1)),
        ("towers", "direct_features", (1, 1, 1, 1, 1)),
        pytest.param("towers", "fist_features", (0.594, 1, 0.594, 1, 1), marks=pytest.mark.long),
        pytest.param("lump", "features", (0.865, 0.986, 0.728, 0.977, 0.990), marks=pytest.mark.long),
        pytest.param("strike", "features", (0.805, 0.831, 0.758, 0.950, 0.953), marks=pytest.mark.long),
    ],
)
def test_little_planning_earns_these_scores(domain, task, scores):
    solution = ideals.of(domain, task)
    found = solution.planning()
    names = ("greedy", "greedy_lucky", *(f"lookahead_{steps}" for steps in planning.HORIZONS))
    shares = [(found[name] - found["floor"]) / (solution.value - found["floor"]) for name in names]
    assert shares == pytest.approx(scores, abs=1e-3)
    assert max(found[name] for name in names) <= solution.value + 1e-4
