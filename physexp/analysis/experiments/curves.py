"""Learning curves: smoothing, and the first time at a level; and drawings that several experiments share."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots

AXES = {"frames": (1e6, "environment steps, millions"), "seconds": (60.0, "minutes of training")}
"""The columns that success may be drawn along, each with its unit and the name of the axis."""

_POINTS = 120
_WINDOW = 2000  # Episodes over which success is averaged, whatever the speed of the machine.

Lines = tuple[np.ndarray, np.ndarray]
"""Places in the unit of `AXES`, [_POINTS], and the values of agents there, [agents, _POINTS]."""


def moving_mean(run, along: str = "frames", of: str = "success_rate") -> tuple[np.ndarray, np.ndarray]:
    """Averages a run over the last `_WINDOW` episodes, or over those between two rows if they are more.

    The column `of` has means over the episodes since the row before. Returns the position on the column `along` of the
    middle of these episodes, and the mean over them; [rows] both.
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
    around = slice(max(above[0] - 1, 0), above[0] + 1)
    return float(np.interp(level, means[around], places[around]))


def reached(rows, level: float, along: str = "frames", of: str = "success_rate") -> np.ndarray:
    """Returns `first_reached` of each agent of a condition."""
    return np.array([first_reached(run, level, along, of) for _, run in rows.groupby("training_seed")])


def better_half(rows, along: str = "frames") -> Lines:
    """Returns the success of the agents of a condition that are in the better half at the end of training.

    So are the paper's figures. The best is first; success is NaN before the middle of an agent's first episodes.
    """
    runs = rows.groupby("training_seed")
    grid = np.linspace(0, runs[along].max().min(), _POINTS)
    means = [moving_mean(run, along) for _, run in runs]
    best = [means[index] for index in estimates.better_half([success[-1] for _, success in means])]
    lines = [np.interp(grid, places, success, left=np.nan) for places, success in best]
    return grid / AXES[along][0], np.array(lines)


def draw_panel(axes, lines: Mapping[str, Lines], chance: float, along: str = "frames") -> None:
    """Draws success, as `better_half` returns it, by label: single agents light, their median dark."""
    for number, (label, (grid, success)) in enumerate(lines.items()):
        axes.plot(grid, success.T, color=plots.COLORS[number], alpha=0.25, linewidth=0.7)
        _draw_median(axes, grid, success, number, label)
    plots.reference(axes, chance, "chance")
    axes.set(xlabel=AXES[along][1], ylim=(0, 1.02), xlim=(0, None))


def draw_range(axes, rows, number: int, label: str, along: str = "frames") -> None:
    """Draws the range of the scores of a condition's agents light, and their median dark, on a logarithmic axis.

    The curves end where the shortest run ends; `number` is that of the color and dashes.
    """
    curves = [moving_mean(run, along, "score") for _, run in rows.groupby("training_seed")]
    first, last = max(places[0] for places, _ in curves), min(places[-1] for places, _ in curves)
    grid = np.geomspace(first, max(first, last), _POINTS)
    lines = np.array([np.interp(grid, places, means) for places, means in curves])
    grid = grid / AXES[along][0]
    axes.fill_between(grid, lines.min(axis=0), lines.max(axis=0), color=plots.COLORS[number], alpha=0.25, linewidth=0)
    _draw_median(axes, grid, lines, number, label)


def _draw_median(axes, grid: np.ndarray, lines: np.ndarray, number: int, label: str) -> None:
    color, dashes = plots.COLORS[number], plots.DASHES[number]
    axes.plot(grid, np.median(lines, axis=0), color=color, linestyle=dashes, linewidth=1.6, label=label)


def draw_spread(axes, places: np.ndarray, lines: Sequence[np.ndarray], number: int, label: str) -> None:
    """Draws the range of some lines, [lines, places], light, and their median with markers."""
    style: dict[str, Any] = dict(color=plots.COLORS[number + 1], marker=plots.MARKERS[number], markersize=3)
    axes.fill_between(places, np.min(lines, axis=0), np.max(lines, axis=0), alpha=0.2, color=style["color"])
    axes.plot(places, np.median(lines, axis=0), label=label, **style)


def draw_histogram(axes, taken, ideal: Mapping[int, float], length: int, color: str) -> None:
    """Draws the shares of episodes with 0, 1, ... interactions, below a length, and outlined the ideal's."""
    shares = np.bincount(taken, minlength=length) / len(taken)
    axes.bar(np.arange(length), shares, color=color, width=0.8, alpha=0.75, label="agents")
    best = [ideal.get(number, 0.0) for number in range(length)]
    axes.stairs(best, np.arange(length + 1) - 0.5, color=plots.GREY, linewidth=1.3, label="ideal")
