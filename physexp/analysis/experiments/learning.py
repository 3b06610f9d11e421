"""Learning curves: what the experiments on success in learning share."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import claims

CAPTION = (
    "Share of right answers in training (drawn actions, smoothed). Light lines: the better half of the agents; dark: "
    "their median."
)

_POINTS = 120
_END = 0.05  # The share of training that is its end.
_WINDOW = 2000  # Episodes over which success is averaged, whatever the speed of the machine they were played on.

AXES = {"frames": (1e6, "environment steps, millions"), "seconds": (60.0, "minutes of training")}
"""What success may be drawn along, by column, with its unit and the name of the axis."""


def moving_mean(run, along: str = "frames", of: str = "success_rate") -> tuple[np.ndarray, np.ndarray]:
    """Averages over the last `_WINDOW` episodes, or over those between two rows where they are more.

    Args:
      run: the rows of a run.
      along: a column.
      of: the column to average, which has means over the episodes since the row before.

    Returns:
      Where on the column `along` the middle of these episodes lies, and the mean over them; [rows] both.
    """
    run = run.sort_values("frames")
    episodes, places = (np.concatenate([[0], run[column]]) for column in ("episodes", along))
    sums = np.concatenate([[0], np.cumsum(run[of] * np.diff(episodes))])
    ends = episodes[1:]
    starts = np.minimum(episodes[:-1], np.maximum(ends - _WINDOW, 0))
    means = (sums[1:] - np.interp(starts, episodes, sums)) / (ends - starts)
    return np.interp((starts + ends) / 2, episodes, places), means


def smoothed(frame, along: str = "frames"):
    """Curves on common grids: for each condition, the grid, in the unit of `AXES`, and success [agents, _POINTS].

    The agents are those in the better half at the end of training, as in the paper's figures, the best first. Before
    the middle of an agent's first episodes nothing is known: NaN.
    """
    curves = {}
    for condition, rows in frame.groupby("condition", sort=False):
        grid = np.linspace(0, rows.groupby("training_seed")[along].max().min(), _POINTS)
        runs = [moving_mean(run, along) for _, run in rows.groupby("training_seed")]
        best = [runs[index] for index in estimates.better_half([success[-1] for _, success in runs])]
        lines = [np.interp(grid, places, success, left=np.nan) for places, success in best]
        curves[condition] = (grid / AXES[along][0], np.array(lines))
    return curves


def draw_panel(axes, curves, names: Sequence[str], labels: Sequence[str], chance: float, along: str = "frames") -> None:
    """Draws curves of some conditions: single agents light, their median dark."""
    for number, (name, label) in enumerate(zip(names, labels, strict=True)):
        if name not in curves:
            continue
        grid, lines = curves[name]
        color, dashes = plots.COLORS[number], plots.DASHES[number]
        axes.plot(grid, lines.T, color=color, alpha=0.25, linewidth=0.7)
        axes.plot(grid, np.median(lines, axis=0), color=color, linestyle=dashes, linewidth=1.6, label=label)
    plots.reference(axes, chance, "chance")
    axes.set(xlabel=AXES[along][1], ylim=(0, 1.02), xlim=(0, None))


def draw_range(axes, runs: Sequence[Any], number: int, label: str, along: str, of: str) -> None:
    """Draws from the worst to the best of some runs light, and their median dark, as far as all have played.

    Args:
      axes: where, with a logarithmic axis.
      runs: the rows of each run.
      number: of its color and dashes.
      label: for the legend.
      along, of: columns, as for `moving_mean`.
    """
    curves = [moving_mean(run, along, of) for run in runs]
    first, last = max(places[0] for places, _ in curves), min(places[-1] for places, _ in curves)
    grid = np.geomspace(first, max(first, last), _POINTS)
    lines = np.array([np.interp(grid, places, means) for places, means in curves])
    color, dashes = plots.COLORS[number], plots.DASHES[number]
    grid = grid / AXES[along][0]
    axes.fill_between(grid, lines.min(axis=0), lines.max(axis=0), color=color, alpha=0.25, linewidth=0)
    axes.plot(grid, np.median(lines, axis=0), color=color, linestyle=dashes, linewidth=1.6, label=label)


def final_success(frame):
    """Share of right answers at the end of training: a DataFrame of condition, training_seed and success_rate."""
    ends = frame.groupby(["condition", "training_seed"]).frames.transform("max")
    last = frame[frame.frames >= (1 - _END) * ends]
    return last.groupby(["condition", "training_seed"], as_index=False, sort=False).success_rate.mean()


def find_claims(frame, **wanted: Any) -> list[claims.Claim]:
    """In each condition the share of right answers at the end of training is as `wanted`, attributes of claims."""
    final = final_success(frame)
    return [
        claims.Claim(
            condition=name,
            estimate=estimates.mean_share(final.success_rate[final.condition == name]),
            **wanted,
        )
        for name in final.condition.unique()
    ]


def first_reached(run, level: float, along: str = "frames", of: str = "success_rate") -> float:
    """Where on a column a run's moving mean first reaches a level, on a line between rows; else infinity."""
    places, means = moving_mean(run, along, of)
    above = np.flatnonzero(means >= level)
    if not len(above):
        return np.inf
    first = above[0]
    if not first:
        return float(places[0])
    return float(np.interp(level, means[first - 1 : first + 1], places[first - 1 : first + 1]))


def compare_first_reached(frame, names: Sequence[str], level: float, along: str = "frames") -> list[np.ndarray]:
    """Where agents of conditions first reach a level, within the shortest training of them all: [agents] for each name.

    An agent who needs longer, or never does, is given the end of that training.
    """
    runs = {name: [run for _, run in frame[frame.condition == name].groupby("training_seed")] for name in names}
    shortest = min((run[along].max() for group in runs.values() for run in group), default=np.inf)
    return [np.array([min(first_reached(run, level, along), shortest) for run in runs[name]]) for name in names]
