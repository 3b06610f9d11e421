"""Draws docs/tasks.png, an episode of each task, and docs/pixels.png, the same in an agent's own images, enlarged."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from physexp import suite
from physexp.suite.engine import rendering

EPISODES = (
    ("which_is_heavier", "pixels", 0, [0, 1, 2, 3, 0, 0, 0]),
    (
        "towers",
        "direct_pixels",
        6,
        [6, 12, 0, 16, 4, 9, 14],
    ),  # Three bodies: some glue, not all. Pushed block by block.
    ("towers", "fist_pixels", 6, [0] * 7),  # Along +x, into the tower.
    ("threshold", "pixels", 2, [3, 5, 4, 1, 7, 0, 4]),
    ("balance", "pixels", 1, [1, 5, 7, 11, 3, 13, 6]),
    ("strings", "pixels", 3, [0, 3, 1, 4, 0, 5, 2]),
    ("sealed_box", "pixels", 2, [3, 4, 4, 0, 4, 2, 4]),
    ("strike", "pixels", 0, [1, 0, 2, 1, 0, 1, 2]),
    ("crush", "pixels", 6, [4, 8, 5, 6, 3, 7, 9]),
    ("lump", "pixels", 2, [1, 2, 1, 2, 2, 0, 2]),
)
"""Domain, task, index of the episode and actions of each row."""

SEED = 3
SIZE = 252


def frames(domain: str, task: str, episode: int, actions: Sequence[int], as_seen: bool) -> np.ndarray:
    """Returns the first image of an episode and those after each action, side by side."""
    environment = suite.load(domain, task, task_kwargs={"random": SEED})
    environment.task.next_episode = episode
    timestep, apparatus = environment.reset(), environment.task.apparatus
    renderer = rendering.Renderer(apparatus.model, apparatus.moving_geoms, size=SIZE)
    images = []
    for action in [None, *actions]:
        if action is not None:
            timestep = environment.step(action)
        if as_seen:
            image = timestep.observation["pixels"].repeat(SIZE // rendering.SIZE, 0).repeat(SIZE // rendering.SIZE, 1)
        else:
            data = environment.physics.data
            positions, image = data.geom_xpos[None].copy(), np.zeros((SIZE, SIZE, 3), np.uint8)
            apparatus.indicate(positions, data.sensordata[None])
            sizes = apparatus.sizes(data.sensordata[None])
            renderer.render(positions, data.geom_xmat[None], [0], image[None], sizes=sizes)
        images.append(np.pad(image, ((2, 2), (2, 2), (0, 0)), constant_values=255))
    renderer.close()
    environment.close()
    return np.concatenate(images, axis=1)


if __name__ == "__main__":
    for name, as_seen in (("tasks", False), ("pixels", True)):
        rows = np.concatenate([frames(*episode, as_seen) for episode in EPISODES])
        Image.fromarray(rows).quantize(128).save(Path(__file__).with_name(f"{name}.png"), optimize=True)
