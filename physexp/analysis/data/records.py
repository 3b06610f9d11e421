"""Records of played episodes: tidy tables, one row an episode, in Parquet files."""

from pathlib import Path
from typing import Any

import numpy as np
import pyarrow

from physexp.analysis.data import tables
from physexp.analysis.evaluation import playing
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.suite.domains import which_is_heavier

SCHEMA = pyarrow.schema(
    [
        ("domain", pyarrow.string()),
        ("task", pyarrow.string()),
        ("difficulty", pyarrow.float32()),  # The paper's beta; null for towers.
        ("discount", pyarrow.float32()),  # That the agent was trained with.
        ("training_seed", pyarrow.int64()),
        ("interaction", pyarrow.string()),  # Learned or random.
        ("control_timestep", pyarrow.float32()),  # s
        ("seed", pyarrow.int64()),  # Of the environment: with `episode`, it rebuilds the episode.
        ("episode", pyarrow.int64()),
        ("masses", pyarrow.list_(pyarrow.float32())),  # On the paper's scale, [0, 1]; null for towers.
        ("mass_gap", pyarrow.float32()),  # Between the two heaviest blocks.
        ("pattern", pyarrow.int8()),  # Of the glue, an index in `tower.PATTERNS`; null for Which is Heavier.
        ("actions", pyarrow.list_(pyarrow.int8())),
        ("answer", pyarrow.int8()),  # The right label.
        ("label", pyarrow.int8()),  # The label given, -1 when time ran out.
        ("reward", pyarrow.float32()),
        ("length", pyarrow.int16()),  # Actions, the label among them.
        ("interactions", pyarrow.int16()),
        ("time", pyarrow.float32()),  # Of interaction before the label, s.
    ]
)

# Hardly a mass comes twice: bytes of one rank side by side, without a dictionary, are a third smaller.
_VARIED = ["masses.list.element", "mass_gap"]
_REPEATED = ["actions.list.element", *(name for name in SCHEMA.names if name not in ("masses", "mass_gap"))]


def table(
    played: playing.Episodes, config: config_lib.TrainConfig, interaction: str, control_timestep: float
) -> pyarrow.Table:
    """The rows of some episodes, as `SCHEMA` has them; `config` is of the agent that played them."""
    count = len(played.lengths)
    is_masses = played.hidden.ndim == 2
    nothing = [None] * count
    columns: dict[str, Any] = {
        "domain": [config.domain] * count,
        "task": [config.task] * count,
        "difficulty": [config.task_kwargs.get("difficulty")] * count,
        "discount": [config.agent.discount] * count,
        "training_seed": [config.agent.seed] * count,
        "interaction": [interaction] * count,
        "control_timestep": [control_timestep] * count,
        "seed": played.seeds,
        "episode": played.numbers,
        "masses": list(played.hidden.astype(np.float32)) if is_masses else nothing,
        "mass_gap": which_is_heavier.mass_gaps(played.hidden).astype(np.float32) if is_masses else nothing,
        "pattern": nothing if is_masses else played.hidden,
        "actions": played.actions,
        "answer": played.answers,
        "label": played.labels,
        "reward": played.rewards,
        "length": played.lengths,
        "interactions": played.interactions,
        "time": played.interactions * control_timestep,
    }
    return pyarrow.table(columns, SCHEMA)


def write(path: Path, rows: pyarrow.Table) -> None:
    """Writes rows and the commit that made them; there is the whole file or none."""
    path.parent.mkdir(parents=True, exist_ok=True)
    stamped = rows.replace_schema_metadata({"commit": run_lib.commit()})
    tables.write(
        path, stamped, compression="zstd", compression_level=9, use_dictionary=_REPEATED, use_byte_stream_split=_VARIED
    )


def read(paths: list[Path], columns: list[str] | None = None):
    """The rows of some files as a pandas DataFrame; `commit` is what made them.

    Args:
      paths: files that `write` has written.
      columns: which columns; all by default.

    Raises:
      OSError: if a file cannot be opened.
      ValueError: if a file is damaged; it names the file.
    """
    import pandas

    frames = []
    for path in paths:
        rows = tables.read(path, SCHEMA, columns)
        commit = (rows.schema.metadata or {}).get(b"commit", b"unknown").decode("ascii", "replace")
        frames.append(rows.to_pandas().assign(commit=commit))
    return pandas.concat(frames, ignore_index=True)


def discounted_return(frame) -> np.ndarray:
    """Discounted returns of the episodes in a frame: the reward, discounted once for each action before the last."""
    return (frame.reward * frame.discount ** (frame.length - 1)).to_numpy()
