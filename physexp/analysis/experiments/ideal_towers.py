"""The ideal experimenters of Towers, computed once and stored with the results."""

from collections.abc import Callable

from physexp.analysis.domains import towers
from physexp.analysis.experiments import base, conditions
from physexp.analysis.ideal import search

# The resolution of the observer: metres for features, differing pixels for images.
RESOLUTIONS = {"features": (0.0, 0.001, 0.003, 0.01, 0.03), "pixels": (0.0, 10.0, 30.0, 100.0)}


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Computes the ideal experimenters of all tasks that are not there yet; `report` is told their names."""
    for condition in conditions.TOWERS:
        path = _path(results, condition.task)
        if not path.exists():
            report(f"searching for the ideal experimenter of {condition.task}")
            resolutions = RESOLUTIONS[conditions.observations(condition)]
            rows = search.curve(towers.hypotheses(condition.task), resolutions, condition.agent.discount)
            base.keep_made(path, rows)


def read(results: base.Results) -> dict[str, list[dict]]:
    """Returns the summaries of `search.curve` by task.

    Raises:
      ValueError: if they have not been computed.
    """
    return {each.task: base.read_made(_path(results, each.task), "ideal_gap") for each in conditions.TOWERS}


def best(rows: list[dict]) -> dict:
    """Returns the summary of the observer that distinguishes every bit."""
    (found,) = (row for row in rows if (row["resolution"], row["objective"]) == (0.0, "return"))
    return found


def summaries(results: base.Results) -> dict[str, dict]:
    """Returns the summary of the observer that distinguishes every bit, by the label of a condition."""
    return {conditions.label("towers", task): best(rows) for task, rows in read(results).items()}


def ideal_return(task: conditions.Condition, results: base.Results) -> float:
    """Returns the ideal experimenter's return in a task of the paper, stored or computed."""
    if task in conditions.TOWERS:
        return best(base.read_made(_path(results, task.task), "ideal_gap"))["value"]
    return conditions.ideal(task).value


def _path(results: base.Results, task: str):
    return results.path / "ideal" / f"towers-{task}.json"
