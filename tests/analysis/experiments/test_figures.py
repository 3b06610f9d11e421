"""Every experiment draws a figure that can be read: named axes, also in grey, the same from the same data."""

import dataclasses
import functools
import io
import itertools
import re
from xml.etree import ElementTree

from made_data import made
import matplotlib
from matplotlib import colors, image, pyplot
import numpy as np
import pytest

from physexp.analysis.data import plots
from physexp.analysis.experiments import EXPERIMENTS, NAMES, conditions, efficiency, ideal_gap, interactions

_SVG = "{http://www.w3.org/2000/svg}"
_JUST_NOTICEABLE = 2.3  # Difference of CIE lightness (Mahy et al., 1994).
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


def test_a_figure_changes_no_settings_and_opens_no_window():
    before = dict(matplotlib.rcParams)
    plots.png(EXPERIMENTS["mass_gap"].figure(made("mass_gap")))
    assert not pyplot.get_fignums() and dict(matplotlib.rcParams) == before


def only(data, condition):
    """The part of an experiment's data that is of one condition."""
    if isinstance(data, efficiency.Learned):
        return efficiency.Learned(only(data.curves, condition), only(data.final, condition))
    if isinstance(data, ideal_gap.Gap | interactions.Played):
        return dataclasses.replace(data, agents=only(data.agents, condition))
    return data[data.condition == condition]


PARTS = [
    *((name, "3-F") for name in ("learning_heavier", "population", "individual", "random_heavier", "ideal_gap")),
    ("data_efficiency", "3-F"),
    ("ablations", "D-F"),
    ("generalization", "F-F"),
    ("learners", "F-F PPO"),
    *((name, "F-P") for name in ("learning_towers", "waiting", "random_towers", "ideal_gap")),
]


@pytest.mark.parametrize("name, condition", PARTS)
def test_one_agent_of_one_condition_is_enough_to_draw(name, condition):
    figure = EXPERIMENTS[name].figure(only(made(name, num_agents=1), condition))
    assert not set().union(*map(ticks, figure.axes)) & (shown_names(LABELS) - shown_names([condition]))
    assert texts(plots.svg(figure))


def test_lines_that_the_legend_tells_apart_differ_in_dashes():
    root = ElementTree.fromstring(drawn("learning_heavier")[1])
    groups = [group for group in root.iter(f"{_SVG}g") if "legend" in group.get("id", "")]
    assert groups
    for group in groups:
        styles = [path.get("style", "") for path in group.iter(f"{_SVG}path")]
        dashes = {re.search("stroke-dasharray: ([^;]*)|$", style)[1] for style in styles}
        assert len(dashes) == 3  # None is a solid line.


def lightness(color):
    """CIE L* of a colour, from 0 for black to 100 for white."""
    values = np.array(colors.to_rgb(color))
    linear = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    luminance = linear @ [0.2126, 0.7152, 0.0722]
    return 116 * np.cbrt(luminance) - 16 if luminance > (6 / 29) ** 3 else luminance * (29 / 3) ** 3


def test_colors_differ_in_grey_from_each_other_and_from_the_paper():
    found = [lightness(color) for color in plots.COLORS]
    assert [lightness(color) for color in ("black", "white")] == pytest.approx([0, 100], abs=1e-6)
    assert lightness("#777777") == pytest.approx(50.03, abs=0.01)  # The grey that is known for being in the middle.
    assert found == sorted(found)  # Darkest first.
    for one, other in itertools.combinations(found[:4], 2):
        assert abs(one - other) > _JUST_NOTICEABLE
    # Lines and bars of the same kind use the first three, which differ more.
    assert np.diff(found[:3]).min() > 3 * _JUST_NOTICEABLE
    assert 100 - found[3] > 40
    for kinds in (plots.COLORS, plots.DASHES, plots.MARKERS):
        assert len(set(kinds)) == len(kinds) >= 4


@pytest.mark.parametrize("vertical", [False, True])
def test_a_reference_is_a_line_at_its_level_with_its_name(vertical):
    _, axes = plots.new()
    plots.reference(axes, 0.3, "chance", vertical=vertical)
    plots.reference(axes, 0.6, "", vertical=vertical)
    levels = [line.get_xdata() if vertical else line.get_ydata() for line in axes.lines]
    assert [list(level) for level in levels] == [[0.3, 0.3], [0.6, 0.6]]
    assert [text.get_text() for text in axes.texts] == ["chance"]


def test_the_number_of_agents_is_told_in_words():
    frame = made("population", num_agents=3)
    assert plots.seeds(frame) == "3 agents each"
    assert plots.seeds(frame[frame.training_seed == 0]) == "1 agent each"
    assert plots.seeds(frame[(frame.condition != "5-F") | (frame.training_seed == 0)]) == "1 to 3 agents each"


def test_conditions_are_spelled_out_since_f_is_both_the_fist_and_features():
    assert conditions.spelled_out("F-F") == "fist, features"
    assert conditions.spelled_out("D-P, each agent") == "direct, pixels, each agent"
    assert conditions.spelled_out("10-F against 5-F") == "difficulty 10, features against difficulty 5, features"
