"""A run's folder: what was asked for, how training went, and the agent it made.

In it are::

    config.json       the whole configuration, with versions and seeds
    metrics.csv       a row every few seconds of training
    episodes.parquet  the episodes of one update for each of those rows, a part for each checkpoint
    checkpoints/      the shared variables (safetensors) and the facts beside them (JSON)
    replays/*.rrd     episodes for the rerun viewer
    agent.safetensors the network alone, in half precision, once `keep_agent_only` has put it in their place
    superseded-N/     records that are no part of the run any more: of attempts that came to no checkpoint, and rows
                      after the checkpoint from which training went on
    .lock             while a trainer is at work

The folder may be a symbolic link; what is in it may not, since it is written to and removed.
"""

from collections.abc import Iterator, Mapping
import contextlib
import importlib.metadata
import itertools
import json
import math
import os
from pathlib import Path
import platform
import shutil
import subprocess
from typing import Any

import pyarrow
import torch

from physexp.agents import checkpointing, files, learning
from physexp.analysis.data import tables
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import lock

FORMAT = 1

_FOLDERS = ("checkpoints", "episodes.parquet", "replays", "tensorboard")
_RECORDS = ("metrics.csv", "failed_batch.npz", "agent.safetensors", *_FOLDERS)
_GIT_SECONDS = 60.0
_LARGEST_METRICS = 2**28  # Bytes: rows of a hundred days.

METRICS = {
    "frames": "environment steps trained on",
    "updates": "updates made",
    "episodes": "episodes trained on",
    "seconds": "time spent training, s",
    "frames_per_second": "since the row before",
    "success_rate": "share of episodes with the right label",
    "episode_return": "mean discounted return",
    "interactions": "mean interaction actions in an episode",
    "timeouts": "share of episodes that ran out of time",
}
"""The columns of `metrics.csv` that every run has.

Those of its learner follow, `AgentConfig.metrics`: means over the updates since the row before.
"""

_KNOWN = {*METRICS, *itertools.chain.from_iterable(agent.metrics for agent in config_lib.ALGORITHMS.values())}

EPISODES = pyarrow.schema(
    [
        ("frames", pyarrow.int64()),  # Of training, when the episode was learned from.
        ("seed", pyarrow.int64()),  # Seed of the environment: with `episode`, it rebuilds the episode.
        ("episode", pyarrow.int64()),
        ("answer", pyarrow.int8()),  # The right label.
        ("label", pyarrow.int8()),  # The label given, -1 when time ran out.
        ("reward", pyarrow.float32()),
        ("length", pyarrow.int16()),
        ("actions", pyarrow.list_(pyarrow.int8())),
    ]
)


class Run:
    """A run's folder."""

    def __init__(self, path: Path):
        self.path = Path(path)
        self.checkpointer = checkpointing.Checkpointer(self.path / "checkpoints")
        self._lock = lock.FolderLock(self.path)

    @property
    def config(self) -> config_lib.TrainConfig:
        """What was asked for.

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
            fields = checkpointing.read_json(self.path / "config.json")
        except (FileNotFoundError, NotADirectoryError):
            raise ValueError(f"{self.path} holds no run (no config.json); give the folder of a run") from None
        form = fields.get("format") if isinstance(fields, dict) else None
        if form != FORMAT:
            raise ValueError(f"{self.path}/config.json has format {form!r}; this version reads format {FORMAT}")
        return fields

    # Starting.

    @contextlib.contextmanager
    def locked(self) -> Iterator[None]:
        """A context in which no other trainer works in the folder; see `FolderLock.held`.

        Raises:
          OSError: if the folder cannot be made or written to.
          ValueError: if another trainer is at work in it, or if it or a folder in it is none.
        """
        with self._lock.held():
            for name in _FOLDERS:
                files.refuse_link(self.path / name)
            for litter in (self.path / "replays").glob(".replay-*"):  # Of a trainer that was killed.
                shutil.rmtree(litter)
            yield

    def check_lock(self) -> None:
        """Makes sure, within `locked`, that nobody else can be writing here by now.

        Raises:
          RuntimeError: if somebody has removed the lock file, or moved the folder.
        """
        if not self._lock.is_held:
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
                "versions": versions(),
                "commit": commit(),
                "renderer": renderer(config),
            }
            files.write_atomically(self.path / "config.json", (json.dumps(content, indent=1) + "\n").encode())
        return moved

    def discard(self) -> None:
        """Takes back, within `locked`, what `create` wrote, unless something has been recorded since."""
        if not self._recorded() and self._lock.is_held:
            (self.path / "config.json").unlink(missing_ok=True)

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
            names, _ = self._lines()
            if names and not {*METRICS, *self.config.agent.metrics} <= set(names):
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

    def variables(self, like: Mapping[str, torch.Tensor]) -> dict[str, torch.Tensor]:
        """The network's variables by name: those kept at the end, or those of the last checkpoint.

        Args:
          like: variables with the names, shapes and types that the network has; their values do not matter.

        Raises:
          ValueError: if there are none yet, or they do not fit.
        """
        if os.path.lexists(self.agent_path):  # A link to nowhere is refused as any other is.
            return checkpointing.read_agent(self.agent_path, like)

        def accept(tensors, facts):
            try:
                checkpointing.check(learning.network_variables(tensors), like)
            except ValueError as error:
                raise ValueError(f"the network {error}; put back the run's own, or remove it") from None

        most = 4 * checkpointing.num_bytes(like.values())  # Adam keeps two statistics of each.
        found = self.checkpointer.latest(accept=accept, most=most)
        if found is None:
            raise ValueError(f"{self.path} holds no checkpoint yet; let the training write one")
        return learning.network_variables(found[0])

    def keep_agent_only(self) -> None:
        """Keeps the network, in half precision, in the place of checkpoints and episodes: this run will not go on.

        Raises:
          ValueError: if there is no checkpoint, or its weights are not finite in half precision.
        """
        with self.locked():
            if not self.agent_path.exists():
                found = self.checkpointer.latest()
                if found is None:
                    raise ValueError(f"{self.path} holds no checkpoint yet; let the training write one")
                checkpointing.write_agent(self.agent_path, learning.network_variables(found[0]))
            for name in ("checkpoints", "episodes.parquet"):
                with contextlib.suppress(FileNotFoundError):
                    shutil.rmtree(self.path / name)

    # Metrics.

    def append_metrics(self, row: dict[str, float]) -> None:
        """Adds a row to `metrics.csv`, under the columns that the first row has made.

        A run that an earlier version has begun may have more columns than rows have now: those get `nan`.
        """
        with files.open_plain(self.path / "metrics.csv", "a+b") as file:
            file.seek(0)
            header = file.readline().decode(errors="replace")
            names = header.strip().split(",") if header else list(row)
            values = [row.get(name, math.nan) for name in names]
            cells = [f"{value:.6g}" if isinstance(value, float) else str(value) for value in values]
            lines = [cells] if header else [names, cells]
            file.write("".join(f"{','.join(line)}\n" for line in lines).encode())

    def metrics(self) -> list[dict[str, float]]:
        """The rows of `metrics.csv`, without one that a crash has torn.

        Raises:
          ValueError: if there is something else in it.
        """
        return self._rows(*self._lines())

    def _rows(self, header: list[str], lines: list[str]) -> list[dict[str, float]]:
        rows = []
        for number, line in enumerate(lines, 2):
            try:
                rows.append(dict(zip(header, map(float, line.split(",")), strict=True)))
            except ValueError:
                raise ValueError(
                    f"{self.path}/metrics.csv is damaged: line {number} is no row of {len(header)} numbers; mend it, "
                    "or move it away"
                ) from None
        return rows

    def _lines(self) -> tuple[list[str], list[str]]:
        """Returns the names of the columns of `metrics.csv`, none if it has none yet, and its whole lines."""
        try:
            content = files.read_plain(self.path / "metrics.csv", _LARGEST_METRICS).decode(errors="replace")
        except (FileNotFoundError, NotADirectoryError):
            content = ""
        if "\n" not in content:
            return [], []
        header, *lines = content[: content.rfind("\n") + 1].splitlines()
        names = header.split(",")
        if names[0] != "frames" or not set(names) <= _KNOWN:  # Earlier versions had fewer columns.
            raise ValueError(
                f"{self.path}/metrics.csv is damaged: its first line names no metrics; mend it, or move it away"
            )
        return names, lines

    def append_episodes(self, frames: int, columns: dict[str, list]) -> None:
        """Adds a part to `episodes.parquet`."""
        folder = self.path / "episodes.parquet"
        folder.mkdir(exist_ok=True)
        tables.write(folder / f"part-{frames:015d}.parquet", pyarrow.table(columns, EPISODES), compression="zstd")

    def rewind(self, frames: int) -> None:
        """Moves what was recorded after a checkpoint aside, so that a resumed run leaves no row twice.

        What it tells of was learned and lost. One worker, or PPO, makes it again to the bit; several workers do not.

        Raises:
          ValueError: as `metrics`.
        """
        header, lines = self._lines()
        is_kept = [row["frames"] <= frames for row in self._rows(header, lines)]
        kept = list(itertools.compress(lines, is_kept))
        later = [line for line, keep in zip(lines, is_kept, strict=True) if not keep]
        parts = (self.path / "episodes.parquet").glob(f"part-{'[0-9]' * 15}.parquet")
        later_parts = [part for part in parts if int(part.stem.removeprefix("part-")) > frames]
        if later or later_parts:
            folder = self._make_superseded()
            (folder / "episodes.parquet").mkdir()
            for part in later_parts:
                part.rename(folder / "episodes.parquet" / part.name)
            _write_lines(folder / "metrics.csv", header, later)
        if (self.path / "metrics.csv").exists():
            _write_lines(self.path / "metrics.csv", header, kept)


def _write_lines(path: Path, names: list[str], lines: list[str]) -> None:
    lines = [",".join(names), *lines] if names else []
    files.write_atomically(path, "".join(f"{line}\n" for line in lines).encode())


def renderer(config: config_lib.TrainConfig) -> str:
    """What draws the images of a run, or that none are drawn."""
    from physexp import suite
    from physexp.suite.engine import rendering

    task = suite.load_task(config.domain, config.task, config.task_kwargs)
    return rendering.renderer_name() if task.sense.needs_gl else "none is needed"


def commit() -> str:
    """Returns the commit of the source that is running, with `+` where files differ from it.

    `unknown` outside a checkout, and where git does not answer.
    """
    if shutil.which("git") is None:
        return "unknown"
    git = ["git", "-C", str(Path(__file__).parent)]
    try:
        found = subprocess.run([*git, "rev-parse", "HEAD"], capture_output=True, text=True, timeout=_GIT_SECONDS)
        if found.returncode:
            return "unknown"
        changed = subprocess.run([*git, "diff", "--quiet", "HEAD", "--", ".."], timeout=_GIT_SECONDS).returncode
    except subprocess.TimeoutExpired:  # A network's file system, for one: no reason not to train.
        return "unknown"
    return found.stdout.strip() + ("+" if changed else "")


def versions() -> dict[str, str]:
    """Versions of what determines a run's results."""
    names = ("physexp", "mujoco", "dm-control", "torch", "numpy")
    return {"python": platform.python_version(), **{name: importlib.metadata.version(name) for name in names}}
