"""A run's folder: its configuration, its records, and the agent.

In it are::

    config.json       the whole configuration, with versions and seeds
    metrics.csv       a row every few seconds of training
    episodes.parquet  the episodes of one update for each of those rows, a part for each checkpoint
    checkpoints/      the shared variables (safetensors) and the facts beside them (JSON)
    replays/*.rrd     episodes for the rerun viewer
    tensorboard/      the metrics once more, if they are wanted so
    failed_batch.npz  what was learned from when a loss was not finite
    agent.safetensors the network alone, in half precision, once `keep_agent_only` has put it in their place
    superseded-N/     records that are no part of the run any more: of attempts that came to no checkpoint, and rows
                      after the checkpoint from which training went on
    .lock             while a trainer is at work

The folder may be a symbolic link; what is in it may not, since it is written to and removed.
"""

from collections.abc import Callable, Iterator, Mapping
import contextlib
import functools
import itertools
import json
import os
from pathlib import Path
import shutil
from typing import TYPE_CHECKING, Any

import pyarrow

from physexp import suite
from physexp.agents import files
from physexp.analysis.data import lock, provenance, tables
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import metrics
from physexp.suite.engine import gl

if TYPE_CHECKING:
    import torch

    from physexp.agents import checkpointing
    from physexp.analysis.training import weights

FORMAT = 1

_FOLDERS = ("checkpoints", "episodes.parquet", "replays", "tensorboard")
_RECORDS = ("metrics.csv", "failed_batch.npz", "agent.safetensors", *_FOLDERS)

EPISODES = pyarrow.schema(
    [
        ("frames", pyarrow.int64()),  # Of training, when the episode was learned from.
        ("seed", pyarrow.int64()),  # Seed of the environment: with `episode`, it rebuilds the episode.
        ("episode", pyarrow.int64()),
        ("answer", pyarrow.int32()),  # The right label.
        ("label", pyarrow.int32()),  # The label given, -1 when time ran out.
        ("reward", pyarrow.float32()),
        ("length", pyarrow.int32()),
        ("actions", pyarrow.list_(pyarrow.int32())),
    ]
)


class Run:
    """A run's folder."""

    def __init__(self, path: Path):
        """Names a folder, in which there need be nothing yet."""
        self.path = Path(path).expanduser()
        self._metrics = metrics.MetricsFile(self.path / "metrics.csv")
        self._lock_is_in_place: Callable[[], bool] | None = None

    @property
    def config(self) -> config_lib.TrainConfig:
        """Returns the run's configuration.

        Raises:
          ValueError: if the folder holds no run, or one of another format, or what was asked for makes no sense.
        """
        facts = self.facts
        try:
            return config_lib.TrainConfig.from_json(facts["train"])
        except (KeyError, TypeError, AttributeError, ValueError) as error:
            what = str(error) if isinstance(error, ValueError) else repr(error)
            raise ValueError(f"{self.path}/config.json is not what was written: {what}") from None

    @property
    def facts(self) -> dict[str, Any]:
        """Returns the configuration, versions, commit and renderer that `create` wrote.

        Raises:
          ValueError: as `config`.
        """
        try:
            fields = files.read_json(self.path / "config.json")
        except (FileNotFoundError, NotADirectoryError):
            what = "is a file" if self.path.is_file() else "holds no run (no config.json)"
            raise ValueError(f"{self.path} {what}; give the folder of a run") from None
        form = fields.get("format") if isinstance(fields, dict) else None
        if form != FORMAT:
            raise ValueError(f"{self.path}/config.json has format {form!r}; this version reads format {FORMAT}")
        return fields

    # Starting.

    @contextlib.contextmanager
    def locked(self) -> Iterator[None]:
        """Returns a context in which no other trainer works in the folder; see `lock.locked`. It may be nested.

        Raises:
          OSError: if the folder cannot be made or written to.
          ValueError: if another trainer is at work in it, or if it or a folder in it is none.
        """
        if self._lock_is_in_place is not None:
            yield
            return
        busy = f"another process is training in {self.path}; wait for it or choose another"
        with lock.locked(self.path, busy) as self._lock_is_in_place:
            try:
                for name in _FOLDERS:
                    files.refuse_link(self.path / name)
                for litter in (self.path / "replays").glob(".replay-*"):  # Of a trainer that was killed.
                    shutil.rmtree(litter)
                yield
            finally:
                self._lock_is_in_place = None

    def check_lock(self) -> None:
        """Makes sure, within `locked`, that no other process can be writing here by now.

        Raises:
          RuntimeError: if the lock file was removed, or the folder was moved.
        """
        if not self._is_locked():
            raise RuntimeError(
                f"training stopped: the lock file {self.path / '.lock'} was removed, or the folder moved; its last "
                "checkpoint is as it was: --resume it where it is now"
            )

    def create(self, config: config_lib.TrainConfig) -> Path | None:
        """Makes the folder and writes the configuration.

        Returns:
          Where the records were moved of an earlier attempt that came to no checkpoint; None where there were none.

        Raises:
          OSError, ValueError: as `locked`; ValueError also if there is a run already.
        """
        with self.locked():
            self.check_new()
            moved = self.set_aside()
            content = {
                "format": FORMAT,
                "train": config.to_json(),
                "versions": provenance.versions(),
                "commit": provenance.commit(),
                "renderer": _renderer(config),
            }
            files.write_atomically(self.path / "config.json", (json.dumps(content, indent=1) + "\n").encode())
        return moved

    def discard(self) -> None:
        """Takes back, within `locked`, what `create` wrote, unless something has been recorded since."""
        if not self._recorded() and self._is_locked():
            (self.path / "config.json").unlink(missing_ok=True)

    def _is_locked(self) -> bool:
        return self._lock_is_in_place is not None and self._lock_is_in_place()

    def check_new(self) -> None:
        """Raises ValueError if the folder holds a run that has come to a checkpoint."""
        if self.checkpointer.paths() or self.agent_path.exists():
            raise ValueError(f"{self.path} already holds a run; add --resume to continue it, or choose another folder")

    def check_resumable(self) -> None:
        """Makes sure that training can go on, or start, without a loss.

        Raises:
          ValueError: if there are records or an agent, but no checkpoint that training could go on from; as `metrics`;
            or if the rows lack columns of the learner.
        """
        if self.checkpointer.paths():
            names, *_ = self._metrics.split(0)
            if names and not {*metrics.METRICS, *self.config.agent.metrics} <= set(names):
                raise ValueError(f"{self.path}/metrics.csv has the columns of an earlier version; resume it with that")
            return
        if self.agent_path.exists():
            raise ValueError(
                f"{self.path} is finished and has kept its agent alone; evaluate it, or train in another folder"
            )
        if self._recorded():
            raise ValueError(
                f"{self.path} holds no checkpoint to resume from; leave out --resume to start anew, which moves its "
                "records aside"
            )

    def set_aside(self) -> Path | None:
        """Moves all that a run has recorded, and its configuration, into a folder `superseded-N`; returns that.

        Returns None, and changes nothing, where nothing has been recorded.
        """
        recorded = self._recorded()
        if not recorded:
            return None
        folder = self._make_superseded()
        for path in recorded:
            if path.is_dir() and not path.is_symlink():
                files.remove_litter(path)  # Nobody writes there any more who would.
            path.rename(folder / path.name)
        with contextlib.suppress(FileNotFoundError):
            (self.path / "config.json").rename(folder / "config.json")
        return folder

    def _recorded(self) -> list[Path]:
        return [self.path / name for name in _RECORDS if os.path.lexists(self.path / name)]

    def _make_superseded(self) -> Path:
        for number in itertools.count(1):
            folder = self.path / f"superseded-{number}"
            with contextlib.suppress(FileExistsError):
                folder.mkdir()
                break
        return folder

    # The agent.

    @property
    def is_finished(self) -> bool:
        """Whether training has had all its frames."""
        rows = self.metrics()
        return bool(rows) and rows[-1]["frames"] >= self.config.agent.frames

    @property
    def agent_path(self) -> Path:
        """Where `keep_agent_only` puts the network's variables."""
        return self.path / "agent.safetensors"

    @functools.cached_property
    def _weights(self) -> "weights.Weights":
        from physexp.analysis.training import weights  # Imports torch, without which records are read in no time.

        return weights.Weights(self.path, self.agent_path)

    @property
    def checkpointer(self) -> "checkpointing.Checkpointer":
        """Writes and reads the run's checkpoints."""
        return self._weights.checkpointer

    def variables(self, like: Mapping[str, "torch.Tensor"]) -> dict[str, "torch.Tensor"]:
        """Returns the network's variables by name: those kept at the end, or those of the last checkpoint.

        Args:
          like: variables with the names, shapes and types that the network has; their values do not matter.

        Raises:
          ValueError: if there are none yet, or they do not fit.
        """
        return self._weights.variables(like)

    def keep_agent_only(self) -> None:
        """Keeps the network, in half precision, in the place of checkpoints and episodes: this run will not go on.

        Raises:
          ValueError: if there is no checkpoint, or its weights are not finite in half precision.
        """
        with self.locked():
            self._weights.keep_network()
            for name in ("checkpoints", "episodes.parquet"):
                with contextlib.suppress(FileNotFoundError):
                    shutil.rmtree(self.path / name)

    # Records.

    def append_metrics(self, row: Mapping[str, float]) -> None:
        """Adds a row to `metrics.csv`, under the columns that the first row has made."""
        self._metrics.append(row)

    def metrics(self) -> list[dict[str, float]]:
        """Returns the rows of `metrics.csv`, without one that a crash has torn.

        Raises:
          ValueError: if there is something else in it.
        """
        return self._metrics.rows()

    def append_episodes(self, frames: int, rows: pyarrow.Table) -> None:
        """Adds a part to `episodes.parquet`.

        Args:
          frames: of training, by now; they name the part.
          rows: episodes, with the columns of `EPISODES`.
        """
        folder = self.path / "episodes.parquet"
        folder.mkdir(exist_ok=True)
        tables.write(folder / f"part-{frames:015d}.parquet", rows, compression="zstd")

    def rewind(self, frames: int) -> None:
        """Moves what was recorded after a checkpoint aside, so that a resumed run leaves no row twice.

        What it tells of was learned and lost. One worker, or PPO, makes it again to the bit; several workers do not.

        Raises:
          ValueError: as `metrics`.
        """
        names, kept, later = self._metrics.split(frames)
        parts = (self.path / "episodes.parquet").glob(f"part-{'[0-9]' * 15}.parquet")
        later_parts = [part for part in parts if int(part.stem.removeprefix("part-")) > frames]
        if later or later_parts:
            folder = self._make_superseded()
            (folder / "episodes.parquet").mkdir()
            for part in later_parts:
                part.rename(folder / "episodes.parquet" / part.name)
            metrics.MetricsFile(folder / "metrics.csv").write(names, later)
        if self._metrics.path.exists():
            self._metrics.write(names, kept)


def _renderer(config: config_lib.TrainConfig) -> str:
    """Returns the name of the renderer of a run's images, or that none are drawn."""
    task = suite.load_task(config.domain, config.task, config.task_kwargs)
    return gl.renderer_name() if task.sense.needs_gl else "none is needed"
