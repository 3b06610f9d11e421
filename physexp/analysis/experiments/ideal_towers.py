"""The ideal experimenters of Towers, computed once and kept with the results."""

from collections.abc import Callable
from typing import Any

from physexp.analysis.domains import towers
from physexp.analysis.experiments import base, conditions
from physexp.analysis.ideal import search

# How coarsely the observer sees: metres for features, differing pixels for images.
RESOLUTIONS = {"features": (0.0, 0.001, 0.003, 0.01, 0.03), "pixels": (0.0, 10.0, 30.0, 100.0)}


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Computes the ideal experimenters of all tasks that are not there yet; `report` is told which."""
    for condition in conditions.TOWERS:
        path = _path(results, condition.task)
        if not path.exists():
            report(f"searching for the ideal experimenter of {condition.task}")
            resolutions = RESOLUTIONS[conditions.observations(condition)]
            rows = search.curve(towers.hypotheses(condition.task), resolutions, condition.agent.discount)
            base.keep_made(path, rows)


def read(results: base.Results) -> dict[str, list[dict]]:
    """By task, the summaries of `search.curve`.

    Raises:
      ValueError: if they have not been computed, or a file is damaged.
    """
    return {
        condition.task: base.read_made(_path(results, condition.task), "ideal_gap", _are_summaries)
        for condition in conditions.TOWERS
    }


def _are_summaries(rows: Any) -> bool:
    return isinstance(rows, list) and bool(rows) and all(map(_is_summary, rows))


def _is_summary(row: Any) -> bool:
    """Whether this is a summary as `search.curve` gives them, with what figures and claims take from it."""
    needed = ("resolution", "accuracy", "mean_interactions", "mean_seconds")
    return (
        isinstance(row, dict)
        and isinstance(row.get("objective"), str)
        and (
            all(type(row.get(name)) in (int, float) for name in needed)
            and all(row.get(name) is None or type(row[name]) in (int, float) for name in ("value", "bound"))
        )
    )


def best(rows: list[dict], objective: str = "return", resolution: float = 0.0) -> dict:
    """Returns the summary for an observer; by default the one who distinguishes every bit."""
    for row in rows:
        if row["resolution"] == resolution and row["objective"] == objective:
            return row
    raise ValueError(
        f"the results have no observer of towers who sees {resolution:g} for {objective}; remove their folder `ideal`, "
        "and `physexp reproduce ideal_gap` makes it again"
    )


def summaries(results: base.Results) -> dict[str, dict]:
    """Returns, by the name of a condition, the summary for the observer who distinguishes every bit."""
    return {conditions.label("towers", task): best(rows) for task, rows in read(results).items()}


def _path(results: base.Results, task: str):
    return results.path / "ideal" / f"towers-{task}.json"
