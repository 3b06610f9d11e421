"""Learning curves: what the experiments on success in learning share."""

from collections.abc import Sequence

import numpy as np

from physexp.analysis import figures, statistics

_POINTS = 120
_SMOOTHING = 5  # Rows of metrics.csv, each some seconds of training.

AXES = {"frames": (1e6, "environment steps, millions"), "seconds": (60.0, "minutes of training")}
"""What success may be drawn along: the column, its unit, and what the axis is called."""


def smoothed(frame, along: str = "frames"):
    """Curves on common grids: for each condition, the grid, in the unit of `AXES`, and success [agents, _POINTS].

    The agents are those in the better half at the end of training, as in the paper's figures, the best first.
    """
    curves = {}
    for condition, rows in frame.groupby("condition", sort=False):
        runs = [run.sort_values("frames") for _, run in rows.groupby("training_seed")]
        grid = np.linspace(0, min(run[along].max() for run in runs), _POINTS)
        success = [run.success_rate.rolling(_SMOOTHING, min_periods=1).mean().to_numpy() for run in runs]
        best = statistics.better_half([values[-1] for values in success])
        lines = [np.interp(grid, runs[index][along], success[index]) for index in best]
        curves[condition] = (grid / AXES[along][0], np.array(lines))
    return curves


def draw_panel(axes, curves, names: Sequence[str], labels: Sequence[str], chance: float,
               along: str = "frames") -> None:  # fmt: skip
    """Draws curves of some conditions: single agents light, their median dark."""
    for number, (name, label) in enumerate(zip(names, labels, strict=True)):
        if name not in curves:
            continue
        grid, lines = curves[name]
        color, dashes = figures.COLORS[number], figures.DASHES[number]
        axes.plot(grid, lines.T, color=color, alpha=0.25, linewidth=0.7)
        axes.plot(grid, np.median(lines, axis=0), color=color, linestyle=dashes, linewidth=1.6, label=label)
    figures.reference(axes, chance, "chance")
    axes.set(xlabel=AXES[along][1], ylim=(0, 1.02), xlim=(0, None))


def final_success(frame, share: float = 0.05):
    """Share of right answers over the last part of training: a DataFrame of condition, training_seed, success_rate."""
    ends = frame.groupby(["condition", "training_seed"]).frames.transform("max")
    last = frame[frame.frames >= (1 - share) * ends]
    return last.groupby(["condition", "training_seed"], as_index=False, sort=False).success_rate.mean()


def first_reached(frame, level: float, along: str = "frames"):
    """When an agent's smoothed success first reaches a level, in frames or seconds; infinite where it never does.

    Returns:
      A DataFrame of condition, training_seed, and `along`.
    """
    import pandas

    found = []
    for (condition, seed), run in frame.groupby(["condition", "training_seed"], sort=False):
        run = run.sort_values("frames")
        reached = run[along][run.success_rate.rolling(_SMOOTHING, min_periods=1).mean() >= level]
        found.append({"condition": condition, "training_seed": seed,
                      along: float(reached.iloc[0]) if len(reached) else np.inf})  # fmt: skip
    return pandas.DataFrame(found)
