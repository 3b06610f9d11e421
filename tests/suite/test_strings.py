"""Strings: a pull moves what bands join to the pulled puck past no clamp, and nothing else can be read."""

import itertools
import math

import chance
import episodes
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import strings

LEAST, GREATEST = strings.SLACKS[3]


def _bands(pucks: int) -> list[tuple[int, int]]:
    return list(itertools.combinations(range(pucks), 2))


def _extremes(rng, pucks: int) -> np.ndarray:
    """Graphs with bands of the least and the greatest slack, m [135, bands]; with three pucks, all of them."""
    every = np.array(list(itertools.product((0.0, *strings.SLACKS[pucks]), repeat=len(_bands(pucks)))))
    return rng.permutation(np.tile(every, (5, 1)))[:135] if pucks > 3 else np.tile(every, (5, 1))


def _moved(slacks: np.ndarray, clamped: set[int], pulled: int, pucks: int) -> np.ndarray:
    """Which pucks a pull moves, bool [pucks], by a power of the matrix of joints, without the clamped pucks."""
    joined = np.eye(pucks)
    for slack, (i, j) in zip(slacks, _bands(pucks), strict=True):
        joined[i, j] = joined[j, i] = slack > 0
    held = list(clamped)
    joined[held], joined[:, held] = 0, 0
    return np.linalg.matrix_power(joined, pucks - 1)[pulled] > 0


def _move(clamped: set[int], puck: int, clamps: int) -> set[int]:
    """The pucks that are clamped after a clamp of one is wanted: the only clamp moves, and a third is not put on."""
    if puck in clamped or len(clamped) < clamps:
        return clamped ^ {puck}
    return {puck} if clamps == 1 else clamped


def _play(rng, batch, slacks):
    """Plays; yields the pucks that are pulled, clamped and should be away, bool [N, pucks] each, and observations."""
    pucks, clamps = batch.task.options.num_pucks, batch.task.options.num_clamps
    held = [set[int]() for _ in slacks]
    for actions, seen in episodes.play(rng, batch, slacks):
        held = [_move(old, a - pucks, clamps) if a >= pucks else old for old, a in zip(held, actions, strict=True)]
        away = [
            _moved(bands, clamped, a, pucks) if a < pucks else np.zeros(pucks, bool)
            for bands, clamped, a in zip(slacks, held, actions, strict=True)
        ]
        clamped = [[k in old for k in range(pucks)] for old in held]
        yield actions[:, None] == np.arange(pucks), np.array(clamped), np.array(away), seen


@pytest.mark.parametrize(
    "pucks, clamps, control_timestep", [(3, 1, 0.1), (3, 1, 0.11), (3, 1, 0.25), (3, 2, 0.1), (4, 2, 0.1)]
)
def test_a_pull_moves_all_joined_pucks_past_no_clamp(seed, pucks, clamps, control_timestep):
    rng = np.random.default_rng(seed)
    kwargs = {"control_timestep": control_timestep, "num_pucks": pucks, "num_clamps": clamps}
    drawn = episodes.drawn("strings", *rng.integers(2**31, size=(2, 60)), **kwargs)
    slacks = np.concatenate([_extremes(rng, pucks), drawn])
    kwargs |= {"random": seed, "time_limit": 50 * control_timestep}
    batch = suite.load_batch("strings", "features", len(slacks), kwargs)
    assert not any(values.any() for values in batch.reset(hidden=slacks).observation.values())
    for *expected, seen in _play(rng, batch, slacks):
        for name, values in zip(("pulled", "clamped", "away"), expected, strict=True):
            np.testing.assert_array_equal(seen[name], values)


def test_a_clamp_catches_a_fast_puck():
    """It takes hold of puck 1 at 0.144 m/s; the greatest speed after clamps in many random episodes was 0.147 m/s."""
    slacks = np.array(
        [[0.0, 0.0052610297914879155, 0.0038269765469315055, 0.0033751730004974345, 0.0, 0.004590669765915968]]
    )
    batch = suite.load_batch("strings", "features", 1, {"random": 0, "num_pucks": 4, "num_clamps": 2})
    batch.reset(hidden=slacks)
    for action in (1, 7, 3, 2, 5, 4, 6, 5, 1, 1, 5, 0):  # The last ones: pulls 1 twice, clamps 1 beside 3, pulls 0.
        seen = batch.step(np.array([action])).observation
    assert batch.num_divergences == 0
    np.testing.assert_array_equal(seen["clamped"], [[0, 1, 0, 1]])
    np.testing.assert_array_equal(seen["away"], [[1, 0, 1, 0]])


@pytest.mark.parametrize("pucks, clamps", [(3, 1), (4, 2)])
@episodes.features_and_pixels
def test_observations_tell_nothing_but_what_is_pulled_clamped_and_away(seed, task, pucks, clamps):
    """Observations follow from these three, for all slacks and all histories."""
    rng = np.random.default_rng(seed)
    slacks = _extremes(rng, pucks)
    batch = suite.load_batch("strings", task, len(slacks), {"random": seed, "num_pucks": pucks, "num_clamps": clamps})
    followed = episodes.Followed()
    for *expected, observation in _play(rng, batch, slacks):
        followed.add(map(tuple, np.hstack(expected)), observation)
    # None is pulled, or a clamped puck, or a free one, with which each of the other free ones may move.
    frees = range(pucks - clamps, pucks + 1)
    possible = sum(math.comb(pucks, free) * (1 + pucks - free + free * 2 ** (free - 1)) for free in frees)
    assert 0.7 * possible < followed.num_different() <= possible


@pytest.mark.parametrize("difficulty, pucks", [(1, 3), (2, 3), (3.5, 3), (1, 4)])
def test_graphs_follow_the_prior_and_slacks_are_within_their_range(seed, difficulty, pucks):
    slacks, graphs = episodes.drawn_with_answers("strings", seed, difficulty=difficulty, num_pucks=pucks)
    pairs = len(_bands(pucks))
    bands = np.array([label.bit_count() for label in range(2**pairs)])
    expected = difficulty ** (pairs - bands) / (1 + difficulty) ** pairs
    np.testing.assert_allclose(strings.prior(difficulty, pucks), expected)
    chance.assert_drawn(np.bincount(graphs, minlength=2**pairs), expected)
    drawn, (least, greatest) = slacks[slacks > 0], strings.SLACKS[pucks]
    assert least <= drawn.min() < least + 1e-5 and greatest - 1e-5 < drawn.max() < greatest


def test_answers_are_named_after_the_pairs_that_are_joined():
    task = suite.load_task("strings", "features")
    assert task.label_names[0] == "none" and task.label_names[7] == "0-1, 0-2, 1-2"
    assert task.answers(np.array([[0, LEAST, 0], [LEAST, 0, GREATEST]])).tolist() == [2, 5]
    assert [task.label_names[label] for label in (2, 5)] == ["0-2", "0-1, 1-2"]
    assert task.reveal(np.array([0, 0, LEAST])).tied == [("puck_1", "puck_2")]
    assert task.reveal(np.zeros(3)).marks == {"puck_1": "no bands"}
