"""A pixel task observes one image: the state as MuJoCo draws it, with every block where it is."""

import itertools

from episodes import SEED
from images import (
    CORNERS,
    EDGE,
    HEAVIER,
    MARKS,
    SEPARATE,
    WHOLE,
    box_of,
    corners_of_blocks,
    image_of,
    load_shared,
    load_single,
    mask_of_block,
    model_of,
    poses_at_rest,
    poses_of,
    project,
)
import numpy as np
import pytest
from scipy import spatial

from physexp import suite
from physexp.suite.parts import tower

import mujoco  # isort: skip  # The suite chooses the GL backend, which mujoco looks at once.

pytestmark = MARKS


@pytest.mark.parametrize("task_name, patterns", [("direct_pixels", [SEPARATE, 6]), ("fist_pixels", [5, WHOLE])])
def test_an_image_of_a_touched_tower_is_what_mujoco_draws_of_the_state(task_name, patterns):
    """Pattern by pattern, though one renderer draws them all, with a renderer of mujoco's own for the pattern."""
    env = load_shared("towers", task_name, SEED)
    for pattern in patterns:
        first = image_of(env.reset(hidden=pattern))
        for _ in range(7):  # The fist has hit the tower, 0.17 m away, after two; the lowest block is pushed.
            image = image_of(env.step(0))
        assert (image != first).any()
        renderer = mujoco.Renderer(env.physics.model.ptr, EDGE, EDGE)
        renderer.update_scene(env.physics.data.ptr, camera="observer")
        for effect in ("SHADOW", "REFLECTION", "SKYBOX", "HAZE"):
            renderer.scene.flags[getattr(mujoco.mjtRndFlag, f"mjRND_{effect}")] = False
        expected = renderer.render()
        renderer.close()
        np.testing.assert_array_equal(image, expected, err_msg=str(tower.PATTERNS[pattern]))


def test_blocks_are_drawn_where_they_are(load, seed):
    """From the camera's pose and field of view alone; nothing hides a block on its rail."""
    rng = np.random.default_rng(seed)
    model = model_of(*HEAVIER)
    batch = load(*HEAVIER, seed, 8)
    images, poses = image_of(batch.reset()), [np.repeat(value, 8, axis=0) for value in poses_at_rest(model)]
    for t in range(12):
        projected = project(model, corners_of_blocks(model, *poses))
        for i, number in itertools.product(range(8), range(4)):
            expected = np.concatenate([projected[i, number].min(axis=0), projected[i, number].max(axis=0)])
            # A pixel is drawn where its centre is covered, which is half a pixel from its edges.
            np.testing.assert_allclose(
                box_of(mask_of_block(images[i], number)), expected, rtol=0, atol=0.6, err_msg=f"step {t}"
            )
        images, poses = image_of(batch.step(rng.integers(4, size=8))), poses_of(batch, range(8))


@pytest.mark.parametrize("domain_name, task_name", suite.tagged("pixels"))
def test_the_front_of_every_block_is_seen_at_first(domain_name, task_name):
    model = model_of(domain_name, task_name)
    image = image_of(load_single(domain_name, task_name).reset())
    front = CORNERS[:, 1] < 0
    for number, corners in enumerate(corners_of_blocks(model, *poses_at_rest(model))[0]):
        area = spatial.ConvexHull(project(model, corners[front])).volume  # In the plane that is the area.
        assert area > 20, "a block of fewer pixels can hardly be told from its neighbour"
        mask = mask_of_block(image, number)
        # The outline's pixels may go either way: one in ten of the whole for the largest front, more for smaller ones.
        assert mask.sum() > area - 2 * np.sqrt(area)
        columns, rows = np.moveaxis(project(model, corners), -1, 0)
        left, top, right, bottom = box_of(mask)
        assert left > columns.min() - 0.6 and right < columns.max() + 0.6
        assert top > rows.min() - 0.6 and bottom < rows.max() + 0.6
