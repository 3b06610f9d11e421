"""Balance: the beam tilts to the heavier pan whatever was there before, and nothing else can be read."""

import itertools

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
    """Plays laying blocks, mostly on pans, which are often equally full; with a latch, half of the actions release it.

    Yields whether beams are free, [N], places, [N, 6], tilts, [N], and what is observed.
    """
    places, latch = np.zeros(weights.shape, int), batch.task.options.latch
    release = len(SIDES) * balance.NUM_BLOCKS

    def draw():
        chosen = rng.choice(len(SIDES), size=len(weights), p=[0.1, 0.45, 0.45])
        placings = len(SIDES) * rng.integers(balance.NUM_BLOCKS, size=len(weights)) + chosen
        return np.where(rng.random(len(weights)) < 0.5 * latch, release, placings)

    for actions, seen in episodes.play(rng, batch, weights, draw):
        (rows,) = (actions < release).nonzero()
        places[rows, actions[rows] // 3] = SIDES[actions[rows] % 3]
        surplus = (places * weights).sum(axis=1)
        is_free = (actions == release) | (not latch)
        yield is_free, places, np.sign(np.where(is_free & (np.abs(surplus) > 1e-9), surplus, 0)), seen


@pytest.mark.parametrize(
    "control_timestep, time_limit, latch", [(0.1, 4.0, False), (0.08, 8.0, False), (0.2, 8.0, False), (0.1, 6.0, True)]
)
def test_the_beam_tilts_to_the_heavier_pan_whatever_was_there_before(seed, control_timestep, time_limit, latch):
    rng = np.random.default_rng(seed)
    drawn = episodes.drawn("balance", *rng.integers(2**31, size=(2, 72)))
    weights = np.concatenate([np.tile(_hardest(), (3, 1)), drawn])
    kwargs = {"random": seed, "control_timestep": control_timestep, "time_limit": time_limit, "latch": latch}
    batch = suite.load_batch("balance", "features", len(weights), kwargs)
    assert not any(values.any() for values in batch.reset(hidden=weights).observation.values())
    where_equally_full = set()
    for is_free, places, tilts, seen in _play(rng, batch, weights):
        np.testing.assert_array_equal(seen["places"], places)
        np.testing.assert_array_equal(seen["tilt"][:, 0], tilts)
        if latch:
            np.testing.assert_array_equal(seen["released"][:, 0], is_free)
        where_equally_full |= set(tilts[is_free & (places.sum(axis=1) == 0)])
    assert where_equally_full == {-1, 0, 1}


@pytest.mark.parametrize("latch", [False, True])
@episodes.features_and_pixels
def test_observations_tell_nothing_but_places_tilt_and_release(seed, task, latch):
    """Observations follow from these three, for all weights and all histories."""
    weights = np.tile(_hardest(), (2, 1))
    batch = suite.load_batch("balance", task, len(weights), {"random": seed, "latch": latch})
    followed = episodes.Followed()
    for is_free, places, tilts, observation in _play(np.random.default_rng(seed), batch, weights):
        followed.add(map(tuple, np.column_stack([is_free, places, tilts])), observation)
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


def test_three_of_ten_questions_and_their_negations_are_held_out():
    every, train, held_out = (
        {frozenset(np.flatnonzero(table)) for table in balance.question_sets()[name]}
        for name in ("all", "train", "held_out")
    )
    assert every == set(map(frozenset, itertools.combinations(range(6), 3)))
    assert train | held_out == every and not train & held_out and len(held_out) == 6
    for question in every:  # A question and its negation are on the same side.
        assert (question in train) == (frozenset(range(6)) - question in train)
    # Any two blocks stay together in some that are not.
    assert all(
        sum(pair < question for question in train) >= 2 for pair in map(set, itertools.combinations(range(6), 2))
    )


def test_a_question_is_drawn_and_told_and_changes_nothing_else(seed):
    hidden, answers = episodes.drawn_with_answers("balance", seed, questions="held_out")
    weights = episodes.drawn("balance", np.full(len(hidden), seed), np.arange(len(hidden)))
    np.testing.assert_array_equal(hidden[:, :6], weights)
    tables, odd = balance.question_sets()["held_out"], np.abs(weights - balance.WEIGHT).argmax(axis=1)
    numbers = hidden[:, 6].astype(int)
    chance.assert_drawn(np.bincount(6 * odd + numbers, minlength=36), np.full(36, 1 / 36))
    np.testing.assert_array_equal(answers, tables[numbers, odd])
    batch = suite.load_batch("balance", "features", 50, {"questions": "held_out", "random": seed})
    batch.reset(hidden=hidden[:50])
    seen = batch.step(np.zeros(50, int))
    np.testing.assert_array_equal(seen.observation["question"], tables[numbers[:50]])
    np.testing.assert_array_equal(batch.step(18 + answers[:50]).reward, np.ones(50))


def test_lamps_show_the_question_and_images_tell_nothing_else_of_it(seed):
    """All 20 questions, after each of three placings that tell nothing: images follow from these two alone."""
    weights = episodes.drawn("balance", np.full(40, seed), np.arange(40))
    hidden = np.hstack([weights, np.tile(np.arange(20), 2)[:, None]])
    batch = suite.load_batch("balance", "pixels", 40, {"questions": "all", "random": seed})
    followed, seen = episodes.Followed(), batch.reset(hidden=hidden).observation
    for number, action in enumerate((2, 5, 8, None)):  # Blocks 0, 1 and 2 on the right pan.
        followed.add([(question, number) for question in hidden[:, 6]], seen)
        if action is not None:
            seen = batch.step(np.full(40, action)).observation
    assert followed.num_different() == 4 * 20
