"""Files of every kind, and the functions that everybody reads them with."""

from collections.abc import Callable
import dataclasses
import json
from pathlib import Path
import subprocess

import subjects

from physexp.analysis.data import tables
from physexp.analysis.replay import viewing
from physexp.analysis.score import log, protocol, scoring, targets
from physexp.analysis.training import finding
from physexp.analysis.training import run as run_lib


def make(folder: Path) -> None:
    """Makes one of each: `run`, `published`, `score`."""
    run = run_lib.Run(folder / "run")
    run.create(subjects.config())
    subjects.train(run.path)
    subjects.publish(folder / "published", 3)
    scoring.score(targets.find("random"), protocol.named(["threshold/features"]), 2, folder / "score")


# Each returns something that can be compared, or raises.


def read_config(folder):
    return run_lib.Run(folder / "run").facts, run_lib.Run(folder / "run").config


def read_metrics(folder):
    return run_lib.Run(folder / "run").metrics()


def read_checkpoint(folder):
    """Reads the newest checkpoint; raises ValueError where the one before it would be used."""
    told: list[str] = []
    tensors, facts = run_lib.Run(folder / "run").checkpointer.latest(told.append)
    if told:
        raise ValueError(told[0])
    return _bytes(tensors), facts


def read_published(folder):
    (path,) = (folder / "published").iterdir()
    network, config, provenance = finding.find_agent(str(path))
    return _bytes(network.state_dict()), config, provenance()


def read_episodes(folder):
    parts = sorted((folder / "run" / "episodes.parquet").iterdir())
    return [tables.read(part, run_lib.EPISODES).to_pylist() for part in parts]


def read_log(folder):
    return log.read(folder / "score").to_pylist()


def read_score(folder):
    return scoring.read(folder / "score")


def verify(path):
    """Has the viewer's own program read a recording; raises ValueError if it finds a fault."""
    command = [viewing.PROGRAM, "rrd", "verify", path]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ValueError(f"{path}: {done.stderr.strip().splitlines()[0]}")


def _bytes(tensors):
    return {name: value.numpy().tobytes() for name, value in tensors.items()}


@dataclasses.dataclass(frozen=True)
class File:
    """A file that is read.

    Attributes:
      pattern: of its path within the folder of `make`; the last match is meant.
      read: reads it.
      has_checksum: whether another value in it is noticed.
    """

    pattern: str
    read: Callable
    has_checksum: bool = True

    def find(self, folder: Path) -> Path:
        return sorted(folder.glob(self.pattern))[-1]

    def outcome(self, folder: Path, expected) -> str:
        """Returns `the same`, `refused` or `another value`; an error must be one line that names the file."""
        path = self.find(folder)
        try:
            found = self.read(folder)
        except (ValueError, RuntimeError, OSError) as error:
            assert str(error).strip() and "\n" not in str(error), repr(error)
            assert path.stem in str(error), f"does not name {path.name}: {error!r}"
            return "refused"
        return "the same" if _comparable(found) == _comparable(expected) else "another value"


def _comparable(value) -> str:
    return json.dumps(value, default=repr, sort_keys=True)


FILES = {
    "config.json": File("run/config.json", read_config, has_checksum=False),
    "metrics.csv": File("run/metrics.csv", read_metrics, has_checksum=False),
    "checkpoint": File("run/checkpoints/*.safetensors", read_checkpoint),
    "published agent": File("published/*.safetensors", read_published),
    "episodes.parquet": File("run/episodes.parquet/*.parquet", read_episodes, has_checksum=False),
    "log of a score": File("score/actions.parquet", read_log, has_checksum=False),
    "score": File("score/score.json", read_score, has_checksum=False),
}
