"""The benchmark compares what it says, of all tasks that there are."""

import importlib
import subprocess
import sys

import numpy as np
import pytest

from physexp import extras, suite
from physexp.analysis import bench
from physexp.analysis.bench import measuring
from physexp.analysis.bench import pixels as bench_pixels
from physexp.suite.engine import rendering


@pytest.mark.parametrize("name", bench_pixels.TASKS)
def test_the_poses_that_are_drawn_are_those_of_environments_that_were_played(name):
    geom_xpos, geom_xmat = bench_pixels._played_poses(name)
    assert len(geom_xpos) == len(geom_xmat) == bench_pixels.BATCH
    task = suite.load_task(*bench_pixels.TASKS[name], {"random": 0})
    apparatus = task.build_apparatus(0)
    renderer = rendering.Renderer(apparatus.model, apparatus.moving_geoms)
    images = np.zeros((bench_pixels.BATCH, rendering.SIZE, rendering.SIZE, 3), np.uint8)
    renderer.render(geom_xpos, geom_xmat, np.arange(bench_pixels.BATCH), images)
    renderer.close()
    different = {image.tobytes() for image in images}
    # Where indicators are all that is seen, there are no more images than readings: two for each interaction.
    most = 2 * task.num_interactions if task.indicators else bench_pixels.BATCH
    assert len(different) > min(bench_pixels.BATCH, most) / 2


@pytest.mark.parametrize("side", [bench_pixels.composer_rendering, lambda: bench_pixels.bare_rendering("fist")])
def test_each_side_draws_as_many_frames_as_it_says(side):
    draw = side()
    assert draw() == draw() >= 1


def test_a_figure_that_is_missed_says_so():
    figure = measuring.row("frames", 9.0, "x", 10, ours=1.0)
    assert not figure["reached"] and measuring.line(figure).startswith("MISS frames")


def test_all_tasks_are_measured():
    measured = [task for observations in ("features", "pixels") for task in measuring.tasks(observations).values()]
    assert sorted(measured) == sorted(suite.ALL_TASKS)


@pytest.mark.parametrize("name", bench.SECTIONS)
def test_every_section_is_there_and_names_the_extras_that_it_imports(name):
    section = bench.SECTIONS[name]
    extras.require(*section.extras)
    module, _, function = section.function.partition(".")
    assert callable(getattr(importlib.import_module(f"physexp.analysis.bench.{module}"), function))


def test_naming_the_sections_imports_nothing_heavy():
    code = "import sys; from physexp.analysis import bench; list(bench.SECTIONS)"
    heavy = "{'numpy', 'mujoco', 'torch', 'dm_control'}"
    subprocess.run([sys.executable, "-c", f"{code}; assert not {heavy} & set(sys.modules)"], check=True, timeout=120)


def test_sections_are_measured_in_the_order_given(monkeypatch, tmp_path):
    given = []

    def figures(*arguments):
        given.append(arguments)
        yield measuring.row("figure", 1.0, "x", 1)

    sections = {"one": bench.Section("measuring.first"), "two": bench.Section("measuring.second", reads_results=True)}
    monkeypatch.setattr(bench, "SECTIONS", sections)
    for function in ("first", "second"):
        monkeypatch.setattr(measuring, function, figures, raising=False)
    assert len(list(bench.run(["two", "one"], tmp_path))) == 2
    assert given == [(tmp_path,), ()]
