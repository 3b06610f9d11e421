"""A run's folder: its configuration, its records, and the agent.

In it are::

    config.json       the whole configuration, with versions and seeds
    metrics.csv       a row every few seconds, and every hundredth of the frames
    episodes.parquet  the episodes of one update for each of those rows, a part for each checkpoint
    checkpoints/      the variables, with the facts of the run
    replays/*.rrd     episodes for the rerun viewer
    tensorboard/      the metrics for TensorBoard, on request
    failed_batch.npz  the batch of a loss that was not finite
    agent.safetensors the network alone, in half precision, once `keep_agent_only` has removed the checkpoints
    superseded-N/     an earlier attempt that was started anew
    .lock             while a trainer is at work
"""

from collections.abc import Callable, Iterator, Mapping
import contextlib
import itertools
import json
from pathlib import Path
import shutil
from typing import TYPE_CHECKING, Any

import pyarrow

from physexp.agents import files
from physexp.analysis.data import lock, provenance, tables
from physexp.analysis.training import config as config_lib
from physexp.suite.engine import gl

if TYPE_CHECKING:
    import torch

    from physexp.agents import checkpointing

FORMAT = 1

METRICS = {
    "frames": "environment steps trained on",
    "updates": "updates made",
    "episodes": "episodes trained on",
    "seconds": "time spent training, s",
    "frames_per_second": "since the row before, or since training was started or resumed",
    "success_rate": "share of episodes with the right label",
    "episode_return": "mean discounted return",
    "interactions": "mean interaction actions in an episode",
    "timeouts": "share of episodes that ran out of time",
}
"""The first columns of `metrics.csv`, those of every run.

Those of its learner follow, `AgentConfig.metrics`: means over the updates since the row before.
"""

_FILES = ("metrics.csv", "failed_batch.npz", "agent.safetensors")
_FOLDERS = ("checkpoints", "episodes.parquet", "replays", "tensorboard")

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
    """A run's folder.

    Attributes:
      path: the folder.
      agent_path: the network's variables that `keep_agent_only` writes.
    """

    def __init__(self, path: Path):
        """Names a folder, which may not exist yet."""
        self.path = Path(path).expanduser()
        self.agent_path = self.path / "agent.safetensors"
        self._metrics_path = self.path / "metrics.csv"
        self._has_lock: Callable[[], bool] | None = None

    @property
    def config(self) -> config_lib.TrainConfig:
        """Returns the run's configuration; raises ValueError if the folder holds no run, or it is damaged."""
        facts = self.facts
        try:
            return config_lib.TrainConfig.from_json(facts["train"])
        except (KeyError, TypeError, AttributeError, ValueError) as error:
            reason = str(error) if isinstance(error, ValueError) else repr(error)
            raise ValueError(f"{self.path}/config.json is damaged: {reason}; put back what was written") from None

    @property
    def facts(self) -> dict[str, Any]:
        """Returns the configuration, versions, commit and renderer that `create` wrote; raises as `config`."""
        try:
            fields = files.read_json(self.path / "config.json")
        except (FileNotFoundError, NotADirectoryError):
            kind = "is a file" if self.path.is_file() else "holds no run (no config.json)"
            raise ValueError(f"{self.path} {kind}; give the folder of a run") from None
        found = fields.get("format") if isinstance(fields, dict) else None
        if found != FORMAT:
            raise ValueError(f"{self.path}/config.json has format {found!r}; this version reads format {FORMAT}")
        return fields

    # Starting.

    @contextlib.contextmanager
    def locked(self) -> Iterator[None]:
        """Context in which no other trainer works in the folder; may be nested.

        Raises OSError if the folder cannot be made or written to, ValueError if another trainer works in it or it is a
        file.
        """
        if self._has_lock is not None:
            yield
            return
        busy = f"another process is training in {self.path}; wait for it or choose another"
        with lock.locked(self.path, busy) as self._has_lock:
            try:
                for folder in (self.path, *map(self.path.joinpath, _FOLDERS)):
                    files.remove_litter(folder)  # Of a trainer that was killed.
                yield
            finally:
                self._has_lock = None

    def check_lock(self) -> None:
        """Raises RuntimeError if, within `locked`, the lock file was removed or the folder moved."""
        if self._has_lock is None or not self._has_lock():
            raise RuntimeError(
                f"training stopped: the lock file {self.path / '.lock'} was removed, or the folder moved; its last "
                "checkpoint is as it was: --resume it where it is now"
            )

    def create(self, config: config_lib.TrainConfig) -> Path | None:
        """Makes the folder and writes the configuration.

        Returns the folder into which the records of an earlier attempt without a checkpoint were moved, or None without
        one. Raises as `locked`, and ValueError if there is a run with a checkpoint.
        """
        with self.locked():
            self.check_new()
            moved = self.set_aside()
            content = {
                "format": FORMAT,
                "train": config.to_json(),
                "versions": provenance.versions(),
                "commit": provenance.commit(),
                "renderer": gl.renderer_name() if config.load_task().pixels else "none is needed",
            }
            files.write_atomically(self.path / "config.json", (json.dumps(content, indent=1) + "\n").encode())
        return moved

    def discard(self) -> None:
        """Removes the configuration, within `locked`, unless something has been recorded since."""
        if not self._recorded() and self._has_lock is not None and self._has_lock():
            (self.path / "config.json").unlink(missing_ok=True)

    def check_new(self) -> None:
        """Raises ValueError if the folder holds a run with a checkpoint or an agent."""
        if self.checkpointer.paths() or self.agent_path.exists():
            raise ValueError(f"{self.path} already holds a run; add --resume to continue it, or choose another folder")

    def check_resumable(self) -> None:
        """Raises ValueError if there are records, but no checkpoint to continue from."""
        if self.checkpointer.paths() or not self._recorded():
            return
        if self.agent_path.exists():
            raise ValueError(
                f"{self.path} is finished and has kept its agent alone; evaluate it, or train in another folder"
            )
        raise ValueError(
            f"{self.path} holds no checkpoint to resume from; leave out --resume to start anew, which moves its "
            "records aside"
        )

    def set_aside(self) -> Path | None:
        """Moves the records and the configuration into a folder `superseded-N`; returns that, or None without any."""
        if not (recorded := self._recorded()):
            return None
        folders = (self.path / f"superseded-{number}" for number in itertools.count(1))
        folder = next(folder for folder in folders if not folder.exists())
        folder.mkdir()
        for path in [*recorded, self.path / "config.json"]:
            if path.exists():
                path.rename(folder / path.name)
        return folder

    def _recorded(self) -> list[Path]:
        return [path for path in map(self.path.joinpath, _FILES + _FOLDERS) if path.exists()]

    # The agent.

    @property
    def is_finished(self) -> bool:
        """Returns whether the agent has been trained for all its frames."""
        rows = self.metrics()
        return bool(rows) and rows[-1]["frames"] >= self.config.agent.frames

    @property
    def checkpointer(self) -> "checkpointing.Checkpointer":
        """Returns the writer and reader of the run's checkpoints."""
        from physexp.agents import checkpointing  # Imports torch, which records do without.

        return checkpointing.Checkpointer(self.path / "checkpoints")

    def variables(self, like: Mapping[str, "torch.Tensor"] | None = None) -> dict[str, "torch.Tensor"]:
        """Returns the network's variables by name: those kept at the end, or those of the last checkpoint.

        Raises ValueError if there are none yet, or names and shapes are not those of `like`.
        """
        from physexp.agents import learning
        from physexp.agents import tensors as tensors_lib

        if self.agent_path.exists():
            path, variables = self.agent_path, tensors_lib.read(self.agent_path)[0]
        elif found := self.checkpointer.latest():
            path, variables = self.path / "checkpoints", learning.network_variables(found[0])
        else:
            raise ValueError(f"{self.path} holds no checkpoint yet; let the training write one")
        try:
            tensors_lib.check(variables, variables if like is None else like)
        except ValueError as error:
            raise ValueError(f"{path}: the network {error}; put back the run's own, or remove it") from None
        return variables

    def keep_agent_only(self) -> None:
        """Replaces checkpoints and episodes by the network in half precision: training cannot be continued after it.

        Raises ValueError if there is no checkpoint, or its weights are not finite in half precision.
        """
        from physexp.agents import tensors as tensors_lib

        with self.locked():
            if not self.agent_path.exists():
                tensors_lib.write(self.agent_path, tensors_lib.halved(self.variables()), {})
            for name in ("checkpoints", "episodes.parquet"):
                with contextlib.suppress(FileNotFoundError):
                    shutil.rmtree(self.path / name)

    # Records.

    def append_metrics(self, row: Mapping[str, float]) -> None:
        """Adds a row to `metrics.csv`; the first one makes the file and its header."""
        cells = [f"{value:.6g}" if isinstance(value, float) else str(value) for value in row.values()]
        with self._metrics_path.open("a", encoding="utf-8") as file:
            lines = [cells] if file.tell() else [list(row), cells]
            file.write("".join(f"{','.join(line)}\n" for line in lines))

    def metrics(self) -> list[dict[str, float]]:
        """Returns the rows of `metrics.csv`, but for a last one that a crash has torn.

        Raises ValueError if the file is damaged.
        """
        return [row for _, row in self._metrics_lines()[1]]

    def _metrics_lines(self) -> tuple[str, list[tuple[str, dict[str, float]]]]:
        """Returns the header of `metrics.csv`, and each whole line below it with the row that it holds."""
        path = self._metrics_path
        content = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
        header, *lines = content[: content.rfind("\n") + 1].splitlines() or [""]
        names, found = header.split(","), []
        if header and names[0] != "frames":
            raise ValueError(f"{path} is damaged: its first line names no metrics; mend it, or move it away")
        for number, line in enumerate(lines, 2):
            try:
                found.append((line, dict(zip(names, map(float, line.split(",")), strict=True))))
            except ValueError:
                raise ValueError(
                    f"{path} is damaged: line {number} is no row of {len(names)} numbers; mend it, or move it away"
                ) from None
        return header, found

    def append_episodes(self, frames: int, rows: pyarrow.Table) -> None:
        """Adds rows of `EPISODES` to `episodes.parquet`, as a part with the name of the frames trained by now."""
        folder = self.path / "episodes.parquet"
        folder.mkdir(exist_ok=True)
        tables.write(folder / f"part-{frames:015d}.parquet", rows, compression="zstd")

    def rewind(self, frames: int) -> None:
        """Removes the records after a checkpoint, whose training is lost; -1 for all of them."""
        header, lines = self._metrics_lines()
        kept = [line for line, row in lines if row["frames"] <= frames]
        if self._metrics_path.exists():
            content = "".join(f"{line}\n" for line in [header, *kept] if line)
            files.write_atomically(self._metrics_path, content.encode())
        for part in (self.path / "episodes.parquet").glob(f"part-{'[0-9]' * 15}.parquet"):
            if int(part.stem.removeprefix("part-")) > frames:
                part.unlink()
