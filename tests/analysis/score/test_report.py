"""A score's report shows the metrics on one page that needs no other file."""

import json
import os
import re
import shutil

import commands
import numpy as np
import pytest
import screens

from physexp.analysis.data import episodes, plots
from physexp.analysis.score import log, protocol, report, scores, scoring, targets, verifying
from physexp.suite.engine import rules

TASKS = ["threshold/features", "strings/features"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A score of random actions in two domains, with its report."""
    folder = tmp_path_factory.mktemp("random") / "guesses"
    scoring.score(targets.find("random"), protocol.named(TASKS), 8, folder)
    report.write(folder)
    return folder


@pytest.fixture(scope="module")
def found(folder):
    return scoring.read(folder)


def test_the_page_shows_the_metrics_and_needs_no_other_file(folder, found):
    page = (folder / "report.html").read_text()
    assert "<h1>guesses</h1>" in page and f"<b>{found['tracks']['exact']['score']:.3f}</b><br>exact" in page
    for name, task in found["tasks"].items():
        assert f"<td>{name}<td>{task['score']:.3f}<td>" in page
    places = re.findall(r"""(?:src|href)\s*=\s*["']?([^"'\s>]*)""", page)
    assert places and all(place.startswith("data:") for place in places)


@screens.needs_browser
def test_a_browser_shows_the_figure_and_runs_nothing_of_the_text(folder, tmp_path):
    """If it were markup, the style would turn the page red, and the script would empty it."""
    shutil.copytree(folder, tmp_path / "hostile")
    change_facts(
        tmp_path / "hostile", target="<style>*{background:#f00}</style><script>document.body.remove()</script>"
    )
    page, _ = report.write(tmp_path / "hostile")
    shown = screens.photographed(page, tmp_path).astype(int)
    assert (shown[..., 2] - shown[..., 0] > 60).sum() > 1_000, "the score and bars of the figure are blue"
    assert not (shown == (255, 0, 0)).all(axis=-1).any()


def change_facts(folder, **facts):
    path = folder / scoring.FILE
    path.write_text(json.dumps({**json.loads(path.read_text()), **facts}))


def test_all_text_of_a_score_is_shown_as_text(folder, tmp_path):
    copied = shutil.copytree(folder, tmp_path / os.fsdecode(b"<b>$\\frac{1}$ \xff\x1b[8m"))
    made = {"algorithm": "<b>&", "agents": {TASKS[0]: {"commit": "<i>"}}}
    change_facts(copied, target="<script>", agent=made, commit="<img>", complete=False, problem="<hr>\x1b")
    shown = report.write(copied)[0].read_text()
    assert not re.search(r"<(b>\$|b>&|i|script|img|hr)>", shown) and "\x1b" not in shown
    assert r"<h1>&lt;b&gt;$\frac{1}$ \udcff\x1b[8m</h1>" in shown
    assert "&lt;b&gt;&amp;;" in shown and "&lt;i&gt;" in shown and r"not complete: &lt;hr&gt;\x1b" in shown


def test_a_score_of_the_first_version_is_verified_and_shown(folder, found, tmp_path):
    copied, asked = shutil.copytree(folder, tmp_path / "older"), protocol.named(TASKS)
    ideals = {one: scores.reference(one, found["protocol"]["episodes"]) for one in asked}
    metrics = scores.summary(scores.of_log(log.read(copied), ideals, "v1"), "v1")
    older = {name: value for name, value in found.items() if name != "tracks"} | {"version": "v1"} | metrics
    (copied / scoring.FILE).write_text(json.dumps(older))
    assert verifying.verify(copied)["scores"] == {"all domains": metrics["whole"]["score"]}
    assert f"<b>{found['tracks']['exact']['score']:.3f}</b><br>exact" in report.write(copied)[0].read_text()


def test_bars_of_mistakes_begin_at_the_score_and_end_at_1(found):
    with plots.style():
        _, axes = plots.new()
        report.draw_mistakes(axes, found)
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
    report.draw_information(panels, found)
    threshold = panels[0]
    # The ideal halves eight levels three times: a bit each.
    np.testing.assert_allclose(threshold.patches[-1].get_data().values[:3], 1)
    gains = found["tasks"]["threshold/features"]["gains"]
    heights = [patch.get_height() for patch in threshold.patches[:-1]]
    np.testing.assert_allclose(heights[: len(gains)], gains[: len(heights)])


def test_random_actions_return_on_average_the_expected_return():
    (asked,) = protocol.named(["threshold/features"])
    make, environment = targets.find("random").make, protocol.load(asked)
    returns = []
    for index in range(600):
        rewards = episodes.play(environment, make(asked, index), index).rewards
        returns.append(rewards[-1] * asked.discount ** (len(rewards) - 1))
    error = np.std(returns) / np.sqrt(len(returns))
    # One in 16,000 is further off than four standard errors; the instances are always the same.
    assert abs(np.mean(returns) - scores.random_return(asked)) < 4 * error
    environment.close()
    one_step = type(asked)(**{**vars(asked), "step_limit": 1})
    # Half of 16 actions are answers, one of 8 of which is right; the others end the episode as wrong ones do.
    expected = (rules.RIGHT / 8 + 7 * rules.WRONG / 8) / 2 + rules.WRONG / 2
    assert scores.random_return(one_step) == pytest.approx(expected)


def test_the_command_writes_the_given_facts_of_the_agent(tmp_path):
    words = ["--tasks", "threshold/features", "--episodes", "2", "--output", "guesses"]
    made = ["--algorithm", "guessing", "--frames", "12000", "--minutes", "1.5"]
    done = commands.run("score", "random", *words, *made, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "guesses" / "report.html").read_text()
    assert "guessing, 12,000 frames, 90 s</tr>" in page, "and nothing that only its owner knows"
