"""The tables of the plan: agents and claims of every experiment, from the code, when the pages are built."""

from collections.abc import Iterable, Mapping, Sequence

from physexp.analysis.experiments import EXPERIMENTS, base, claims, conditions, report


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Returns a Markdown table; nothing without rows."""
    rows = list(rows)
    return report.markdown_table([header, *rows]) + "\n" if rows else ""


def changes() -> str:
    """Returns the table of changes that were made when some data were known."""
    later = [(name, *pair) for name, row in claims.table().items() for pair in row.get("later", [])]
    rows = [(f"{name}: {change}", known) for name, change, known in later]
    return table(("change", "data known by then"), rows)


def section(experiment: base.Experiment) -> str:
    """Returns the part of the plan on an experiment."""
    agents = [
        (each.id, f"{each.agent.frames:,}", f"0 to {conditions.SEEDS[each.observations] - 1}")
        for each in experiment.conditions
    ]
    written = claims.table()[experiment.name]["written"]
    played = f"They play: {', '.join(trial.name for trial in experiment.trials)}.\n" if experiment.trials else ""
    return "\n".join(
        [
            f"## {experiment.name}\n",
            f"{experiment.title} ({experiment.section}). Ranges written {written} the agents were trained.\n",
            table(("agents", "environment steps each", "seeds"), agents),
            played,
            table(("claim", "section", "tested on", "statistic", "wanted"), map(row, experiment.claims)),
        ]
    )


def row(claim: claims.Claim) -> tuple[str, ...]:
    """Returns the row of a claim."""
    statistic = f"{claim.statistic}; found in these data" if claim.is_found else claim.statistic
    limits = f"{wanted(claim)}: “{claim.quote}”" if claim.quote else wanted(claim)
    if claim.is_check:
        limits += ", a sanity check"
    return claim.text, claim.section, "; ".join(map(conditions.spelled_out, claim.on)), statistic, limits


def wanted(claim: claims.Claim) -> str:
    """Returns the range of a claim, for each condition if they differ."""
    ends = [end for end in (claim.above, claim.below) if isinstance(end, Mapping)]
    if not ends:
        return claims.wanted(claim.above, claim.below)
    sign = ">" if isinstance(claim.above, Mapping) else "<"
    return "; ".join(f"{conditions.spelled_out(name)}: {sign} {end:g}" for name, end in ends[0].items())


def fill(app, docname: str, source: list[str]) -> None:
    """Replaces the marks in the page of the plan by tables."""
    if docname == "plan":
        sections = "\n".join(map(section, EXPERIMENTS.values()))
        source[0] = source[0].replace("<!-- changes -->", changes()).replace("<!-- experiments -->", sections)


def setup(app) -> dict:
    """Connects to the reading of pages."""
    app.connect("source-read", fill)
    return {"parallel_read_safe": True}
