"""The blocks and the fist stay in view under all actions."""

from images import (
    CORNERS,
    EDGE,
    HEAVIER,
    MARKS,
    SEPARATE,
    WHOLE,
    batch_of_patterns,
    corners_of_blocks,
    model_of,
    poses_of,
    project,
)
import numpy as np
import pytest

pytestmark = MARKS


def _assert_in_view(model, points, message="", margin=0.0):
    seen = project(model, points).reshape(-1, 2)
    in_view = (seen.min() >= -margin) & (seen.max() <= EDGE + margin)
    assert in_view, (message, seen.min(axis=0), seen.max(axis=0))


@pytest.mark.parametrize("difficulty", [1, 1e300])
def test_blocks_on_their_rails_stay_in_view(load, seed, difficulty):
    """However long a poke is held: all the lightest blocks, too, up to the ends of their rails."""
    rng = np.random.default_rng(seed)
    model = model_of(*HEAVIER)
    batch = load(*HEAVIER, seed, 24, difficulty=difficulty)
    batch.reset()
    actions, holds = np.zeros(24, int), np.repeat([1, 3, 8, 60], 6)
    highest = 0.0
    for t in range(60):
        actions = np.where(t % holds == 0, rng.integers(4, size=24), actions)
        batch.step(actions)
        corners = corners_of_blocks(model, *poses_of(batch, range(24)))
        highest = max(highest, corners[..., 2].max())
        _assert_in_view(model, corners, f"step {t}")
    assert highest > 0.1 + 0.4, "no block reached the end of its rail"


def _pushes_of_towers(rng) -> np.ndarray:
    """Whole episodes of pushes [N, 26]: each push held, each block into each corner of the room, and random ones."""
    held = np.repeat(np.arange(20)[:, None], 26, axis=1)
    corners = [[4 * k + (x, y)[t % 2] for t in range(26)] for k in range(5) for x in (0, 1) for y in (2, 3)]
    return np.concatenate([held, corners, rng.integers(20, size=(24, 26))])


def _blows_of_the_fist(rng) -> np.ndarray:
    """Whole episodes of the fist [N, 26]: each direction held, and random ones held for one to four steps."""
    held = np.repeat(np.arange(4)[:, None], 26, axis=1)
    return np.concatenate([held, *(np.repeat(rng.integers(4, size=(14, 26)), n, axis=1)[:, :26] for n in (1, 2, 3, 4))])


@pytest.mark.parametrize("task_name, plan", [("direct_pixels", _pushes_of_towers), ("fist_pixels", _blows_of_the_fist)])
def test_the_blocks_of_a_tower_and_the_fist_stay_in_view(seed, task_name, plan):
    model = model_of("towers", task_name)
    plans = plan(np.random.default_rng(seed))
    patterns = np.resize([SEPARATE, WHOLE, 6], len(plans))
    batch, chosen, _ = batch_of_patterns(task_name, patterns)
    farthest = 0.0
    for t, actions in enumerate(plans.T):
        batch.step(actions, chosen)
        poses = poses_of(batch, chosen)
        corners = corners_of_blocks(model, *poses)
        farthest = max(farthest, np.abs(corners[..., :2]).max())
        _assert_in_view(model, corners, f"step {t}", margin=1)  # A wall gives way a little to what hits it.
        if task_name == "fist_pixels":  # The corners of the cube around it are farther out than the fist.
            fist = poses[0][:, model.geom("fist/geom").id]
            _assert_in_view(model, fist[:, None] + 2 * CORNERS, f"fist in step {t}")
    assert farthest > 0.55, "nothing came near a wall"
