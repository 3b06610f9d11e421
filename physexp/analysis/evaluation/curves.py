"""Learning curves, drawn from a run's records."""

from pathlib import Path

from physexp import suite
from physexp.analysis.training import run as run_lib


def draw(run: run_lib.Run, path: Path) -> Path:
    """Draws success and interactions of a run against frames; returns the path of the PNG.

    Raises:
      ValueError: if the run has no metrics yet.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    rows = run.metrics()
    if not rows:
        raise ValueError(f"{run.path} has no metrics yet")
    frames = [row["frames"] / 1e6 for row in rows]
    figure, (top, bottom) = pyplot.subplots(2, sharex=True, figsize=(6, 5), layout="constrained")
    top.plot(frames, [row["success_rate"] for row in rows], color="C0")
    chance = 1 / num_labels(run)
    top.axhline(chance, color="0.5", linestyle="--", linewidth=1)
    top.text(frames[-1], chance, "chance ", ha="right", va="bottom", color="0.4")
    top.set(ylabel="share of right answers", ylim=(0, 1.02), title=run.config.name)
    bottom.plot(frames, [row["interactions"] for row in rows], color="C1")
    bottom.set(xlabel="environment steps, millions", ylabel="interactions in an episode", ylim=(0, None))
    for axes in (top, bottom):
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=150)
    pyplot.close(figure)
    return path


def num_labels(run: run_lib.Run) -> int:
    """Returns how many answers the run's question has."""
    return suite.load_task(run.config.domain, run.config.task, run.config.task_kwargs).num_labels
