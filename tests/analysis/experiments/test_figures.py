"""Every experiment draws a figure that can be read: named axes, also in grey, the same from the same data."""

import dataclasses
import functools
import itertools
from pathlib import Path
import re
from xml.etree import ElementTree

import made_data
import matplotlib
from matplotlib import colors, image, pyplot
import numpy as np
import pytest
from seeds import fresh_seed

from physexp.analysis.data import plots
from physexp.analysis.experiments import EXPERIMENTS, conditions

_SVG = "{http://www.w3.org/2000/svg}"
_JUST_NOTICEABLE = 2.3  # Difference of CIE lightness (Mahy et al., 1994).


@functools.cache
def _made(name, num_agents):
    seed = fresh_seed()
    return seed, made_data.WORLDS[name]["paper"](num_agents, np.random.default_rng(seed))


def made(name, num_agents=3):
    """The frame of an experiment; the same for all tests, since they only read it."""
    seed, frame = _made(name, num_agents)
    print("made with seed", seed)
    return frame


@dataclasses.dataclass(frozen=True)
class Drawn:
    """The axes of a figure, the labels on them, the names of their ticks, and the files."""

    axes: list
    labels: list[tuple[str, str]]
    ticks: list[list[str]]
    svg: bytes
    png: Path


@pytest.fixture(scope="module")
def draw(tmp_path_factory):
    """Draws the figure of an experiment, each once."""

    @functools.cache
    def drawn(name):
        figure = EXPERIMENTS[name].figure(made(name))
        axes = figure.axes
        labels = [(one.get_xlabel(), one.get_ylabel()) for one in axes]
        ticks = [[tick.get_text() for tick in one.get_xticklabels()] for one in axes]
        path = plots.save(figure, tmp_path_factory.mktemp("figures"), name)
        return Drawn(axes, labels, ticks, plots.svg(figure), path)

    return drawn


def texts(svg):
    """All text in an SVG file."""
    root = ElementTree.fromstring(svg)
    return ["".join(element.itertext()).strip() for element in root.iter(f"{_SVG}text")]


def shown_names(frame):
    """The names of conditions as axes have them, on one line or two."""
    names = {conditions.tick(name) for name in frame.get("condition", [])}
    return names | {name.replace(", ", "\n") for name in names}


def lightness(color):
    """CIE L* of a colour, from 0 for black to 100 for white."""
    values = np.array(colors.to_rgb(color))
    linear = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    luminance = linear @ [0.2126, 0.7152, 0.0722]
    return 116 * np.cbrt(luminance) - 16 if luminance > (6 / 29) ** 3 else luminance * (29 / 3) ** 3


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_every_axis_is_named_or_shares_the_one_that_is(draw, name):
    drawn = draw(name)
    assert drawn.axes
    named_x, named_y = (
        [one for one, labels in zip(drawn.axes, drawn.labels, strict=True) if labels[index]] for index in (0, 1)
    )
    for one, ticks in zip(drawn.axes, drawn.ticks, strict=True):
        categories = set(ticks) & shown_names(made(name))  # Names instead of numbers.
        assert categories or one in named_x or any(one.get_shared_x_axes().joined(one, other) for other in named_x)
        assert one in named_y or any(one.get_shared_y_axes().joined(one, other) for other in named_y)


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_the_vector_file_has_the_names_of_the_axes_as_text(draw, name):
    drawn = draw(name)
    assert drawn.png.name == f"{name}.png"
    assert {words for labels in drawn.labels for words in labels if words} <= set(texts(drawn.svg))


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_the_picture_is_not_blank_and_nothing_is_cut_off(draw, name):
    png = draw(name).png
    assert png.name == f"{name}.png"
    pixels = image.imread(png)
    assert min(pixels.shape[:2]) > 300  # 2.2 inches at 160 dots.
    grey = pixels[..., :3].mean(axis=2)
    assert len(np.unique(grey.round(3))) > 10  # Black, colours and what is between them and white.
    assert 0.5 < (grey == 1).mean() < 0.99
    for border in (grey[0], grey[-1], grey[:, 0], grey[:, -1]):
        assert (border == 1).all()


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_the_same_data_make_the_same_vector_file(draw, name):
    figure = EXPERIMENTS[name].figure(made(name))
    assert plots.svg(figure) == draw(name).svg


def test_figures_are_drawn_and_saved_without_a_change_of_settings_or_windows(tmp_path):
    before = dict(matplotlib.rcParams)
    figure = EXPERIMENTS["mass_gap"].figure(made("mass_gap"))
    path = plots.save(figure, tmp_path / "a" / "b", "name")
    assert path == tmp_path / "a" / "b" / "name.png" and path.stat().st_size
    assert not pyplot.get_fignums()
    assert dict(matplotlib.rcParams) == before


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
    frame = made(name, 1)
    frame = frame[frame.condition == condition]
    figure = EXPERIMENTS[name].figure(frame)
    ticks = {tick.get_text() for axes in figure.axes for tick in axes.get_xticklabels()}
    assert not ticks & shown_names(made(name)) - shown_names(frame)
    assert texts(plots.svg(figure))


def test_conditions_are_spelled_out_since_f_is_both_the_fist_and_features():
    assert conditions.spelled_out("F-F") == "fist, features"
    assert conditions.spelled_out("D-P, each agent") == "direct, pixels, each agent"
    assert conditions.spelled_out("10-F against 5-F") == "difficulty 10, features against difficulty 5, features"
    assert conditions.spelled_out("beta 3 against 5") == "beta 3 against 5"


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_no_figure_abbreviates_a_condition(draw, name):
    drawn = draw(name)
    words = {*texts(drawn.svg), *(tick for ticks in drawn.ticks for tick in ticks)}
    assert not [text for text in words if re.search(r"\b(\d+|[DF])-[FP]\b", text)]


def test_no_axes_share_their_place(draw):
    """Two scales over one place, left and right, are read wrong."""
    for name in EXPERIMENTS:
        places = [tuple(axes.get_position().bounds) for axes in draw(name).axes]
        assert len(set(places)) == len(places), name


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_the_picture_is_sharp_on_a_dense_screen_and_small(draw, name):
    drawn = draw(name)
    assert image.imread(drawn.png).shape[0] > 400 and drawn.png.stat().st_size < 120_000


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


def test_lines_and_dots_of_one_panel_differ_in_more_than_color():
    for kinds in (plots.COLORS, plots.DASHES, plots.MARKERS):
        assert len(set(kinds)) == len(kinds) >= 4


@pytest.mark.parametrize("name", ["learning_heavier", "mass_gap"])
def test_lines_that_the_legend_tells_apart_differ_in_dashes(draw, name):
    root = ElementTree.fromstring(draw(name).svg)
    groups = [group for group in root.iter(f"{_SVG}g") if "legend" in group.get("id", "")]
    assert groups
    for group in groups:
        styles = [path.get("style", "") for path in group.iter(f"{_SVG}path")]
        dashes = {re.search("stroke-dasharray: ([^;]*)|$", style)[1] for style in styles}
        assert len(dashes) == 3  # None is a solid line.


@pytest.mark.parametrize("vertical", [False, True])
def test_a_reference_is_a_line_at_its_level_with_its_name(vertical):
    figure, axes = plots.new()
    plots.reference(axes, 0.3, "chance", vertical=vertical)
    plots.reference(axes, 0.6, "", vertical=vertical)
    levels = [line.get_xdata() if vertical else line.get_ydata() for line in axes.lines]
    assert [list(level) for level in levels] == [[0.3, 0.3], [0.6, 0.6]]
    assert [text.get_text() for text in axes.texts] == ["chance"]


def test_the_number_of_agents_is_told_in_words():
    frame = made("population", 3)
    assert plots.seeds(frame) == "3 agents each"
    assert plots.seeds(frame[frame.training_seed == 0]) == "1 agent each"
    assert plots.seeds(frame[(frame.condition != "5-F") | (frame.training_seed == 0)]) == "1 to 3 agents each"
