"""Images tell nothing of the hidden property before a touch."""

import dm_env
from episodes import EVERY_PATTERN, plans_that_miss
from images import (
    FIST,
    MARKS,
    SHAPE,
    batch_of_patterns,
    corners_of_blocks,
    image_of,
    model_of,
    poses_at_rest,
    poses_of,
    project,
)
import numpy as np

pytestmark = MARKS


def test_images_of_an_untouched_tower_are_the_same_for_every_glue(seed):
    step_limit, patterns = 26, EVERY_PATTERN
    plans = plans_that_miss(np.random.default_rng(seed), step_limit, 0.1, 2)
    size = len(patterns)
    batch, chosen, first = batch_of_patterns("fist_pixels", np.tile(patterns, len(plans)))
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
