"""The ideal experimenter of K things of which one is different, when one touch of a thing reveals its value.

The theory is in docs/ideal.md. What it knows after some touches is all in two numbers: the largest value M found, and
t, the sum of the likelihood ratios r(m) (odd one's density over a common one's) of the values found, over r(M). What
states are worth is found by going back from the last touch, on a grid.
"""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
import functools
import math
from typing import Any

import numpy as np
from scipy import interpolate, special
from scipy.stats import qmc

from physexp import checks
from physexp.agents import core
from physexp.analysis.ideal import base
from physexp.suite.engine import priors, rules

_LARGEST_NODES, _RATIO_NODES = 400, 33
_QUADRATURE_NODES = 48  # Per half of each density; many more where there is only one state to integrate from.
_EPISODES = 2**17  # Of the histogram; drawn evenly (Sobol), so that its error is far below 0.001.
MOST_THINGS = 20
_EASIEST = 1e6

Read = Callable[[Mapping[str, np.ndarray], int], float]
"""Reads the value of the thing that an interaction has touched from the observation after it."""


def posterior(values: np.ndarray, prior: priors.OddOneOut) -> np.ndarray:
    """Returns how likely each thing is to have the largest value, given the values of those that were touched.

    Args:
      values: in [0, 1], NaN where a thing was not touched, float64 [N, K].
      prior: of the values.

    Returns:
      Probabilities, float64 [N, K]. Of the things touched only the largest can be it; unknown ones share the rest.
    """
    return _posterior(values, *_statistics(values, prior), prior)


def _posterior(values, largest, log_weight, prior) -> np.ndarray:
    """Returns the same, given the statistics of the values."""
    touched = ~np.isnan(values)
    unknown = (~touched).sum(axis=1)
    chance = np.where(touched.any(axis=1), _largest_is_touched(unknown, largest, log_weight, prior), 0.0)
    others = np.divide(1 - chance, unknown, out=np.zeros(len(values)), where=unknown > 0)
    result = np.where(touched, 0.0, others[:, None])
    rows = np.flatnonzero(touched.any(axis=1))
    result[rows, np.nanargmax(values[rows], axis=1)] = chance[rows]
    return result


def _statistics(values, prior) -> tuple[np.ndarray, np.ndarray]:
    """Of the things touched: the largest value, and the logarithm of the sum of ratios; -inf where there is none."""
    known = np.where(np.isnan(values), -np.inf, values)
    ratios = np.where(np.isnan(values), -np.inf, prior.log_ratio(np.nan_to_num(values, nan=0.5)))
    return known.max(axis=1), special.logsumexp(ratios, axis=1)


def _largest_is_touched(unknown, largest, log_weight, prior):
    """Returns the probability that the largest value found is the largest of all.

    The odd one is among those touched with probability W / (W + u), W being the sum of their ratios and u how many
    things are unknown; then u common ones must have smaller values. Otherwise the odd one and u - 1 common ones must.
    """
    value = np.clip(largest, 0, 1)
    with np.errstate(divide="ignore"):
        among_touched = special.expit(log_weight - np.log(unknown))
    smaller = prior.common_cdf(value)
    all_smaller = among_touched * smaller**unknown
    odd_smaller = (1 - among_touched) * prior.odd_cdf(value) * smaller ** np.maximum(unknown - 1, 0)
    return np.where(unknown == 0, 1.0, all_smaller + odd_smaller)


@dataclasses.dataclass(frozen=True)
class Solution:
    """The best policy there is, and what it is worth. It is solved for when it is first asked what touches are worth.

    Attributes:
      prior, discount: of what it is the best.
      step_limit: steps in an unanswered episode, which are taken for more than all touches and an answer need.
      find_read: finds out how values are read from what a task observes; None where they cannot be.
    """

    prior: priors.OddOneOut
    discount: float
    step_limit: float = math.inf
    find_read: Callable[[], Read] | None = dataclasses.field(default=None, compare=False)

    @property
    def value(self) -> float:
        """Expected discounted return, discount^touches times +1 or -1, from an episode's start."""
        return _go_back(self.prior, self.discount)[0]

    @property
    def bound(self) -> float:
        """Returns the upper bound, which is the value, since that is exact."""
        return self.value

    @property
    def at_once(self) -> float:
        """Expected return of an answer without any touch."""
        return base.worth_of_answers(1 / self.prior.num_things)

    @property
    def random_value(self) -> float:
        """Expected return of touches drawn uniformly, with the best answers at the best moment."""
        return _go_back(self.prior, self.discount, at_random=True)[0]

    def values(self, known: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns what the best answer and what one more touch are worth.

        Args:
          known: the values that are known, as for `posterior`, [N, K].

        Returns:
          Two float64 [N]; a touch is worth -inf where nothing is left to touch.
        """
        beliefs, touch = self._beliefs_and_touch(known)
        return base.worth_of_answers(beliefs.max(axis=1)), touch

    def _beliefs_and_touch(self, known: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns the posterior, [N, K], and what one more touch is worth, [N]."""
        largest, log_weight = _statistics(known, self.prior)
        touches = (~np.isnan(known)).sum(axis=1)
        touch = np.full(len(known), -np.inf)
        touch[touches == 0] = self.value
        for number, function in enumerate(_go_back(self.prior, self.discount)[1], start=1):
            rows = touches == number
            ratio = np.exp(log_weight[rows] - self.prior.log_ratio(largest[rows]))
            touch[rows] = function(_points(largest[rows], ratio))
        return _posterior(known, largest, log_weight, self.prior), touch

    def actions(self, known: np.ndarray) -> np.ndarray:
        """Returns the best action, int64 [N]: the first unknown thing, or K plus the label; `known` as above."""
        beliefs, touch = self._beliefs_and_touch(known)
        label = self.prior.num_things + beliefs.argmax(axis=1)
        return np.where(touch > base.worth_of_answers(beliefs.max(axis=1)), np.isnan(known).argmax(axis=1), label)

    def play(self, values: np.ndarray, read: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Plays episodes without physics.

        Args:
          values: of the things, float64 [N, K].
          read: what touches show of them, float64 [N, K]; by default the values.

        Returns:
          Touches, int64 [N], and whether the answer was right, bool [N].
        """
        read = values if read is None else read
        known = np.full(values.shape, np.nan)
        touches, labels = np.zeros(len(values), np.int64), np.full(len(values), -1)
        going = np.arange(len(values))
        while len(going):
            actions = self.actions(known[going])
            touching = actions < self.prior.num_things
            labels[going[~touching]] = actions[~touching] - self.prior.num_things
            going, touched = going[touching], actions[touching]
            known[going, touched] = read[going, touched]
            touches[going] += 1
        return touches, labels == values.argmax(axis=1)

    def actor(self) -> core.Actor:
        """Returns an actor that reads values from observations.

        Raises:
          ValueError: if they cannot be read from what the task observes.
        """
        if self.find_read is None:
            raise ValueError("the ideal experimenter reads values from features, not from images; choose such a task")
        return _Player(self, self.find_read())

    def beliefs(self, episode: base.Episode) -> np.ndarray:
        """Returns the posterior at the start and after each action of an episode, float64 [T + 1, K]."""
        return self.judge(episode).beliefs

    def judge(self, episode: base.Episode) -> base.Judgement:
        """Returns what could be known in an episode, and what its actions were worth."""
        return self.judge_all(np.asarray(episode.hidden)[None], [episode.actions])[0]

    def judge_all(self, values: np.ndarray, actions: Sequence[np.ndarray]) -> list[base.Judgement]:
        """Returns the same of N episodes, much faster than one after the other.

        Args:
          values: of the things, float64 [N, K].
          actions: of each episode, N arrays int64 [T].
        """
        num_things = self.prior.num_things
        lengths = np.array([len(taken) + 1 for taken in actions])
        ends = lengths.cumsum()
        rows = np.repeat(np.arange(len(lengths)), lengths)
        steps = np.arange(len(rows)) - np.repeat(ends - lengths, lengths)
        taken = np.concatenate([np.append(row, num_things) for row in actions])  # None after the last one.
        touched_at = np.full(values.shape, len(rows))
        moments = np.flatnonzero(taken < num_things)[::-1]  # Of several touches of a thing the first one is kept.
        touched_at[rows[moments], taken[moments]] = steps[moments]
        is_known = steps[:, None] > touched_at[rows]
        known = np.where(is_known, values[rows], np.nan)
        beliefs, touch = self._beliefs_and_touch(known)
        again = self.discount * np.maximum(base.worth_of_answers(beliefs.max(axis=1)), touch)
        touches = np.where(is_known, again[:, None], touch[:, None])
        touches[steps >= self.step_limit - 1] = rules.WRONG  # Silence.
        worth = np.concatenate([touches, base.worth_of_answers(beliefs)], axis=1)
        tells = np.append(~is_known, np.zeros_like(is_known), axis=1)[np.arange(len(rows)), taken]
        parts = [slice(start, end) for start, end in zip(ends - lengths, ends, strict=True)]
        return [base.Judgement(beliefs[part], worth[part][:-1], tells[part][:-1]) for part in parts]

    def figures(self) -> dict[str, Any]:
        """Returns what `base.figures` does."""
        return base.figures(self, *_evenly_drawn_episodes(self))

    def summary(self) -> dict[str, Any]:
        """Returns the figures, `at_once` and `random_value`."""
        return {**self.figures(), "at_once": self.at_once, "random_value": self.random_value}


class _Player(core.Actor):
    """Plays a solution: from what a touch shows it reads the value."""

    def __init__(self, solution: Solution, read: Read):
        self._solution, self._read = solution, read

    def observe_first(self, timestep):
        self._known = np.full((1, self._solution.prior.num_things), np.nan)

    def select_action(self, observation) -> int:
        return int(self._solution.actions(self._known)[0])

    def observe(self, action, next_timestep):
        if action < self._solution.prior.num_things and not next_timestep.last():
            self._known[0, action] = self._read(next_timestep.observation, action)


@functools.lru_cache(maxsize=64)
def _evenly_drawn_episodes(solution: Solution) -> tuple[np.ndarray, np.ndarray]:
    """Returns touches and success, as `Solution.play` does, of episodes whose values are spread evenly."""
    draws = qmc.Sobol(solution.prior.num_things + 1, rng=0).random(_EPISODES).clip(1e-12, 1 - 1e-12)
    return solution.play(solution.prior.from_uniforms(draws))


def solve(
    prior: priors.OddOneOut,
    discount: float,
    step_limit: float = math.inf,
    find_read: Callable[[], Read] | None = None,
) -> Solution:
    """Returns the best policy; its value is found to better than 0.0001.

    Args:
      prior: of 2 to 20 things, with a difficulty in [1, 1e6].
      discount: the agent's gamma, above 0 and at most 1.
      step_limit, find_read: as in `Solution`.

    Raises:
      ValueError: for a value that makes no sense.
    """
    difficulty = prior.difficulty
    if not (isinstance(difficulty, (int, float)) and 1 <= difficulty <= _EASIEST):
        raise ValueError(f"difficulty is {difficulty!r}; give a number in [1, {_EASIEST:g}] (the paper's beta)")
    checks.integer("num_things", prior.num_things, 2, MOST_THINGS)
    return Solution(prior, checks.discount("discount", discount), step_limit, find_read)


@functools.lru_cache(maxsize=64)
def _go_back(prior, discount, at_random=False) -> tuple[float, tuple[Callable, ...]]:
    """Returns the value, and for each number of touches done, 1 to K - 1, what going on is worth.

    The latter are functions of points [N, 2] of (largest value found, t). Who draws touches may touch what is known,
    which tells nothing and takes as long: with k of K known, until a new one is touched,
    `g (K - k) / K * sum over i of (g k / K)^i`.
    """
    num_things = prior.num_things
    levels = np.linspace(0, 1, _LARGEST_NODES // 2 + 2)[1:-1]
    nodes = np.unique(np.concatenate([prior.odd_quantile(levels), prior.common_quantile(levels)]))
    nodes = np.concatenate([[nodes[0] * 1e-3], nodes, [1 - (1 - nodes[-1]) * 1e-3]])
    functions: list[Callable] = []
    after = None  # What a state with one more touch is worth beyond its answer.
    for known in reversed(range(1, num_things)):
        ratios = np.linspace(1, known, _RATIO_NODES) if known > 1 else np.array([1.0, 2.0])
        largest, ratio = (grid.ravel() for grid in np.meshgrid(nodes, ratios, indexing="ij"))
        again = discount * known / num_things if at_random else 0.0
        delay = discount * (1 - known / num_things) / (1 - again) if at_random else discount
        values = delay * _expected(known, largest, ratio, prior, after)
        after = interpolate.RegularGridInterpolator(
            (nodes, ratios), values.reshape(len(nodes), -1), bounds_error=False, fill_value=None
        )
        functions.insert(0, after)
    first = discount * _expected(0, np.zeros(1), np.zeros(1), prior, after)
    return max(float(first[0]), base.worth_of_answers(1 / num_things)), tuple(functions)


def _expected(known, largest, ratio, prior, after) -> np.ndarray:
    """Returns what a state is worth on average after one more touch, [N].

    Args:
      known: touches done.
      largest, ratio: the states, [N] each.
      prior: of the values.
      after: what a further touch is worth in a state with `known` + 1 touches; None where nothing is left to touch.
    """
    if after is None:
        return np.ones(len(largest))
    unknown = prior.num_things - known
    with np.errstate(divide="ignore"):
        log_weight = prior.log_ratio(largest) + np.log(ratio) if known else np.full(1, -np.inf)
    nodes, weights = special.roots_legendre(_QUADRATURE_NODES * (1 if known else 16))
    nodes, weights = (nodes + 1) / 2, weights / 2
    is_odd = special.expit(np.log(unknown) - log_weight) / unknown  # Of one thing among the unknown ones.
    total = np.zeros(len(largest))
    parts = [
        (is_odd, prior.odd_cdf(largest), prior.odd_quantile),
        (1 - is_odd, prior.common_cdf(largest), prior.common_quantile),
    ]
    for chance, below, quantile in parts:  # Split where the new value becomes the largest: there the worth has a kink.
        for start, width in ((np.zeros_like(below), below), (below, 1 - below)):
            levels = start[:, None] + width[:, None] * nodes
            value = quantile(levels.clip(1e-300, 1 - 1e-16))
            worth = _worth_after(known, unknown, largest[:, None], ratio[:, None], value, prior, after)
            total += chance * width * (worth @ weights)
    return total


def _worth_after(known, unknown, largest, ratio, value, prior, after) -> np.ndarray:
    """Returns what a state is worth once one more thing has turned out to have this value; arrays [N, 1] and [N, Q]."""
    value = value.clip(1e-300, 1 - 1e-16)
    if known:
        difference = prior.log_ratio(value) - prior.log_ratio(largest)
        ratio = np.where(value > largest, 1 + ratio * np.exp(-np.abs(difference)), ratio + np.exp(-np.abs(difference)))
        largest = np.maximum(largest, value)
    else:
        largest, ratio = value, np.ones_like(value)
    log_weight = prior.log_ratio(largest) + np.log(ratio)
    left = np.full(largest.shape, unknown - 1)
    chance = _largest_is_touched(left, largest, log_weight, prior)
    answer = base.worth_of_answers(np.maximum(chance, (1 - chance) / (unknown - 1)))
    return np.maximum(answer, after(_points(largest, ratio)))


def _points(largest, ratio) -> np.ndarray:
    return np.stack([largest, ratio], axis=-1)
