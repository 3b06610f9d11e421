"""The ideal experimenter of Which is Heavier, when one poke reveals a mass exactly (theory: docs/ideal.md).

What it knows after k pokes is all in two numbers: the mass M of the heaviest block poked, and t, the sum of the
likelihood ratios r(m) = Beta(m; beta, 1) / Beta(m; 1, beta) = (m / (1 - m))^(beta - 1) of the blocks poked over r(M).
Their values are found by going back from the last poke, on a grid.
"""

from collections.abc import Callable
import dataclasses
import functools
from typing import Any

import numpy as np
from scipy import interpolate, special
from scipy.stats import qmc

from physexp.analysis import domains
from physexp.suite.domains import which_is_heavier

_HEAVIEST_NODES, _RATIO_NODES = 400, 33
_QUADRATURE_NODES = 48  # Per half of each density; many more where there is only one state to integrate from.
_EPISODES = 2**17  # Of the histogram; drawn evenly (Sobol), so that its error is far below 0.001.


def posterior(masses: np.ndarray, difficulty: float) -> np.ndarray:
    """How likely each block is to be the heaviest, given the masses of those that were poked.

    Args:
      masses: on the paper's scale, in [0, 1], NaN where a block was not poked, float64 [N, num_blocks].
      difficulty: the paper's beta.

    Returns:
      Probabilities, float64 [N, num_blocks]. Of the poked blocks only the heaviest can be it; unknown ones share the
      rest.
    """
    poked = ~np.isnan(masses)
    unknown = (~poked).sum(axis=1)
    heaviest, log_weight = _statistics(masses, difficulty)
    chance = np.where(poked.any(axis=1), _heaviest_is_poked(unknown, heaviest, log_weight, difficulty), 0.0)
    others = np.divide(1 - chance, unknown, out=np.zeros(len(masses)), where=unknown > 0)
    result = np.where(poked, 0.0, others[:, None])
    rows = np.flatnonzero(poked.any(axis=1))
    result[rows, np.nanargmax(masses[rows], axis=1)] = chance[rows]
    return result


def _statistics(masses, difficulty) -> tuple[np.ndarray, np.ndarray]:
    """Of the poked blocks: the heaviest mass, and the logarithm of the sum of ratios; -inf where none was."""
    known = np.where(np.isnan(masses), -np.inf, masses)
    with np.errstate(divide="ignore"):
        ratios = np.where(np.isnan(masses), -np.inf, _log_ratio(np.nan_to_num(masses, nan=0.5), difficulty))
    return known.max(axis=1), special.logsumexp(ratios, axis=1)


def _log_ratio(mass, difficulty):
    """log r(m)."""
    return (difficulty - 1) * special.logit(mass)


def _heaviest_is_poked(unknown, heaviest, log_weight, difficulty):
    """Probability that the heaviest block poked is the heaviest of all.

    The drawn heavy block is among those poked with probability W / (W + u), W being the sum of their ratios and u how
    many blocks are unknown; then u light blocks must be lighter. Otherwise the heavy one and u - 1 light ones must be.
    """
    mass = np.clip(heaviest, 0, 1)
    with np.errstate(divide="ignore"):
        among_poked = special.expit(log_weight - np.log(unknown))
    lighter = _light_cdf(mass, difficulty)
    all_lighter = among_poked * lighter**unknown
    heavy_lighter = (1 - among_poked) * mass**difficulty * lighter ** np.maximum(unknown - 1, 0)
    return np.where(unknown == 0, 1.0, all_lighter + heavy_lighter)


def _light_cdf(mass, difficulty):
    return -special.expm1(difficulty * special.log1p(-mass))


@dataclasses.dataclass(frozen=True)
class Solution:
    """The best policy there is, and what it is worth.

    Attributes:
      difficulty, discount, num_blocks: of what it is the best.
      value: expected discounted return, discount^pokes times +1 or -1, from an episode's start.
      poke_values: for each number of pokes done, 1 to num_blocks - 1, what one more is worth: a function of points
        [N, 2] of (mass of the heaviest block poked, t).
    """

    difficulty: float
    discount: float
    num_blocks: int
    value: float
    poke_values: tuple[Callable, ...]

    def values(self, masses: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """What the best answer and what one more poke are worth.

        Args:
          masses: what is known, as for `posterior`, [N, num_blocks].

        Returns:
          Two float64 [N]; a poke is worth -inf where nothing is left to poke.
        """
        answer = 2 * posterior(masses, self.difficulty).max(axis=1) - 1
        heaviest, log_weight = _statistics(masses, self.difficulty)
        known = (~np.isnan(masses)).sum(axis=1)
        poke = np.full(len(masses), -np.inf)
        poke[known == 0] = self.value
        for number, function in enumerate(self.poke_values, start=1):
            rows = known == number
            ratio = np.exp(log_weight[rows] - _log_ratio(heaviest[rows], self.difficulty))
            poke[rows] = function(_points(heaviest[rows], ratio))
        return answer, poke

    def actions(self, masses: np.ndarray) -> np.ndarray:
        """The best action, int64 [N]: the first unknown block, or num_blocks plus the label; `masses` as above."""
        answer, poke = self.values(masses)
        label = self.num_blocks + posterior(masses, self.difficulty).argmax(axis=1)
        return np.where(poke > answer, np.isnan(masses).argmax(axis=1), label)

    def play(self, masses: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Plays episodes without physics.

        Args:
          masses: of the blocks, on the paper's scale, float64 [N, num_blocks].

        Returns:
          Pokes, int64 [N], and whether the answer was right, bool [N].
        """
        known = np.full(masses.shape, np.nan)
        pokes, labels = np.zeros(len(masses), np.int64), np.full(len(masses), -1)
        going = np.arange(len(masses))
        while len(going):
            actions = self.actions(known[going])
            poking = actions < self.num_blocks
            labels[going[~poking]] = actions[~poking] - self.num_blocks
            going, poked = going[poking], actions[poking]
            known[going, poked] = masses[going, poked]
            pokes[going] += 1
        return pokes, labels == masses.argmax(axis=1)

    def summary(self) -> dict[str, Any]:
        """`value`, `accuracy`, `mean_interactions` and `histogram` (share of episodes for each number of pokes)."""
        pokes, right = _evenly_drawn_episodes(self)
        shares = np.bincount(pokes, minlength=self.num_blocks + 1) / len(pokes)
        return {
            "value": self.value,
            "accuracy": float(right.mean()),
            "mean_interactions": float(pokes.mean()),
            "histogram": {number: float(share) for number, share in enumerate(shares)},
        }


@functools.lru_cache(maxsize=64)
def _evenly_drawn_episodes(solution: Solution) -> tuple[np.ndarray, np.ndarray]:
    """Pokes and success, as `Solution.play` has them, of episodes whose masses are spread evenly."""
    draws = qmc.Sobol(solution.num_blocks + 1, rng=0).random(_EPISODES).clip(1e-12, 1 - 1e-12)
    return solution.play(which_is_heavier.masses_from(draws, solution.difficulty))


@functools.lru_cache(maxsize=64)
def solve(
    difficulty: float = which_is_heavier.Options.difficulty,
    discount: float = domains.find("which_is_heavier").discount,
    num_blocks: int = which_is_heavier.NUM_BLOCKS,
) -> Solution:
    """Finds the best policy, its value to better than 0.0001.

    Args:
      difficulty: the paper's beta, in [1, 1e6].
      discount: the agent's gamma, in (0, 1].
      num_blocks: how many blocks, from 2 to 20.

    Raises:
      ValueError: for a value that makes no sense.
    """
    if not (isinstance(difficulty, (int, float)) and 1 <= difficulty <= 1e6):
        raise ValueError(f"difficulty is {difficulty!r}; give a number in [1, 1e6] (the paper's beta)")
    if not (isinstance(discount, (int, float)) and 0 < discount <= 1):
        raise ValueError(f"discount is {discount!r}; give a number in (0, 1]")
    if not isinstance(num_blocks, int) or not 2 <= num_blocks <= 20:
        raise ValueError(f"num_blocks is {num_blocks!r}; give an integer >= 2 and <= 20")
    levels = np.linspace(0, 1, _HEAVIEST_NODES // 2 + 2)[1:-1]
    nodes = np.unique(np.concatenate([_heavy_quantile(levels, difficulty), _light_quantile(levels, difficulty)]))
    nodes = np.concatenate([[nodes[0] * 1e-3], nodes, [1 - (1 - nodes[-1]) * 1e-3]])
    functions: list[Callable] = []
    after = None  # What a state with one more poke is worth beyond its answer.
    for known in reversed(range(1, num_blocks)):
        ratios = np.linspace(1, known, _RATIO_NODES) if known > 1 else np.array([1.0, 2.0])
        heaviest, ratio = (grid.ravel() for grid in np.meshgrid(nodes, ratios, indexing="ij"))
        values = discount * _expected(known, num_blocks, heaviest, ratio, difficulty, after)
        after = interpolate.RegularGridInterpolator(
            (nodes, ratios), values.reshape(len(nodes), -1), bounds_error=False, fill_value=None
        )
        functions.insert(0, after)
    first = discount * _expected(0, num_blocks, np.zeros(1), np.zeros(1), difficulty, after)
    return Solution(difficulty, discount, num_blocks, max(float(first[0]), 2 / num_blocks - 1), tuple(functions))


def _expected(known, num_blocks, heaviest, ratio, difficulty, after) -> np.ndarray:
    """What a state is worth on average after one more poke, [N].

    Args:
      known: pokes done.
      num_blocks: how many blocks there are.
      heaviest, ratio: the states, [N] each.
      difficulty: the paper's beta.
      after: what a further poke is worth in a state with `known` + 1 pokes; None where nothing is left to poke.
    """
    if after is None:
        return np.ones(len(heaviest))
    unknown = num_blocks - known
    with np.errstate(divide="ignore"):
        log_weight = _log_ratio(heaviest, difficulty) + np.log(ratio) if known else np.full(1, -np.inf)
    nodes, weights = special.roots_legendre(_QUADRATURE_NODES * (1 if known else 16))
    nodes, weights = (nodes + 1) / 2, weights / 2
    is_heavy = special.expit(np.log(unknown) - log_weight) / unknown  # Of one block among the unknown ones.
    total = np.zeros(len(heaviest))
    parts = [
        (is_heavy, heaviest**difficulty, _heavy_quantile),
        (1 - is_heavy, _light_cdf(heaviest, difficulty), _light_quantile),
    ]
    for chance, split, quantile in parts:  # Split where the new block becomes the heaviest: there the value has a kink.
        for start, width in ((np.zeros_like(split), split), (split, 1 - split)):
            levels = start[:, None] + width[:, None] * nodes
            mass = quantile(levels.clip(1e-300, 1 - 1e-16), difficulty)
            value = _value_after(known, unknown, heaviest[:, None], ratio[:, None], mass, difficulty, after)
            total += chance * width * (value @ weights)
    return total


def _value_after(known, unknown, heaviest, ratio, mass, difficulty, after) -> np.ndarray:
    """What a state is worth once one more block has turned out to have this mass; arrays [N, 1] and [N, Q]."""
    mass = mass.clip(1e-300, 1 - 1e-16)
    if known:
        difference = _log_ratio(mass, difficulty) - _log_ratio(heaviest, difficulty)
        ratio = np.where(mass > heaviest, 1 + ratio * np.exp(-np.abs(difference)), ratio + np.exp(-np.abs(difference)))
        heaviest = np.maximum(heaviest, mass)
    else:
        heaviest, ratio = mass, np.ones_like(mass)
    log_weight = _log_ratio(heaviest, difficulty) + np.log(ratio)
    left = np.full(heaviest.shape, unknown - 1)
    chance = _heaviest_is_poked(left, heaviest, log_weight, difficulty)
    answer = 2 * np.maximum(chance, (1 - chance) / (unknown - 1)) - 1
    return np.maximum(answer, after(_points(heaviest, ratio)))


def _points(heaviest, ratio) -> np.ndarray:
    return np.stack([heaviest, ratio], axis=-1)


def _heavy_quantile(level, difficulty):
    return level ** (1 / difficulty)


def _light_quantile(level, difficulty):
    return -special.expm1(special.log1p(-level) / difficulty)
