"""Estimates with their 95 % confidence intervals.

Means are over agents, since the episodes of one agent depend on how it was trained.
"""

from collections.abc import Callable, Sequence
import dataclasses
import math

import numpy as np

_LEVEL = 0.95
_NORMAL = 1.96  # Standard errors on either side that hold so much of a normal distribution.


@dataclasses.dataclass(frozen=True)
class Estimate:
    """A figure and its 95 % confidence interval."""

    value: float
    low: float
    high: float


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
    """Returns the share of true outcomes that are independent, [N]."""
    right = int(np.sum(outcomes))
    return Estimate(right / len(outcomes), *wilson_interval(right, len(outcomes)))


def mean(values: Sequence[float] | np.ndarray) -> Estimate:
    """Returns the mean of independent values, [N], with Student's interval; infinite for less than two values."""
    from scipy import stats

    average = float(np.mean(values)) if len(values) else math.nan
    if len(values) < 2:
        return Estimate(average, -math.inf, math.inf)
    error = float(np.std(values, ddof=1)) / math.sqrt(len(values))
    if not error:
        return Estimate(average, average, average)
    low, high = stats.t.interval(_LEVEL, len(values) - 1, loc=average, scale=error)
    return Estimate(average, float(low), float(high))


def mean_share(shares: Sequence[float] | np.ndarray) -> Estimate:
    """Returns the mean of independent shares, [N] in [0, 1], with Student's interval, cut to [0, 1]."""
    estimate = mean(shares)
    return Estimate(estimate.value, max(0.0, estimate.low), min(1.0, estimate.high))


def median(values: Sequence[float] | np.ndarray) -> Estimate:
    """Returns the median of independent values, [N], with the order statistics' interval, infinite for too few."""
    from scipy import stats

    interval = stats.quantile_test(np.asarray(values), p=0.5).confidence_interval(_LEVEL)
    low, high = (float(end) for end in interval)
    return Estimate(
        float(np.median(values)), -math.inf if math.isnan(low) else low, math.inf if math.isnan(high) else high
    )


def ratio_of_means(numerators: Sequence[float] | np.ndarray, denominators: Sequence[float] | np.ndarray) -> Estimate:
    """Returns how many times as large the values of one group are as those of another, by their geometric means.

    Args:
      numerators, denominators: independent values, [N] and [M]; Welch's interval of the logarithms, which is infinite
        for a single value and where one is not positive and finite.
    """
    from scipy import stats

    groups = [np.asarray(group, float) for group in (numerators, denominators)]
    if not all(np.all((group > 0) & (group < math.inf)) for group in groups):
        return Estimate(math.nan, 0.0, math.inf)
    logs = [np.log(group) for group in groups]
    value = float(logs[0].mean() - logs[1].mean())
    if min(map(len, logs)) < 2:
        return Estimate(math.exp(value), 0.0, math.inf)
    if not np.ptp(logs[1]):  # Without a spread of one group, Welch's interval is Student's of the other.
        interval = mean(logs[0] - logs[1][0])
    elif not np.ptp(logs[0]):
        interval = mean(logs[0][0] - logs[1])
    else:
        interval = stats.ttest_ind(*logs, equal_var=False).confidence_interval(_LEVEL)
    return Estimate(math.exp(value), math.exp(interval.low), math.exp(interval.high))


def ratio_of_pairs(numerators: Sequence[float] | np.ndarray, denominators: Sequence[float] | np.ndarray) -> Estimate:
    """Returns the geometric mean of ratios, [N] of independent pairs, with Student's interval of their logarithms.

    The interval is infinite for a single pair and where a value is not positive and finite.
    """
    top, bottom = np.asarray(numerators, float), np.asarray(denominators, float)
    if not np.all((np.minimum(top, bottom) > 0) & (np.maximum(top, bottom) < math.inf)):
        return Estimate(math.nan, 0.0, math.inf)
    logs = mean(np.log(top / bottom))
    return Estimate(math.exp(logs.value), math.exp(logs.low), math.exp(logs.high))


def normal(value: float, standard_error: float) -> Estimate:
    """Returns a figure with the normal interval of its standard error, as a mean of many values has it."""
    return Estimate(value, value - _NORMAL * standard_error, value + _NORMAL * standard_error)


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
    return Estimate(statistic(values), float(drawn.confidence_interval.low), float(drawn.confidence_interval.high))


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
    if not error:
        return Estimate(value, value, value)
    low, high = stats.norm.interval(_LEVEL, loc=value, scale=error)
    return Estimate(value, float(low), float(high))
