"""The report: every figure, and the table of claims, as Markdown."""

import collections
from collections.abc import Sequence
import math
from pathlib import Path
from typing import Any, NamedTuple

from physexp.agents import files
from physexp.analysis.data import plots, provenance, text
from physexp.analysis.experiments import EXPERIMENTS, base, conditions, summary, sweep
from physexp.analysis.experiments import claims as claims_lib
from physexp.analysis.training import callbacks

_INTRODUCTION = (
    "The paper is *Learning to Perform Physics Experiments via Deep Reinforcement Learning* (Denil et al., ICLR "
    "2017); its claims and ours are tested on stored data. A claim holds where its statistic lies inside the range "
    "wanted, fails where it lies outside, and is undecided where the data, or too few agents, cannot tell at a level "
    "of 5 %, corrected for the number of conditions in which the same claim is tested (Holm, 1979); the 95 % "
    "intervals shown are not corrected. Sanity checks, which could fail only if something were broken, are not "
    "counted. The ranges of all claims, and when each was written down, are in docs/plan.md; a statistic that was "
    "found in these data says so, and its verdict describes them. Of the agents planned, those that are not trained "
    "yet are named below their figure."
)


_VERDICTS = (claims_lib.FAILS, claims_lib.UNDECIDED, claims_lib.HOLDS)
_HEADER = ("verdict", "claim", "condition", "statistic", "estimate", "95 % interval", "wanted", "section", "experiment")


class _Row(NamedTuple):
    """A claim, its corrected verdict, and the name of its experiment."""

    claim: claims_lib.Tested
    verdict: str
    experiment: str


def write(results: base.Results, tell: callbacks.Tell = callbacks.ignore) -> Path:
    """Draws every figure and tests every claim with data; returns the path of the Markdown.

    Args:
      results: the folder with the data.
      tell: called with lines about the progress.

    Raises:
      ValueError: if there is no such folder.
    """
    if not results.path.is_dir():
        raise ValueError(f"{results.path} is no folder; `physexp reproduce` makes one with results")
    rows: list[_Row] = []
    sections: list[str] = []
    missing = []
    for experiment in EXPERIMENTS.values():
        try:
            data = experiment.load(results)
        except ValueError as error:
            missing.append(f"Left out: {experiment.name}: {error}")
            tell(f"left out {experiment.name}: {error}")
            continue
        plots.save(experiment.figure(data), results.path / "figures", experiment.name)
        sections += _section(experiment, data, results)
        found = experiment.test(data)
        verdicts = claims_lib.corrected(found)
        rows += [_Row(claim, verdict, experiment.name) for claim, verdict in zip(found, verdicts, strict=True)]
        tell(f"drew {experiment.name}")
    ours = [row for row in rows if row.claim.section == claims_lib.OURS]
    papers = [row for row in rows if row.claim.section != claims_lib.OURS]
    runs = results.load("runs", ["run", "commit", "config"])
    paragraphs = [
        "# Results",
        *summary.paragraphs([(row.claim, row.verdict) for row in papers if not row.claim.is_check], runs.config),
        _INTRODUCTION,
        *_table_of_claims("Claims of the paper", papers),
        *_table_of_claims("Claims of ours", ours),
        *sections,
        *missing,
        "## Provenance",
        *_provenance(runs),
    ]
    path = results.path / "report.md"
    files.write_atomically(path, ("\n\n".join(paragraphs) + "\n").encode())
    return path


def _section(experiment: base.Experiment, data: Any, results: base.Results) -> list[str]:
    """Returns the paragraphs about an experiment."""
    paragraphs = [
        f'<a id="{_anchor(experiment.name)}"></a>',
        f"## {experiment.title} ({experiment.section})",
        f"![{experiment.title}](figures/{experiment.name}.png)",
        experiment.caption,
    ]
    if experiment.table and (table := experiment.table(data)):
        paragraphs.append(_markdown_table(table))
    finished = set(results.load("runs", ["run"]).run)
    seeds = collections.defaultdict(list)
    for job in sweep.jobs([experiment], conditions.OBSERVATIONS, conditions.SEEDS.__getitem__):
        if job.config.name not in finished:
            condition, _, seed = job.config.name.rpartition("-seed")
            seeds[condition].append(seed)
    if seeds:
        words = "; ".join(f"{condition} ({', '.join(its)})" for condition, its in seeds.items())
        paragraphs.append(f"Planned, and not trained yet (seeds): {words}.")
    return paragraphs


def _table_of_claims(title: str, rows: Sequence[_Row]) -> list[str]:
    """Returns the paragraphs about claims: failures first, sanity checks last, and the reasons of failures."""
    if not rows:
        return []
    rows = sorted(rows, key=lambda row: (row.claim.is_check, _VERDICTS.index(row.verdict)))
    counted = [row.verdict for row in rows if not row.claim.is_check]
    tally = ", ".join(f"{counted.count(verdict)} {verdict}" for verdict in reversed(_VERDICTS))
    failing = [row.claim for row in rows if row.verdict == claims_lib.FAILS and row.claim.reason]
    return [
        f"## {title}",
        f"{tally}; sanity checks: {len(rows) - len(counted)}.",
        _markdown_table([_HEADER, *map(_cells, rows)]),
        *dict.fromkeys(f'Why "{claim.text}" fails: {claim.reason}' for claim in failing),
    ]


def _cells(row: _Row) -> tuple[str, ...]:
    claim, estimate = row.claim, row.claim.estimate
    return (
        f"**{row.verdict} (sanity check)**" if claim.is_check else f"**{row.verdict}**",
        claim.text,
        conditions.spelled_out(claim.condition),
        f"{claim.statistic}; found in these data" if claim.is_found else claim.statistic,
        _number(estimate.value),
        f"{_number(estimate.low)} to {_number(estimate.high)}",
        f"{claim.wanted}: “{claim.quote}”" if claim.quote else claim.wanted,
        claim.section,
        f"[{row.experiment}](#{_anchor(row.experiment)})",
    )


def _number(value: float) -> str:
    if math.isnan(value):
        return "unknown"
    return f"{value:.3g}" if math.isfinite(value) else ("-∞" if value < 0 else "∞")


def _anchor(experiment: str) -> str:
    return experiment.replace("_", "-")


def _markdown_table(rows: Sequence[Sequence[str]]) -> str:
    """Returns a header and rows as a table."""
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([lines[0], "|" + "---|" * len(rows[0]), *lines[1:]])


def _provenance(runs: Any) -> list[str]:
    """Returns the number of agents from each commit, and the commit of the report."""
    commits = (text.escaped(provenance.shortened(commit)) for commit in runs.commit)
    made = ", ".join(f"{number} by {commit}" for commit, number in collections.Counter(commits).items())
    return [
        f"Agents: {len(runs)}, trained by the source of these commits: {made}.",
        f"Figures and verdicts: made by {provenance.shortened(provenance.commit())}.",
    ]
