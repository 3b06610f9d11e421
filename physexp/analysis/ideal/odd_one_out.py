"""The ideal experimenter of K things with one odd one out, when one touch of a thing reveals its value.

The theory is in docs/ideal.md. Two numbers are a sufficient statistic of the values found: the largest, M, and t, the
sum of the likelihood ratios r(m) (odd one's density over a common one's) of all values found, divided by r(M). The
values of states are computed backwards from the last touch, on a grid.
"""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
import functools
import math

import numpy as np
from scipy import interpolate, special
from scipy.stats import qmc

from physexp.agents import core
from physexp.analysis.ideal import base, calibration, planning
from physexp.suite.engine import priors, rules

_LARGEST_NODES, _RATIO_NODES = 400, 33
_QUADRATURE_NODES = 48  # For each half of a density; 16 times as many for the first touch.
_EPISODES = 2**17  # For the histogram; drawn evenly (Sobol), so that its error is far below 0.001.
_NEGLIGIBLE = 1e-4  # Part of a return.
_EASIEST = 1e6  # The largest difficulty for which the grid is exact enough.


def _posterior(values, largest, log_weight, prior) -> np.ndarray:
    """Returns the probability of each thing to have the largest value, given the statistics of the values, [N, K].

    Only the largest touched thing has a probability above 0; untouched things share the rest.
    """
    touched = ~np.isnan(values)
    unknown, is_known = (~touched).sum(axis=1), touched.any(axis=1)
    chance = np.where(is_known, _largest_is_touched(unknown, largest, log_weight, prior), 0.0)
    others = np.divide(1 - chance, unknown, out=np.zeros(len(values)), where=unknown > 0)
    result, rows = np.where(touched, 0.0, others[:, None]), np.flatnonzero(is_known)
    result[rows, np.nanargmax(values[rows], axis=1)] = chance[rows]
    return result


def _statistics(values, prior) -> tuple[np.ndarray, np.ndarray]:
    """Returns the largest value found, and the logarithm of the sum of ratios; -inf if no thing was touched."""
    known = np.where(np.isnan(values), -np.inf, values)
    ratios = np.where(np.isnan(values), -np.inf, prior.log_ratio(np.nan_to_num(values, nan=0.5)))
    return known.max(axis=1), special.logsumexp(ratios, axis=1)


def _largest_is_touched(unknown, largest, log_weight, prior):
    """Returns the probability that the largest value found is the largest of all.

    The odd one is among the touched things with probability W / (W + u), W being the sum of their ratios and u the
    number of unknown things. In that case u common things must have smaller values; otherwise the odd one and u - 1
    common ones.
    """
    value = np.clip(largest, 0, 1)
    with np.errstate(divide="ignore"):
        among_touched = special.expit(log_weight - np.log(unknown))
    smaller = prior.common_cdf(value)
    all_smaller = among_touched * smaller**unknown
    odd_smaller = (1 - among_touched) * prior.odd_cdf(value) * smaller ** np.maximum(unknown - 1, 0)
    return np.where(unknown == 0, 1.0, all_smaller + odd_smaller)


@dataclasses.dataclass(frozen=True)
class Solution(base.Solution):
    """The best policy and its value, exact to better than 0.0001; solved when first needed.

    Attributes:
      prior: distribution of the values, of 2 to 20 things.
      discount: the agent's gamma.
      step_limit: maximum number of actions in an episode, including the answer.
      find_read: returns a function that reads values from observations; None for images.
    """

    prior: priors.OddOneOut
    discount: float
    step_limit: float = math.inf
    find_read: Callable[[], calibration.Read] | None = dataclasses.field(default=None, compare=False)

    def __post_init__(self):
        if self.prior.difficulty > _EASIEST:
            raise ValueError(f"difficulty is {self.prior.difficulty}; give a number from 1 to {_EASIEST:g}")

    @property
    def value(self) -> float:
        return self._value(at_random=False)

    def compared(self):
        return {"at_once": base.answer_values(1 / self.prior.num_things), "random_value": self._value(at_random=True)}

    def planning(self):
        """Returns the returns of experimenters that plan less; those that look ahead differ only in when they stop.

        The largest information is always that of an untouched thing, and these are alike, so the greedy ones are ideal.
        """

        def mean_return(touches: np.ndarray, right: np.ndarray) -> float:
            return float((self.discount**touches * np.where(right, rules.RIGHT, rules.WRONG)).mean())

        ideal = mean_return(*self._evenly_drawn_episodes)
        return {
            "floor": base.floor(base.answer_values(1 / self.prior.num_things), self.discount, self.step_limit),
            **dict.fromkeys(("greedy", "greedy_lucky"), self.value),
            **{
                f"lookahead_{horizon}": self.value + mean_return(*self._play_evenly(horizon)) - ideal
                for horizon in planning.HORIZONS
            },
            "planning_error": 0.0,
        }

    def _value(self, at_random: bool) -> float:
        at_once = base.answer_values(1 / self.prior.num_things)
        if self.step_limit == 1:
            return at_once
        touch = _touch(self.prior, self.discount, 0, self.step_limit, at_random)
        return max(at_once, float(touch((np.zeros(1), np.zeros(1)))[0]))

    def evaluate(self, known: np.ndarray, left: float | np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns the posterior, and the value of one more touch of an unknown thing, -inf if there is none.

        The posterior has the probability of each thing to have the largest value, float64 [N, K]; values are float64
        [N].

        Args:
          known: the values found, in [0, 1], NaN for untouched things, float64 [N, K].
          left: number of actions left in the episode, at least 1; one for each row, [N], or one for all.
        """
        largest, log_weight = _statistics(known, self.prior)
        touches = (~np.isnan(known)).sum(axis=1)
        num_things = self.prior.num_things
        useful = np.minimum(left, num_things - touches + 1)  # An answer follows the last touch.
        touch = np.where(touches < num_things, float(rules.WRONG), -np.inf)  # In the last step: no answer in time.
        for number, steps in {*zip(touches.tolist(), useful.tolist(), strict=True)}:
            if number < num_things and steps > 1:
                rows = (touches == number) & (useful == steps)
                most, touch_in = largest[rows], _touch(self.prior, self.discount, number, steps)
                ratio = np.exp(log_weight[rows] - self.prior.log_ratio(most)) if number else np.zeros(len(most))
                touch[rows] = touch_in((most, ratio))
        return _posterior(known, largest, log_weight, self.prior), touch

    def actions(self, known: np.ndarray, left: float | np.ndarray) -> np.ndarray:
        """Returns the best action, int64 [N]: the first unknown thing, or K plus the label; as for `evaluate`."""
        beliefs, touch = self.evaluate(known, left)
        label = self.prior.num_things + beliefs.argmax(axis=1)
        return np.where(touch > base.answer_values(beliefs.max(axis=1)), np.isnan(known).argmax(axis=1), label)

    def play(self, values: np.ndarray, horizon: float = math.inf) -> tuple[np.ndarray, np.ndarray]:
        """Plays episodes of things with some values, float64 [N, K], without physics.

        The policy looks some touches ahead. Returns the touches, int64 [N], and whether the answer was right, bool [N].
        """
        known, going = np.full(values.shape, np.nan), np.arange(len(values))
        touches, labels = np.zeros(len(values), np.int64), np.full(len(values), -1)
        while len(going):
            actions = self.actions(known[going], np.minimum(self.step_limit - touches[going], horizon + 1))
            touching = actions < self.prior.num_things
            labels[going[~touching]] = actions[~touching] - self.prior.num_things
            going, touched = going[touching], actions[touching]
            known[going, touched] = values[going, touched]
            touches[going] += 1
        return touches, labels == values.argmax(axis=1)

    def actor(self) -> core.Actor:
        read, unknown = base.readable(self.find_read)(), np.full((1, self.prior.num_things), np.nan)

        def follow(known: np.ndarray, touched: int, observation: Mapping[str, np.ndarray]) -> np.ndarray:
            return np.where(np.arange(known.shape[1]) == touched, read(observation, touched), known)

        return base.Player(
            begin=lambda observation: unknown,
            choose=lambda known, step: int(self.actions(known, self.step_limit - step)[0]),
            follow=follow,
        )

    def judge(self, hidden, actions):
        return self.judge_all(np.asarray(hidden)[None], [actions])[0]

    def judge_all(self, values: np.ndarray, actions: Sequence[np.ndarray]) -> list[base.Judgement]:
        """Returns the judgements of N episodes, of values [N, K] and actions int64 [T]; faster than one by one."""
        ends = np.cumsum([len(taken) + 1 for taken in actions])[:-1]
        steps = np.concatenate([np.arange(len(taken) + 1) for taken in actions])
        are_touches = [taken[:, None] == np.arange(self.prior.num_things) for taken in map(np.asarray, actions)]
        is_known = np.concatenate([np.logical_or.accumulate(np.pad(rows, ((1, 0), (0, 0)))) for rows in are_touches])
        known = np.where(is_known, np.repeat(values, [len(taken) + 1 for taken in actions], axis=0), np.nan)
        left = np.maximum(self.step_limit - steps, 1)
        beliefs, touch = self.evaluate(known, left)
        _, next_touch = self.evaluate(known, np.maximum(left - 1, 1))
        again = self.discount * np.maximum(base.answer_values(beliefs.max(axis=1)), next_touch)
        touches = np.where(is_known, again[:, None], touch[:, None])
        touches[left == 1] = rules.WRONG  # The episode ends unanswered.
        worths = np.concatenate([touches, base.answer_values(beliefs)], axis=1)
        parts = zip(*(np.split(each, ends) for each in (beliefs, worths, is_known)), are_touches, strict=True)
        return [base.Judgement(b, v[:-1], (touched & ~k[:-1]).any(axis=1)) for b, v, k, touched in parts]

    def outcomes(self):
        return *self._evenly_drawn_episodes, np.full(_EPISODES, 1 / _EPISODES)

    @functools.cached_property
    def _evenly_drawn_episodes(self) -> tuple[np.ndarray, np.ndarray]:
        return self._play_evenly()

    def _play_evenly(self, horizon: float = math.inf) -> tuple[np.ndarray, np.ndarray]:
        draws = qmc.Sobol(self.prior.num_things + 1, rng=0).random(_EPISODES).clip(1e-12, 1 - 1e-12)
        return self.play(self.prior.from_uniforms(draws), horizon)


@functools.lru_cache(maxsize=512)
def _touch(
    prior: priors.OddOneOut, discount: float, known: int, left: float, at_random: bool = False
) -> Callable[[tuple[np.ndarray, np.ndarray]], np.ndarray]:
    """Returns the value of one more touch, as a function of states, two arrays: of the largest values found, and of t.

    The touch is of an unknown thing, or else drawn uniformly among all; fewer than all are known, and at least two
    actions left.
    """
    num_things = prior.num_things
    again = known / num_things if at_random else 0.0  # The probability of touching a known thing.
    if not at_random:
        left = min(left, num_things - known + 1)
    elif (discount * (num_things - 1) / num_things) ** (left - 2) < _NEGLIGIBLE:  # A touch so late hardly counts.
        left = math.inf
    further = _touch(prior, discount, known + 1, left - 1, at_random) if known + 1 < num_things and left > 2 else None
    largest, ratio, axes = _grid(prior, known)
    values = discount * (1 - again) * _expected(known, largest, ratio, prior, further)
    if again and left == math.inf:  # Known things may be touched any number of times before an unknown one.
        values /= 1 - discount * again
    elif again:
        value = _answer_value(num_things - known, largest, ratio, prior)
        if left > 2:
            value = np.maximum(value, _touch(prior, discount, known, left - 1, True)((largest, ratio)))
        values += discount * again * value
    if not known:
        return lambda states: np.full(len(states[0]), values[0])
    shape = [len(axis) for axis in axes]
    return interpolate.RegularGridInterpolator(axes, values.reshape(shape), bounds_error=False, fill_value=None)


def _grid(prior: priors.OddOneOut, known: int) -> tuple[np.ndarray, np.ndarray, tuple[np.ndarray, ...]]:
    """Returns states with `known` known things: largest values [N], ratios [N], and the axes of their grid."""
    if not known:
        return np.zeros(1), np.zeros(1), ()
    levels = np.linspace(0, 1, _LARGEST_NODES // 2 + 2)[1:-1]
    nodes = np.unique(np.concatenate([prior.odd_quantile(levels), prior.common_quantile(levels)]))
    nodes = np.concatenate([[nodes[0] * 1e-3], nodes, [1 - (1 - nodes[-1]) * 1e-3]])
    ratios = np.linspace(1, known, _RATIO_NODES) if known > 1 else np.array([1.0, 2.0])
    largest, ratio = (grid.ravel() for grid in np.meshgrid(nodes, ratios, indexing="ij"))
    return largest, ratio, (nodes, ratios)


def _expected(known, largest, ratio, prior, after) -> np.ndarray:
    """Returns the expected values of N states after one more touch of an unknown thing, [N].

    A further touch is worth `after`, a function of states with one more known thing; if it is None, an answer follows.
    """
    unknown = prior.num_things - known
    if unknown == 1:
        return np.ones(len(largest))
    with np.errstate(divide="ignore"):
        log_weight = prior.log_ratio(largest) + np.log(ratio) if known else np.full(1, -np.inf)
    nodes, weights = special.roots_legendre(_QUADRATURE_NODES * (1 if known else 16))
    nodes, weights = (nodes + 1) / 2, weights / 2
    is_odd = special.expit(np.log(unknown) - log_weight) / unknown  # Probability of each unknown thing to be odd.
    total = np.zeros(len(largest))
    parts = [
        (is_odd, prior.odd_cdf(largest), prior.odd_quantile),
        (1 - is_odd, prior.common_cdf(largest), prior.common_quantile),
    ]
    for chance, below, quantile in parts:  # Split where the new value becomes the largest, at a kink.
        for start, width in ((np.zeros_like(below), below), (below, 1 - below)):
            levels = start[:, None] + width[:, None] * nodes
            value = quantile(levels.clip(1e-300, 1 - 1e-16))
            worths = _value_after(known, unknown, largest[:, None], ratio[:, None], value, prior, after)
            total += chance * width * (worths @ weights)
    return total


def _value_after(known, unknown, largest, ratio, value, prior, after) -> np.ndarray:
    """Returns the values of states after one more thing turned out to have a value; arrays [N, 1] and [N, Q]."""
    value = value.clip(1e-300, 1 - 1e-16)
    if known:
        difference = prior.log_ratio(value) - prior.log_ratio(largest)
        ratio = np.where(value > largest, 1 + ratio * np.exp(-np.abs(difference)), ratio + np.exp(-np.abs(difference)))
        largest = np.maximum(largest, value)
    else:
        largest, ratio = value, np.ones_like(value)
    answer = _answer_value(unknown - 1, largest, ratio, prior)
    return answer if after is None else np.maximum(answer, after((largest, ratio)))


def _answer_value(unknown: int, largest, ratio, prior) -> np.ndarray:
    """Returns the values of the best answers in states with `unknown` unknown things, at least one."""
    log_weight = prior.log_ratio(largest) + np.log(ratio)
    chance = _largest_is_touched(np.full(largest.shape, unknown), largest, log_weight, prior)
    return base.answer_values(np.maximum(chance, (1 - chance) / unknown))
