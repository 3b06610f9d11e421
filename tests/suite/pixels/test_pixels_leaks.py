"""Images tell nothing of the hidden property before a touch."""

import dm_env
from episodes import EVERY_PATTERN, plans_that_miss
from images import (
    FIST,
    HEAVIER,
    MARKS,
    SHAPE,
    batch_of_patterns,
    corners_of_blocks,
    image_of,
    load_single,
    model_of,
    poses_at_rest,
    poses_of,
    project,
)
import numpy as np
import pytest

pytestmark = MARKS


@pytest.mark.parametrize(
    "control_timestep, step_limit, patterns, num_random",
    [(0.1, 26, EVERY_PATTERN, 2), (0.01, 260, np.array([0, 6, 15]), 0)],
    ids=["0.1 s", "0.01 s"],
)
def test_images_of_an_untouched_tower_are_the_same_for_every_glue(
    seed, control_timestep, step_limit, patterns, num_random
):
    plans = plans_that_miss(np.random.default_rng(seed), step_limit, control_timestep, num_random)
    size = len(patterns)
    batch, chosen, first = batch_of_patterns("fist_pixels", np.tile(patterns, len(plans)), control_timestep)
    model = model_of(*FIST)
    fist = model.geom("fist/geom").id
    columns = project(model, corners_of_blocks(model, *poses_at_rest(model))[0])[..., 0]
    tower_columns = slice(int(columns.min()), int(columns.max()) + 1)
    leaks = []
    for t in range(step_limit):
        steps = batch.step(np.repeat(plans[:, t], size), chosen)
        assert poses_of(batch, chosen)[0][:, fist, 0].max() < -0.3, "the fist must keep away from the tower"
        images = image_of(steps).reshape(len(plans), size, *SHAPE)
        if images.tobytes() != np.repeat(images[:, :1], size, axis=1).tobytes():
            leaks.append((t, "glue"))
        if (images[..., tower_columns, :] != first[0, :, tower_columns]).any():
            leaks.append((t, "moved"))
    assert (steps.step_type == dm_env.StepType.LAST).all(), "the episodes were not played to their end"
    assert len({image.tobytes() for image in images[:3, 0]} | {first[0].tobytes()}) == 4, "the fist is not to be seen"
    assert not leaks, f"{len(leaks)} leaks (control step, what), the first: {leaks[:4]}"


def test_a_poked_block_tells_nothing_of_the_others_which_stay_as_they_were():
    """Masses, in [0, 1], are given to the blocks in turn: 0.4 or 1 to the poked one, 0 or 1 to the others."""
    model = model_of(*HEAVIER)
    env = load_single(*HEAVIER)
    first = image_of(env.reset())
    columns = project(model, corners_of_blocks(model, *poses_at_rest(model))[0])[..., 0]

    def play(poked, mass, others):
        masses = np.full(4, others)
        masses[poked] = mass
        env.reset(hidden=masses)
        return np.stack([image_of(env.step(poked)) for _ in range(10)])

    for poked in range(4):
        light, heavy = play(poked, 0.4, 0.0), play(poked, 0.4, 1.0)
        assert light.tobytes() == heavy.tobytes()
        assert (light[0] != first).any() and (light[0] != play(poked, 1.0, 0.0)[0]).any()
        for other in {0, 1, 2, 3} - {poked}:
            seen = slice(int(columns[other].min()), int(columns[other].max()) + 1)
            assert (light[:, :, seen] == first[:, seen]).all()
