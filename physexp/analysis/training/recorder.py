"""Recording: writes the metrics, episodes and checkpoints of a run while it trains."""

from collections.abc import Callable, Mapping, Sequence
import functools
import io
import math
import time

import numpy as np
import pyarrow
import torch

from physexp import suite
from physexp.agents import core, files, learning
from physexp.analysis.data import episodes as episodes_lib
from physexp.analysis.data import provenance
from physexp.analysis.training import callbacks
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

ROW_SECONDS = 5.0  # Between rows of metrics.csv, at most.
_LEAST_ROWS = 100  # Of a whole training, which may be over in seconds.

OnCheckpoint = Callable[[int, Mapping[str, torch.Tensor]], None]
"""Called after a checkpoint is written, with the frames trained on and the network's variables."""


class Recorder:
    """Writes a run's rows, episodes and checkpoints.

    A checkpoint is written once all updates in it, and none after it, have been recorded. So the records of a run that
    was killed and resumed have no gap and nothing twice.
    """

    def __init__(
        self,
        run: run_lib.Run,
        config: config_lib.TrainConfig,
        report: callbacks.Report,
        tell: callbacks.Tell,
        on_checkpoint: OnCheckpoint,
    ):
        """Records nothing yet; for the calls see `trainer.train`, by which the run's folder is locked."""
        self._run, self._config, self._tell = run, config, tell
        self._report = callbacks.expendable(report, tell, "the report of training")
        self._on_checkpoint = callbacks.expendable(on_checkpoint, tell, "the watcher of checkpoints (replays)")
        self._rules, self._settings = config.load_task().rules, len(config.settings)
        self._frames = self._updates = self._num_episodes = self._frames_at_row = 0
        self._seconds = 0.0
        self._started = self._checkpointed = self._row_started = time.monotonic()
        self._window: list[core.Update] = []  # Updates since the last row.
        self._snapshot: dict[str, torch.Tensor] | None = None  # Of a checkpoint that waits for updates before it.
        self._later: list[core.Update] = []  # Updates after that checkpoint.
        self._rows: list[pyarrow.Table] = []  # Episodes since the last checkpoint.

    def resume(self, agent: core.Agent) -> None:
        """Restores the agent and the records from the last checkpoint that is whole, or to the start.

        Raises ValueError if none is whole, or it is of another task or does not fit; it names the file.
        """
        own = self._config.task_name

        def accept(tensors: Mapping[str, torch.Tensor], facts: Mapping[str, object]) -> None:
            if (task := facts.get("task")) != own:
                raise ValueError(f"the checkpoint is of {task}, the run of {own}; put back the run's own")
            agent.restore(tensors)

        found = self._run.checkpointer.latest(self._tell, accept)
        if found is not None:
            tensors, facts = found
            self._frames = self._frames_at_row = int(tensors["frames"])
            self._updates = int(tensors["updates"])
            self._num_episodes, self._seconds = facts["episodes"], facts["seconds"]
        self._run.rewind(-1 if found is None else self._frames)

    def add(self, update: core.Update) -> None:
        """Records an update, or keeps it until the checkpoint before it has been written."""
        if self._snapshot is not None and update.metrics["updates"] > int(self._snapshot["updates"]):
            self._later.append(update)
            return
        self._window.append(update)
        self._updates += 1
        self._frames += update.episodes.num_frames
        self._num_episodes += len(update.episodes.lengths)
        played = self._frames - self._frames_at_row
        if time.monotonic() - self._row_started > ROW_SECONDS or played * _LEAST_ROWS >= self._config.agent.frames:
            self._report(self._write_row())
        self._write_checkpoint_when_complete()

    def checkpoint_is_due(self) -> bool:
        """Returns whether it is time for a snapshot."""
        waited = time.monotonic() - self._checkpointed
        return self._snapshot is None and waited > self._config.agent.checkpoint_seconds

    def snapshot(self, tensors: dict[str, torch.Tensor]) -> None:
        """Writes a checkpoint of the variables as soon as all updates in it are recorded; none before the first one."""
        if int(tensors["updates"]) > 0:
            self._snapshot = tensors
            self._write_checkpoint_when_complete()

    def save_failure(self, error: core.AgentError) -> str:
        """Saves the episodes of a loss that was not finite; returns a phrase that names the file."""
        if error.batch is None:
            return ""
        path, content = self._run.path / "failed_batch.npz", io.BytesIO()
        np.savez_compressed(content, **error.batch)
        try:
            files.write_atomically(path, content.getvalue())
        except OSError as obstacle:
            return f" (the batch could not be written to {path}: {obstacle.strerror})"
        return f" (the batch is in {path})"

    def _write_checkpoint_when_complete(self) -> None:
        if self._snapshot is None or self._updates < int(self._snapshot["updates"]):
            return
        tensors, self._snapshot = self._snapshot, None
        row = self._write_row() if self._window else None
        self._run.check_lock()
        if self._rows:
            self._run.append_episodes(self._frames, pyarrow.concat_tables(self._rows).combine_chunks())
            self._rows = []
        facts = {
            "task": self._config.task_name,
            "episodes": self._num_episodes,
            "seconds": self._seconds + time.monotonic() - self._started,
            "versions": provenance.versions(),
        }
        self._run.checkpointer.save(tensors, facts)
        if row is not None:
            self._report(row)
        self._on_checkpoint(self._frames, learning.network_variables(tensors))
        self._checkpointed = time.monotonic()
        later, self._later = self._later, []
        for update in later:
            self.add(update)

    def _write_row(self) -> dict[str, float]:
        """Writes and returns the metrics of the updates since the row before; keeps the episodes of the last one."""
        self._run.check_lock()
        now, discount = time.monotonic(), self._config.agent.discount
        parts = [self._episodes(update) for update in self._window]
        episodes = episodes_lib.Episodes.joined(parts)
        row = {
            "frames": self._frames,
            "updates": self._updates,
            "episodes": self._num_episodes,
            "seconds": self._seconds + now - self._started,
            "frames_per_second": (self._frames - self._frames_at_row) / max(1e-3, now - self._row_started),
            "success_rate": float(episodes.right.mean()),
            "episode_return": float(episodes.returns(discount).mean()),
            "interactions": float(episodes.interactions.mean()),
            "timeouts": float(episodes.is_timeout.mean()),
            **{name: _mean([update.metrics[name] for update in self._window]) for name in self._config.agent.metrics},
        }
        self._run.append_metrics(row)
        first = [part for part, update in zip(parts, self._window, strict=True) if not update.episode % self._settings]
        if first:  # Stored episodes are of the task itself.
            self._rows.append(first[-1].table(run_lib.EPISODES, frames=self._frames))
        self._window, self._row_started, self._frames_at_row = [], now, self._frames
        return row

    def _episodes(self, update: core.Update) -> episodes_lib.Episodes:
        seeds = _environment_seeds(update.seed, len(update.episodes.lengths))
        return episodes_lib.Episodes.of_round(update.episodes, self._rules, seeds, update.episode)


def _mean(values: Sequence[float]) -> float:
    """Returns the mean of the values that are not NaN: an update without a step of Adam has no losses."""
    numbers = [value for value in values if not math.isnan(value)]
    return float(np.mean(numbers)) if numbers else math.nan


@functools.lru_cache(maxsize=256)  # A worker's batch of environments has one seed for all of its updates.
def _environment_seeds(seed: int, size: int) -> np.ndarray:
    return np.array([suite.environment_seed(seed, index) for index in range(size)])
