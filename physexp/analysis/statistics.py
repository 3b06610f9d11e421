"""Estimates with their 95 % intervals.

The unit of what is averaged is the agent, since episodes of one are not independent of how it was trained.
"""

from collections.abc import Callable, Sequence
import dataclasses
import math

import numpy as np

_LEVEL = 0.95
_NORMAL_975 = 1.959963984540054  # The 97.5 % quantile of the normal distribution.


@dataclasses.dataclass(frozen=True)
class Estimate:
    """A figure and its 95 % confidence interval."""

    value: float
    low: float
    high: float


def wilson_interval(successes: int, trials: int) -> tuple[float, float]:
    """The 95 % confidence interval of a proportion (Wilson, 1927).

    Args:
      successes: how often it happened.
      trials: how often it could have, >= 1.
    """
    share, z2 = successes / trials, _NORMAL_975**2
    center = (share + z2 / (2 * trials)) / (1 + z2 / trials)
    half = _NORMAL_975 / (1 + z2 / trials) * math.sqrt(share * (1 - share) / trials + z2 / (4 * trials**2))
    return max(0.0, center - half), min(1.0, center + half)


def proportion(outcomes: Sequence[bool] | np.ndarray) -> Estimate:
    """The share of true outcomes that are independent, [N]."""
    right = int(np.sum(outcomes))
    return Estimate(right / len(outcomes), *wilson_interval(right, len(outcomes)))


def mean(values: Sequence[float] | np.ndarray) -> Estimate:
    """The mean of independent values, [N], with Student's interval; a single value has an infinite one."""
    from scipy import stats

    average = float(np.mean(values))
    if len(values) < 2:
        return Estimate(average, -math.inf, math.inf)
    half = stats.t.ppf((1 + _LEVEL) / 2, len(values) - 1) * float(np.std(values, ddof=1)) / math.sqrt(len(values))
    return Estimate(average, average - half, average + half)


def median(values: Sequence[float] | np.ndarray) -> Estimate:
    """The median of independent values, [N], with the interval of the order statistics; infinite for too few values."""
    from scipy import stats

    interval = stats.quantile_test(np.asarray(values), p=0.5).confidence_interval(_LEVEL)
    low, high = (float(end) for end in interval)
    return Estimate(
        float(np.median(values)), -math.inf if math.isnan(low) else low, math.inf if math.isnan(high) else high
    )


def ratio_of_means(numerators: Sequence[float] | np.ndarray, denominators: Sequence[float] | np.ndarray) -> Estimate:
    """How many times as large the values of one group are as those of another, by their geometric means.

    Args:
      numerators, denominators: independent positive values, [N] and [M]; Welch's interval of the logarithms.
    """
    from scipy import stats

    logs = [np.log(numerators), np.log(denominators)]
    value = float(logs[0].mean() - logs[1].mean())
    if min(map(len, logs)) < 2:
        return Estimate(math.exp(value), 0.0, math.inf)
    if all(np.ptp(group) == 0 for group in logs):
        return Estimate(*[math.exp(value)] * 3)
    interval = stats.ttest_ind(*logs, equal_var=False).confidence_interval(_LEVEL)
    return Estimate(math.exp(value), math.exp(interval.low), math.exp(interval.high))


def bootstrap(
    values: Sequence[float] | np.ndarray, statistic: Callable[[np.ndarray], float], seed: int = 0
) -> Estimate:
    """Any statistic of independent values, [N], with the bootstrap's percentile interval; infinite for one value."""
    from scipy import stats

    values = np.asarray(values, float)
    if len(values) < 2:
        return Estimate(statistic(values), -math.inf, math.inf)
    drawn = stats.bootstrap((values,), statistic, vectorized=False, method="percentile", n_resamples=2000,
                            confidence_level=_LEVEL, rng=np.random.default_rng(seed))  # fmt: skip
    return Estimate(statistic(values), float(drawn.confidence_interval.low), float(drawn.confidence_interval.high))


def slope(x: np.ndarray, y: np.ndarray) -> Estimate:
    """The slope of an ordinary least-squares line; x and y [N] are pairs.

    The interval allows for a spread of y that changes with x (White's standard error, HC1).
    """
    centered = x - x.mean()
    square = float(centered @ centered)
    value = float(centered @ (y - y.mean())) / square
    residuals = y - y.mean() - value * centered
    error = math.sqrt(float((centered**2) @ (residuals**2)) * len(x) / (len(x) - 2)) / square
    return Estimate(value, value - _NORMAL_975 * error, value + _NORMAL_975 * error)
