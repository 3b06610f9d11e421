"""Metrics for TensorBoard, beside `metrics.csv`."""

from physexp.analysis import run as run_lib


class TensorBoard:
    """Writes rows of metrics into a run's folder, `tensorboard/`; use it as a context manager."""

    def __init__(self, run: run_lib.Run):
        """Opens the log; of a run that is resumed, it hides what was logged after the last checkpoint."""
        from torch.utils import tensorboard

        paths = run.checkpointer.paths()
        resumed = int(paths[-1].stem) + 1 if paths else 0
        self._writer = tensorboard.SummaryWriter(str(run.path / "tensorboard"), purge_step=resumed)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._writer.close()

    def __call__(self, row: dict[str, float]) -> None:
        """Logs a row of `run.METRICS` at its environment steps."""
        for name in run_lib.METRICS:
            if name != "frames":
                self._writer.add_scalar(name, row[name], int(row["frames"]))
        self._writer.flush()
