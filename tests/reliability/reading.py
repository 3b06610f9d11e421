"""What is read of a run, of a published agent and of records, by the functions that everybody reads them with."""

import dataclasses
import json
from pathlib import Path
import shutil
import subprocess

import subjects

from physexp.agents import pretrained
from physexp.analysis.data import tables
from physexp.analysis.replay import viewing
from physexp.analysis.training import finding, records
from physexp.analysis.training import run as run_lib


def make(folder: Path) -> None:
    """Makes one of each: `run`, `kept` (the agent alone), `published`, `records`."""
    run = run_lib.Run(folder / "run")
    run.create(subjects.config())
    subjects.train(run.path)
    shutil.copytree(run.path, folder / "kept")
    run_lib.Run(folder / "kept").keep_agent_only()
    subjects.publish(folder / "published", 3)
    records.write(folder / "records" / "records.parquet", subjects.rows(50))


# Each returns something that can be compared, or raises.


def read_config(folder):
    return run_lib.Run(folder / "run").facts, run_lib.Run(folder / "run").config


def read_metrics(folder):
    return run_lib.Run(folder / "run").metrics()


def read_checkpoint(folder):
    """What training resumes from, and the network that is evaluated."""
    told: list[str] = []
    run = run_lib.Run(folder / "run")
    tensors, facts = run.checkpointer.latest(told.append)
    if told:
        assert "\n" not in told[0] and "is damaged" in told[0]
        raise ValueError(told[0])  # The one before it is used.
    return {name: value.numpy().tobytes() for name, value in tensors.items()}, facts, _network(folder / "run")


def read_kept(folder):
    return _network(folder / "kept")


def read_published(folder):
    agent = pretrained.load("which_is_heavier", "features", 10.0, folder=folder / "published")
    return agent.card, _bytes(agent.network), finding.config_of(agent.card)


def read_records(folder):
    return records.read([folder / "records" / "records.parquet"]).to_json()


def read_episodes(folder):
    parts = sorted((folder / "run" / "episodes.parquet").iterdir())
    return [tables.read(part, run_lib.EPISODES).to_pylist() for part in parts]


def verify(path):
    """Has the viewer's own program read a recording; raises ValueError where it finds a fault."""
    command = [viewing.PROGRAM, "rrd", "verify", path]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ValueError(f"{path}: {done.stderr.strip().splitlines()[0]}")


def _network(path):
    network, config, _ = finding.find_agent(str(path))
    return _bytes(network), config


def _bytes(network):
    return {name: value.numpy().tobytes() for name, value in network.state_dict().items()}


@dataclasses.dataclass(frozen=True)
class File:
    """A file that is read.

    Attributes:
      path: within what `make` makes; a pattern of which the last one is meant.
      read: reads it.
      has_checksum: whether another value in it is noticed.
    """

    path: str
    read: object
    has_checksum: bool = True

    def find(self, folder: Path) -> Path:
        return sorted(folder.glob(self.path))[-1]


FILES = {
    "config.json": File("run/config.json", read_config, has_checksum=False),
    "metrics.csv": File("run/metrics.csv", read_metrics, has_checksum=False),
    "checkpoint, tensors": File("run/checkpoints/*.safetensors", read_checkpoint),
    "checkpoint, JSON": File("run/checkpoints/*.json", read_checkpoint),
    "agent.safetensors": File("kept/agent.safetensors", read_kept),
    "published weights": File("published/*.safetensors", read_published),
    "published card": File("published/*.json", read_published),
    "records": File("records/records.parquet", read_records),
    "episodes.parquet": File("run/episodes.parquet/*.parquet", read_episodes),
}


def outcome(file: File, path: Path, folder: Path, expected) -> str:
    """`the same`, `refused` or `another value`; anything else than one line that names `path` is an error."""
    try:
        found = file.read(folder)
    except (ValueError, RuntimeError, OSError) as error:
        assert str(error).strip() and "\n" not in str(error), repr(error)
        assert path.stem in str(error), f"does not name {path.name}: {error!r}"
        return "refused"
    return "the same" if _comparable(found) == _comparable(expected) else "another value"


def _comparable(value) -> str:
    return json.dumps(value, default=repr, sort_keys=True)
