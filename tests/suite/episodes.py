"""Shared by tests of the suite: a seed for a module, towers with patterns of glue, and actions to play."""

import functools
import os
import secrets

import numpy as np

from physexp import suite

# From the operating system, or from PHYSEXP_TEST_SEED to replay a failure.
SEED = int(os.environ.get("PHYSEXP_TEST_SEED", secrets.randbits(31)))
EVERY_PATTERN = np.arange(16)
INTO_THE_TOWER, AWAY, LEFT, RIGHT = range(4)  # The fist's actions: +x, -x, +y, -y. It starts at x = -0.32 m.


@functools.cache
def _load_task(domain, **options):
    return suite.load_task(domain, suite.TASKS_BY_DOMAIN[domain][0], options)


def drawn(domain, seeds, indices, **options):
    """Returns the hidden properties of some episodes of a domain."""
    return _load_task(domain, **options).draw(seeds, indices)


def episode_with(pattern: int, environment_seed: int) -> int:
    """The first episode with this pattern; one in thirty at least has it, so a thousand are enough."""
    patterns = drawn("towers", np.full(1000, environment_seed), np.arange(1000))
    return int(np.flatnonzero(patterns == pattern)[0])


def random_actions(rng, task, size):
    """Interactions, and one label in fifteen."""
    labels = task.num_interactions + rng.integers(task.num_labels, size=size)
    return np.where(rng.random(size) < 1 / 15, labels, rng.integers(task.num_interactions, size=size))


@functools.cache
def _load_batch(task_name, size, control_timestep):
    """Batches are built once: compiling sixteen towers takes a second."""
    return suite.load_batch("towers", task_name, size, {"random": SEED, "control_timestep": control_timestep})


def batch_of(task_name, patterns, control_timestep=0.1):
    """A batch whose i-th environment starts with `patterns[i]`, and its first observation."""
    batch = _load_batch(task_name, len(patterns), control_timestep)
    rows = []
    for i, pattern in enumerate(patterns):
        episode = episode_with(pattern, suite.environment_seed(SEED, i))
        rows.append(batch.reset(np.array([i]), episode).observation)
    np.testing.assert_array_equal(batch.hidden, patterns)
    return batch, {name: np.concatenate([row[name] for row in rows]) for name in rows[0]}


def plans_that_miss(rng, step_limit: int, control_timestep: float, num_random: int):
    """Fist actions of whole episodes that never touch the tower, [number of plans, T].

    Each of the three directions that lead away held throughout, which ends in pressing against a limit of the fist's
    room, and walks that choose one of them anew every 0.3 s.
    """
    hold = max(1, round(0.3 / control_timestep))
    walks = rng.choice([AWAY, LEFT, RIGHT], size=(num_random, -(-step_limit // hold)))
    held = np.array([[AWAY], [LEFT], [RIGHT]])
    return np.concatenate([np.repeat(held, step_limit, axis=1), np.repeat(walks, hold, axis=1)[:, :step_limit]])


class Followed:
    """Asserts that observations follow from keys: under equal keys, they are equal to the bit.

    Attributes:
      shown: the observation of each key, as bytes.
    """

    def __init__(self):
        self.shown = {}

    def add(self, keys, observation) -> None:
        """Adds the observations of a batch and the key of each."""
        for row, key in enumerate(keys):
            seen = b"".join(value[row].tobytes() for value in observation.values())
            assert self.shown.setdefault(key, seen) == seen, key

    def num_different(self) -> int:
        """Returns the number of keys, whose observations all differ."""
        assert len(set(self.shown.values())) == len(self.shown)
        return len(self.shown)
