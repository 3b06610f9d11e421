"""The leaderboard shows the verified scores of the whole protocol, and names the folders that hold none."""

import html
import json
import os
from pathlib import Path
import re
import shutil
from urllib import parse

import commands
import made_agents
import numpy as np
import pyarrow
import pytest

from physexp.analysis.score import leaderboard, log, protocol, scoring, targets, verifying

ROOT = Path(__file__).parents[3]
EPISODES = 5
BOTH = protocol.named(["threshold/features", "strings/features"])


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """The results of two rows of a short protocol, in two domains."""
    results = tmp_path_factory.mktemp("leaderboard") / "results"
    for target in ("random", "ideal"):
        folder = results / "scores" / target
        folder.parent.mkdir(parents=True, exist_ok=True)
        scoring.score(targets.find(target), BOTH, EPISODES, folder)
    return results


@pytest.fixture(autouse=True)
def short_protocol(monkeypatch, request):
    """Has a row play fewer episodes, except where the project's own rows are read."""
    if "results" in request.fixturenames:
        monkeypatch.setattr(protocol, "EPISODES", EPISODES)


@pytest.fixture(autouse=True, scope="module")
def cache(tmp_path_factory):
    """A folder of this module's own for the marks of verified files."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture
def copied(results, tmp_path):
    """A copy of the results, and in it a row that a test changes: that of the ideal, named `changed`."""
    copied = shutil.copytree(results, tmp_path / "results")
    return copied, shutil.copytree(copied / "scores" / "ideal", copied / "scores" / "changed")


def change_facts(folder, **facts):
    path = folder / scoring.FILE
    path.write_text(json.dumps({**json.loads(path.read_text()), **facts}))


def change_rows(folder, change):
    """Writes a log with other rows, and the figures that follow from it."""
    rows = change(log.read(folder).to_pandas())
    changed = pyarrow.Table.from_pandas(rows, log.SCHEMA, preserve_index=False)
    log.write(folder, changed)
    change_facts(folder, **scoring.metrics(changed, protocol.named(["threshold/features", "strings/features"]), {}))


def test_rows_are_sorted_by_score_and_what_they_do_not_play_counts_as_0(results):
    (best, worst), refused = leaderboard.read(results)
    assert not refused
    assert (best.name, worst.name) == ("ideal", "random")
    of_domains = [best.domains[name]["score"] for name in best.domains]
    assert sorted(of_domains)[-2:] == pytest.approx([1, 1]) and not any(sorted(of_domains)[:-2])
    # An interquartile mean leaves out a quarter at either end, rounded down.
    cut = len(of_domains) // 4
    assert best.whole["score"] == pytest.approx(np.mean(sorted(of_domains)[cut : len(of_domains) - cut]))
    assert best.played["threshold"] == (1, 1) and best.played["balance"] == (0, 1)


def test_a_domain_that_is_not_played_is_marked(results):
    header, _, row = leaderboard.markdown(leaderboard.read(results)[0]).splitlines()[6:9]
    cells = dict(zip(header.split(" | "), row.split(" | "), strict=True))
    assert cells["agent"] == "[ideal](scores/ideal/report.png)"
    assert (cells["threshold"], cells["balance"]) == ("1.000", "–")


def test_the_page_its_figure_and_its_part_of_the_readme_are_written(results, monkeypatch):
    readme = results.parent / "README.md"
    first, last = leaderboard.MARKS
    readme.write_text(f"Before.\n\n{first}\noutdated\n{last}\n\nAfter.\n")
    paths, refused = leaderboard.write(results)
    assert not refused
    assert {path.name for path in paths} == {"leaderboard.md", "leaderboard.svg", "leaderboard.png", "README.md"}
    written = readme.read_text()
    assert written.startswith(f"Before.\n\n{first}\n\n|") and written.endswith(f"{last}\n\nAfter.\n")
    assert "outdated" not in written and "| [ideal](results/scores/ideal/report.png) |" in written
    readme.write_text(f"Before.\n\n{first}\noutdated\n{last}\n\nAfter.\n")
    monkeypatch.chdir(results)
    leaderboard.write(Path())
    assert readme.read_text() == written


def test_a_readme_without_the_end_of_the_leaderboard_is_left_alone(results):
    readme = results.parent / "README.md"
    readme.write_text(f"before\n{leaderboard.MARKS[0]}\nafter\n")
    with pytest.raises(ValueError, match="put that where the leaderboard ends"):
        leaderboard.write(results)
    assert readme.read_text() == f"before\n{leaderboard.MARKS[0]}\nafter\n"


def test_the_readme_has_the_first_rows_only(results):
    (row, _), _ = leaderboard.read(results)
    lines = leaderboard.short([row] * 15).splitlines()
    assert len([line for line in lines if "| [ideal](" in line]) == leaderboard.SHORT


def reason(results, name) -> str:
    """The reason why a folder is no row; the board cannot be written if there is no other."""
    rows, (line,) = leaderboard.read(results)
    folder = results / "scores" / name
    assert line.isprintable() and line.startswith(f"{folder} is no row: ")
    if not rows:
        with pytest.raises(ValueError, match=re.escape(line)):
            leaderboard.write(results)
    return line.removeprefix(f"{folder} is no row: ").removeprefix(f"{folder} ")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda rows: rows.assign(worth=rows.value + 5), "threshold/features, episode 0, step 0: worth is "),
        (lambda rows: rows.assign(worth=np.nan), "NaN is no number"),
        (lambda rows: rows[rows.episode == 0], f"threshold/features has 1 episodes instead of {EPISODES}"),
    ],
)
def test_a_forged_row_is_named_and_the_others_are_shown(copied, change, said):
    results, folder = copied
    change_rows(folder, change)
    done = commands.run("leaderboard", "--results-dir", results, first=shorten)
    assert done.returncode == 1 and said in done.stderr and f"{folder} is no row: " in done.stderr
    page = (results / "leaderboard.md").read_text()
    assert "[ideal]" in page and "[random]" in page and "changed" not in page


def shorten():
    protocol.EPISODES = EPISODES


@pytest.mark.parametrize(
    ("facts", "said"),
    [
        ({"agent": {"frames": "many"}}, "frames is 'many'"),
        ({"agent": {"agents": {"strings/features": 7}}}, "strings/features is 7"),
        ({"agent": {"agents": {"strings/features": {"commit": 7}}}}, "commit is 7"),
        ({"commit": 7}, "commit is 7"),
        ({"version": "v0"}, "is of protocol 'v0'"),
        ({"protocol": {"seed": 2000003, "episodes": EPISODES, "tasks": []}}, "is of no task"),
    ],
)
def test_a_row_with_wrong_facts_is_named(copied, facts, said):
    results, folder = copied
    change_facts(folder, **facts)
    assert said in reason(results, "changed")


def test_names_and_facts_of_a_row_are_text_in_pages_and_figures(copied):
    results, folder = copied
    name, algorithm = os.fsdecode(b"[a](b) | <b>\xff $\\frac{1}$"), "| <img src=x> `$\\frac{1}$` [x](javascript:y)\n# z"
    shutil.move(folder, results / "scores" / name)
    change_facts(results / "scores" / name, agent={"algorithm": algorithm}, commit="<script>")
    paths, refused = leaderboard.write(results)
    assert not refused and len(paths) == 3
    header, _, *rows = (results / "leaderboard.md").read_text().splitlines()[6:]
    (row,) = [row for row in rows if "frac" in row]
    cells = row.removeprefix("| ").removesuffix(" |").split(" | ")
    assert len(cells) == len(header.split(" | ")) and not set("".join(cells[3:])) & set("<>`$[]")
    linked = re.fullmatch(r"\[([^]]*)\]\(scores/([^)]*)/report.png\)", cells[1])
    assert html.unescape(linked[1]) == name.replace("\udcff", r"\udcff")
    assert parse.unquote_to_bytes(linked[2]) == os.fsencode(name)


def test_a_row_is_played_again_once_it_changes(copied, monkeypatch):
    results, folder = copied
    played = []
    monkeypatch.setattr(verifying, "verify", played.append)
    leaderboard.read(results)
    assert not played, "a copy of a verified row is known, too"
    change_facts(folder, target="another")
    leaderboard.read(results)
    leaderboard.read(results)
    assert played == [folder]


def test_a_score_of_less_than_the_protocol_is_no_row(results, tmp_path):
    (tmp_path / "scores").mkdir()
    scoring.score(targets.find("random"), protocol.named(["threshold/features"]), 2, tmp_path / "scores" / "few")
    assert reason(tmp_path, "few") == f"has 2 episodes of each task; a row has {EPISODES}"


def test_a_score_that_was_ended_early_is_no_row(results, tmp_path, monkeypatch):
    made_agents.put_into(tmp_path)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scores").mkdir()
    with pytest.raises(ValueError, match="made:raises failed"):
        scoring.score(targets.find("made:raises"), BOTH[:1], EPISODES, tmp_path / "scores" / "raises")
    assert reason(tmp_path, "raises").startswith("is not complete: made:raises failed")


def test_without_scores_there_is_no_leaderboard(tmp_path):
    for make in (tmp_path.exists, (tmp_path / "scores").mkdir):
        make()
        done = commands.run("leaderboard", "--results-dir", tmp_path)
        assert done.returncode == 2 and done.stderr.startswith(f"physexp: {tmp_path / 'scores'} has no scores")


def test_the_pages_of_this_project_show_its_rows():
    rows, refused = leaderboard.read(ROOT / "results", verify=lambda folder: None)
    assert not refused
    assert (ROOT / "results" / "leaderboard.md").read_text() == leaderboard.markdown(rows)
    readme = (ROOT / "README.md").read_text()
    assert readme == leaderboard.with_part(readme, leaderboard.short(rows))
