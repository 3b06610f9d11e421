"""Threshold: a push slides the block if and only if it is stronger than friction, and nothing else can be read."""

import chance
import episodes
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import threshold

LEVELS = threshold.LEVEL_SPACING * np.arange(1, threshold.NUM_LEVELS + 1)  # N


def _edges_of_intervals() -> np.ndarray:
    """The least and the greatest friction of each label, N [2 * NUM_LEVELS]: the hardest cases."""
    below = LEVELS - threshold.LEVEL_SPACING
    margins = threshold.LEVEL_SPACING * np.array([threshold.MARGIN, 1 - threshold.MARGIN])
    return (below[:, None] + margins).ravel()


@pytest.mark.parametrize("control_timestep, time_limit", [(0.1, 1.5), (0.06, 3.0), (0.2, 3.0), (0.1, 10.0)])
def test_a_push_moves_the_block_if_and_only_if_its_force_is_above_friction(seed, control_timestep, time_limit):
    rng = np.random.default_rng(seed)
    frictions = np.concatenate([_edges_of_intervals(), episodes.drawn("threshold", *rng.integers(2**31, size=(2, 48)))])
    kwargs = {"random": seed, "control_timestep": control_timestep, "time_limit": time_limit}
    batch = suite.load_batch("threshold", "features", len(frictions), kwargs)
    first = batch.reset(hidden=frictions).observation
    assert (first["slid"] == 0).all() and (first["strength"] == 0).all()
    for pushes, seen in episodes.play(rng, batch, frictions):
        np.testing.assert_array_equal(seen["slid"][:, 0] == 1, LEVELS[pushes] > frictions)
        np.testing.assert_array_equal(seen["strength"][:, 0], ((pushes + 1) / threshold.NUM_LEVELS).astype(np.float32))


def test_a_block_pushed_in_vain_for_a_whole_episode_stays_on_its_stop():
    """The strongest push that does not slide it, all the time: MuJoCo's friction creeps, and must not creep across."""
    labels = np.arange(1, threshold.NUM_LEVELS)
    frictions = LEVELS[labels] - (1 - threshold.MARGIN) * threshold.LEVEL_SPACING
    batch = suite.load_batch("threshold", "features", len(labels), {"random": 0, "time_limit": 10.0})
    batch.reset(hidden=frictions)
    for _ in range(batch.task.rules.step_limit - 1):
        assert (batch.step(labels - 1).observation["slid"] == 0).all()
    assert np.abs(episodes.coordinates(batch)).max() < 0.4 * threshold.TRAVEL


@episodes.features_and_pixels
def test_observations_tell_nothing_but_the_push_and_whether_the_block_slid(seed, task):
    """Observations follow from these two, for all frictions and all histories."""
    frictions = _edges_of_intervals()
    batch = suite.load_batch("threshold", task, len(frictions), {"random": seed})
    followed = episodes.Followed()
    for pushes, observation in episodes.play(np.random.default_rng(seed), batch, frictions):
        followed.add(zip(pushes, LEVELS[pushes] > frictions, strict=True), observation)
    assert followed.num_different() > 1.5 * threshold.NUM_LEVELS


@pytest.mark.parametrize("difficulty", [1.0, 2.0, 5.0])
def test_labels_follow_the_prior_and_frictions_keep_away_from_the_levels(seed, difficulty):
    frictions, labels = episodes.drawn_with_answers("threshold", seed, difficulty=difficulty)
    # Beta(1, d) has the distribution function 1 - (1 - x)^d.
    edges = 1 - (1 - np.arange(threshold.NUM_LEVELS + 1) / threshold.NUM_LEVELS) ** difficulty
    chance.assert_drawn(np.bincount(labels, minlength=threshold.NUM_LEVELS), np.diff(edges))
    distances = np.abs(frictions[:, None] - np.concatenate([[0.0], LEVELS])).min(axis=1)
    assert distances.min() >= threshold.MARGIN * threshold.LEVEL_SPACING - 1e-9
    assert (LEVELS[labels] > frictions).all() and (LEVELS[labels] - threshold.LEVEL_SPACING < frictions).all()
