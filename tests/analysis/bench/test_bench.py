"""The benchmark measures all tasks, and each section can be imported with its extras."""

import importlib

import numpy as np
import pytest

from physexp import extras, suite
from physexp.analysis import bench
from physexp.analysis.bench import measuring
from physexp.analysis.bench import pixels as bench_pixels
from physexp.suite.engine import rendering


def test_drawn_poses_differ_as_after_play():
    name = next(iter(bench_pixels.TASKS))
    geom_xpos, geom_xmat = bench_pixels._played_poses(name)
    apparatus = suite.load_task(*bench_pixels.TASKS[name], {"random": 0}).build_apparatus(0)
    renderer = rendering.Renderer(apparatus.model, apparatus.moving_geoms)
    images = np.zeros((bench_pixels.BATCH, rendering.SIZE, rendering.SIZE, 3), np.uint8)
    renderer.render(geom_xpos, geom_xmat, np.arange(bench_pixels.BATCH), images)
    renderer.close()
    assert len({image.tobytes() for image in images}) > bench_pixels.BATCH / 2


@pytest.mark.parametrize("side", [bench_pixels.composer_rendering, lambda: bench_pixels.bare_rendering("fist")])
def test_each_side_returns_the_number_of_frames_it_draws(side):
    draw = side()
    assert draw() == draw() >= 1


def test_a_missed_target_is_printed_as_missed():
    figure = measuring.ratio("frames", 10, ours=9.0, theirs=1.0)
    assert not figure["reached"] and measuring.line(figure).startswith("MISS frames")


def test_all_tasks_are_measured():
    measured = [task for observations in ("features", "pixels") for task in measuring.tasks(observations).values()]
    assert sorted(measured) == sorted(suite.ALL_TASKS)


@pytest.mark.parametrize("name", bench.SECTIONS)
def test_every_section_names_its_function_and_extras(name):
    extras.require(*bench.extras([name]))
    module, _, function = bench.SECTIONS[name].partition(".")
    assert callable(getattr(importlib.import_module(f"physexp.analysis.bench.{module}"), function))


def test_sections_are_measured_in_the_order_given(monkeypatch):
    for name in ("first", "second"):
        row = measuring.row(name, 1.0, "x", 1)
        monkeypatch.setattr(measuring, name, lambda row=row: iter([row]), raising=False)
    monkeypatch.setattr(bench, "SECTIONS", {"one": "measuring.first", "two": "measuring.second"})
    assert [row["figure"] for row in bench.run(["two", "one"])] == ["second", "first"]
