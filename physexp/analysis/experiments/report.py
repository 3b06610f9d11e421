"""The report: every figure, and the table of claims, as Markdown."""

import collections
import dataclasses
import math
from pathlib import Path
from typing import Any

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


@dataclasses.dataclass(frozen=True)
class _Tested:
    """A claim, its verdict, corrected, and the experiment that it is of."""

    claim: claims_lib.Tested
    verdict: str
    experiment: base.Experiment

    @property
    def words(self) -> str:
        """Its verdict, and whether it counts."""
        return f"{self.verdict} (sanity check)" if self.claim.is_check else self.verdict


@dataclasses.dataclass(frozen=True)
class _Shown:
    """An experiment with a figure, its table (a header and rows of words), and a sentence on missing agents."""

    experiment: base.Experiment
    table: list[tuple[str, ...]]
    missing: str


_VERDICTS = (claims_lib.FAILS, claims_lib.UNDECIDED, claims_lib.HOLDS)
_TABLES = {
    "Claims of the paper": lambda claim: claim.section != claims_lib.OURS,
    "Claims of ours": lambda claim: claim.section == claims_lib.OURS,
}


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
    shown: list[_Shown] = []
    tested: list[_Tested] = []
    missing = []
    for experiment in EXPERIMENTS.values():
        try:
            frame = experiment.load(results)
        except ValueError as error:
            missing.append(f"{experiment.name}: {error}")
            tell(f"left out {missing[-1]}")
            continue
        plots.save(experiment.figure(frame), results.path / "figures", experiment.name)
        table = experiment.table(frame) if experiment.table else []
        shown.append(_Shown(experiment, table, _missing(experiment, results)))
        found = experiment.test(frame)
        verdicts = claims_lib.corrected(found)
        tested += [_Tested(claim, verdict, experiment) for claim, verdict in zip(found, verdicts, strict=True)]
        tell(f"drew {experiment.name}")
    path, runs = results.path / "report.md", results.load("runs", ["run", "commit", "config"])
    files.write_atomically(path, _markdown(shown, tested, missing, runs).encode())
    return path


def _missing(experiment: base.Experiment, results: base.Results) -> str:
    """Returns a sentence about the planned agents that are not trained yet; nothing where there are none."""
    finished = set(results.load("runs", ["run"]).run)
    seeds = collections.defaultdict(list)
    for job in sweep.jobs([experiment], conditions.OBSERVATIONS, conditions.SEEDS.__getitem__):
        if job.config.name not in finished:
            condition, _, seed = job.config.name.rpartition("-seed")
            seeds[condition].append(seed)
    words = "; ".join(f"{condition} ({', '.join(its)})" for condition, its in seeds.items())
    return f"Planned, and not trained yet (seeds): {words}." if words else ""


def _summary(tested: list[_Tested], runs: Any) -> dict[str, list[str]]:
    """Returns the paragraphs at the beginning, and the points below each."""
    claims = [(one.claim, one.verdict) for one in tested if one.claim.section != claims_lib.OURS]
    counted = [(claim, verdict) for claim, verdict in claims if not claim.is_check]
    sentences = " ".join(filter(None, [summary.in_numbers(counted), summary.of_workers(runs.config)]))
    return {sentences: [], **summary.of_claims(counted), _INTRODUCTION: []}


def _provenance(runs: Any) -> list[str]:
    """Returns the number of agents from each commit, and the commit of the report."""
    commits = (text.escaped(provenance.shortened(commit)) for commit in runs.commit)
    made = ", ".join(f"{number} by {commit}" for commit, number in collections.Counter(commits).items())
    return [
        f"Agents: {len(runs)}, trained by the source of these commits: {made}.",
        f"Figures and verdicts: made by {provenance.shortened(provenance.commit())}.",
    ]


def _tables(tested: list[_Tested]) -> dict[str, list[_Tested]]:
    """Returns the claims of each table, failures first and sanity checks last."""
    tables = {}
    for title, belongs in _TABLES.items():
        rows = [one for one in tested if belongs(one.claim)]
        tables[title] = sorted(rows, key=lambda one: (one.claim.is_check, _VERDICTS.index(one.verdict)))
    return {title: rows for title, rows in tables.items() if rows}


def _tally(rows: list[_Tested]) -> str:
    counted = [one.verdict for one in rows if not one.claim.is_check]
    tally = ", ".join(f"{counted.count(verdict)} {verdict}" for verdict in reversed(_VERDICTS))
    return f"{tally}; sanity checks: {len(rows) - len(counted)}"


_HEADER = ("verdict", "claim", "condition", "statistic", "estimate", "95 % interval", "wanted", "section", "experiment")


def _row(one: _Tested) -> tuple[str, ...]:
    """Returns a claim under `_HEADER`, without verdict and experiment at its ends."""
    claim, estimate = one.claim, one.claim.estimate
    return (
        claim.text,
        conditions.spelled_out(claim.condition),
        f"{claim.statistic}; found in these data" if claim.is_found else claim.statistic,
        _number(estimate.value),
        f"{_number(estimate.low)} to {_number(estimate.high)}",
        f"{claim.wanted}: “{claim.quote}”" if claim.quote else claim.wanted,
        claim.section,
    )


def _number(value: float) -> str:
    if math.isnan(value):
        return "unknown"
    return f"{value:.3g}" if math.isfinite(value) else ("-∞" if value < 0 else "∞")


def _reasons(rows: list[_Tested]) -> list[str]:
    """Returns our explanations of the claims that fail, each once."""
    failing = [one.claim for one in rows if one.verdict == claims_lib.FAILS and one.claim.reason]
    return list(dict.fromkeys(f'Why "{claim.text}" fails: {claim.reason}' for claim in failing))


def _anchor(experiment: base.Experiment) -> str:
    return experiment.name.replace("_", "-")


def _markdown(shown: list[_Shown], tested: list[_Tested], missing: list[str], runs: Any) -> str:
    lines = ["# Results", ""]
    for paragraph, points in _summary(tested, runs).items():
        lines += [paragraph, "", *(f"- {point}" for point in points), ""] if points else [paragraph, ""]
    for title, rows in _tables(tested).items():
        lines += [f"## {title}", "", f"{_tally(rows)}.", ""]
        lines += _header(_HEADER)
        lines += [
            " | ".join((f"| **{one.words}**", *_row(one), f"[{one.experiment.name}](#{_anchor(one.experiment)}) |"))
            for one in rows
        ]
        lines += [""] + [part for reason in _reasons(rows) for part in (reason, "")]
    for one in shown:
        experiment, table = one.experiment, one.table
        lines += [
            f'<a id="{_anchor(experiment)}"></a>',
            "",
            f"## {experiment.title} ({experiment.section})",
            "",
            f"![{experiment.title}](figures/{experiment.name}.png)",
            "",
            experiment.caption,
            "",
        ]
        if table:
            lines += [*_header(table[0]), *("| " + " | ".join(row) + " |" for row in table[1:]), ""]
        if one.missing:
            lines += [one.missing, ""]
    lines += [part for line in missing for part in (f"Left out: {line}", "")]
    lines += ["## Provenance", "", *(part for line in _provenance(runs) for part in (line, ""))]
    return "\n".join(lines).rstrip() + "\n"


def _header(names) -> list[str]:
    """Returns the first two lines of a Markdown table."""
    return ["| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
