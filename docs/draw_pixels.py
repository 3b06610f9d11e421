"""Draws docs/pixels.png: an episode of each task in an agent's own images, enlarged."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from physexp import suite

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
SCALE = 3


def frames(domain: str, task: str, episode: int, actions: Sequence[int]) -> np.ndarray:
    """Returns the first image of an episode and those after each action, side by side."""
    environment = suite.load(domain, task, task_kwargs={"random": SEED})
    environment.task.next_episode = episode
    timesteps = [environment.reset(), *map(environment.step, actions)]
    environment.close()
    images = [step.observation["pixels"].repeat(SCALE, 0).repeat(SCALE, 1) for step in timesteps]
    frame = ((2, 2), (2, 2), (0, 0))
    return np.concatenate([np.pad(image, frame, constant_values=255) for image in images], axis=1)


if __name__ == "__main__":
    rows = np.concatenate([frames(*episode) for episode in EPISODES])
    Image.fromarray(rows).quantize(128).save(Path(__file__).with_name("pixels.png"), optimize=True)
