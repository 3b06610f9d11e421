"""Learning curves of a run."""

from pathlib import Path

from physexp.agents import files
from physexp.analysis.data import plots
from physexp.analysis.training import run as run_lib


def draw(run: run_lib.Run, path: Path) -> Path:
    """Draws the success rate and interactions of a run with metrics against frames; returns the path of the PNG."""
    rows, config = run.metrics(), run.config
    frames = [row["frames"] / 1e6 for row in rows]
    with plots.style():
        drawn, (top, bottom) = plots.new(rows=2, width=4.5, height=1.8, sharex=True)
        top.plot(frames, [row["success_rate"] for row in rows], color=plots.COLORS[1])
        plots.reference(top, 1 / config.load_task().num_labels, "chance")
        top.set(ylabel="share of right answers", ylim=(0, 1.02), title=config.name)
        bottom.plot(frames, [row["interactions"] for row in rows], color=plots.COLORS[2])
        bottom.set(xlabel="environment steps, millions", ylabel="interactions in an episode", ylim=(0, None))
    files.write_atomically(path, plots.png(drawn))
    return path
