"""The leaderboard shows the verified scores of the whole protocol, and names the folders that hold none."""

import html
import json
import math
import os
from pathlib import Path
import re
import shutil
import sys
from urllib import parse

import commands
import pyarrow
import pytest

from physexp import cli
from physexp.analysis.score import leaderboard, log, playing, protocol, scores, scoring, targets, transcripts, verifying
from physexp.suite import words

ROOT = Path(__file__).parents[3]
EPISODES = 4
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
    """A row has fewer episodes, except where the project's own rows are read."""
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


def test_rows_are_sorted_by_score_and_unplayed_tasks_count_as_0(results):
    (best, worst), refused = leaderboard.read(results)
    assert not refused
    assert (best.name, worst.name) == ("ideal", "random")
    exact = best.tracks["exact"]
    of_domains = {name: one["score"] for name, one in exact["domains"].items()}
    assert of_domains == pytest.approx({name: float(name in ("threshold", "strings")) for name in of_domains})
    assert exact["score"] == pytest.approx(2 / len(of_domains)) and exact["worst"] == {next(iter(of_domains)): 0}
    page = leaderboard.markdown([best, worst])
    assert f"[ideal](scores/ideal) | {2 / len(of_domains):.3f}<br><sub>0.000 which is heavier</sub> |" in page
    header, _, row = page.partition("## Track `exact`")[2].splitlines()[4:7]
    cells = dict(zip(header.split(" | "), row.split(" | "), strict=True))
    assert (cells["agent"], cells["threshold"], cells["balance"]) == ("ideal", "1.000", "–")
    assert cells["domains played |"] == f"2 of {len(of_domains)} |"


def test_a_row_links_to_the_costliest_mistake_of_each_domain(results):
    part = leaderboard.markdown(leaderboard.read(results)[0]).partition("## Costliest mistakes")[2].partition("##")[0]
    assert "| ideal |" not in part  # It makes none.
    links = re.findall(r"\[(\w+): (\w+)\]\(\.\./docs/_build/html/play\.html\?([^)]*)\) ([\d.]+)", part)
    logged, found = log.read(results / "scores" / "random").to_pandas(), {}
    for question in BOTH:
        its = logged[logged.domain == question.domain]
        costs = its.regret * question.discount**its.step
        at = costs.idxmax()
        actions = ",".join(map(str, its[its.episode == its.episode[at]].action))
        query = {"task": question.name, "episode": str(its.episode[at]), "actions": actions}
        found[costs[at]] = question.domain, its.mistake[at], query, f"{costs[at]:.3f}"
    shown = [(domain, kind, dict(parse.parse_qsl(html.unescape(query))), cost) for domain, kind, query, cost in links]
    assert shown == [found[cost] for cost in sorted(found, reverse=True)]


def test_a_forged_row_is_named_and_the_others_are_shown(copied):
    results, folder = copied
    rows = log.read(folder).to_pandas()
    changed = pyarrow.Table.from_pandas(rows.assign(worth=rows.value + 5), log.SCHEMA, preserve_index=False)
    log.write(folder, changed)
    change_facts(
        folder, **scores.summary(scores.of_log(changed, dict.fromkeys(BOTH)))
    )  # The metrics follow from the forged log.
    done = commands.run("leaderboard", "--results-dir", results, first=shorten)
    assert done.returncode == 1 and f"{folder} is no row: " in done.stderr
    assert "threshold/features, episode 0, step 0: worth is " in done.stderr
    page = (results / "leaderboard.md").read_text()
    assert "[ideal]" in page and "[random]" in page and "changed" not in page
    assert (results / "figures" / "leaderboard.png").exists()


def shorten():
    protocol.EPISODES = EPISODES


@pytest.mark.parametrize(
    ("facts", "said"),
    [
        ({"agent": {"frames": "many"}}, "frames is 'many'"),
        ({"agent": {"agents": {"strings/features": {"commit": 7}}}}, "commit is 7"),
        ({"agent": {"player": "p", "told": {"tokens": "many"}}}, "tokens is 'many'"),
        ({"version": "v0"}, "is of protocol 'v0'"),
        ({"complete": False, "problem": "made:dies ended"}, "is not complete: made:dies ended"),
        ({"protocol": {"seed": 2000003, "episodes": EPISODES, "tasks": []}}, "is of no task; a row is of tasks of"),
        ({"protocol": {"seed": 2000003, "episodes": 2, "tasks": []}}, "has 2 episodes of each task; a row has 4"),
    ],
)
def test_a_row_with_wrong_facts_is_named(copied, facts, said):
    results, folder = copied
    change_facts(folder, **facts)
    _, (line,) = leaderboard.read(results)
    assert line.isprintable() and line.startswith(f"{folder} is no row: ") and said in line


def test_names_and_facts_of_a_row_are_text_in_pages_and_figures(copied):
    results, folder = copied
    name, algorithm = "[a](b) | <b> $\\frac{1}$", "| <img src=x> `$\\frac{1}$` [x](javascript:y)\n# z"
    shutil.move(folder, results / "scores" / name)
    change_facts(results / "scores" / name, agent={"algorithm": algorithm}, commit="<script>")
    paths, refused = leaderboard.write(results)
    assert not refused and [path.name for path in paths] == ["leaderboard.md", "leaderboard.png"]
    header, _, *rows = paths[0].read_text().splitlines()[6:]
    row, shorter = [row for row in rows if "frac" in row]
    cells = row.removeprefix("| ").removesuffix(" |").split(" | ")
    assert len(cells) == len(header.split(" | ")) and not set("".join([*cells[2:], shorter])) & set("<>`$[]")
    linked = re.fullmatch(r"\[([^]]*)\]\(scores/([^)]*)\)", cells[0])
    assert html.unescape(linked[1]) == name and parse.unquote(linked[2]) == name


def test_a_row_is_played_again_once_it_changes(copied, monkeypatch):
    results, folder = copied
    leaderboard.read(results)
    played = []
    monkeypatch.setattr(verifying, "verify", played.append)
    leaderboard.read(results)
    assert not played
    change_facts(folder, target="another")
    leaderboard.read(results)
    leaderboard.read(results)
    assert played == [folder]


def test_a_player_in_words_gets_a_row_that_tells_its_facts(copied, monkeypatch, tmp_path):
    monkeypatch.setattr(transcripts, "EPISODES", 2)
    played = tmp_path / "run"
    facts = {"model": "m 1", "harness": "h 2", "tools": "none", "budget": "a reply"}
    with transcripts.run(played, **facts) as run:
        for episode in run.episodes("threshold/features", 2):
            episode.believe([0.5, 0.5, 0, 0, 0, 0, 0, 0])
            episode.answer(0)
            run.tell(tokens=600, cost=0.25)
    results, _ = copied
    folder = results / "scores" / "in words"
    given = ["--records", played / transcripts.RECORDS, "--episodes", "2", "--output", folder, "--json"]
    monkeypatch.setattr(sys, "argv", ["physexp", "score", *map(str, given)])
    cli.main()
    kept = [json.loads(line) for line in (played / transcripts.RECORDS).read_text().splitlines()]
    assert [record["told"] for record in kept] == [{"tokens": 600, "cost": 0.25}] * 2
    metrics = scoring.read(folder)["tasks"]["threshold/features"]
    mean = sum(record["return"] for record in kept) / 2
    expected = (mean - metrics["floor"]) / (metrics["ideal"] - metrics["floor"])
    assert metrics["raw_score"] == pytest.approx(expected, abs=1e-12)
    rows, refused = leaderboard.read(results)
    assert not refused and "in words" in [row.name for row in rows]
    page = leaderboard.markdown(rows)
    told = "player m 1; harness h 2; tools none; budget a reply; level named; tokens 1,200; cost 0.5"
    lost = 6 / 8 * -math.log2(words.LEAST_BELIEF) + 2 / 8 * 1 - math.log2(8)  # All eight answers are as likely.
    assert f"{told}; beliefs lose {lost:.3f} bits | one player, 2 episodes of each task |" in page

    change_facts(folder, agent={})
    _, (line,) = leaderboard.read(results)
    assert "has 2 episodes of each task; a row has 4" in line


def test_an_interrupted_score_is_no_row_and_can_go_on(copied):
    results, folder = copied
    (folder / scoring.FILE).rename(folder / playing.FILE)
    _, (line,) = leaderboard.read(results)
    assert line == f"{folder} is no row: {folder} is not complete; the same `physexp score` goes on in it"


def test_a_pipe_is_no_file_of_a_row(copied):
    results, folder = copied
    (folder / log.FILE).unlink()
    os.mkfifo(folder / log.FILE)
    _, (line,) = leaderboard.read(results)
    assert line == f"{folder} is no row: {folder / log.FILE} is no regular file; put one in its place"


def test_without_scores_there_is_no_leaderboard(tmp_path):
    done = commands.run("leaderboard", "--results-dir", tmp_path)
    assert done.returncode == 2 and done.stderr.startswith(f"physexp: {tmp_path / 'scores'} has no scores")


def test_the_page_of_this_project_shows_its_rows():
    rows, refused = leaderboard.read(ROOT / "results", verify=lambda folder: None)
    assert not refused
    assert (ROOT / "results" / "leaderboard.md").read_text() == leaderboard.markdown(rows)
