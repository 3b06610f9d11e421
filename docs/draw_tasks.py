"""Draws docs/tasks.png: an episode of each task, as the camera sees it."""

from pathlib import Path

import numpy as np
from PIL import Image

from physexp import suite  # Before mujoco, for which it chooses the GL backend.

import mujoco  # isort: skip

EPISODES = (
    ("which_is_heavier", "features", [0, 1, 2, 3, 0, 0, 0]),
    ("towers", "direct_features", [6, 12, 0, 16, 4, 9, 14]),  # Pushes, block by block.
    ("towers", "fist_features", [0] * 7),  # Along +x, into the tower.
)
SIZE = 252


def frames(domain: str, task: str, actions: list[int]) -> np.ndarray:
    """The first image of an episode and those after each action, side by side."""
    environment = suite.load(domain, task, task_kwargs={"random": 3})
    environment.reset()
    while domain == "towers" and environment.task.correct_answer != 2:  # Three bodies: some glue, not all.
        environment.reset()
    renderer = mujoco.Renderer(environment.physics.model.ptr, SIZE, SIZE)
    images = []
    for action in [None, *actions]:
        if action is not None:
            environment.step(action)
        renderer.update_scene(environment.physics.data.ptr, camera="observer")
        images.append(np.pad(renderer.render(), ((2, 2), (2, 2), (0, 0)), constant_values=255))
    renderer.close()
    return np.concatenate(images, axis=1)


if __name__ == "__main__":
    rows = np.concatenate([frames(*episode) for episode in EPISODES])
    Image.fromarray(rows).quantize(128).save(Path(__file__).with_name("tasks.png"), optimize=True)
