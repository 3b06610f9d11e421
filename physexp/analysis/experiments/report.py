"""The report: every figure, and the table of claims, as Markdown and as one HTML page."""

import base64
import collections
import dataclasses
import html
import math
from pathlib import Path

from physexp.agents import files
from physexp.analysis.data import plots, provenance, text
from physexp.analysis.experiments import EXPERIMENTS, base, conditions, summary, sweep
from physexp.analysis.experiments import claims as claims_lib
from physexp.analysis.training import callbacks
from physexp.analysis.training import run as run_lib

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

    claim: claims_lib.Claim
    verdict: str
    experiment: base.Experiment

    @property
    def words(self) -> str:
        """Its verdict, and whether it counts."""
        return f"{self.verdict} (sanity check)" if self.claim.is_sanity_check else self.verdict


@dataclasses.dataclass(frozen=True)
class _Shown:
    """An experiment whose figure was drawn; its table, a header and rows of words; and which agents are missing."""

    experiment: base.Experiment
    table: list[tuple[str, ...]]
    missing: str


_VERDICTS = (claims_lib.FAILS, claims_lib.UNDECIDED, claims_lib.HOLDS)
_TABLES = {
    "Claims of the paper": lambda claim: claim.section != claims_lib.OURS,
    "Claims of ours": lambda claim: claim.section == claims_lib.OURS,
}


def write(results: base.Results, tell: callbacks.Tell = callbacks.ignore) -> Path:
    """Draws every figure and tests every claim that there is data for; returns the path of the Markdown.

    Args:
      results: the folder with the data.
      tell: called with lines that tell how it goes.

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
        found = experiment.claims(frame)
        verdicts = claims_lib.corrected(found)
        tested += [_Tested(claim, verdict, experiment) for claim, verdict in zip(found, verdicts, strict=True)]
        tell(f"drew {experiment.name}")
    markdown, runs = results.path / "report.md", _finished(results)
    files.write_atomically(markdown, _markdown(shown, tested, missing, runs).encode())
    files.write_atomically(results.path / "report.html", _page(shown, tested, missing, runs, results).encode())
    return markdown


def _missing(experiment: base.Experiment, results: base.Results) -> str:
    """Says which agents of the plan are not trained yet; nothing where all are."""
    seeds = collections.defaultdict(list)
    for job in sweep.jobs([experiment], conditions.OBSERVATIONS, conditions.SEEDS.__getitem__):
        if not results.run(job.config).is_finished:
            condition, _, seed = job.config.name.rpartition("-seed")
            seeds[condition].append(seed)
    words = "; ".join(f"{condition} ({', '.join(its)})" for condition, its in seeds.items())
    return f"Planned, and not trained yet (seeds): {words}." if words else ""


def _finished(results: base.Results) -> list[run_lib.Run]:
    """Returns the runs of all agents; those that are still in training are left out."""
    runs = [run_lib.Run(path.parent) for path in sorted((results.path / "runs").glob("*/config.json"))]
    return [run for run in runs if run.is_finished]


def _summary(tested: list[_Tested], runs: list[run_lib.Run]) -> dict[str, list[str]]:
    """Returns the paragraphs at the beginning, and the points below each."""
    claims = [(one.claim, one.verdict) for one in tested if one.claim.section != claims_lib.OURS]
    counted = [(claim, verdict) for claim, verdict in claims if not claim.is_sanity_check]
    sentences = " ".join(filter(None, [summary.in_numbers(counted), summary.of_workers(runs)]))
    return {sentences: [], **summary.of_claims(counted), _INTRODUCTION: []}


def _provenance(runs: list[run_lib.Run]) -> list[str]:
    """Returns how many agents each commit has made, and the commit that has made the report."""
    commits = (text.escaped(provenance.shortened(str(run.facts.get("commit", "unknown")))) for run in runs)
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
        tables[title] = sorted(rows, key=lambda one: (one.claim.is_sanity_check, _VERDICTS.index(one.verdict)))
    return {title: rows for title, rows in tables.items() if rows}


def _tally(rows: list[_Tested]) -> str:
    counted = [one.verdict for one in rows if not one.claim.is_sanity_check]
    tally = ", ".join(f"{counted.count(verdict)} {verdict}" for verdict in reversed(_VERDICTS))
    return f"{tally}; sanity checks: {len(rows) - len(counted)}"


_HEADER = ("verdict", "claim", "condition", "statistic", "estimate", "95 % interval", "wanted", "section", "experiment")


def _row(one: _Tested) -> tuple[str, ...]:
    """Returns a claim under `_HEADER`, without verdict and experiment at its ends."""
    claim, estimate = one.claim, one.claim.estimate
    return (
        claim.text,
        conditions.spelled_out(claim.condition),
        claim.statistic,
        _number(estimate.value),
        f"{_number(estimate.low)} to {_number(estimate.high)}",
        f"{claim.wanted}: “{claim.words}”" if claim.words else claim.wanted,
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


def _markdown(shown, tested, missing, runs) -> str:
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


def _page(shown, tested, missing, runs, results) -> str:
    parts = []
    for paragraph, points in _summary(tested, runs).items():
        parts.append(f"<p>{html.escape(paragraph).replace('*', '')}</p>")
        parts += [f"<ul>{''.join(f'<li>{html.escape(point)}</li>' for point in points)}</ul>"] if points else []
    head = "".join(f"<th>{name}</th>" for name in _HEADER)
    for title, rows in _tables(tested).items():
        body = "".join(
            f'<tr><td class="{one.verdict}">{one.words}</td>'
            + "".join(f"<td>{html.escape(cell)}</td>" for cell in _row(one))
            + f'<td><a href="#{_anchor(one.experiment)}">{one.experiment.name}</a></td></tr>'
            for one in rows
        )
        parts.append(f"<h2>{title}</h2><p>{_tally(rows)}.</p><table><tr>{head}</tr>{body}</table>")
        parts += [f"<p>{html.escape(reason)}</p>" for reason in _reasons(rows)]
    for one in shown:
        experiment, table = one.experiment, one.table
        image = base64.b64encode((results.path / "figures" / f"{experiment.name}.svg").read_bytes()).decode()
        parts.append(
            f'<h2 id="{_anchor(experiment)}">{html.escape(experiment.title)} '
            f"<small>{html.escape(experiment.section)}</small></h2>"
            f'<img alt="{html.escape(experiment.title)}" src="data:image/svg+xml;base64,{image}">'
            f"<p>{html.escape(experiment.caption)}</p>"
        )
        if table:
            cells = [
                "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in row)
                for tag, row in zip(["th"] + ["td"] * len(table), table, strict=False)
            ]
            parts.append("<table>" + "".join(f"<tr>{row}</tr>" for row in cells) + "</table>")
        if one.missing:
            parts.append(f"<p>{html.escape(one.missing)}</p>")
    parts += [f"<p>Left out: {html.escape(line)}</p>" for line in missing]
    parts += ["<h2>Provenance</h2>", *(f"<p>{line}</p>" for line in _provenance(runs))]
    return f"<!doctype html><meta charset=utf-8><title>physexp: results</title><style>{_STYLE}</style>" + (
        "<h1>Results</h1>" + "\n".join(parts) + "\n"
    )


_STYLE = """
body {font: 15px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; color: #222}
img {max-width: 100%; height: auto; display: block; margin: 1rem 0}
table {border-collapse: collapse; font-size: 13px} td, th {border-bottom: 1px solid #ccc; padding: .25rem .5rem;
text-align: left; vertical-align: top} small {color: #777; font-weight: normal}
.holds {color: #00664b; font-weight: bold} .fails {color: #b33; font-weight: bold} .undecided {color: #666}
"""
