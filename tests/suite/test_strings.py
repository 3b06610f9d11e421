"""Strings: a pull moves what bands join to the pulled puck past no clamp, and nothing else can be read."""

import itertools

import chance
import episodes
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import strings

LEAST, GREATEST = strings.SLACKS


def _extremes() -> np.ndarray:
    """Every graph with every choice of the least and the greatest slack of its bands, m [27, 3]."""
    return np.array(list(itertools.product((0.0, LEAST, GREATEST), repeat=3)))


def _moved(slacks: np.ndarray, clamped: int, pulled: int) -> np.ndarray:
    """Which pucks a pull moves, bool [3], by the square of the matrix of joints, without the clamped puck."""
    joined = np.eye(3)
    for slack, (i, j) in zip(slacks, ((0, 1), (0, 2), (1, 2)), strict=True):
        joined[i, j] = joined[j, i] = slack > 0
    if clamped >= 0:
        joined[clamped], joined[:, clamped] = 0, 0
    return np.linalg.matrix_power(joined, 2)[pulled] > 0


def _play(rng, batch, slacks):
    """Plays; yields what is pulled, clamped and should be away, bool [N, 3] each, and what is observed."""
    clamped = np.full(len(slacks), -1)
    for actions, seen in episodes.play(rng, batch, slacks):
        clamped = np.where(actions < 3, clamped, np.where(clamped == actions - 3, -1, actions - 3))
        away = [
            _moved(bands, clamp, action) if action < 3 else np.zeros(3, bool)
            for bands, clamp, action in zip(slacks, clamped, actions, strict=True)
        ]
        yield actions[:, None] == np.arange(3), clamped[:, None] == np.arange(3), np.array(away), seen


@pytest.mark.parametrize("control_timestep", [0.1, 0.11, 0.25])
def test_a_pull_moves_all_joined_pucks_past_no_clamp(seed, control_timestep):
    rng = np.random.default_rng(seed)
    drawn = episodes.drawn("strings", *rng.integers(2**31, size=(2, 60)))
    slacks = np.concatenate([np.repeat(_extremes(), 5, axis=0), drawn])
    kwargs = {"random": seed, "control_timestep": control_timestep, "time_limit": 50 * control_timestep}
    batch = suite.load_batch("strings", "features", len(slacks), kwargs)
    assert not any(values.any() for values in batch.reset(hidden=slacks).observation.values())
    for *expected, seen in _play(rng, batch, slacks):
        for name, values in zip(("pulled", "clamped", "away"), expected, strict=True):
            np.testing.assert_array_equal(seen[name], values)


@episodes.features_and_pixels
def test_observations_tell_nothing_but_what_is_pulled_clamped_and_away(seed, task):
    """Observations follow from these three, for all slacks and all histories."""
    slacks = np.repeat(_extremes(), 12, axis=0)  # So many that all 31 are seen but in one run of a hundred million.
    batch = suite.load_batch("strings", task, len(slacks), {"random": seed})
    followed = episodes.Followed()
    for *expected, observation in _play(np.random.default_rng(seed), batch, slacks):
        followed.add(map(tuple, np.hstack(expected)), observation)
    # Nothing pulled, with each clamp or none: 4. Each pulled without a clamp, and others with it or not: 3 * 4; clamped
    # itself: 3; or past another's clamp, and the third with it or not: 3 * 2 * 2.
    assert followed.num_different() == 4 + 12 + 3 + 12


@pytest.mark.parametrize("difficulty", [1, 2, 3.5])
def test_graphs_follow_the_prior_and_slacks_are_within_their_range(seed, difficulty):
    slacks, graphs = episodes.drawn_with_answers("strings", seed, difficulty=difficulty)
    bands = np.array([0, 1, 1, 2, 1, 2, 2, 3])  # Bits of the labels' numbers.
    expected = difficulty ** (3 - bands) / (1 + difficulty) ** 3
    np.testing.assert_allclose(strings.prior(difficulty), expected)
    chance.assert_drawn(np.bincount(graphs, minlength=8), expected)
    drawn = slacks[slacks > 0]
    assert LEAST <= drawn.min() < LEAST + 1e-5 and GREATEST - 1e-5 < drawn.max() < GREATEST


def test_answers_are_named_after_the_pairs_that_are_joined():
    task = suite.load_task("strings", "features")
    assert task.label_names[0] == "none" and task.label_names[7] == "0-1, 0-2, 1-2"
    assert task.answers(np.array([[0, LEAST, 0], [LEAST, 0, GREATEST]])).tolist() == [2, 5]
    assert [task.label_names[label] for label in (2, 5)] == ["0-2", "0-1, 1-2"]
    assert task.reveal(np.array([0, 0, LEAST])).tied == [("puck_1", "puck_2")]
    assert task.reveal(np.zeros(3)).marks == {"puck_1": "no bands"}
