"""Metrics for TensorBoard, beside `metrics.csv`."""

from typing import Any

from physexp.analysis.training import run as run_lib


class TensorBoard:
    """Writes rows of metrics into `tensorboard/` in a run's folder; the first row makes the log."""

    def __init__(self, run: run_lib.Run):
        self._run = run
        self._writer: Any = None

    def __call__(self, row: dict[str, float]) -> None:
        """Logs a row of metrics, the last of the run's, at its environment steps."""
        if self._writer is None:
            self._writer = self._open()
        for name, value in row.items():
            if name != "frames":
                self._writer.add_scalar(name, value, int(row["frames"]))
        self._writer.flush()

    def close(self) -> None:
        """Closes the log."""
        if self._writer is not None:
            self._writer.close()

    def _open(self):
        """Opens the log; in a run that is resumed, entries after the checkpoint are hidden."""
        from torch.utils import tensorboard

        earlier = self._run.metrics()[:-1]
        resumed = int(earlier[-1]["frames"]) + 1 if earlier else 0
        return tensorboard.SummaryWriter(str(self._run.path / "tensorboard"), purge_step=resumed)
