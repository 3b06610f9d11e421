"""Learning curves: smoothing, the first time at a level, and drawing."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots

AXES = {"frames": (1e6, "environment steps, millions"), "seconds": (60.0, "minutes of training")}
"""The columns that success may be drawn along, each with its unit and the name of the axis."""

_POINTS = 120
_WINDOW = 2000  # Episodes over which success is averaged, whatever the speed of the machine.


def runs(frame) -> list:
    """Returns the rows of each agent of a condition."""
    return [run for _, run in frame.groupby("training_seed")]


def moving_mean(run, along: str = "frames", of: str = "success_rate") -> tuple[np.ndarray, np.ndarray]:
    """Averages over the last `_WINDOW` episodes, or over those between two rows if they are more.

    Args:
      run: the rows of a run.
      along: a column.
      of: the column to average, which has means over the episodes since the row before.

    Returns:
      The position on the column `along` of the middle of these episodes, and the mean over them; [rows] both.
    """
    run = run.sort_values("frames")
    episodes, places = (np.concatenate([[0], run[column]]) for column in ("episodes", along))
    sums = np.concatenate([[0], np.cumsum(run[of] * np.diff(episodes))])
    ends = episodes[1:]
    starts = np.minimum(episodes[:-1], np.maximum(ends - _WINDOW, 0))
    means = (sums[1:] - np.interp(starts, episodes, sums)) / (ends - starts)
    return np.interp((starts + ends) / 2, episodes, places), means


def first_reached(run, level: float, along: str = "frames", of: str = "success_rate") -> float:
    """Returns the position at which a run's moving mean first reaches a level, interpolated; else infinity."""
    places, means = moving_mean(run, along, of)
    above = np.flatnonzero(means >= level)
    if not len(above):
        return np.inf
    first = above[0]
    if not first:
        return float(places[0])
    return float(np.interp(level, means[first - 1 : first + 1], places[first - 1 : first + 1]))


def better_half(frame, along: str = "frames") -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Returns for each condition a grid, in the unit of `AXES`, and the success of its agents, [agents, _POINTS].

    The agents are those in the better half at the end of training, as in the paper's figures, the best first. Success
    is NaN before the middle of an agent's first episodes.
    """
    curves = {}
    for condition, rows in frame.groupby("condition", sort=False):
        grid = np.linspace(0, rows.groupby("training_seed")[along].max().min(), _POINTS)
        means = [moving_mean(run, along) for run in runs(rows)]
        best = [means[index] for index in estimates.better_half([success[-1] for _, success in means])]
        lines = [np.interp(grid, places, success, left=np.nan) for places, success in best]
        curves[condition] = (grid / AXES[along][0], np.array(lines))
    return curves


def draw_panel(axes, curves, labels: Mapping[str, str], chance: float, along: str = "frames") -> None:
    """Draws the `better_half` of the labelled conditions: single agents light, their median dark."""
    for number, (name, label) in enumerate(labels.items()):
        if name not in curves:
            continue
        grid, lines = curves[name]
        color, dashes = plots.COLORS[number], plots.DASHES[number]
        axes.plot(grid, lines.T, color=color, alpha=0.25, linewidth=0.7)
        axes.plot(grid, np.median(lines, axis=0), color=color, linestyle=dashes, linewidth=1.6, label=label)
    plots.reference(axes, chance, "chance")
    axes.set(xlabel=AXES[along][1], ylim=(0, 1.02), xlim=(0, None))


def draw_range(axes, runs: Sequence[Any], number: int, label: str, along: str = "frames") -> None:
    """Draws the range of the scores of some runs light, and their median dark, on a logarithmic axis.

    The curves end where the shortest run ends; `number` is that of the color and dashes.
    """
    curves = [moving_mean(run, along, "score") for run in runs]
    first, last = max(places[0] for places, _ in curves), min(places[-1] for places, _ in curves)
    grid = np.geomspace(first, max(first, last), _POINTS)
    lines = np.array([np.interp(grid, places, means) for places, means in curves])
    color, dashes = plots.COLORS[number], plots.DASHES[number]
    grid = grid / AXES[along][0]
    axes.fill_between(grid, lines.min(axis=0), lines.max(axis=0), color=color, alpha=0.25, linewidth=0)
    axes.plot(grid, np.median(lines, axis=0), color=color, linestyle=dashes, linewidth=1.6, label=label)


def draw_spread(axes, places: np.ndarray, lines: Sequence[np.ndarray], number: int, label: str) -> None:
    """Draws the range of some lines, [lines, places], light, and their median with markers."""
    style: dict[str, Any] = dict(color=plots.COLORS[number + 1], marker=plots.MARKERS[number], markersize=3)
    axes.fill_between(places, np.min(lines, axis=0), np.max(lines, axis=0), alpha=0.2, color=style["color"])
    axes.plot(places, np.median(lines, axis=0), label=label, **style)
