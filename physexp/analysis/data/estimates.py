"""Estimates with their 95 % confidence intervals, and p-values of what else could be true.

Means are over agents, since the episodes of one agent depend on how it was trained.
"""

from collections.abc import Callable, Sequence
import dataclasses
import math
from typing import Any, Literal

import numpy as np

_LEVEL = 0.95
Alternative = Literal["greater", "less"]


def _unknown(bound: float, alternative: Alternative) -> float:
    """The p-value where too little is known to test anything."""
    return 1.0


@dataclasses.dataclass(frozen=True)
class Estimate:
    """A figure and its 95 % confidence interval.

    Attributes:
      value: what was measured.
      low, high: ends of the interval.
      p_value: the one-sided p-value of the hypothesis that the figure is a bound, against the alternative that it is
        `greater` or `less`; 1 where too little is known.
    """

    value: float
    low: float
    high: float
    p_value: Callable[[float, Alternative], float] = dataclasses.field(default=_unknown, compare=False, repr=False)

    @property
    def can_be_tested(self) -> bool:
        """Returns whether enough is known to rule anything out, whatever the values are."""
        return self.p_value is not _unknown


_UNKNOWN_POSITIVE = Estimate(math.nan, 0.0, math.inf)  # Of what cannot be negative.


def _are_positive(values: Sequence[float] | np.ndarray) -> bool:
    """Whether all values are positive and finite."""
    return all(0 < value < math.inf for value in values)


def _exact(value: float) -> Estimate:
    """A figure without any spread."""

    def p_value(bound: float, alternative: Alternative) -> float:
        return float(value <= bound if alternative == "greater" else value >= bound)

    return Estimate(value, value, value, p_value)


def _around(value: float, error: float, distribution: Any) -> Estimate:
    """A figure whose distance from the truth, in standard errors, has a distribution of scipy, symmetric about 0."""
    half = float(distribution.ppf((1 + _LEVEL) / 2)) * error

    def p_value(bound: float, alternative: Alternative) -> float:
        distance = (value - bound) / error
        return float(distribution.sf(distance if alternative == "greater" else -distance))

    return Estimate(value, value - half, value + half, p_value)


def _mapped(estimate: Estimate, function: Callable[[float], float], inverse: Callable[[float], float]) -> Estimate:
    """An increasing function of what was estimated."""

    def p_value(bound: float, alternative: Alternative) -> float:
        return estimate.p_value(inverse(bound), alternative)

    return Estimate(
        function(estimate.value),
        function(estimate.low),
        function(estimate.high),
        p_value if estimate.can_be_tested else _unknown,
    )


def better_half(values: Sequence[float] | np.ndarray) -> np.ndarray:
    """Returns indices of the larger half of some values, largest first; the middle one of an odd number is in it."""
    return np.argsort(-np.asarray(values), kind="stable")[: (len(values) + 1) // 2]


def wilson_interval(successes: int, trials: int) -> tuple[float, float]:
    """Returns the 95 % confidence interval of a proportion (Wilson, 1927).

    Args:
      successes: how often it happened.
      trials: how often it could have, >= 1.
    """
    from scipy import stats

    interval = stats.binomtest(successes, trials).proportion_ci(_LEVEL, method="wilson")
    return float(interval.low), float(interval.high)


def proportion(outcomes: Sequence[bool] | np.ndarray) -> Estimate:
    """Returns the share of true outcomes that are independent, [N]; p-values are of the score test, as Wilson's."""
    from scipy import stats

    share = float(np.mean(outcomes))

    def p_value(bound: float, alternative: Alternative) -> float:
        if not 0 < bound < 1:
            return _exact(share).p_value(bound, alternative)
        distance = (share - bound) / math.sqrt(bound * (1 - bound) / len(outcomes))
        return float(stats.norm.sf(distance if alternative == "greater" else -distance))

    return Estimate(share, *wilson_interval(int(np.sum(outcomes)), len(outcomes)), p_value)


def mean(values: Sequence[float] | np.ndarray) -> Estimate:
    """Returns the mean of independent values, [N], with Student's interval.

    It is infinite for less than two values, for two that are the same, and where one is not known, NaN.
    """
    from scipy import stats

    average = float(np.mean(values)) if len(values) else math.nan
    tells_no_spread = len(values) < 3 and len(np.unique(values)) < 2  # Two may be the same by chance.
    if tells_no_spread or math.isnan(average):
        return Estimate(average, -math.inf, math.inf)
    error = float(np.std(values, ddof=1)) / math.sqrt(len(values))
    return _around(average, error, stats.t(len(values) - 1)) if error else _exact(average)


def mean_share(shares: Sequence[float] | np.ndarray) -> Estimate:
    """Returns the mean of independent shares, [N] in [0, 1], with Student's interval, cut to [0, 1]."""
    estimate = mean(shares)
    return dataclasses.replace(estimate, low=max(0.0, estimate.low), high=min(1.0, estimate.high))


def median(values: Sequence[float] | np.ndarray) -> Estimate:
    """Returns the median of independent values, [N], with the order statistics' interval.

    It is infinite for too few values, less than six, and where one is not known, NaN.
    """
    from scipy import stats

    if np.isnan(values).any():
        return Estimate(math.nan, -math.inf, math.inf)

    def p_value(bound: float, alternative: Alternative) -> float:
        return float(stats.quantile_test(np.asarray(values), q=bound, p=0.5, alternative=alternative).pvalue)

    interval = stats.quantile_test(np.asarray(values), p=0.5).confidence_interval(_LEVEL)
    low, high = (float(end) for end in interval)
    if math.isnan(low) and math.isnan(high):
        return Estimate(float(np.median(values)), -math.inf, math.inf)
    return Estimate(
        float(np.median(values)),
        -math.inf if math.isnan(low) else low,
        math.inf if math.isnan(high) else high,
        p_value,
    )


def geometric_mean(values: Sequence[float] | np.ndarray) -> Estimate:
    """Returns the geometric mean of independent values, [N], with Student's interval of their logarithms.

    The interval is infinite for a single value, for two that are the same, and where one is not positive and finite.
    """
    return _exponential(mean(np.log(values))) if _are_positive(values) else _UNKNOWN_POSITIVE


def ratio_of_means(numerators: Sequence[float] | np.ndarray, denominators: Sequence[float] | np.ndarray) -> Estimate:
    """Returns how many times as large the values of one group are as those of another, by their geometric means.

    Args:
      numerators, denominators: independent values, [N] and [M]; Welch's interval of the logarithms, which is infinite
        for a single value, where both groups have no spread and the first is of two, and where one is not positive and
        finite.
    """
    from scipy import stats

    groups = [np.asarray(group, float) for group in (numerators, denominators)]
    if not all(map(_are_positive, groups)):
        return _UNKNOWN_POSITIVE
    top, bottom = (np.log(group) for group in groups)
    if min(len(top), len(bottom)) < 2:
        return Estimate(math.exp(top.mean() - bottom.mean()), 0.0, math.inf)
    if not np.ptp(bottom):  # Without a spread of one group, Welch's interval is Student's of the other.
        return _exponential(mean(top - bottom[0]))
    if not np.ptp(top):
        return _exponential(mean(top[0] - bottom))

    def test(shift: float = 0.0, alternative: str = "two-sided"):
        return stats.ttest_ind(top - shift, bottom, equal_var=False, alternative=alternative)

    interval = test().confidence_interval(_LEVEL)
    return _exponential(
        Estimate(
            float(top.mean() - bottom.mean()),
            float(interval.low),
            float(interval.high),
            lambda bound, alternative: float(test(bound, alternative).pvalue),
        )
    )


def _exponential(estimate: Estimate) -> Estimate:
    return _mapped(estimate, math.exp, math.log)


def at_most(estimate: Estimate) -> Estimate:
    """Returns what is known of a positive figure of which only something larger could be measured."""

    def p_value(bound: float, alternative: Alternative) -> float:
        return estimate.p_value(bound, alternative) if alternative == "less" else 1.0

    return Estimate(estimate.value, 0.0, estimate.high, p_value if estimate.can_be_tested else _unknown)


def ratio_of_pairs(numerators: Sequence[float] | np.ndarray, denominators: Sequence[float] | np.ndarray) -> Estimate:
    """Returns the geometric mean of ratios, [N] of independent pairs, with Student's interval of their logarithms.

    The interval is infinite for a single pair, for two of the same ratio, and where a value is not positive and finite.
    """
    top, bottom = np.asarray(numerators, float), np.asarray(denominators, float)
    return geometric_mean(top / bottom) if _are_positive([*top, *bottom]) else _UNKNOWN_POSITIVE


def difference_of_pairs(first, second) -> Estimate:
    """Returns the mean of the first less the second, where both are known, with Student's interval.

    Args:
      first, second: pandas Series; values of the same index are a pair.
    """
    return mean(np.subtract(*first.align(second, join="inner")))


def normal(value: float, standard_error: float) -> Estimate:
    """Returns a figure with the normal interval of its standard error, as a mean of many values has it."""
    from scipy import stats

    return _around(value, standard_error, stats.norm) if standard_error else _exact(value)


def difference_of_shares(first: np.ndarray, second: np.ndarray) -> Estimate:
    """Returns by how much larger a share of true outcomes is than another, [N] and [M] independent and many."""
    shares = [float(np.mean(outcomes)) for outcomes in (first, second)]
    variances = (share * (1 - share) / len(outcomes) for share, outcomes in zip(shares, (first, second), strict=True))
    return normal(shares[0] - shares[1], math.sqrt(sum(variances)))


def bootstrap(
    values: Sequence[float] | np.ndarray, statistic: Callable[[np.ndarray], float], seed: int = 0
) -> Estimate:
    """Returns any statistic of independent values, [N], with the bootstrap's percentile interval, infinite for one."""
    from scipy import stats

    values = np.asarray(values, float)
    if len(values) < 2:
        return Estimate(statistic(values), -math.inf, math.inf)
    drawn = stats.bootstrap(
        (values,),
        statistic,
        vectorized=False,
        method="percentile",
        n_resamples=2000,
        confidence_level=_LEVEL,
        rng=np.random.default_rng(seed),
    )
    found = drawn.bootstrap_distribution

    def p_value(bound: float, alternative: Alternative) -> float:
        beyond = found <= bound if alternative == "greater" else found >= bound
        return float(1 + beyond.sum()) / (1 + len(found))

    return Estimate(
        statistic(values), float(drawn.confidence_interval.low), float(drawn.confidence_interval.high), p_value
    )


def correlation(x: np.ndarray, y: np.ndarray) -> Estimate:
    """Returns Pearson's correlation of pairs, x and y [N], with an interval on Fisher's scale.

    Its standard error is Fisher's, which is that of normal pairs, or the one that follows from how much each pair
    weighs (the influence function), whichever is larger. The interval is that of all correlations where all x or all y
    are the same, and for fewer than four pairs.
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


def slope(x: np.ndarray, y: np.ndarray) -> Estimate:
    """Returns the slope of an ordinary least-squares line; x and y [N] are pairs.

    The interval allows for a spread of y that changes with x (White's standard error, HC1); it is infinite for fewer
    than three pairs and where all x are the same.
    """
    from scipy import stats

    centered = x - x.mean()
    square = float(centered @ centered)
    if square == 0:
        return Estimate(math.nan, -math.inf, math.inf)
    value = float(centered @ (y - y.mean())) / square
    if len(x) < 3:
        return Estimate(value, -math.inf, math.inf)
    residuals = y - y.mean() - value * centered
    error = math.sqrt(float((centered**2) @ (residuals**2)) * len(x) / (len(x) - 2)) / square
    return _around(value, error, stats.norm) if error else _exact(value)
