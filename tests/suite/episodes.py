"""Shared by tests of the suite: a seed for a module, towers with patterns of glue, and actions to play."""

import functools
import os
import secrets

import dm_env
import mujoco
import numpy as np
import pytest

from physexp import suite
from physexp.suite.engine import snapshots

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


def drawn_with_answers(domain, seed, **options):
    """Returns the hidden properties and the answers of the first 100 000 episodes of a seed."""
    hidden = drawn(domain, np.full(100_000, seed), np.arange(100_000), **options)
    return hidden, _load_task(domain, **options).answers(hidden)


features_and_pixels = pytest.mark.parametrize("task", ["features", "pixels"])


def play(rng, batch, hidden, draw=None):
    """Plays interactions, random ones or from `draw()`, up to the last step; yields them and what is observed."""
    batch.reset(hidden=hidden)
    for _ in range(batch.task.rules.step_limit - 1):
        actions = draw() if draw else rng.integers(batch.task.num_interactions, size=len(hidden))
        yield actions, batch.step(actions).observation


def coordinates(batch) -> np.ndarray:
    """Returns the coordinates of all environments, `qpos`, [N, nq]."""
    return np.array([snapshots.view(batch, "qpos", row) for row in range(batch.num_environments)])


def assert_moves_as(models, controls, rng, batch, hidden, atol) -> None:
    """Random interactions move things as MuJoCo moves those of models into which the hidden property is compiled.

    Each is compared from the state before it, because things that bounce between walls multiply rounding errors.
    """
    data = [mujoco.MjData(model) for model in models]
    for actions, _ in play(rng, batch, hidden):
        for model, state, action in zip(models, data, actions, strict=True):
            state.ctrl[:] = controls[action]
            mujoco.mj_step(model, state, nstep=batch.task.options.substeps)
        np.testing.assert_allclose(coordinates(batch), [state.qpos for state in data], atol=atol)
        for row, state in enumerate(data):
            state.qpos[:], state.qvel[:] = (snapshots.view(batch, field, row) for field in ("qpos", "qvel"))


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
    return batch, batch.reset(hidden=np.asarray(patterns)).observation


def plans_that_miss(rng, step_limit: int, control_timestep: float, num_random: int):
    """Fist actions of whole episodes that never touch the tower, [number of plans, T].

    Each of the three directions that lead away held throughout, which ends in pressing against a limit of the fist's
    room, and walks that choose one of them anew every 0.3 s.
    """
    hold = max(1, round(0.3 / control_timestep))
    walks = rng.choice([AWAY, LEFT, RIGHT], size=(num_random, -(-step_limit // hold)))
    held = np.array([[AWAY], [LEFT], [RIGHT]])
    return np.concatenate([np.repeat(held, step_limit, axis=1), np.repeat(walks, hold, axis=1)[:, :step_limit]])


def assert_same(steps: dm_env.TimeStep, singles: list[dm_env.TimeStep]) -> None:
    """Row `i` of a batch's time step is the i-th single time step; on a first step a batch has 0 for None, and 1."""
    for i, single in enumerate(singles):
        assert steps.step_type[i] == single.step_type
        reward, discount = (0.0, 1.0) if single.first() else (single.reward, single.discount)
        assert (steps.reward[i], steps.discount[i]) == (reward, discount)
        assert set(steps.observation) == set(single.observation)
        for name, value in single.observation.items():
            row = steps.observation[name][i]
            assert (row.dtype, row.shape) == (value.dtype, value.shape)
            assert row.tobytes() == value.tobytes(), (i, name, row, value)


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
