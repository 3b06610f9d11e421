"""An hour of play: nothing diverges, no episode is lost, memory stays flat and nothing slows down.

`make soak` plays all tasks at full length, with PHYSEXP_SOAK set; `make test-all` plays seconds of two tasks.
"""

import os
import time

import dm_env
from memory import resident_bytes
import numpy as np
import pytest
from seeds import fresh_seed
import torch

from physexp import suite
from physexp.agents import acting, pretrained

pytestmark = pytest.mark.long

FULL = "PHYSEXP_SOAK" in os.environ
TASKS = suite.ALL_TASKS if FULL else [("which_is_heavier", "features"), ("strike", "pixels")]
FULL_STEPS = {"features": 5_000_000, "pixels": 300_000}
SHORT_STEPS = {"features": 1_600, "pixels": 400}
SIZES = {"features": 128 if FULL else 32, "pixels": 32 if FULL else 16}
LABELS = 0.02  # Probability of an answer in random play, so that episodes have all lengths.
WARM_UP = 60  # Batched steps, which compile all sixteen towers and fill every buffer.
SLOWER = 1.05 if FULL else 2.0  # A short run measures seconds, which other processes disturb.
GROWTH = 16e6  # Bytes: three for each step of the full length, within the allocator's noise.


class Players:
    """Plays a batch: every other environment with the trained agent of the task, the rest at random.

    All environments of a task without such an agent are played at random.
    """

    def __init__(self, domain, task, size, seed):
        self.batch = suite.load_batch(domain, task, size, {"random": seed})
        # Environments are in different steps here, and the belief learner's memory has one length for all of them.
        learner = {"which_is_heavier": "a3c", "towers": "a3c", "threshold": "ppo"}.get(domain)
        learner = learner if task.endswith("features") else None
        self._network = pretrained.load(domain, task, agent=learner).network if learner else None
        self._generator = np.random.default_rng(seed)
        self._random = np.arange(size) % 2 == 1
        self._state = self._network.initial_state(size) if self._network else ()
        self._timestep = self.batch.reset()
        self.started, self.ended, self.rewards = size, 0, set()

    def _learned(self, timestep):
        """The agent's actions, [B]."""
        fresh = torch.from_numpy(timestep.step_type == dm_env.StepType.FIRST)
        for part in self._state:
            part[:, fresh] = 0  # An episode starts: so does the memory.
        encoded = self._network.encode(acting.as_tensors(timestep.observation))
        output, self._state = self._network.step(encoded, self._state)
        return acting.sample(output.logits, self._generator)

    @torch.inference_mode()
    def step(self):
        timestep, task = self._timestep, self.batch.task
        size = len(self._random)
        labels = self._generator.integers(task.num_labels, size=size)
        # Every other answer is right: in a short life, one of twelve might never be.
        labels = task.num_interactions + np.where(
            self._generator.random(size) < 0.5, self.batch.correct_answers, labels
        )
        pokes = self._generator.integers(task.num_interactions, size=size)
        at_random = np.where(self._generator.random(size) < LABELS, labels, pokes)
        actions = np.where(self._random, at_random, self._learned(timestep)) if self._network else at_random
        self._timestep = timestep = self.batch.step(actions)
        self.started += int((timestep.step_type == dm_env.StepType.FIRST).sum())
        self.ended += int((timestep.step_type == dm_env.StepType.LAST).sum())
        self.rewards |= set(np.unique(timestep.reward))
        assert all(np.isfinite(value).all() for value in timestep.observation.values())

    @property
    def in_flight(self):
        return int((self._timestep.step_type != dm_env.StepType.LAST).sum())


def warm_players(domain, task, size):
    players = Players(domain, task, size, fresh_seed())
    for _ in range(WARM_UP):
        players.step()
    return players


def compare(old, new, num_steps):
    """Median seconds of a step of either, in turns: the machine's own speed changes from hour to hour."""
    seconds = np.zeros((num_steps, 2))
    for step in range(num_steps):
        for side, players in enumerate((old, new)):
            begun = time.process_time()
            players.step()
            seconds[step, side] = time.process_time() - begun
    return np.median(seconds, axis=0)


@pytest.mark.parametrize(("domain", "task"), TASKS)
def test_a_batch_plays_on_and_on(domain, task):
    """The last tenth of a long life is as quick as the first tenth of a new one."""
    torch.set_num_threads(1)
    kind = task.rpartition("_")[2]
    players = warm_players(domain, task, SIZES[kind])
    num_steps = (FULL_STEPS if FULL else SHORT_STEPS)[kind] // SIZES[kind]
    before, start = resident_bytes(), time.monotonic()
    for step in range(num_steps):
        players.step()
        if (step + 1) % -(-num_steps // 10) == 0 or step + 1 == num_steps:
            done, elapsed = (step + 1) / num_steps, time.monotonic() - start
            left = f"time left {elapsed / done - elapsed:.0f} s"
            print(f"{domain}/{task}: {(step + 1) * SIZES[kind]:,} steps, {left}", flush=True)
    grown = resident_bytes() - before
    old, new = compare(players, warm_players(domain, task, SIZES[kind]), max(20, num_steps // 10))
    speed = f"{SIZES[kind] / old:.0f} steps/s, {old / new:.3f} of the time of a new batch"
    print(f"{players.ended} episodes, {grown / 1e6:.1f} MB more, {speed}")
    assert players.batch.num_divergences == 0
    assert players.started == players.ended + players.in_flight
    assert players.started == (players.batch.episodes + 1).sum()
    assert players.ended > 0 and players.rewards == {-1.0, 0.0, 1.0}
    assert grown < GROWTH
    assert old / new < SLOWER
