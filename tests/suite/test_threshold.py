"""Threshold: a push slides the block if and only if it is stronger than friction, and nothing else can be read."""

import chance
import episodes
import numpy as np
import pytest
from scipy import stats

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


def test_flags_are_wrong_as_often_as_asked_and_independently(seed):
    noise, size = 0.2, 500
    batch = suite.load_batch("threshold", "features", size, {"random": seed, "flag_noise": noise})
    frictions = batch.reset().observation["slid"] + batch.hidden[:, :1]  # The first flags are down.
    np.testing.assert_array_equal(frictions[:, 0], episodes.drawn("threshold", batch.seeds, np.zeros(size, int)))
    played = episodes.play(np.random.default_rng(seed), batch, batch.hidden)
    wrong = np.array([(seen["slid"][:, 0] == 1) != (LEVELS[pushes] > frictions[:, 0]) for pushes, seen in played])
    chance.assert_drawn([wrong.sum(), (~wrong).sum()], [noise, 1 - noise])
    chance.assert_drawn([(wrong[0] & wrong[1]).sum(), (~(wrong[0] & wrong[1])).sum()], [noise**2, 1 - noise**2])
    chance.assert_drawn(np.bincount(wrong.sum(axis=0), minlength=15), stats.binom(14, noise).pmf(np.arange(15)))


@episodes.features_and_pixels
def test_observations_tell_nothing_but_the_push_and_an_unsure_flag(seed, task):
    """They follow from these two, in a batch and alone; and a hidden property determines the flags of its episode."""
    frictions = _edges_of_intervals()
    batch = suite.load_batch("threshold", task, len(frictions), {"random": seed, "flag_noise": 0.3})
    hidden = np.column_stack([frictions, np.random.default_rng(seed).random(len(frictions))])
    played = list(episodes.play(np.random.default_rng(seed), batch, hidden))
    pushes, followed = np.array([pushes for pushes, _ in played]), episodes.Followed()
    flags = np.transpose([batch.task.flags(one, taken) for one, taken in zip(hidden, pushes.T, strict=True)])
    for taken, shown, (_, observation) in zip(pushes, flags, played, strict=True):
        followed.add(zip(taken, shown, strict=True), observation)
    assert followed.num_different() > 1.5 * threshold.NUM_LEVELS
    single = suite.load("threshold", task, task_kwargs={"random": seed, "flag_noise": 0.3})
    single.task.give_hidden(hidden[5])
    single.reset()
    followed.add(
        zip(pushes[:, 5], flags[:, 5], strict=True), _stacked(single.step(one) for one in pushes[:, 5].tolist())
    )


def _stacked(timesteps):
    """The observations of time steps, with a leading axis."""
    seen = [timestep.observation for timestep in timesteps]
    return {name: np.array([one[name] for one in seen]) for name in seen[0]}


@pytest.mark.parametrize("difficulty", [1.0, 2.0, 5.0])
def test_labels_follow_the_prior_and_frictions_keep_away_from_the_levels(seed, difficulty):
    frictions, labels = episodes.drawn_with_answers("threshold", seed, difficulty=difficulty)
    # Beta(1, d) has the distribution function 1 - (1 - x)^d.
    edges = 1 - (1 - np.arange(threshold.NUM_LEVELS + 1) / threshold.NUM_LEVELS) ** difficulty
    chance.assert_drawn(np.bincount(labels, minlength=threshold.NUM_LEVELS), np.diff(edges))
    distances = np.abs(frictions[:, None] - np.concatenate([[0.0], LEVELS])).min(axis=1)
    assert distances.min() >= threshold.MARGIN * threshold.LEVEL_SPACING - 1e-9
    assert (LEVELS[labels] > frictions).all() and (LEVELS[labels] - threshold.LEVEL_SPACING < frictions).all()
