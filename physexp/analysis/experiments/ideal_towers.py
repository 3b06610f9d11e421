"""The ideal experimenters of Towers, computed once and stored with the results; shares of an ideal's return."""

from collections.abc import Callable
import functools

import numpy as np

from physexp.analysis.domains import towers
from physexp.analysis.experiments import base, conditions
from physexp.analysis.ideal import search
from physexp.analysis.training import records

# The resolution of the observer: metres for features, differing pixels for images.
RESOLUTIONS = {"features": (0.0, 0.001, 0.003, 0.01, 0.03), "pixels": (0.0, 10.0, 30.0, 100.0)}


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Computes the ideal experimenters of all tasks that are not there yet; `report` is told their names."""
    for task in conditions.TOWERS:
        words = f"searching for the ideal experimenter of {task.task}"
        results.make(_name(task), report, words, functools.partial(_solve, task))


def _solve(task: conditions.Condition) -> list[dict]:
    return search.curve(towers.hypotheses(task.task), RESOLUTIONS[task.observations], task.agent.discount)


def _name(task: conditions.Condition) -> str:
    return f"ideal/towers-{task.task}"


def curve(task: conditions.Condition, results: base.Results) -> list[dict]:
    """Returns the stored summaries of `search.curve` of a task."""
    return results.made(_name(task))


def best(task: conditions.Condition, results: base.Results) -> dict:
    """Returns the summary of the observer that distinguishes every bit."""
    (found,) = (row for row in curve(task, results) if (row["resolution"], row["objective"]) == (0.0, "return"))
    return found


def ideal_return(task: conditions.Condition, results: base.Results) -> float:
    """Returns the ideal experimenter's return in a task, stored or computed."""
    return best(task, results)["value"] if task.domain == "towers" else task.ideal().value


def share(episodes, ideal: float) -> dict[str, float]:
    """Returns an agent's mean return as a `share` of the ideal's, and the standard `error` of that."""
    shares = records.discounted_return(episodes) / ideal
    return {"share": shares.mean(), "error": shares.std(ddof=1) / np.sqrt(len(shares))}
