"""A score's report shows what the figures say, on one page that needs no other file."""

import json
import os
import re
import shutil

import commands
import numpy as np
from PIL import Image
import pytest
import screens

from physexp.analysis.data import plots
from physexp.analysis.score import drawing, episodes, protocol, reference, report, scoring, targets, verifying
from physexp.suite.engine import rules

FOUR = ["threshold/features", "strings/features", "balance/features", "which_is_heavier/features"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A score of random actions in four domains, with its report."""
    folder = tmp_path_factory.mktemp("random") / "guesses"
    scoring.score(targets.find("random"), protocol.named(FOUR), 8, folder)
    report.write(folder)
    return folder


@pytest.fixture(scope="module")
def found(folder):
    return scoring.read(folder)


@pytest.fixture
def axes():
    with plots.style():
        _, axes = plots.new()
        yield axes


def test_the_page_says_what_was_played_and_found_and_needs_no_other_file(folder, found):
    page = (folder / "report.html").read_text()
    assert "<h1>guesses</h1>" in page and f"<b>{found['whole']['score']:.3f}</b>" in page
    for name, figures_of_task in found["tasks"].items():
        assert f"<td>{name}</td><td>{figures_of_task['score']:.3f}</td>" in page
    places = re.findall(r"""(?:src|href)\s*=\s*["']?([^"'\s>]*)""", page)
    assert places and all(place.startswith("data:") for place in places)


@screens.needs_browser
def test_a_browser_shows_the_page_with_its_figures(folder, tmp_path):
    shown = screens.photographed(folder / "report.html", tmp_path).astype(int)
    page = (folder / "report.html").read_text()
    without = re.sub(r"<img\b[^>]*>", "", page)
    assert len(without) < len(page)
    (tmp_path / "without.html").write_text(without)
    bare = screens.photographed(tmp_path / "without.html", tmp_path).astype(int)
    colored, of_text = ((np.ptp(image, axis=-1) > 60).sum() for image in (shown, bare))
    assert colored > 3 * of_text > 0, "the score is blue, and most of what is coloured is in the figures"


def test_the_image_is_as_wide_as_a_desktop(folder):
    with Image.open(folder / "report.png") as image:
        assert 1200 < image.width < 3 * 1200 and image.height < image.width


def test_bars_of_mistakes_begin_at_the_score_and_end_at_1(axes, found):
    drawing.draw_mistakes(axes, found)
    bars = {}
    for patch in axes.patches:
        bars.setdefault(round(patch.get_y() + patch.get_height() / 2), []).append(patch)
    assert len(bars) == len(found["tasks"])
    for place, task in zip(sorted(bars, reverse=True), found["tasks"].values(), strict=True):
        earned, *lost = bars[place]
        assert earned.get_width() == max(0, task["score"]) and lost[0].get_x() == task["score"]
        assert lost[-1].get_x() + lost[-1].get_width() == pytest.approx(1)


def test_bits_of_each_interaction_are_drawn_beside_the_ideals(found):
    _, panels = plots.new(columns=len(found["tasks"]))
    drawing.draw_information(panels, found)
    threshold = panels[0]
    # The ideal halves eight levels three times: a bit each.
    np.testing.assert_allclose(threshold.patches[-1].get_data().values[:3], 1)
    gains = found["tasks"]["threshold/features"]["gains"]
    heights = [patch.get_height() for patch in threshold.patches[:-1]]
    np.testing.assert_allclose(heights[: len(gains)], gains[: len(heights)])


@pytest.mark.parametrize("name", ["threshold/features", "which_is_heavier/features", "strings/features"])
def test_what_random_actions_are_expected_to_return_is_what_they_return(name):
    (asked,) = protocol.named([name])
    actor, environment = targets.find("random").make(asked, 0), protocol.load(asked)
    returns = []
    for number in range(1000):
        rewards = episodes.play(environment, actor, number).rewards
        returns.append(rewards[-1] * asked.discount ** (len(rewards) - 1))
    error = np.std(returns) / np.sqrt(len(returns))
    # One in 16,000 is further off than four standard errors; the instances are always the same.
    assert abs(np.mean(returns) - reference.random_return(asked)) < 4 * error
    environment.close()


def test_an_agent_that_can_only_answer_returns_at_random_what_answers_are_worth():
    (asked,) = protocol.named(["threshold/features"])
    one_step = type(asked)(**{**vars(asked), "step_limit": 1})
    # Half of 16 actions are answers, one of 8 of which is right; the others end the episode as wrong ones do.
    expected = (rules.RIGHT / 8 + 7 * rules.WRONG / 8) / 2 + rules.WRONG / 2
    assert reference.random_return(one_step) == pytest.approx(expected)


def test_a_score_of_one_domain_has_a_report_without_a_radar(tmp_path):
    scoring.score(targets.find("silent"), protocol.named(["threshold/features"]), 2, tmp_path / "<quiet>")
    paths = report.write(tmp_path / "<quiet>")
    assert not drawing.has_skills(scoring.read(tmp_path / "<quiet>"))
    assert [path.name for path in paths] == ["report.html", "report.png"]
    assert "&#60;quiet&#62;" in paths[0].read_text() and "<quiet>" not in paths[0].read_text()


def test_a_report_shows_any_text_of_a_score_as_text(folder, tmp_path):
    copied = shutil.copytree(folder, tmp_path / os.fsdecode(b"$\\frac{1}$ \xff\x1b[8m"))
    path = copied / scoring.FILE
    hostile = {"algorithm": r"<b>$\frac{1}$", "agents": {FOUR[0]: {"commit": "<i>"}}}
    facts = {"target": "<script>", "agent": hostile, "commit": "<img>", "complete": False, "problem": "<hr>\x1b"}
    path.write_text(json.dumps({**json.loads(path.read_text()), **facts}))
    page, _ = report.write(path.parent)
    shown = page.read_text()
    assert not any(tag in shown for tag in ("<b>$", "<i>", "<script>", "<img>", "<hr>", "\x1b"))
    assert r"<h1>&#36;\frac{1}&#36; \udcff\x1b&#91;8m</h1>".replace("\\", "&#92;") in shown


def test_a_report_is_no_part_of_what_is_verified(folder):
    (folder / "report.html").write_text("<h1>1.000</h1>")
    assert verifying.verify(folder)["episodes"] == 8 * len(FOUR)


def test_the_command_writes_the_report_with_what_is_said_of_the_agent(tmp_path):
    words = ["--tasks", "threshold/features", "--episodes", "2", "--output", "guesses"]
    made = ["--algorithm", "guessing", "--frames", "12000", "--minutes", "1.5"]
    done = commands.run("score", "random", *words, *made, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "guesses" / "report.html").read_text()
    assert "guessing, 12,000 frames, 90 s<" in page, "and nothing that only its owner knows"
    assert (tmp_path / "guesses" / "report.png").exists()
