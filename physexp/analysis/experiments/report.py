"""The report: a summary of the paper's claims, every figure, and the table of all claims, as Markdown."""

import collections
from collections.abc import Sequence
import contextlib
import json
import math
from pathlib import Path
from typing import Any, NamedTuple

from physexp.agents import files
from physexp.analysis.data import estimates, plots, provenance, text
from physexp.analysis.experiments import EXPERIMENTS, base, conditions, sweep
from physexp.analysis.experiments import claims as claims_lib
from physexp.analysis.training import callbacks, records

_INTRODUCTION = (
    "The paper is *Learning to Perform Physics Experiments via Deep Reinforcement Learning* (Denil et al., ICLR "
    "2017); its claims and ours are tested on stored data. A claim holds where its statistic lies inside the range "
    "wanted, fails where it lies outside, and is undecided where the data, or too few agents, cannot tell at a level "
    "of 5 %, corrected for the number of conditions in which the same claim is tested (Holm, 1979); the 95 % "
    "intervals shown are not corrected. Sanity checks, which could fail only if something were broken, are not "
    "counted. The ranges of all claims, and when each was written down, are in docs/plan.md; a statistic that was "
    "found in these data says so, and its verdict describes them. Conditions with fewer "
    "agents than planned are named below their figure."
)
_POWER = (
    "**Power.** Claims about agents are about their mean, with Student's interval, so one agent decides nothing. Four "
    "times in five, before the correction, a mean is told from the end of a range that is so many standard deviations "
    "of the agents away: {} agents."
)
_NUMBERS = (2, 3, 4, 5, 6, 10)  # Of agents in a condition.

_VERDICTS = (claims_lib.FAILS, claims_lib.UNDECIDED, claims_lib.HOLDS)
_HEADER = ("verdict", "claim", "condition", "statistic", "estimate", "95 % interval", "wanted", "section", "experiment")


class Row(NamedTuple):
    """A claim, its corrected verdict, and the name of its experiment."""

    claim: claims_lib.Tested
    verdict: str
    experiment: str


def write(results: base.Results, tell: callbacks.Tell = callbacks.ignore) -> Path:
    """Draws every figure and tests every claim with data; returns the path of the Markdown.

    Raises:
      ValueError: if the folder of the results does not exist.
    """
    if not results.path.is_dir():
        raise ValueError(f"{results.path} is no folder; `physexp reproduce` makes one with results")
    rows: list[Row] = []
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
        rows += [Row(claim, verdict, experiment.name) for claim, verdict in zip(found, verdicts, strict=True)]
        tell(f"drew {experiment.name}")
    ours = [row for row in rows if row.claim.section == claims_lib.OURS]
    papers = [row for row in rows if row.claim.section != claims_lib.OURS]
    runs = results.load("runs", ["run", "commit", "config"])
    paragraphs = [
        "# Results",
        *_summary([row for row in papers if not row.claim.is_check], runs.config),
        _INTRODUCTION,
        _POWER.format(", ".join(f"{estimates.detectable(number):.1f} with {number}" for number in _NUMBERS)),
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


def _summary(rows: Sequence[Row], configs: Sequence[str]) -> list[str]:
    """Returns a paragraph in plain words, and below a heading for each verdict a point for each claim.

    A claim counts with the worst verdict of its conditions. `configs` are those of the runs, in JSON.
    """
    by_text = collections.defaultdict(list)
    for row in rows:
        by_text[row.claim.text, row.claim.section].append(row)
    groups: dict[str, list[list[Row]]] = {verdict: [] for verdict in _VERDICTS}
    for its in by_text.values():
        groups[_worst(its)].append(its)
    held, failed, is_open = (groups[verdict] for verdict in (claims_lib.HOLDS, claims_lib.FAILS, claims_lib.UNDECIDED))
    numbers = (
        f"Of {len(by_text)} claims of the paper, {len(held)} hold wherever they are tested, {len(failed)} fail "
        f"somewhere, and {len(is_open)} cannot be decided somewhere."
    )
    words = [
        numbers,
        _plainly("Replicated", held),
        _plainly("Not replicated", failed),
        _plainly("Undecided", is_open),
        _workers(configs),
    ]
    points = {
        "Replicated:": [f"{_named(its)} ({len(its)} condition{'' if len(its) == 1 else 's'})." for its in held],
        "Not replicated:": [
            " ".join([_failure(its), *map(_opening, _with(its, claims_lib.UNDECIDED))]) for its in failed
        ],
        "Undecided:": [
            " ".join([f"{_named(its)}.", *map(_opening, _with(its, claims_lib.UNDECIDED))]) for its in is_open
        ],
    }
    found = [" ".join(filter(None, words))]
    for heading, sentences in points.items():
        if sentences:
            found += [heading, "\n".join(f"- {sentence}" for sentence in sentences)]
    return found


def _plainly(heading: str, claims: Sequence[Sequence[Row]]) -> str:
    """Returns a heading and the plain words that claims have for their verdict and conditions; nothing without."""
    sentences = []
    for its in claims:
        values = {row.claim.condition: row.claim.estimate.value for row in its}
        with contextlib.suppress(KeyError):
            sentences.append(its[0].claim.plainly[_worst(its)].format_map(values))
    return " ".join([f"**{heading}.**", *sentences]) if sentences else ""


def _worst(rows: Sequence[Row]) -> str:
    return min((row.verdict for row in rows), key=_VERDICTS.index)


def _workers(configs: Sequence[str]) -> str:
    """Returns a sentence on the numbers of workers of the A3C agents; nothing without such agents."""
    agents = [json.loads(config)["agent"] for config in configs]
    counts = collections.Counter(agent["num_workers"] for agent in agents if agent["algorithm"] == "a3c")
    told = [f"{each} with {number}" for number, each in sorted(counts.items(), reverse=True)]
    return f"A3C agents, by their asynchronous workers: {', '.join(told)}." if told else ""


def _with(rows: Sequence[Row], verdict: str) -> list[claims_lib.Tested]:
    return [row.claim for row in rows if row.verdict == verdict]


def _named(rows: Sequence[Row]) -> str:
    """Returns a claim with its section, since the paper claims some things of several tasks."""
    return f"Section {rows[0].claim.section}: {rows[0].claim.text}"


def _failure(rows: Sequence[Row]) -> str:
    """Returns a sentence on a claim and its failures, with our explanation."""
    failing = _with(rows, claims_lib.FAILS)
    where = "; ".join(conditions.spelled_out(claim.condition) for claim in failing)
    reasons = dict.fromkeys(claim.reason for claim in failing if claim.reason)
    return " ".join([f"{_named(rows)}: fails in {len(failing)} of {len(rows)} ({where}).", *reasons])


def _opening(claim: claims_lib.Tested) -> str:
    """Returns a sentence on a condition in which a claim is undecided: the reason."""
    where, estimate = conditions.spelled_out(claim.condition), claim.estimate
    if not estimate.can_be_tested:
        return f"Undecided in {where}: too few agents."
    interval = f"Undecided in {where}: the interval, {estimate.low:.3g} to {estimate.high:.3g},"
    if claim.verdict == claims_lib.UNDECIDED:
        return f"{interval} reaches across an end of the wanted range, {claim.wanted}."
    return f"{interval} is too near an end of the wanted range, {claim.wanted}, for as many tests of one claim."


def _section(experiment: base.Experiment, data: Any, results: base.Results) -> list[str]:
    """Returns the paragraphs about an experiment."""
    paragraphs = [
        f'<a id="{_anchor(experiment.name)}"></a>',
        f"## {experiment.title} ({experiment.section})",
        f"![{experiment.title}](figures/{experiment.name}.png)",
        experiment.caption,
    ]
    if experiment.table and (table := experiment.table(data)):
        paragraphs.append(markdown_table(table))
    finished = set(results.load("runs", ["run"]).run)
    is_trained = collections.defaultdict(list)
    for job in sweep.jobs([experiment], conditions.OBSERVATIONS, conditions.SEEDS.__getitem__):
        is_trained[records.condition_id(job.config)].append(job.config.name in finished)
    open_conditions = {condition: its for condition, its in is_trained.items() if not all(its)}
    if open_conditions:
        words = "; ".join(f"{condition} ({sum(its)} of {len(its)})" for condition, its in open_conditions.items())
        paragraphs.append(f"Conditions with fewer agents than planned: {words}.")
    return paragraphs


def _table_of_claims(title: str, rows: Sequence[Row]) -> list[str]:
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
        markdown_table([_HEADER, *map(cells, rows)]),
        *dict.fromkeys(f'Why "{claim.text}" fails: {claim.reason}' for claim in failing),
    ]


def cells(row: Row) -> tuple[str, ...]:
    """Returns the cells of a claim in the table of claims."""
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


def markdown_table(rows: Sequence[Sequence[str]]) -> str:
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
