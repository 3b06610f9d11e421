"""Every experiment draws a figure that can be read: named axes, also in grey, the same from the same data."""

import functools
import io
import itertools
import re
from xml.etree import ElementTree

from made_data import made
from matplotlib import image
import numpy as np
import pytest

from physexp.analysis.data import plots
from physexp.analysis.experiments import EXPERIMENTS, NAMES, conditions

_SVG = "{http://www.w3.org/2000/svg}"
LABELS = [config.label for config in (*conditions.HEAVIER, *conditions.TOWERS)]


@functools.cache
def drawn(name):
    """The figure of an experiment, and its SVG; each is drawn once."""
    figure = EXPERIMENTS[name].figure(made(name, num_agents=3))
    return figure, plots.svg(figure)


def texts(svg):
    """All text in an SVG file."""
    root = ElementTree.fromstring(svg)
    return ["".join(element.itertext()).strip() for element in root.iter(f"{_SVG}text")]


def shown_names(labels):
    """The names of conditions as axes have them, on one line or two."""
    names = {conditions.tick(label) for label in labels}
    return names | {name.replace(", ", "\n") for name in names}


def ticks(axes):
    return {tick.get_text() for tick in axes.get_xticklabels()}


@pytest.mark.parametrize("name", NAMES)
def test_every_axis_is_named_in_words_or_shares_the_one_that_is(name):
    figure, svg = drawn(name)
    assert figure.axes
    named_x = [axes for axes in figure.axes if axes.get_xlabel() or ticks(axes) & shown_names(LABELS)]
    named_y = [axes for axes in figure.axes if axes.get_ylabel()]
    for axes in figure.axes:
        assert any(axes is other or axes.get_shared_x_axes().joined(axes, other) for other in named_x)
        assert any(axes is other or axes.get_shared_y_axes().joined(axes, other) for other in named_y)
    words = {*texts(svg), *itertools.chain(*map(ticks, figure.axes))}
    assert {axes.get_ylabel() for axes in named_y} <= words
    assert not [text for text in words if re.search(r"\b(\d+|[DF])-[FP]\b", text)], "no condition is abbreviated"
    places = [tuple(axes.get_position().bounds) for axes in figure.axes]
    assert len(set(places)) == len(places), "two scales over one place are read wrong"


@pytest.mark.parametrize("name", NAMES)
def test_the_picture_is_sharp_and_small_and_nothing_is_cut_off(name):
    png = plots.png(drawn(name)[0])
    pixels = image.imread(io.BytesIO(png))
    assert min(pixels.shape[:2]) > 400 and len(png) < 120_000
    grey = pixels[..., :3].mean(axis=2)
    assert len(np.unique(grey.round(3))) > 10  # Black, colours and the shades between them and white.
    assert 0.5 < (grey == 1).mean() < 0.99
    for border in (grey[0], grey[-1], grey[:, 0], grey[:, -1]):
        assert (border == 1).all()


@pytest.mark.parametrize("name", ["individual", "learners", "laboratory"])
def test_the_same_data_make_the_same_figure(name):
    assert plots.svg(EXPERIMENTS[name].figure(made(name, num_agents=3))) == drawn(name)[1]


PARTS = [
    *((name, "3-F") for name in ("population", "individual", "random_heavier", "data_efficiency")),
    *((name, "F-P") for name in ("learning_towers", "waiting", "ideal_gap")),
]


@pytest.mark.parametrize("name, condition", PARTS)
def test_one_agent_of_one_condition_is_enough_to_draw(name, condition):
    frame = made(name, num_agents=1)
    figure = EXPERIMENTS[name].figure(frame[frame.condition == condition])
    assert not set().union(*map(ticks, figure.axes)) & (shown_names(LABELS) - shown_names([condition]))
    assert texts(plots.svg(figure))


def test_the_number_of_agents_is_told_in_words():
    frame = made("population", num_agents=3)
    assert plots.seeds(frame) == "3 agents each"
    assert plots.seeds(frame[frame.training_seed == 0]) == "1 agent each"
    assert plots.seeds(frame[(frame.condition != "5-F") | (frame.training_seed == 0)]) == "1 to 3 agents each"
