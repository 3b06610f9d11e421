"""Crush: a press crushes the first whole can if and only if it is stronger than the cans, and nothing else is read."""

import chance
import episodes
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import crush
from physexp.suite.engine import snapshots

TASKS = [("crush", "features"), ("crush", "pixels")]
FORCES = crush.FORCE_SPACING * np.arange(1, crush.NUM_FORCES + 1)  # N
WEAKEST = FORCES - (1 - crush.MARGIN) * crush.FORCE_SPACING  # N, of each label
STRONGEST = FORCES - crush.MARGIN * crush.FORCE_SPACING  # N


class Player:
    """Plays presses in a batch and counts the cans that they should have crushed."""

    def __init__(self, batch, strengths):
        self._batch, self._strengths = batch, strengths
        self.first = batch.reset(hidden=strengths).observation
        self.num_crushed = np.zeros(len(strengths), int)

    def step(self, presses):
        """Returns the observation after presses, int [N]."""
        crushed = self.num_crushed + (FORCES[presses] > self._strengths)
        self.num_crushed = np.minimum(crushed, self._batch.task.options.num_cans)
        return self._batch.step(presses).observation


@pytest.mark.parametrize(
    "control_timestep, time_limit, num_cans",
    [(0.1, 1.6, 1), (0.1, 1.6, 2), (0.1, 10.0, 3), (0.08, 3.0, 3), (0.2, 3.0, 2)],
)
def test_a_press_crushes_the_first_whole_can_if_it_is_the_stronger(seed, control_timestep, time_limit, num_cans):
    rng = np.random.default_rng(seed)
    drawn = episodes.drawn("crush", *rng.integers(2**31, size=(2, 96)))
    strengths = np.concatenate([np.repeat([WEAKEST, STRONGEST], 8, axis=1).ravel(), drawn])
    kwargs = {"random": seed, "control_timestep": control_timestep, "time_limit": time_limit, "num_cans": num_cans}
    batch = suite.load_batch("crush", "features", len(strengths), kwargs)
    player, labels = Player(batch, strengths), batch.task.answers(strengths)
    assert not any(values.any() for values in player.first.values())
    for _ in range(batch.task.rules.step_limit - 1):
        # Mostly the strongest press that the cans withstand, so that some are whole until the end.
        withstood, drawn = np.maximum(labels - 1, 0), rng.integers(crush.NUM_FORCES, size=len(labels))
        presses = np.where(rng.random(len(labels)) < 0.7, withstood, drawn)
        seen = player.step(presses)
        np.testing.assert_array_equal(seen["crushed"], np.arange(num_cans) < player.num_crushed[:, None])
        np.testing.assert_array_equal(seen["strength"][:, 0], ((presses + 1) / crush.NUM_FORCES).astype(np.float32))


def test_a_can_pressed_in_vain_for_a_whole_episode_stays_whole():
    """The strongest press that does not crush it, all the time: MuJoCo's friction creeps, and must not creep across."""
    labels = np.arange(1, crush.NUM_FORCES)
    batch = suite.load_batch("crush", "features", len(labels), {"random": 0, "time_limit": 10.0})
    batch.reset(hidden=WEAKEST[labels])
    for _ in range(batch.task.rules.step_limit - 1):
        assert not batch.step(labels - 1).observation["crushed"].any()
    for environment in range(len(labels)):
        assert float(snapshots.view(batch, "qpos", environment)[0]) < 0.4 * crush.TRAVEL


@pytest.mark.parametrize("domain_name, task_name", TASKS)
def test_observations_tell_nothing_but_the_press_and_the_crushed_cans(seed, domain_name, task_name):
    """Observations follow from these two, for all strengths and all histories."""
    rng = np.random.default_rng(seed)
    strengths = np.repeat([WEAKEST, STRONGEST], 4, axis=1).ravel()
    batch = suite.load_batch(domain_name, task_name, len(strengths), {"random": seed, "num_cans": 3})
    followed, player = episodes.Followed(), Player(batch, strengths)
    for _ in range(batch.task.rules.step_limit - 1):
        presses = rng.integers(crush.NUM_FORCES, size=len(strengths))
        observation = player.step(presses)
        followed.add(zip(presses, player.num_crushed, strict=True), observation)
    assert followed.num_different() > 3 * crush.NUM_FORCES  # Of all presses with none, one, two and three crushed.


def test_labels_are_equally_likely_and_strengths_keep_away_from_the_forces(seed):
    """Each label's share of 100 000 episodes is what its probability makes likely."""
    count = 100_000
    strengths = episodes.drawn("crush", np.full(count, seed), np.arange(count))
    labels = suite.load_task("crush", "features").answers(strengths)
    chance.assert_drawn(np.bincount(labels, minlength=crush.NUM_FORCES), np.full(16, 1 / 16))
    assert (WEAKEST[labels] <= strengths).all() and (strengths <= STRONGEST[labels]).all()
