"""Balance: the beam tilts to the heavier pan whatever was there before, and nothing else can be read."""

import chance
import episodes
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import balance

TASKS = [("balance", "features"), ("balance", "pixels")]
SIDES = np.array(list(balance.PLACES.values()))


def _hardest() -> np.ndarray:
    """The weights of each label with the least and the greatest difference, kg [24, 6]."""
    weights = np.full((2, 2, balance.NUM_BLOCKS, balance.NUM_BLOCKS), balance.WEIGHT)
    for i, difference in enumerate(balance.DIFFERENCES):
        for j, sign in enumerate((1, -1)):
            weights[i, j] += sign * difference * balance.WEIGHT * np.eye(balance.NUM_BLOCKS)
    return weights.reshape(-1, balance.NUM_BLOCKS)


def _placings(rng, count: int) -> np.ndarray:
    """Random interactions of which most lay a block on a pan, so that pans are often equally full, int [count]."""
    places = rng.choice(len(SIDES), size=count, p=[0.1, 0.45, 0.45])
    return len(SIDES) * rng.integers(balance.NUM_BLOCKS, size=count) + places


@pytest.mark.parametrize("control_timestep, time_limit", [(0.1, 4.0), (0.08, 8.0), (0.2, 8.0)])
def test_the_beam_tilts_to_the_heavier_pan_whatever_was_there_before(seed, control_timestep, time_limit):
    rng = np.random.default_rng(seed)
    drawn = episodes.drawn("balance", *rng.integers(2**31, size=(2, 72)))
    weights = np.concatenate([np.tile(_hardest(), (3, 1)), drawn])
    kwargs = {"random": seed, "control_timestep": control_timestep, "time_limit": time_limit}
    batch = suite.load_batch("balance", "features", len(weights), kwargs)
    first = batch.reset(hidden=weights).observation
    assert not first["places"].any() and not first["tilt"].any()
    places = np.zeros_like(weights)
    tilts = set()
    for _ in range(batch.task.rules.step_limit - 1):
        actions = _placings(rng, len(weights))
        seen = batch.step(actions).observation
        places[np.arange(len(weights)), actions // 3] = SIDES[actions % 3]
        surplus = (places * weights).sum(axis=1)
        np.testing.assert_array_equal(seen["places"], places)
        np.testing.assert_array_equal(seen["tilt"][:, 0], np.sign(np.where(np.abs(surplus) < 1e-9, 0, surplus)))
        tilts |= set(seen["tilt"][places.sum(axis=1) == 0, 0])
    assert tilts == {-1, 0, 1}


@pytest.mark.parametrize("domain_name, task_name", TASKS)
def test_observations_tell_nothing_but_places_and_tilt(seed, domain_name, task_name):
    """Observations follow from these two, for all weights and all histories."""
    rng = np.random.default_rng(seed)
    weights = np.tile(_hardest(), (2, 1))
    batch = suite.load_batch(domain_name, task_name, len(weights), {"random": seed})
    batch.reset(hidden=weights)
    places, followed = np.zeros(weights.shape, int), episodes.Followed()
    for _ in range(batch.task.rules.step_limit - 1):
        actions = _placings(rng, len(weights))
        observation = batch.step(actions).observation
        places[np.arange(len(weights)), actions // 3] = SIDES[actions % 3]
        surplus = (places * weights).sum(axis=1)
        tilts = np.sign(np.where(np.abs(surplus) < 1e-9, 0, surplus))
        followed.add(map(tuple, np.column_stack([places, tilts])), observation)
    assert followed.num_different() > 200


def test_labels_are_equally_likely_and_differences_within_their_range(seed):
    """Each label's share of 100 000 episodes is what its probability makes likely."""
    count = 100_000
    for difficulty in (1, 2, 3):
        weights = episodes.drawn("balance", np.full(count, seed), np.arange(count), difficulty=difficulty)
        labels = suite.load_task("balance", "features").answers(weights)
        suspects = 7 - difficulty
        expected = np.where(np.arange(12) < 2 * suspects, 1 / (2 * suspects), 0)
        chance.assert_drawn(np.bincount(labels, minlength=12), expected)
        differences = weights[np.arange(count), labels // 2] - balance.WEIGHT
        assert ((differences < 0) == (labels % 2 == 1)).all()
        least, greatest = balance.DIFFERENCES
        assert least <= np.abs(differences).min() < least + 0.001 and greatest - 0.001 < np.abs(differences).max()
        assert ((weights != balance.WEIGHT).sum(axis=1) == 1).all()


def test_blocks_that_are_known_to_be_like_the_others_are_grey():
    grey = {}
    for difficulty in (1, 2, 3):
        environment = suite.load("balance", "features", {"difficulty": difficulty})
        model = environment.physics.model
        colours = [tuple(model.geom(f"block_{k}/geom").rgba.round(3)) for k in range(balance.NUM_BLOCKS)]
        grey[difficulty] = [colour == tuple(np.round(model.geom("left_pan").rgba, 3)) for colour in colours]
    assert {difficulty: sum(are) for difficulty, are in grey.items()} == {1: 0, 2: 1, 3: 2}
    assert grey[3][-2:] == [True, True]
