"""What the benchmark of pixels compares is what it says."""

import numpy as np
import pytest

from physexp import suite
from physexp.analysis.bench import measuring
from physexp.analysis.bench import pixels as bench_pixels
from physexp.suite.engine import rendering


@pytest.mark.parametrize("name", bench_pixels.TASKS)
def test_the_poses_that_are_drawn_are_those_of_environments_that_were_played(name):
    geom_xpos, geom_xmat = bench_pixels._played_poses(name)
    assert len(geom_xpos) == len(geom_xmat) == bench_pixels.BATCH
    apparatus = suite.load_task(*bench_pixels.TASKS[name], {"random": 0}).build_apparatus(0)
    renderer = rendering.Renderer(apparatus.model, apparatus.moving_geoms)
    images = np.zeros((bench_pixels.BATCH, rendering.SIZE, rendering.SIZE, 3), np.uint8)
    renderer.render(geom_xpos, geom_xmat, np.arange(bench_pixels.BATCH), images)
    renderer.close()
    different = {image.tobytes() for image in images}
    assert len(different) > bench_pixels.BATCH / 2


@pytest.mark.parametrize("side", [bench_pixels.composer_rendering, lambda: bench_pixels.bare_rendering("fist")])
def test_each_side_draws_as_many_frames_as_it_says(side):
    draw = side()
    assert draw() == draw() >= 1


def test_a_figure_that_is_missed_says_so():
    figure = measuring.row("frames", 9.0, "x", 10, ours=1.0)
    assert not figure["reached"] and measuring.line(figure).startswith("MISS frames")
