"""Strings: a pull moves what bands join to the pulled puck past no clamp, and nothing else can be read."""

import itertools

import chance
import episodes
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import strings

TASKS = [("strings", "features"), ("strings", "pixels")]
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


class Player:
    """Plays random interactions in a batch and follows the clamp."""

    def __init__(self, rng, batch, slacks):
        self._rng, self._batch, self._slacks = rng, batch, slacks
        self.first = batch.reset(hidden=slacks).observation
        self.clamped = np.full(len(slacks), -1)

    def step(self):
        """Returns the observation, the pulled pucks, and the pucks that should be away, bool [N, 3]."""
        actions = self._rng.integers(6, size=len(self.clamped))
        moved = actions - 3
        self.clamped = np.where(moved < 0, self.clamped, np.where(self.clamped == moved, -1, moved))
        away = [
            _moved(slacks, clamped, action) if action < 3 else np.zeros(3, bool)
            for slacks, clamped, action in zip(self._slacks, self.clamped, actions, strict=True)
        ]
        return self._batch.step(actions).observation, actions[:, None] == np.arange(3), np.array(away)


@pytest.mark.parametrize("control_timestep", [0.1, 0.11, 0.25])
def test_a_pull_moves_all_joined_pucks_past_no_clamp(seed, control_timestep):
    rng = np.random.default_rng(seed)
    drawn = episodes.drawn("strings", *rng.integers(2**31, size=(2, 100)))
    slacks = np.concatenate([np.repeat(_extremes(), 8, axis=0), drawn])
    kwargs = {"random": seed, "control_timestep": control_timestep, "time_limit": 60 * control_timestep}
    player = Player(rng, suite.load_batch("strings", "features", len(slacks), kwargs), slacks)
    assert not any(values.any() for values in player.first.values())
    for _ in range(50):
        seen, pulled, away = player.step()
        np.testing.assert_array_equal(seen["pulled"], pulled)
        np.testing.assert_array_equal(seen["clamped"], player.clamped[:, None] == np.arange(3))
        np.testing.assert_array_equal(seen["away"], away)


@pytest.mark.parametrize("domain_name, task_name", TASKS)
def test_observations_tell_nothing_but_what_is_pulled_clamped_and_away(seed, domain_name, task_name):
    """Observations follow from these three, for all slacks and all histories."""
    rng = np.random.default_rng(seed)
    slacks = np.repeat(
        _extremes(), 12, axis=0
    )  # So many that each of the 31 is seen but in one run of a hundred million.
    player = Player(rng, suite.load_batch(domain_name, task_name, len(slacks), {"random": seed}), slacks)
    followed = episodes.Followed()
    for _ in range(19):
        observation, pulled, away = player.step()
        followed.add(map(tuple, np.column_stack([pulled, away, player.clamped])), observation)
    # Nothing pulled, with each clamp or none: 4. Each pulled without a clamp, and others with it or not: 3 * 4; clamped
    # itself: 3; or past another's clamp, and the third with it or not: 3 * 2 * 2.
    assert followed.num_different() == 4 + 12 + 3 + 12


def test_graphs_follow_the_prior_and_slacks_are_within_their_range(seed):
    """Each graph's share of 100 000 episodes is what its probability makes likely."""
    count = 100_000
    for difficulty in (1, 2, 3.5):
        slacks = episodes.drawn("strings", np.full(count, seed), np.arange(count), difficulty=difficulty)
        graphs = suite.load_task("strings", "features").answers(slacks)
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
