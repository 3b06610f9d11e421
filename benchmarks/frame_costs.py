"""Measures the cost of each part of a frame, and of each choice of the scene, as ratios to the frame as it is.

    python benchmarks/frame_costs.py

Variants take turns, so that the noise of the machine meets all of them. LP_NUM_THREADS=2 in front of the command shows
what Mesa's own threads do to frames this small.
"""

from collections.abc import Callable
import functools
import statistics
import time

import numpy as np

from physexp import suite
from physexp.suite.engine import gl, rendering

import mujoco  # isort: skip

REPETITIONS, FRAMES = 7, 100


def apparatus(**visual):
    """The fist's scene, with attributes of its MJCF's visual/quality or visual/global changed."""
    task = suite.load_task("towers", "fist_features", {"random": 0})
    root = task.root_entity.mjcf_model
    for name, value in visual.items():
        if name == "floor":
            task.root_entity.floor.set_attributes(type=value, pos=[0, 0, -0.005])
        elif name == "skybox":
            root.asset.add(
                "texture",
                name="sky",
                type="skybox",
                builtin="gradient",
                rgb1=[0.4, 0.6, 0.8],
                rgb2=[0, 0, 0],
                width=128,
                height=128,
            )
        elif name == "lamp":
            root.find("light", "lamp").castshadow = value
        else:
            root.visual.quality.set_attributes(**{name: value})
    return task.build_apparatus(0)


def drawing(
    drawn, size=rendering.SIZE, buffer=rendering.SIZE, flags=(), num_geoms=None, read=True
) -> Callable[[], None]:
    """A function that draws a frame, and reads it back."""
    renderer = rendering.Renderer(drawn.model, drawn.moving_geoms, size=buffer)
    renderer.scene.ngeom = renderer.scene.ngeom if num_geoms is None else num_geoms
    for flag in flags:
        renderer.scene.flags[flag] = True
    image, rectangle = np.zeros((size, size, 3), np.uint8), mujoco.MjrRect(0, 0, size, size)

    def draw() -> None:
        with gl.current(renderer.context):
            for _ in range(FRAMES):
                mujoco.mjr_render(rectangle, renderer.scene, renderer.buffers)
                if read:
                    mujoco.mjr_readPixels(image, None, rectangle, renderer.buffers)
            if not read:  # Waits for the frames to be drawn.
                mujoco.mjr_readPixels(image, None, rectangle, renderer.buffers)

    return functools.partial(gl.draw, draw)


def main() -> None:
    """Prints the cost of each variant."""
    flag = mujoco.mjtRndFlag
    ours = apparatus()
    variants = {
        "as it is": drawing(ours),
        "without read-back": drawing(ours, read=False),
        "an empty scene (clear and read back)": drawing(ours, num_geoms=0),
        "the floor alone (fragments)": drawing(ours, num_geoms=1),
        "all geoms in 8 x 8 pixels (vertices and state)": drawing(ours, size=8),
        "off-screen buffer of 640 x 640": drawing(ours, buffer=640),
        "4 samples a pixel": drawing(apparatus(offsamples=4)),
        "8 samples a pixel": drawing(apparatus(offsamples=8)),
        "a plane as floor": drawing(apparatus(floor="plane")),
        "4 x 4 quads a box side": drawing(apparatus(numquads=4)),
        "28 slices a sphere": drawing(apparatus(numslices=28, numstacks=16)),
        "reflections": drawing(ours, flags=[flag.mjRND_REFLECTION]),
        "a skybox": drawing(apparatus(skybox=True), flags=[flag.mjRND_SKYBOX]),
        "a shadow, map of 1024": drawing(apparatus(lamp=True, shadowsize=1024), flags=[flag.mjRND_SHADOW]),
        "a shadow, map of 4096": drawing(apparatus(lamp=True, shadowsize=4096), flags=[flag.mjRND_SHADOW]),
    }
    costs: dict[str, list[float]] = {name: [] for name in variants}
    for repetition in range(REPETITIONS + 1):
        for name, draw in variants.items():
            start = time.perf_counter()
            draw()
            if repetition:  # The first one warms up.
                costs[name].append((time.perf_counter() - start) / FRAMES)
    reference = statistics.median(costs["as it is"])
    for name, seconds in costs.items():
        median = statistics.median(seconds)
        print(f"{name:48} {1e6 * median:8.1f} us {median / reference:8.2f} x")


if __name__ == "__main__":
    main()
