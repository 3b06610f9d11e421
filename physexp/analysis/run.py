"""A run's folder: what was asked for, how training went, and the agent it made.

In it are::

    config.json       the whole configuration, with versions and seeds
    metrics.csv       a row every few seconds of training
    episodes.parquet  the episodes of one update for each of those rows, a part for each checkpoint
    checkpoints/      the shared variables (safetensors) and the facts beside them (JSON)
    replays/*.rrd     episodes for the rerun viewer
    agent.safetensors the network alone, in half precision, once `keep_agent_only` has put it in their place
"""

from collections.abc import Mapping
import csv
import fcntl
import importlib.metadata
import io
import json
from pathlib import Path
import platform
import shutil
import subprocess
from typing import Any

import pyarrow
import torch

from physexp.agents import checkpointing, learning
from physexp.analysis import config as config_lib
from physexp.analysis import tables

FORMAT = 1

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
    "entropy": "mean entropy of the policy, nats",
    "policy_loss": "",
    "baseline_loss": "",
    "gradient_norm": "before clipping",
    "learning_rate": "",
    "entropy_cost": "",
    "staleness": "updates of others between taking the parameters and applying the gradient",
}
"""The columns of `metrics.csv`; losses and rates are means over the updates since the row before."""

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
        self._lock_file: Any = None

    @property
    def config(self) -> config_lib.TrainConfig:
        """What was asked for.

        Raises:
          ValueError: if the folder holds no run, or one of another format.
        """
        try:
            return config_lib.TrainConfig.from_json(self.facts["train"])
        except (KeyError, TypeError, AttributeError) as error:
            raise ValueError(f"{self.path}/config.json is not what was written: {error!r}") from None

    @property
    def facts(self) -> dict[str, Any]:
        """Returns the configuration, versions, commit and renderer that `create` wrote.

        Raises:
          ValueError: as `config`.
        """
        try:
            fields = json.loads((self.path / "config.json").read_text())
        except FileNotFoundError:
            raise ValueError(f"{self.path} holds no run (no config.json); give the folder of a run") from None
        except (ValueError, RecursionError) as error:
            raise ValueError(f"{self.path}/config.json is no JSON: {error}") from None
        form = fields.get("format") if isinstance(fields, dict) else None
        if form != FORMAT:
            raise ValueError(f"{self.path}/config.json has format {form!r}; this version reads format {FORMAT}")
        return fields

    def create(self, config: config_lib.TrainConfig) -> None:
        """Makes the folder and writes the configuration.

        Raises:
          ValueError: if there is a run already.
        """
        if (self.path / "config.json").exists():
            raise ValueError(f"{self.path} already holds a run; add --resume to continue it, or choose another folder")
        self.path.mkdir(parents=True, exist_ok=True)
        content = {"format": FORMAT, "train": config.to_json(), "versions": versions(), "commit": commit(),
                   "renderer": renderer(config)}  # fmt: skip
        checkpointing.write_atomically(self.path / "config.json", (json.dumps(content, indent=1) + "\n").encode())

    def lock(self) -> None:
        """Keeps other trainers out of the folder until this process ends or `unlock` is called.

        Raises:
          ValueError: if another trainer is at work in it.
        """
        self._lock_file = open(self.path / ".lock", "w")  # noqa: SIM115
        try:
            fcntl.flock(self._lock_file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._lock_file.close()
            raise ValueError(f"another process is training in {self.path}; wait for it or choose another") from None

    def unlock(self) -> None:
        self._lock_file.close()

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
        if self.agent_path.exists():
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
        found = self.checkpointer.latest()
        if found is None:
            raise ValueError(f"{self.path} holds no checkpoint yet; let the training write one")
        checkpointing.write_agent(self.agent_path, learning.network_variables(found[0]))
        for folder in ("checkpoints", "episodes.parquet"):
            shutil.rmtree(self.path / folder, ignore_errors=True)

    # Metrics.

    def append_metrics(self, row: dict[str, float]) -> None:
        """Adds a row to `metrics.csv`."""
        path = self.path / "metrics.csv"
        text = io.StringIO()
        writer = csv.DictWriter(text, METRICS, lineterminator="\n")
        if not path.exists():
            writer.writeheader()
        writer.writerow({name: f"{row[name]:.6g}" if isinstance(row[name], float) else row[name] for name in METRICS})
        with open(path, "a") as file:
            file.write(text.getvalue())

    def metrics(self) -> list[dict[str, float]]:
        """The rows of `metrics.csv`."""
        path = self.path / "metrics.csv"
        if not path.exists():
            return []
        with open(path) as file:
            return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]

    def append_episodes(self, frames: int, columns: dict[str, list]) -> None:
        """Adds a part to `episodes.parquet`."""
        folder = self.path / "episodes.parquet"
        folder.mkdir(exist_ok=True)
        tables.write(folder / f"part-{frames:015d}.parquet", pyarrow.table(columns, EPISODES), compression="zstd")

    def rewind(self, frames: int) -> None:
        """Drops what was recorded after a checkpoint, so that a resumed run leaves no row twice."""
        path = self.path / "metrics.csv"
        if path.exists():
            lines = path.read_text().splitlines(keepends=True)
            kept = [line for line in lines[1:] if line.endswith("\n") and int(line.split(",", 1)[0]) <= frames]
            checkpointing.write_atomically(path, "".join(lines[:1] + kept).encode())
        for part in (self.path / "episodes.parquet").glob("part-*.parquet"):
            if int(part.stem.removeprefix("part-")) > frames:
                part.unlink()


def renderer(config: config_lib.TrainConfig) -> str:
    """What draws the images of a run, or that none are drawn."""
    from physexp import suite
    from physexp.suite import rendering

    task = suite.load_task(config.domain, config.task, config.task_kwargs)
    return rendering.renderer_name() if task.sense.needs_gl else "none is needed"


def commit() -> str:
    """The commit of the source that is running, with `+` where files differ from it; `unknown` outside a checkout."""
    if shutil.which("git") is None:
        return "unknown"
    git = ["git", "-C", str(Path(__file__).parent)]
    found = subprocess.run([*git, "rev-parse", "HEAD"], capture_output=True, text=True, check=False)
    if found.returncode:
        return "unknown"
    changed = subprocess.run([*git, "diff", "--quiet", "HEAD", "--", ".."], check=False).returncode
    return found.stdout.strip() + ("+" if changed else "")


def versions() -> dict[str, str]:
    """Versions of what determines a run's results."""
    names = ("physexp", "mujoco", "dm-control", "torch", "numpy")
    return {"python": platform.python_version(), **{name: importlib.metadata.version(name) for name in names}}
