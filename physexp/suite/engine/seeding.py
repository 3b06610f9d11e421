"""Seeds and draws: pure functions of integers, the same for one environment and for thousands.

An episode depends on `(environment seed, episode index)` alone, so any episode can be rebuilt by itself, and a batch
draws all its resets in one vectorized call.
"""

from typing import Any

import numpy as np
from scipy import special

from physexp import checks

LARGEST_SEED = 2**63 - 1
LAST_EPISODE = 2**62 - 1  # Far enough from the largest int64 that counting on never overflows.

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
# Keys that separate numbers for one purpose from those for another.
_NOISE, _VARIATION, _TIMING = np.uint64(0x6E6F697365), np.uint64(0x76617279), np.uint64(0x74696D65)


def _mix(x: np.ndarray) -> np.ndarray:
    """One step of the SplitMix64 generator (Steele et al., 2014): a bijection of 64-bit integers."""
    x = x + _GOLDEN
    x = (x ^ (x >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    x = (x ^ (x >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return x ^ (x >> np.uint64(31))


def environment_seed(seed: int, index: int) -> int:
    """Returns the seed, in [0, 2**32), of environment `index` in a batch seeded with `seed`; both are in [0, 2**63)."""
    seed = checks.integer("seed", seed, 0, LARGEST_SEED)
    index = checks.integer("index", index, 0, LARGEST_SEED)
    return int(environment_seeds(seed, np.array([index]))[0])


def environment_seeds(seed: int, indices: np.ndarray) -> np.ndarray:
    """Returns `environment_seed` of several environments, int64 [N], of their indices, int64 [N]."""
    key = _mix(np.array([seed], np.uint64))
    return (_mix(key ^ indices.astype(np.uint64)) >> np.uint64(32)).astype(np.int64)


def uniforms(seeds: np.ndarray, episodes: np.ndarray, count: int, attempt: int = 0) -> np.ndarray:
    """Returns independent uniform numbers in (0, 1), float64 [N, count], of episodes: seeds and indices, int64 [N].

    Each attempt, 0, 1 and so on, gives further, independent numbers of the same episodes.
    """
    return _uniforms(_keys(seeds, episodes), count, attempt)


def variations(seeds: np.ndarray, episodes: np.ndarray, count: int) -> np.ndarray:
    """Returns numbers in (-1, 1), float64 [N, count], independent of those of `uniforms`; arguments as there."""
    return 2 * _uniforms(_mix(_keys(seeds, episodes) ^ _VARIATION), count) - 1


def timings(seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
    """Returns a number in (0, 1) of each episode, float64 [N], independent of all others; as `uniforms`."""
    return _uniforms(_mix(_keys(seeds, episodes) ^ _TIMING), 1)[:, 0]


def normals(seeds: np.ndarray, episodes: np.ndarray, steps: np.ndarray, count: int) -> np.ndarray:
    """Returns standard normal numbers, float64 [N, count], of control steps, int64 [N], independent of all others."""
    keys = _mix(_mix(_keys(seeds, episodes) ^ _NOISE) ^ steps.astype(np.uint64))
    return special.ndtri(_uniforms(keys, count))


def _keys(seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
    """Returns a number for each episode, uint64 [N], that tells it from all others."""
    return _mix(_mix(seeds.astype(np.uint64)) ^ episodes.astype(np.uint64))


def _uniforms(keys: np.ndarray, count: int, attempt: int = 0) -> np.ndarray:
    """Returns uniform numbers in (0, 1), float64 [N, count], that follow from keys, uint64 [N]."""
    steps = np.arange(attempt * count + 1, (attempt + 1) * count + 1, dtype=np.uint64) * _GOLDEN
    bits = _mix(keys[:, None] + steps) >> np.uint64(12)
    return (bits.astype(np.float64) + 0.5) * 2.0**-52


def seed_from(random: Any) -> int:
    """Returns the environment seed that an argument `random` stands for, as in dm_control's tasks."""
    if random is None:
        random = np.random.RandomState()
    if isinstance(random, np.random.RandomState):
        return int(random.randint(2**32, dtype=np.uint64))
    if checks.is_integer(random) and 0 <= random <= LARGEST_SEED:
        return int(random)
    raise ValueError(
        f"random, the seed, is {checks.shown(random)}; give an integer in [0, 2**63), a numpy RandomState, or None"
    )
