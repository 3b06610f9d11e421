"""Memory stays flat over thousands of resets, and what is dropped is given back."""

from memory import growth
import pytest

from physexp import suite

pytestmark = pytest.mark.long

# Resets whose memory is measured; fewer of an environment that takes up another compiled model in most of them, 8 ms.
NUM_RESETS, NUM_CHANGES = 1_000, 250

# Bytes a reset. The smallest thing that a reset could lose is a few hundred bytes (a small array, a TimeStep).
FLAT = 100
NOISE = 50_000  # bytes: buffers that numpy keeps came to 5 kB.

FEATURE_TASKS = suite.tagged("features")
every_feature_task = pytest.mark.parametrize("domain_name, task_name", FEATURE_TASKS)


def _assert_memory_is_flat(reset, num_resets: int, num_warm_up: int) -> None:
    grown = growth(reset, num_resets, num_warm_up)
    print(f"{grown} bytes in {num_resets} resets")
    assert grown < FLAT * num_resets + NOISE


@every_feature_task
def test_resets_of_one_environment_leave_memory_as_it_is(seed, domain_name, task_name):
    env = suite.load(domain_name, task_name, {"random": seed})
    is_one = env.task.scene.num_structures == 1
    # Meanwhile the sixteen towers are compiled: each comes up with a probability of 1/30 at least.
    _assert_memory_is_flat(env.reset, NUM_RESETS if is_one else NUM_CHANGES, num_warm_up=100 if is_one else 400)


@every_feature_task
def test_resets_of_a_batch_leave_memory_as_it_is(seed, domain_name, task_name):
    batch = suite.load_batch(domain_name, task_name, 4, {"random": seed})
    _assert_memory_is_flat(batch.reset, NUM_RESETS, num_warm_up=100 if batch.task.scene.num_structures == 1 else 300)
