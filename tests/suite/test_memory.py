"""Memory stays flat over many resets, and what is dropped is given back."""

from memory import growth
import numpy as np
import pytest

from physexp import suite

# With one compiled model and with many, of which each reset takes up another, which takes 8 ms.
TASKS = [("which_is_heavier", "features", 500, 100), ("towers", "fist_features", 200, 300)]

# Bytes a reset. The smallest thing that a reset could lose is a few hundred bytes (a small array, a TimeStep).
FLAT = 100
NOISE = 50_000  # bytes: buffers that numpy keeps came to 5 kB.


@pytest.mark.long
@pytest.mark.parametrize("size", [None, 4], ids=["environment", "batch"])
@pytest.mark.parametrize("domain, task, num_resets, num_warm_up", TASKS)
def test_resets_leave_memory_as_it_is(seed, domain, task, num_resets, num_warm_up, size):
    """Each of the sixteen towers, with a probability of 1/30 at least, has been compiled in the warm-up."""
    load = suite.load if size is None else lambda *names: suite.load_batch(*names[:2], size, names[2])
    environment = load(domain, task, {"random": seed})
    action = 0 if size is None else np.zeros(size, int)

    def play():
        environment.reset()
        environment.step(action)

    grown = growth(play, num_resets, num_warm_up)
    assert grown < FLAT * num_resets + NOISE, f"{grown} bytes in {num_resets} resets"
