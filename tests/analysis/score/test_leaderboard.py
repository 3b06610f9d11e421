"""The leaderboard says what its folders give, and takes a row that is a score of the whole protocol."""

from pathlib import Path

import commands
import made_agents
import numpy as np
import pytest

from physexp.analysis.score import leaderboard, protocol, scoring

ROOT = Path(__file__).parents[3]
EPISODES = 5


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Results with two rows of a short protocol, in two domains."""
    results = tmp_path_factory.mktemp("leaderboard") / "results"
    for target in ("random", "ideal"):
        folder = results / "scores" / target
        folder.parent.mkdir(parents=True, exist_ok=True)
        scoring.score(target, protocol.named(["threshold/features", "strings/features"]), EPISODES, folder)
    return results


@pytest.fixture(autouse=True)
def short_protocol(monkeypatch, request):
    """Has a row play fewer episodes, except where the project's own rows are read."""
    if "results" in request.fixturenames:
        monkeypatch.setattr(protocol, "EPISODES", EPISODES)


def test_rows_are_sorted_by_score_and_what_they_do_not_play_counts_as_0(results):
    best, worst = leaderboard.read(results)
    assert (best.name, worst.name) == ("ideal", "random")
    of_domains = [best.domains[name]["score"] for name in best.domains]
    assert sorted(of_domains)[-2:] == pytest.approx([1, 1]) and not any(sorted(of_domains)[:-2])
    # An interquartile mean leaves out a quarter at either end, rounded down.
    cut = len(of_domains) // 4
    assert best.whole["score"] == pytest.approx(np.mean(sorted(of_domains)[cut : len(of_domains) - cut]))
    assert best.played["threshold"] == (1, 1) and best.played["balance"] == (0, 1)


def test_a_domain_that_is_not_played_is_marked(results):
    header, _, row = leaderboard.markdown(leaderboard.read(results)).splitlines()[6:9]
    cells = dict(zip(header.split(" | "), row.split(" | "), strict=True))
    assert cells["agent"] == "[ideal](scores/ideal/report.png)"
    assert (cells["threshold"], cells["balance"]) == ("1.000", "–")


def test_the_page_its_figure_and_its_part_of_the_readme_are_written(results, monkeypatch):
    readme = results.parent / "README.md"
    first, last = leaderboard.MARKS
    readme.write_text(f"Before.\n\n{first}\noutdated\n{last}\n\nAfter.\n")
    paths = leaderboard.write(results)
    assert {path.name for path in paths} == {"leaderboard.md", "leaderboard.svg", "leaderboard.png", "README.md"}
    written = readme.read_text()
    assert written.startswith(f"Before.\n\n{first}\n\n|") and written.endswith(f"{last}\n\nAfter.\n")
    assert "outdated" not in written and "| [ideal](results/scores/ideal/report.png) |" in written
    readme.write_text(f"Before.\n\n{first}\noutdated\n{last}\n\nAfter.\n")
    monkeypatch.chdir(results)
    leaderboard.write(Path())
    assert readme.read_text() == written


def test_a_readme_in_which_the_end_of_the_leaderboard_is_lost_is_left_alone(results):
    readme = results.parent / "README.md"
    readme.write_text(f"before\n{leaderboard.MARKS[0]}\nafter\n")
    with pytest.raises(ValueError, match="put that where the leaderboard ends"):
        leaderboard.write(results)
    assert readme.read_text() == f"before\n{leaderboard.MARKS[0]}\nafter\n"


def test_the_readme_has_the_first_rows_only(results):
    (row, _) = leaderboard.read(results)
    lines = leaderboard.short([row] * 15).splitlines()
    assert len([line for line in lines if "| [ideal](" in line]) == leaderboard.SHORT


def test_a_score_of_less_than_the_protocol_is_no_row(results, tmp_path):
    (tmp_path / "scores").mkdir()
    scoring.score("random", protocol.named(["threshold/features"]), 2, tmp_path / "scores" / "few")
    with pytest.raises(ValueError, match=f"few has 2 episodes of each task; a row has {EPISODES}"):
        leaderboard.read(tmp_path)


def test_a_score_that_was_ended_early_is_no_row(results, tmp_path, monkeypatch):
    made_agents.put_into(tmp_path)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scores").mkdir()
    with pytest.raises(ValueError, match="made:raises failed"):
        scoring.score("made:raises", protocol.named(["threshold/features"]), EPISODES, tmp_path / "scores" / "raises")
    with pytest.raises(ValueError, match="raises is not complete: made:raises failed"):
        leaderboard.read(tmp_path)


def test_without_scores_there_is_no_leaderboard(tmp_path):
    for make in (tmp_path.exists, (tmp_path / "scores").mkdir):
        make()
        done = commands.run("leaderboard", "--results-dir", tmp_path)
        assert done.returncode == 2 and done.stderr.startswith(f"physexp: {tmp_path / 'scores'} has no scores")


def test_the_pages_of_this_project_say_what_its_folders_give():
    rows = leaderboard.read(ROOT / "results")
    assert (ROOT / "results" / "leaderboard.md").read_text() == leaderboard.markdown(rows)
    readme = (ROOT / "README.md").read_text()
    assert readme == leaderboard.with_part(readme, leaderboard.short(rows))
