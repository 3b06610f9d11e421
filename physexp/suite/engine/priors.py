"""Priors of hidden properties, written once: for drawing, and for ideal experimenters."""

import dataclasses
from typing import Any

import numpy as np

from physexp.suite.engine import seeding

_MAX_DRAWS = 16


@dataclasses.dataclass(frozen=True)
class OddOneOut:
    """The prior of K things of which one is different (paper, Section 5.1).

    Each thing has a hidden value in [0, 1]. One of them, drawn uniformly, is the odd one: its value is from
    Beta(difficulty, 1), the others', the common ones', from Beta(1, difficulty). The question is whose is the largest.

    Attributes:
      num_things: K, at least 2.
      difficulty: the paper's beta, >= 1; the larger, the easier.
    """

    num_things: int
    difficulty: float

    def odd_cdf(self, values: Any) -> Any:
        """Returns the cumulative distribution function of the odd one's value, at `values`."""
        return values**self.difficulty

    def odd_quantile(self, levels: Any) -> Any:
        """Returns the quantiles of the odd one's value, at the probabilities `levels`."""
        return np.exp(np.log(levels) / self.difficulty)

    def common_cdf(self, values: Any) -> Any:
        """Returns the cumulative distribution function of a common one's value, at `values`."""
        with np.errstate(divide="ignore"):
            return -np.expm1(self.difficulty * np.log1p(-values))

    def common_quantile(self, levels: Any) -> Any:
        """Returns the quantiles of a common one's value, at the probabilities `levels`."""
        return -np.expm1(np.log1p(-levels) / self.difficulty)

    def log_ratio(self, values: Any) -> Any:
        """Returns the log likelihood ratio of `values`: of the odd one's density to a common one's."""
        with np.errstate(divide="ignore"):
            return (self.difficulty - 1) * (np.log(values) - np.log1p(-values))

    def from_uniforms(self, draws: np.ndarray) -> np.ndarray:
        """Returns values, float64 [N, K], from numbers [N, K + 1], uniform in (0, 1); the first chooses the odd one."""
        values = self.common_quantile(draws[:, 1:])
        rows, odd = np.arange(len(draws)), (draws[:, 0] * self.num_things).astype(np.int64)
        values[rows, odd] = self.odd_quantile(draws[rows, 1 + odd])
        return values

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the values of some episodes, float64 [N, K]; the largest two always differ."""
        count = self.num_things + 1
        values = self.from_uniforms(seeding.uniforms(seeds, episodes, count))
        for attempt in range(1, _MAX_DRAWS):
            tied = gaps(values) == 0
            if not tied.any():
                return values
            values[tied] = self.from_uniforms(seeding.uniforms(seeds[tied], episodes[tied], count, attempt))
        raise RuntimeError(
            f"difficulty {self.difficulty} makes things tie in {_MAX_DRAWS} draws; choose one closer to 1"
        )


def choose(prior: np.ndarray, draws: np.ndarray) -> np.ndarray:
    """Returns indices with the given probabilities, int64 [N], from uniform numbers in (0, 1), [N]."""
    return np.searchsorted(np.cumsum(prior)[:-1], draws, side="right")


def gaps(values: np.ndarray) -> np.ndarray:
    """Returns by how much the largest value is larger than the second, float64 [N], of values [N, K]."""
    two_largest = np.partition(values, -2, axis=1)[:, -2:]
    return two_largest[:, 1] - two_largest[:, 0]
