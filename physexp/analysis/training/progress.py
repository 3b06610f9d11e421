"""Progress of training: a live table on a terminal, plain lines elsewhere, and metrics for TensorBoard."""

from collections.abc import Callable, Iterator
import contextlib
import sys
import time
from typing import Any

from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

_COLUMNS = (
    ("frames", "{:,.0f}"),
    ("frames_per_second", "{:,.0f}"),
    ("success_rate", "{:.3f}"),
    ("episode_return", "{:.3f}"),
    ("interactions", "{:.2f}"),
    ("entropy", "{:.3f}"),
)
_LINE_SECONDS = 10.0


class Progress:
    """Shows rows of metrics while training runs; use it as a context manager."""

    def __init__(self, config: config_lib.TrainConfig, file=None):
        """Prepares the display of a run on `file`, by default standard error."""
        self._config, self._file = config, file or sys.stderr
        self._live: Any = None
        self._printed = 0.0
        self._rates: list[float] = []

    def __enter__(self):
        if self._file.isatty():
            from rich import console, live  # Only a terminal needs it.

            self._live = live.Live(console=console.Console(file=self._file), auto_refresh=False)
            self._live.start()
        return self

    def __exit__(self, *_):
        if self._live is not None:
            self._live.stop()

    def __call__(self, row: dict) -> None:
        """Shows a row of metrics."""
        self._rates = [*self._rates[-11:], row["frames_per_second"]]
        cells = {name: form.format(row[name]) for name, form in _COLUMNS if name in row}
        if len(self._rates) > 1:  # The first row holds the start of training, which takes time and few frames.
            left = (self._config.agent.frames - row["frames"]) / max(1.0, sum(self._rates) / len(self._rates))
            cells["time left"] = duration(max(0.0, left))
        if self._live is not None:
            from rich import table

            grid = table.Table(title=self._config.name)
            for name in cells:
                grid.add_column(name.replace("_", " "), justify="right")
            grid.add_row(*cells.values())
            self._live.update(grid, refresh=True)
        elif time.monotonic() - self._printed > _LINE_SECONDS or row["frames"] >= self._config.agent.frames:
            self._printed = time.monotonic()
            line = "  ".join(f"{name.replace('_', ' ')} {value}" for name, value in cells.items())
            print(line, file=self._file, flush=True)


class TensorBoard:
    """Writes rows of metrics into `tensorboard/` in a run's folder; the first row makes the log."""

    def __init__(self, run: run_lib.Run):
        self._run = run
        self._writer: Any = None

    def __call__(self, row: dict[str, float]) -> None:
        """Logs a row of metrics, the last of the run's, at its environment steps."""
        if self._writer is None:
            from torch.utils import tensorboard

            earlier = self._run.metrics()[:-1]  # In a run that is resumed, entries after the checkpoint are hidden.
            first = int(earlier[-1]["frames"]) + 1 if earlier else 0
            self._writer = tensorboard.SummaryWriter(str(self._run.path / "tensorboard"), purge_step=first)
        for name, value in row.items():
            if name != "frames":
                self._writer.add_scalar(name, value, int(row["frames"]))
        self._writer.flush()

    def close(self) -> None:
        """Closes the log."""
        if self._writer is not None:
            self._writer.close()


@contextlib.contextmanager
def bar(name: str, total: int, file=None) -> Iterator[Callable[[int], None]]:
    """Yields a function that takes the number of steps done; a terminal, by default standard error, shows a bar."""
    from rich import console, progress

    names, counts = progress.TextColumn("{task.description}"), progress.MofNCompleteColumn()
    columns = names, progress.BarColumn(), counts, progress.TimeRemainingColumn()
    terminal = console.Console(file=file or sys.stderr)
    with progress.Progress(*columns, console=terminal, transient=True, disable=not terminal.is_terminal) as shown:
        task = shown.add_task(name, total=total)
        yield lambda done: shown.update(task, completed=done)


def duration(seconds: float) -> str:
    """Returns a duration in hours, minutes and seconds, as 1:02:03."""
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{seconds:02d}"
