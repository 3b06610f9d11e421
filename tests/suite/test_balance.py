"""Balance: the beam tilts to the heavier pan whatever was there before, and nothing else can be read."""

import chance
import episodes
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import balance

SIDES = np.array(list(balance.PLACES.values()))


def _hardest() -> np.ndarray:
    """The weights of each label with the least and the greatest difference, kg [24, 6]."""
    weights = np.full((2, 2, balance.NUM_BLOCKS, balance.NUM_BLOCKS), balance.WEIGHT)
    for i, difference in enumerate(balance.DIFFERENCES):
        for j, sign in enumerate((1, -1)):
            weights[i, j] += sign * difference * balance.WEIGHT * np.eye(balance.NUM_BLOCKS)
    return weights.reshape(-1, balance.NUM_BLOCKS)


def _play(rng, batch, weights):
    """Plays laying blocks, mostly on pans, which are often equally full; yields places, tilts, and what is observed."""
    places = np.zeros(weights.shape, int)

    def draw():
        chosen = rng.choice(len(SIDES), size=len(weights), p=[0.1, 0.45, 0.45])
        return len(SIDES) * rng.integers(balance.NUM_BLOCKS, size=len(weights)) + chosen

    for actions, seen in episodes.play(rng, batch, weights, draw):
        places[np.arange(len(weights)), actions // 3] = SIDES[actions % 3]
        surplus = (places * weights).sum(axis=1)
        yield places, np.sign(np.where(np.abs(surplus) < 1e-9, 0, surplus)), seen


@pytest.mark.parametrize("control_timestep, time_limit", [(0.1, 4.0), (0.08, 8.0), (0.2, 8.0)])
def test_the_beam_tilts_to_the_heavier_pan_whatever_was_there_before(seed, control_timestep, time_limit):
    rng = np.random.default_rng(seed)
    drawn = episodes.drawn("balance", *rng.integers(2**31, size=(2, 72)))
    weights = np.concatenate([np.tile(_hardest(), (3, 1)), drawn])
    kwargs = {"random": seed, "control_timestep": control_timestep, "time_limit": time_limit}
    batch = suite.load_batch("balance", "features", len(weights), kwargs)
    first = batch.reset(hidden=weights).observation
    assert not first["places"].any() and not first["tilt"].any()
    where_equally_full = set()
    for places, tilts, seen in _play(rng, batch, weights):
        np.testing.assert_array_equal(seen["places"], places)
        np.testing.assert_array_equal(seen["tilt"][:, 0], tilts)
        where_equally_full |= set(tilts[places.sum(axis=1) == 0])
    assert where_equally_full == {-1, 0, 1}


@episodes.features_and_pixels
def test_observations_tell_nothing_but_places_and_tilt(seed, task):
    """Observations follow from these two, for all weights and all histories."""
    weights = np.tile(_hardest(), (2, 1))
    batch = suite.load_batch("balance", task, len(weights), {"random": seed})
    followed = episodes.Followed()
    for places, tilts, observation in _play(np.random.default_rng(seed), batch, weights):
        followed.add(map(tuple, np.column_stack([places, tilts])), observation)
    assert followed.num_different() > 200


@pytest.mark.parametrize("difficulty", [1, 2, 3])
def test_labels_are_equally_likely_and_differences_within_their_range(seed, difficulty):
    weights, labels = episodes.drawn_with_answers("balance", seed, difficulty=difficulty)
    suspects = 7 - difficulty
    expected = np.where(np.arange(12) < 2 * suspects, 1 / (2 * suspects), 0)
    chance.assert_drawn(np.bincount(labels, minlength=12), expected)
    differences = weights[np.arange(len(labels)), labels // 2] - balance.WEIGHT
    assert ((differences < 0) == (labels % 2 == 1)).all()
    least, greatest = balance.DIFFERENCES
    assert least <= np.abs(differences).min() < least + 0.001 and greatest - 0.001 < np.abs(differences).max()
    assert ((weights != balance.WEIGHT).sum(axis=1) == 1).all()


@pytest.mark.parametrize("difficulty", [1, 2, 3])
def test_blocks_that_are_known_to_be_like_the_others_are_grey(difficulty):
    model = suite.load_task("balance", "features", {"difficulty": difficulty}).build_apparatus(0).model
    pan = model.geom("left_pan").rgba.round(3).tolist()
    grey = [model.geom(f"block_{k}/geom").rgba.round(3).tolist() == pan for k in range(balance.NUM_BLOCKS)]
    assert grey == [False] * (7 - difficulty) + [True] * (difficulty - 1)
