"""Estimates with their 95 % confidence intervals, and p-values of other values.

Means are over agents, since the episodes of one agent depend on its training. With too little data an interval is
infinite and nothing can be tested.
"""

from collections.abc import Callable, Sequence
import dataclasses
import math
from typing import Any, Literal

import numpy as np

_LEVEL = 0.95
_POWER = 0.8
Alternative = Literal["greater", "less"]
Values = Sequence[float] | np.ndarray


def _unknown(bound: float, alternative: Alternative) -> float:
    return 1.0


@dataclasses.dataclass(frozen=True)
class Estimate:
    """A value and its 95 % confidence interval.

    Attributes:
      value: the measured value.
      low, high: ends of the interval.
      p_value: the one-sided p-value of the hypothesis that the true value is a bound, against the alternative that it
        is `greater` or `less`; 1 with too little data.
    """

    value: float
    low: float
    high: float
    p_value: Callable[[float, Alternative], float] = dataclasses.field(default=_unknown, compare=False, repr=False)

    @property
    def can_be_tested(self) -> bool:
        """Whether the number of data is enough to rule out some values."""
        return self.p_value is not _unknown


_UNKNOWN_POSITIVE = Estimate(math.nan, 0.0, math.inf)


def _are_positive(values: Values) -> bool:
    return all(0 < value < math.inf for value in values)


def _exact(value: float) -> Estimate:
    """Returns the estimate of data without any spread."""
    return Estimate(
        value, value, value, lambda bound, side: float(value <= bound if side == "greater" else value >= bound)
    )


def _around(value: float, error: float, distribution: Any) -> Estimate:
    """Returns the estimate with a standard error, and a symmetric distribution of scipy for value / error."""
    half = float(distribution.ppf((1 + _LEVEL) / 2)) * error

    def p_value(bound: float, alternative: Alternative) -> float:
        distance = (value - bound) / error
        return float(distribution.sf(distance if alternative == "greater" else -distance))

    return Estimate(value, value - half, value + half, p_value)


def _mapped(estimate: Estimate, function: Callable[[float], float], inverse: Callable[[float], float]) -> Estimate:
    """Returns the estimate of an increasing function of the value."""

    def p_value(bound: float, alternative: Alternative) -> float:
        return estimate.p_value(inverse(bound), alternative)

    value, low, high = (function(each) for each in (estimate.value, estimate.low, estimate.high))
    return Estimate(value, low, high, p_value if estimate.can_be_tested else _unknown)


def _exponential(estimate: Estimate) -> Estimate:
    return _mapped(estimate, math.exp, math.log)


def better_half(values: Values) -> np.ndarray:
    """Returns the indices of the larger half of some values, largest first; with the middle one of an odd number."""
    return np.argsort(-np.asarray(values), kind="stable")[: (len(values) + 1) // 2]


def wilson_interval(successes: int, trials: int) -> tuple[float, float]:
    """Returns the 95 % confidence interval of a proportion (Wilson, 1927)."""
    from scipy import stats

    interval = stats.binomtest(successes, trials).proportion_ci(_LEVEL, method="wilson")
    return float(interval.low), float(interval.high)


def median_interval(values: Values) -> tuple[float, float]:
    """Returns the 95 % confidence interval of a median, between order statistics; NaN at an end without one."""
    from scipy import stats

    interval = stats.quantile_test(values, p=0.5).confidence_interval(_LEVEL)
    return float(interval.low), float(interval.high)


def proportion(successes: int, trials: int) -> Estimate:
    """Returns a share of independent trials with Wilson's interval; p-values are those of the score test."""
    from scipy import stats

    share = successes / trials

    def p_value(bound: float, alternative: Alternative) -> float:
        if not 0 < bound < 1:
            return _exact(share).p_value(bound, alternative)
        distance = (share - bound) / math.sqrt(bound * (1 - bound) / trials)
        return float(stats.norm.sf(distance if alternative == "greater" else -distance))

    return Estimate(share, *wilson_interval(successes, trials), p_value)


def mean(values: Values) -> Estimate:
    """Returns the mean of independent values with Student's interval.

    It is infinite for fewer than two values, for two equal ones, and with a NaN.
    """
    from scipy import stats

    average = float(np.mean(values)) if len(values) else math.nan
    has_no_spread = len(values) < 3 and len(np.unique(values)) < 2  # Two may be equal by chance.
    if has_no_spread or math.isnan(average):
        return Estimate(average, -math.inf, math.inf)
    error = float(np.std(values, ddof=1)) / math.sqrt(len(values))
    return _around(average, error, stats.t(len(values) - 1)) if error else _exact(average)


def detectable(number: int) -> float:
    """Returns the distance of a mean from a bound that a test of `number` values notices in four cases of five.

    It is in standard deviations of the values, which are normal; the test is Student's, two-sided, at 5 %.
    """
    from scipy import optimize, stats

    critical = stats.t.ppf((1 + _LEVEL) / 2, number - 1)

    def lacks(distance: float) -> float:
        return stats.nct.sf(critical, number - 1, distance * math.sqrt(number)) - _POWER

    return float(optimize.brentq(lacks, 0, 20))  # It is 11.5 for two values, and less for more.


def mean_share(shares: Values) -> Estimate:
    """Returns the mean of independent shares with Student's interval, cut to [0, 1]."""
    estimate = mean(shares)
    return dataclasses.replace(estimate, low=max(0.0, estimate.low), high=min(1.0, estimate.high))


def difference_of_pairs(first: Any, second: Any) -> Estimate:
    """Returns the mean of the first less the second of two pandas Series, over the common index."""
    return mean(np.subtract(*first.align(second, join="inner")))


def geometric_mean(values: Values) -> Estimate:
    """Returns the geometric mean of independent values: `mean` of their logarithms, unknown with one that has none."""
    return _exponential(mean(np.log(values))) if _are_positive(values) else _UNKNOWN_POSITIVE


def ratio_of_pairs(numerators: Values, denominators: Values) -> Estimate:
    """Returns the geometric mean of the ratios of independent pairs."""
    top, bottom = np.asarray(numerators, float), np.asarray(denominators, float)
    return geometric_mean(top / bottom) if _are_positive([*top, *bottom]) else _UNKNOWN_POSITIVE


def ratio_of_means(numerators: Values, denominators: Values) -> Estimate:
    """Returns the ratio of the geometric means of two groups of independent values.

    The interval is Welch's of the logarithms; unknown with a value that has none.
    """
    from scipy import stats

    if not (_are_positive(numerators) and _are_positive(denominators)):
        return _UNKNOWN_POSITIVE
    top, bottom = np.log(np.asarray(numerators, float)), np.log(np.asarray(denominators, float))
    difference = float(top.mean() - bottom.mean())
    if min(len(top), len(bottom)) < 2:
        return Estimate(math.exp(difference), 0.0, math.inf)
    if not np.ptp(bottom):  # Without a spread of one group, Welch's interval is Student's of the other.
        return _exponential(mean(top - bottom[0]))
    if not np.ptp(top):
        return _exponential(mean(top[0] - bottom))
    interval = stats.ttest_ind(top, bottom, equal_var=False).confidence_interval(_LEVEL)

    def p_value(bound: float, alternative: Alternative) -> float:
        return float(stats.ttest_ind(top - bound, bottom, equal_var=False, alternative=alternative).pvalue)

    return _exponential(Estimate(difference, float(interval.low), float(interval.high), p_value))


def between(lower: Estimate, upper: Estimate) -> Estimate:
    """Returns the estimate of a value that is bounded by two others; the value shown is the upper bound."""

    def p_value(bound: float, alternative: Alternative) -> float:
        return (lower if alternative == "greater" else upper).p_value(bound, alternative)

    can_be_tested = lower.can_be_tested or upper.can_be_tested
    return Estimate(upper.value, lower.low, upper.high, p_value if can_be_tested else _unknown)


def at_most(estimate: Estimate) -> Estimate:
    """Returns the estimate of a positive value that the measured value only bounds from above."""
    return between(_UNKNOWN_POSITIVE, estimate)


def normal(value: float, standard_error: float) -> Estimate:
    """Returns an estimate with the normal interval of its standard error."""
    from scipy import stats

    return _around(value, standard_error, stats.norm) if standard_error else _exact(value)


def correlation(x: np.ndarray, y: np.ndarray) -> Estimate:
    """Returns Pearson's correlation of pairs, x and y [N], with an interval on Fisher's scale.

    Its standard error is Fisher's, which is that of normal pairs, or that of the influence function, the larger one.
    Any correlation is possible for fewer than four pairs, and if all x or all y are equal.
    """
    from scipy import stats

    if len(x) < 4 or not np.ptp(x) or not np.ptp(y):
        return Estimate(math.nan, -1.0, 1.0)
    value = float(stats.pearsonr(x, y).statistic)
    if abs(value) > 1 - 1e-12:
        return _exact(value)
    first, second = ((each - np.mean(each)) / np.std(each) for each in (x, y))
    influences = first * second - value * (first**2 + second**2) / 2
    error = max(1 / math.sqrt(len(x) - 3), float(np.std(influences)) / math.sqrt(len(x)) / (1 - value**2))
    return _mapped(_around(math.atanh(value), error, stats.norm), math.tanh, math.atanh)
