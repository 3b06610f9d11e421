"""Statistics of proportions."""

import math

_NORMAL_975 = 1.959963984540054  # The 97.5 % quantile of the normal distribution.


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
