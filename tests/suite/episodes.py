"""What tests of the suite share: a seed for a module, patterns of glue, and actions to play."""

import os
import secrets

import numpy as np

from physexp.suite import towers

# From the operating system, or from PHYSEXP_TEST_SEED to replay a failure.
SEED = int(os.environ.get("PHYSEXP_TEST_SEED", secrets.randbits(31)))
EVERY_PATTERN = np.arange(16)


def episode_with(pattern: int, environment_seed: int) -> int:
    """The first episode with this pattern; one in thirty at least has it, so a thousand are enough."""
    patterns = towers.draw_patterns(np.full(1000, environment_seed), np.arange(1000))
    return int(np.flatnonzero(patterns == pattern)[0])


def random_actions(rng, task, size):
    """Interactions, and one label in fifteen."""
    labels = task.num_interactions + rng.integers(task.num_labels, size=size)
    return np.where(rng.random(size) < 1 / 15, labels, rng.integers(task.num_interactions, size=size))
