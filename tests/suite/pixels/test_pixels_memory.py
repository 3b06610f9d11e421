"""Drawing, and opening and closing what draws, leaves memory and open files as they are."""

import gc

from images import EDGE, HEAVIER, MARKS, load_shared
import memory
import numpy as np
import pytest

from physexp import suite
from physexp.suite.engine import gl

pytestmark = MARKS


def test_two_thousand_resets_leave_memory_as_it_is(seed, drawn):
    """Of one environment, where each of them draws, and of a batch, where each is followed by a step that does."""
    env, batch = load_shared(*HEAVIER, seed), load_shared(*HEAVIER, seed, 16)

    def play():
        for _ in range(4):
            env.reset()
        env.step(0)
        batch.reset()
        batch.step(np.zeros(16, int))

    grown = memory.growth(play, 100, num_warm_up=20)
    assert sum(drawn) >= 120 * (4 + 1 + 16)
    assert grown < 400_000, f"{grown} bytes; an image has {EDGE * EDGE * 3}"


def test_environments_that_are_dropped_give_their_memory_back():
    """A context and its buffers take 7 MB, and not one of those of six environments may be lost."""

    def play():
        for env in (suite.load(*HEAVIER), suite.load_batch(*HEAVIER, 1)):
            env.reset()
        del env
        gc.collect()
        gl.draw(lambda: None)  # The drawing thread has freed all that it was given before.

    grown = memory.growth(play, 3, num_warm_up=3)
    assert grown < 7_000_000, f"{grown} bytes"


@pytest.mark.long
@pytest.mark.parametrize("size", [None, 2], ids=["environment", "batch"])
def test_two_hundred_environments_opened_and_closed_leave_nothing(size):
    """Neither memory nor open files; 20 kB of each would be 4 MB in all, and a context takes 7 MB."""

    def play():
        environment = suite.load(*HEAVIER) if size is None else suite.load_batch(*HEAVIER, size)
        environment.reset()
        environment.step(0 if size is None else np.zeros(size, int))
        environment.close()

    play()
    files = memory.open_files()
    grown = memory.growth(play, 200, num_warm_up=20)
    assert grown < 4_000_000, f"{grown} bytes"
    assert memory.open_files() <= files  # Of those of other tests, some may be closed late.
