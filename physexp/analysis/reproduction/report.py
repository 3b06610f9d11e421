"""The report: every figure, and the table of claims, as Markdown and as one HTML page."""

import base64
import html
import math
from pathlib import Path

from physexp.agents import files
from physexp.analysis import callbacks
from physexp.analysis.data import provenance
from physexp.analysis.evaluation import figures
from physexp.analysis.experiments import EXPERIMENTS, base, conditions
from physexp.analysis.experiments import claims as claims_lib
from physexp.analysis.training import run as run_lib

_INTRODUCTION = (
    "What *Learning to Perform Physics Experiments via Deep Reinforcement Learning* (Denil et al., ICLR 2017) reports, "
    "made again from stored data. A claim holds where the 95 % interval of its statistic lies inside the range wanted, "
    "fails where it lies outside, and is undecided where it crosses the border or where too few agents were trained."
)


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
    sections, missing = [], []
    for experiment in EXPERIMENTS.values():
        try:
            frame = experiment.load(results)
        except ValueError as error:
            missing.append(f"{experiment.name}: {error}")
            tell(f"left out {missing[-1]}")
            continue
        figures.save(experiment.figure(frame), results.path / "figures", experiment.name)
        sections.append((experiment, experiment.claims(frame)))
        tell(f"drew {experiment.name}")
    markdown = results.path / "report.md"
    files.write_atomically(markdown, _markdown(sections, missing, results).encode())
    files.write_atomically(results.path / "report.html", _page(sections, missing, results).encode())
    return markdown


def _provenance(results: base.Results) -> list[str]:
    """Which commits made the agents and how many there are."""
    counts: dict[str, int] = {}
    for folder in sorted((results.path / "runs").glob("*")):
        commit = run_lib.Run(folder).facts.get("commit", "unknown")[:10]
        counts[commit] = counts.get(commit, 0) + 1
    made = ", ".join(f"{number} by {commit}" for commit, number in counts.items())
    return [
        f"Agents: {sum(counts.values())}, trained by the source of these commits: {made}.",
        f"Figures and verdicts: made by {provenance.commit()[:11]}.",
    ]


def _tally(sections) -> str:
    verdicts = [claim.verdict for _, found in sections for claim in found]
    kinds = (claims_lib.HOLDS, claims_lib.FAILS, claims_lib.UNDECIDED)
    return ", ".join(f"{verdicts.count(kind)} {kind}" for kind in kinds)


_HEADER = ("claim", "section", "condition", "statistic", "estimate", "95 % interval", "wanted", "verdict")


def _row(claim: claims_lib.Claim) -> tuple[str, ...]:
    """Returns a claim under `_HEADER`."""
    estimate = claim.estimate
    interval = f"{_number(estimate.low)} to {_number(estimate.high)}"
    return (
        claim.text,
        claim.section,
        conditions.spelled_out(claim.condition),
        claim.statistic,
        _number(estimate.value),
        interval,
        claim.wanted,
        claim.verdict,
    )


_OPEN_HEADER = ("verdict", "claim", "condition", "95 % interval", "wanted", "experiment")


def _open(sections) -> list[tuple[tuple[str, ...], base.Experiment]]:
    """Returns rows under `_OPEN_HEADER` of what does not hold, failures first; the experiment stands apart."""
    claims = [(claim, experiment) for experiment, found in sections for claim in found]
    rows: list[tuple[tuple[str, ...], base.Experiment]] = []
    for verdict in (claims_lib.FAILS, claims_lib.UNDECIDED):
        for claim, experiment in claims:
            if claim.verdict == verdict:
                text, _, condition, _, _, interval, wanted, _ = _row(claim)
                rows.append(((verdict, text, condition, interval, wanted), experiment))
    return rows


def _number(value: float) -> str:
    return f"{value:.3g}" if math.isfinite(value) else ("-∞" if value < 0 else "∞")


def _reasons(found: list[claims_lib.Claim]) -> list[str]:
    """Returns our explanations of the claims that fail, each once."""
    failing = [claim for claim in found if claim.verdict == claims_lib.FAILS and claim.reason]
    return list(dict.fromkeys(f'Why "{claim.text}" fails: {claim.reason}' for claim in failing))


_OPEN_TITLE = "What does not hold"


def _anchor(experiment: base.Experiment) -> str:
    return experiment.name.replace("_", "-")


def _table(header: tuple[str, ...]) -> list[str]:
    return ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]


def _markdown(sections, missing, results) -> str:
    lines = ["# Results", "", _INTRODUCTION, "", *_provenance(results), "", f"Verdicts: {_tally(sections)}.", ""]
    if _open(sections):
        lines += [f"## {_OPEN_TITLE}", "", *_table(_OPEN_HEADER)]
        lines += [
            f"| **{verdict}** | " + " | ".join(row) + f" | [{experiment.name}](#{_anchor(experiment)}) |"
            for (verdict, *row), experiment in _open(sections)
        ]
        lines += [""]
    for experiment, found in sections:
        lines += [
            f'<a id="{_anchor(experiment)}"></a>',
            "",
            f"## {experiment.title} ({experiment.section})",
            "",
            f"![{experiment.title}](figures/{experiment.name}.png)",
            "",
            experiment.caption,
            "",
            *_table(_HEADER),
        ]
        lines += ["| " + " | ".join(row[:-1]) + f" | **{row[-1]}** |" for row in map(_row, found)]
        lines += [""] + [text for reason in _reasons(found) for text in (reason, "")]
    lines += [text for line in missing for text in (f"Left out: {line}", "")]
    return "\n".join(lines).rstrip() + "\n"


def _head(header: tuple[str, ...]) -> str:
    return "<tr>" + "".join(f"<th>{name}</th>" for name in header) + "</tr>"


def _page(sections, missing, results) -> str:
    parts = [
        f"<p>{html.escape(text).replace('*', '')}</p>"
        for text in (_INTRODUCTION, *_provenance(results), f"Verdicts: {_tally(sections)}.")
    ]
    if _open(sections):
        body = "".join(
            f'<tr><td class="{verdict}">{verdict}</td>'
            + "".join(f"<td>{html.escape(cell)}</td>" for cell in row)
            + f'<td><a href="#{_anchor(experiment)}">{experiment.name}</a></td></tr>'
            for (verdict, *row), experiment in _open(sections)
        )
        parts.append(f"<h2>{_OPEN_TITLE}</h2><table>{_head(_OPEN_HEADER)}{body}</table>")
    for experiment, found in sections:
        image = base64.b64encode((results.path / "figures" / f"{experiment.name}.svg").read_bytes()).decode()
        body = "".join(
            "<tr>"
            + "".join(f"<td>{html.escape(cell)}</td>" for cell in row[:-1])
            + f'<td class="{row[-1]}">{row[-1]}</td></tr>'
            for row in map(_row, found)
        )
        parts.append(
            f'<h2 id="{_anchor(experiment)}">{html.escape(experiment.title)} '
            f"<small>{html.escape(experiment.section)}</small></h2>"
            f'<img alt="{html.escape(experiment.title)}" src="data:image/svg+xml;base64,{image}">'
            f"<p>{html.escape(experiment.caption)}</p><table>{_head(_HEADER)}{body}</table>"
            + "".join(f"<p>{html.escape(reason)}</p>" for reason in _reasons(found))
        )
    parts += [f"<p>Left out: {html.escape(line)}</p>" for line in missing]
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
