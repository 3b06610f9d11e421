"""Reproducing an experiment and the report of all of them, as a user does it."""

import re
import shutil

import commands
import pytest

from physexp.analysis.data import provenance
from physexp.analysis.experiments import EXPERIMENTS, base, claims, conditions, report
from physexp.analysis.training import records

CONDITIONS = EXPERIMENTS["population"].conditions


@pytest.fixture(scope="module")
def rehearsed(tmp_path_factory):
    """Results of a rehearsal of one experiment."""
    folder = tmp_path_factory.mktemp("results")
    options = ["--seeds", 1, "--observations", "features", "--frames", 5000, "--results-dir", folder]
    done = commands.run("reproduce", "population", *options, check=True)
    return base.Results(folder), done.stdout


@pytest.fixture(scope="module")
def reported(rehearsed):
    """The report of some experiments, written while another agent trains."""
    results, _ = rehearsed
    training = results.path / "runs" / "training"
    shutil.copytree(results.run(CONDITIONS[0].run(0)).path, training)
    names = ("mass_gap", "learning_heavier", "population", "individual", "waiting", "random_towers")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(report, "EXPERIMENTS", {name: EXPERIMENTS[name] for name in names})
        return report.write(results).read_text()


def test_a_reproduction_leaves_rows_a_figure_and_verdicts(rehearsed):
    results, output = rehearsed
    assert results.load("runs", ["condition"]).condition.tolist() == sorted(one.id for one in CONDITIONS)
    assert (results.path / "figures" / "population.png").stat().st_size > 5000
    assert "0 of 3 agents are done" in output and "time left" in output
    verdicts = [line.split()[0] for line in output.splitlines() if "95 % interval" in line]
    assert len(verdicts) == 3 and set(verdicts) <= {"holds", "fails", "undecided"}


def test_an_experiment_reads_complete_episodes(rehearsed):
    columns = [*records.STORED, "label", "reward", "length", "interactions", "time", "masses", "mass_gap"]
    frame = rehearsed[0].episodes([base.LEARNED], CONDITIONS, columns[1:])
    assert frame.notna().all(axis=None)
    assert frame.groupby("condition").length.sum().min() >= 10_000
    assert set(frame.condition) == {one.label for one in CONDITIONS}
    with pytest.raises(ValueError, match="holds no episodes of this experiment; `physexp reproduce EXPERIMENT` makes"):
        rehearsed[0].episodes([base.RANDOM], CONDITIONS)


def test_the_report_has_the_figures_and_what_is_missing(rehearsed, reported):
    results, _ = rehearsed
    for name in ("mass_gap", "population", "learning_heavier"):  # The runs have curves, too.
        assert f"figures/{name}.png" in reported and (results.path / "figures" / f"{name}.png").exists()
    for name in ("waiting", "random_towers", "individual"):
        assert f"Left out: {name}" in reported
    for condition in CONDITIONS:
        assert f"{condition.id} (1 of {conditions.SEEDS['features']})" in reported
    assert f"Agents: {len(CONDITIONS)}, trained by" in reported  # The one that is in training is not counted.
    assert provenance.commit()[:10] in reported


def test_the_report_lists_failures_first_and_sanity_checks_last(reported):
    table = reported[reported.index("## Claims of the paper") : reported.index("![")].split("## Claims of ours")[0]
    verdicts = re.findall(r"^\| \*\*(\w+)( \(sanity check\))?\*\* \|", table, re.MULTILINE)
    order = {"fails": 0, "undecided": 1, "holds": 2}
    keys = [(bool(check), order[verdict]) for verdict, check in verdicts]
    assert keys == sorted(keys)
    counted = [verdict for verdict, check in verdicts if not check]
    assert set(counted) - {"holds"} and len(counted) < len(verdicts), "after so few frames some claims are open"
    tally = f"{counted.count('holds')} holds, {counted.count('undecided')} undecided, {counted.count('fails')} fails"
    assert f"{tally}; sanity checks: {len(verdicts) - len(counted)}." in table
    for name in set(re.findall(r"\]\(#([\w-]+)\)", reported)):
        assert f'<a id="{name}">' in reported


def test_the_report_begins_with_a_summary_in_plain_words(reported):
    first = reported.splitlines()[2]
    words = r"Of (\d+) claims of the paper, (\d+) hold .*, (\d+) fail somewhere, and (\d+) cannot be decided"
    claimed, *counts = map(int, re.match(words, first).groups())
    assert claimed == sum(counts) > 0
    assert f"A3C agents, by their asynchronous workers: {len(CONDITIONS)} with 2." in first
    positions = [reported.index(words) for words in ("Undecided:", "## Claims of the paper", "## Provenance")]
    assert positions == sorted(positions)
    assert claims.HOLDS in reported


def test_a_report_of_nothing_says_what_to_do(tmp_path):
    with pytest.raises(ValueError, match="nothing is no folder; `physexp reproduce` makes one with results"):
        report.write(base.Results(tmp_path / "nothing"))
    assert not list(tmp_path.iterdir())
