"""Shared by tests of images: environments that are built once, and the places of things in an image."""

import functools
import itertools
import re

from episodes import SEED
import numpy as np
import pytest

from physexp import suite
from physexp.suite.engine import snapshots
from physexp.suite.parts import things

import mujoco  # isort: skip  # The suite chooses the GL backend, which mujoco looks at once.

HEAVIER, FIST = ("which_is_heavier", "pixels"), ("towers", "fist_pixels")
# One compiled model and many, contacts, and geoms that indicate readings: all that drawing knows.
PIXEL_TASKS = [HEAVIER, FIST, ("sealed_box", "pixels")]
every_pixel_task = pytest.mark.parametrize("domain_name, task_name", PIXEL_TASKS)
MARKS = [
    pytest.mark.usefixtures("seed"),
    pytest.mark.filterwarnings("ignore:PIXELS ARE DRAWN BY THE PROCESSOR"),  # Tested elsewhere.
]

EDGE = 84  # pixels, of an image
SHAPE = (EDGE, EDGE, 3)
CORNERS = np.array(list(itertools.product((-0.05, 0.05), repeat=3)))  # m, of a cube, from its centre
SEPARATE, WHOLE = 0, 15


@functools.cache
def load_shared(domain_name, task_name, random, size=None):
    """An environment, or a batch, that tests use in turn: building sixteen towers takes a second."""
    task = suite.load_task(domain_name, task_name, {"random": random})
    return suite.Environment(task) if size is None else suite.BatchEnvironment(task, size)


def load_single(domain_name, task_name, number=0):
    """The environment that is one of the batch's, about to start its first episode."""
    single = load_shared(domain_name, task_name, suite.environment_seed(SEED, number))
    single.task.next_episode = 0
    return single


def image_of(step) -> np.ndarray:
    return step.observation["pixels"]


# Patterns of glue.


def batch_of_patterns(task_name, patterns):
    """A batch whose first environments start with `patterns`, their indices, and their first images."""
    batch, chosen = load_shared("towers", task_name, SEED, 80), np.arange(len(patterns))
    return batch, chosen, image_of(batch.reset(chosen, hidden=np.asarray(patterns)))


# Poses of things, and their places in an image.


def model_of(domain_name, task_name):
    """The compiled model of a task: of the separate cubes, for towers."""
    return suite.load_task(domain_name, task_name).build_apparatus(0).model


def block_geoms(model) -> list[int]:
    """Geoms of the blocks, in order."""
    found = [(re.search(r"block_(\d)", model.geom(i).name), i) for i in range(model.ngeom)]
    return [i for _, i in sorted((match[1], i) for match, i in found if match)]


def poses_at_rest(model):
    """Positions [1, G, 3] and rotation matrices [1, G, 3, 3] of all geoms in the initial state."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data.geom_xpos[None].copy(), data.geom_xmat.reshape(1, -1, 3, 3).copy()


def poses_of(batch, chosen):
    """Positions [N, G, 3] and rotation matrices [N, G, 3, 3] of all geoms of some environments after a step."""
    poses = {"geom_xpos": [], "geom_xmat": []}
    for i in chosen:
        for field, values in poses.items():
            values.append(snapshots.view(batch, field, int(i)).copy())
    positions = np.stack(poses["geom_xpos"])
    return positions, np.stack(poses["geom_xmat"]).reshape(*positions.shape[:2], 3, 3)


def corners_of_blocks(model, positions, rotations) -> np.ndarray:
    """Corners of the blocks, [B, number of blocks, 8, 3], m, from the poses of all geoms."""
    geoms = block_geoms(model)
    return positions[:, geoms, None] + np.einsum("bkij,cj->bkci", rotations[:, geoms], CORNERS)


def project(model, points) -> np.ndarray:
    """Column and row [..., 2] at which the camera sees points [..., 3]: 0, 0 is the image's upper left corner."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    camera = model.camera("observer").id
    # In the camera's frame x is to the right and y up, and it looks along -z.
    seen = (np.asarray(points) - data.cam_xpos[camera]) @ data.cam_xmat[camera].reshape(3, 3)
    half_height = -seen[..., 2:] * np.tan(np.radians(model.cam_fovy[camera]) / 2)
    return EDGE / 2 * (1 + seen[..., :2] / half_height * [1, -1])


def mask_of_block(image, number: int) -> np.ndarray:
    """Pixels of a block, bool [84, 84]: light that is white changes how bright a colour is, not the colour."""
    colors = np.array([*(color[:3] for color in things.COLORS), (1, 1, 1)])  # White is all that is grey.
    directions = colors / np.linalg.norm(colors, axis=1, keepdims=True)
    return (image.astype(float) @ directions.T).argmax(axis=-1) == number


def box_of(mask) -> np.ndarray:
    """The first column and row, and those after the last, of a mask."""
    assert mask.any(), "not to be seen"
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return np.array([columns[0], rows[0], columns[-1] + 1, rows[-1] + 1])
