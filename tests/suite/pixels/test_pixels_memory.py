"""Drawing, and opening and closing what draws, leaves memory and open files as they are."""

import gc

from images import EDGE, HEAVIER, MARKS, load_shared
import memory
import numpy as np
import pytest

from physexp import suite
from physexp.suite.engine import gl

pytestmark = MARKS


def test_resets_leave_memory_as_it_is(seed, drawn):
    """Of one environment, where each of them draws, and of a batch, where each is followed by a step that does."""
    env, batch = load_shared(*HEAVIER, seed), load_shared(*HEAVIER, seed, 8)

    def play():
        env.reset()
        env.step(0)
        batch.reset()
        batch.step(np.zeros(8, int))

    grown = memory.growth(play, 50, num_warm_up=10)
    assert sum(drawn) >= 60 * (2 + 8)
    assert grown < 200_000, f"{grown} bytes; an image has {EDGE * EDGE * 3}"


@pytest.mark.parametrize("closes", [True, False], ids=["closed", "dropped"])
def test_environments_that_end_leave_nothing(closes):
    """Neither memory nor open files: 20 kB of each would be 200 kB in all, and a context and its buffers take 7 MB."""

    def play():
        for environment in (suite.load(*HEAVIER), suite.load_batch(*HEAVIER, 1)):
            environment.reset()
            if closes:
                environment.close()
        del environment
        gc.collect()
        gl.draw(lambda: None)  # The drawing thread has freed all that it was given before.

    play()
    files = memory.open_files()
    grown = memory.growth(play, 5, num_warm_up=2)
    assert grown < 200_000, f"{grown} bytes"
    assert memory.open_files() <= files  # Of those of other tests, some may be closed late.
