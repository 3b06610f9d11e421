"""The ideal experimenter of comparisons with wrong results, against a tree of all sequences of tests and results."""

import functools
import math
import statistics

import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.analysis import domains
from physexp.analysis.ideal import intervals, mistakes, noisy_intervals, planning, resting, rollouts


class Tree:
    """Experimenters that remember how often each test was passed and failed; their beliefs are by Bayes' rule."""

    def __init__(self, prior, error, discount, step_limit):
        self._prior, self._error, self._discount, self._step_limit = prior, error, discount, step_limit
        self._split, self._plan = functools.cache(self._find_split), functools.cache(self._find_plan)

    def belief(self, counts):
        """The posterior, from a pair of numbers of failures and passes for each test."""
        weights = [
            chance
            * math.prod(
                (self._error if label <= test else 1 - self._error) ** failed
                * (1 - self._error if label <= test else self._error) ** passed
                for test, (failed, passed) in enumerate(counts)
            )
            for label, chance in enumerate(self._prior)
        ]
        return np.array(weights) / sum(weights)

    def answer(self, counts):
        return 2 * self.belief(counts).max() - 1

    def bits(self, counts):
        return -sum(p * math.log2(p) for p in self.belief(counts) if p > 0)

    def _find_split(self, counts, test):
        passing = sum(
            chance * (1 - self._error if label <= test else self._error)
            for label, chance in enumerate(self.belief(counts))
        )
        failed, passed = counts[test]
        results = ((1 - passing, (failed + 1, passed)), (passing, (failed, passed + 1)))
        return [(chance, (*counts[:test], after, *counts[test + 1 :])) for chance, after in results]

    def worths(self, value, counts):
        """The expected value after each test, times the discount."""
        return [
            self._discount * sum(chance * value(after) for chance, after in self._split(counts, test))
            for test in range(len(counts))
        ]

    def _find_plan(self, counts, steps):
        """The best return of at most some tests and an answer, and the first tests of these plans."""
        worths = self.worths(lambda after: self._plan(after, steps - 1)[0], counts) if steps else []
        best = max([self.answer(counts), *worths])
        firsts = [test for test, worth in enumerate(worths) if worth > best - 1e-10]
        return best, firsts if best > self.answer(counts) + 1e-10 else []

    def informative(self, counts, left):
        bits = self.worths(self.bits, counts)
        return [test for test, one in enumerate(bits) if one < min(bits) + 1e-10]

    def earned(self, choose, join=statistics.fmean):
        """The return of tests that `choose` names, which `join` combines, and of an answer at the best moment."""

        @functools.cache
        def value(counts, left):
            chosen = choose(counts, left) if left > 1 else []
            worths = self.worths(lambda after: value(after, left - 1), counts) if chosen else []
            return max([self.answer(counts), *([join(worths[test] for test in chosen)] if chosen else [])])

        return value(((0, 0),) * len(self._prior), self._step_limit)

    def returns(self):
        """The returns of all experimenters, by name."""
        everything = range(len(self._prior))
        ahead = {
            f"lookahead_{steps}": self.earned(lambda counts, left, k=steps: self._plan(counts, min(k, left - 1))[1])
            for steps in planning.HORIZONS
        }
        return {
            "value": self.earned(lambda counts, left: everything, max),
            "random_value": self.earned(lambda counts, left: everything),
            "greedy": self.earned(self.informative),
            "greedy_lucky": self.earned(self.informative, max),
            **ahead,
        }


@pytest.mark.parametrize("size, step_limit", [(2, 7), (3, 7), (4, 6), (5, 5), (4, 1)])
def test_a_tree_finds_the_same_returns(size, step_limit):
    generator = np.random.default_rng(fresh_seed())
    prior = np.full(size, 1 / size) if size == 5 else generator.dirichlet(np.ones(size))
    error, discount = generator.uniform(0.01, 0.4), generator.uniform(0.7, 1)
    solution = noisy_intervals.Solution(prior, error, discount, step_limit)
    found = {**solution.planning(), "value": solution.value, "random_value": solution.compared()["random_value"]}
    at_once = 2 * prior.max() - 1
    assert found.pop("floor") == pytest.approx(max(at_once, at_once * discount ** (step_limit - 1)))
    assert found.pop("planning_error") == 0
    assert found == pytest.approx(Tree(prior.tolist(), error, discount, step_limit).returns(), abs=1e-9)
    interactions, right, shares = solution.outcomes()
    assert shares @ (discount**interactions * np.where(right, 1, -1)) == pytest.approx(solution.value, abs=1e-9)


def test_results_that_are_hardly_ever_wrong_are_worth_as_much():
    prior = np.diff(1 - (1 - np.arange(9) / 8) ** 2)
    exact = resting.Solution(intervals.Thresholds(prior), 0.95, 8)
    for error in (1e-300, 1e-9):
        found = noisy_intervals.Solution(prior, error, 0.95, 8)
        assert {"value": found.value, **found.compared()} == pytest.approx(
            {"value": exact.value, **exact.compared()}, abs=1e-6
        )


OPTIONS = {"flag_noise": 0.1, "time_limit": 0.8}


def solved():
    return domains.find("threshold").ideal("features", OPTIONS, 0.95)


def test_its_mean_return_with_wrong_flags_is_its_value():
    solution = solved()
    actors = [solution.actor() for _ in range(64)]
    rewards, lengths = rollouts.play(actors, "threshold", "features", OPTIONS, 8, fresh_seed())
    returns = rewards * 0.95 ** (lengths - 1)
    assert abs(returns.mean() - solution.value) < 6 * returns.std() / math.sqrt(returns.size)


def test_its_own_episodes_are_judged_to_cost_nothing():
    """The beliefs of the judge, from the hidden property, are those of the player, from the flags."""
    solution, seed = solved(), fresh_seed()
    environment = suite.load("threshold", "features", task_kwargs={**OPTIONS, "random": seed})
    for _ in range(10):
        actor, timestep, taken = solution.actor(), environment.reset(), []
        actor.observe_first(timestep)
        while not timestep.last():
            taken.append(actor.select_action(timestep.observation))
            timestep = environment.step(taken[-1])
            actor.observe(taken[-1], timestep)
        judgement = solution.judge(environment.task.hidden, np.array(taken))
        (costs,) = zip(*mistakes.of_episodes([judgement], [np.array(taken)], 0.95).values(), strict=True)
        assert costs == pytest.approx([0] * len(mistakes.KINDS), abs=1e-12)
        assert judgement.beliefs.shape == (len(taken) + 1, 8)
        np.testing.assert_array_equal(judgement.beliefs[-1], judgement.beliefs[-2])


def test_silence_is_judged_until_the_last_step():
    judgement = solved().judge(np.array([13.0, 0.5]), np.full(8, 7))  # The strongest push reveals nothing.
    np.testing.assert_allclose(judgement.beliefs, 1 / 8)
    assert (judgement.values[-1, :8] == -1).all() and not judgement.is_informative.any()
    # The later, the fewer pushes are left for the same belief.
    assert (np.diff(judgement.values.max(axis=1)) <= 1e-12).all()
