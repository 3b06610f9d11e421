"""Long runs: memory stays flat over thousands of resets, and random play never diverges."""

import ctypes
import gc
import os
import secrets

import numpy as np
import pytest

from physexp import suite

# Resets whose memory is measured, of one environment (a reset takes 8 ms with either of the two towers tasks) and of
# batches of 4.
NUM_RESETS = {"which_is_heavier": 10_000, "towers": 750}
NUM_BATCH_RESETS = 10_000
# Control steps of random play.
NUM_STEPS = {"which_is_heavier": 100_000, "towers": 15_000}

# Bytes a reset. The smallest thing that a reset could lose is a few hundred bytes (a small array, a TimeStep); the
# allocator's own noise over a thousand resets was below 100 kB.
FLAT = 100
NOISE = 1_000_000  # bytes

FEATURE_TASKS = [(domain, task) for domain, task in suite.ALL_TASKS if task.endswith("features")]
every_feature_task = pytest.mark.parametrize("domain_name, task_name", FEATURE_TASKS)


@pytest.fixture
def seed():
    """From the operating system, or from PHYSEXP_TEST_SEED to replay a failure."""
    value = int(os.environ.get("PHYSEXP_TEST_SEED", secrets.randbits(31)))
    print(f"PHYSEXP_TEST_SEED={value}")
    return value


def _resident_bytes() -> int:
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)  # What has been freed goes back to the system, and does not count.
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def _assert_memory_is_flat(reset, num_resets: int, num_warm_up: int) -> None:
    for _ in range(num_warm_up):
        reset()
    before = _resident_bytes()
    for _ in range(num_resets):
        reset()
    grown = _resident_bytes() - before
    print(f"{grown} bytes in {num_resets} resets")
    assert grown < FLAT * num_resets + NOISE


@every_feature_task
def test_resets_of_one_environment_leave_memory_as_it_is(seed, domain_name, task_name):
    env = suite.load(domain_name, task_name, {"random": seed})
    # Meanwhile the sixteen towers are compiled: each comes up with a probability of 1/30 at least.
    _assert_memory_is_flat(env.reset, NUM_RESETS[domain_name], num_warm_up=200)


@every_feature_task
def test_resets_of_a_batch_leave_memory_as_it_is(seed, domain_name, task_name):
    batch = suite.load_batch(domain_name, task_name, 4, {"random": seed})
    _assert_memory_is_flat(batch.reset, NUM_BATCH_RESETS, num_warm_up=300)


@pytest.mark.parametrize("domain_name, task_name", [("which_is_heavier", "features"), ("towers", "fist_features")])
def test_environments_and_batches_that_are_dropped_give_their_memory_back(domain_name, task_name):
    def build_and_drop():
        env = suite.load(domain_name, task_name, {"random": 0})
        env.reset()
        env.step(0)
        env.close()
        batch = suite.load_batch(domain_name, task_name, 4, {"random": 0})
        batch.reset()
        batch.step([0, 0, 0, 0])

    for _ in range(2):
        build_and_drop()
    before = _resident_bytes()
    for _ in range(6):
        build_and_drop()
    # Either one is megabytes large: an arena for contacts, for one, takes some.
    assert _resident_bytes() - before < 6 * 300_000


@every_feature_task
def test_random_play_never_diverges_and_stays_finite(seed, domain_name, task_name):
    """One label in a hundred actions, so that episodes of all lengths are played; memory stays flat as well."""
    rng = np.random.default_rng(seed)
    size = {"which_is_heavier": 500, "towers": 100}[domain_name]
    batch = suite.load_batch(domain_name, task_name, size, {"random": seed}, num_threads=1)
    batch.reset()
    num_interactions, num_labels = batch.task.num_interactions, batch.task.num_labels
    rewards = []
    for _ in range(NUM_STEPS[domain_name] // size):
        labels = num_interactions + rng.integers(num_labels, size=size)
        actions = np.where(rng.random(size) < 0.01, labels, rng.integers(num_interactions, size=size))
        step = batch.step(actions)
        assert all(np.isfinite(value).all() for value in step.observation.values())
        rewards.append(step.reward)
    assert batch.num_divergences == 0
    assert set(np.unique(rewards)) == {-1.0, 0.0, 1.0}
