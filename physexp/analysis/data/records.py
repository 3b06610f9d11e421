"""Records of played episodes: tidy tables, one row an episode, in Parquet files."""

from pathlib import Path
from typing import Any

import numpy as np
import pyarrow

from physexp.analysis import domains
from physexp.analysis.data import tables
from physexp.analysis.domains import base
from physexp.analysis.evaluation import playing
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

_HEAD = [
    ("domain", pyarrow.string()),
    ("task", pyarrow.string()),
    ("difficulty", pyarrow.float32()),  # Null for a domain that has none.
    ("discount", pyarrow.float32()),  # That the agent was trained with.
    ("training_seed", pyarrow.int64()),
    ("interaction", pyarrow.string()),  # Learned or random.
    ("control_timestep", pyarrow.float32()),  # s
    ("seed", pyarrow.int64()),  # Of the environment: with `episode`, it rebuilds the episode.
    ("episode", pyarrow.int64()),
]
_TAIL = [
    ("actions", pyarrow.list_(pyarrow.int8())),
    ("answer", pyarrow.int8()),  # The right label.
    ("label", pyarrow.int8()),  # The label given, -1 when time ran out.
    ("reward", pyarrow.float32()),
    ("length", pyarrow.int16()),  # Actions, the label among them.
    ("interactions", pyarrow.int16()),
    ("time", pyarrow.float32()),  # Of interaction before the label, s.
]


def _field(column: base.Column) -> tuple[str, pyarrow.DataType]:
    kind = pyarrow.type_for_alias(column.type)
    return column.name, pyarrow.list_(kind) if column.is_list else kind


_COLUMNS = [column for domain in domains.DOMAINS.values() for column in domain.columns]

SCHEMA = pyarrow.schema([*_HEAD, *(_field(column) for column in _COLUMNS if column.is_everywhere), *_TAIL])
"""The columns of every file."""


def schema(domain_name: str) -> pyarrow.Schema:
    """Returns the columns of a file with episodes of a domain: those of every file, and then its own."""
    own = [_field(column) for column in domains.find(domain_name).columns if not column.is_everywhere]
    return pyarrow.schema([*SCHEMA, *(pyarrow.field(*each) for each in own)])


_SCHEMAS = [SCHEMA, *(schema(name) for name in domains.DOMAINS)]


def table(
    played: playing.Episodes, config: config_lib.TrainConfig, interaction: str, control_timestep: float
) -> pyarrow.Table:
    """The rows of some episodes, as `schema` has them; `config` is of the agent that played them."""
    count = len(played.lengths)
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
        "actions": played.actions,
        "answer": played.answers,
        "label": played.labels,
        "reward": played.rewards,
        "length": played.lengths,
        "interactions": played.interactions,
        "time": played.interactions * control_timestep,
        **_hidden_columns(config.domain, played.hidden),
    }
    wanted = schema(config.domain)
    return pyarrow.table({name: columns.get(name, [None] * count) for name in wanted.names}, wanted)


def _hidden_columns(domain_name: str, hidden: np.ndarray) -> dict[str, pyarrow.Array]:
    """Returns the domain's own columns, of hidden properties, [N, ...]."""
    domain = domains.find(domain_name)
    filled = domain.fill(hidden)
    found = {}
    for column in domain.columns:
        values = np.asarray(filled[column.name])
        flat = pyarrow.array(values.ravel().astype(pyarrow.type_for_alias(column.type).to_pandas_dtype()))
        if column.is_list:
            offsets = np.arange(len(values) + 1, dtype=np.int32) * (values[0].size if len(values) else 0)
            flat = pyarrow.ListArray.from_arrays(offsets, flat)
        found[column.name] = flat
    return found


def write(path: Path, rows: pyarrow.Table) -> None:
    """Writes rows and the commit that made them; there is the whole file or none."""
    path.parent.mkdir(parents=True, exist_ok=True)
    packed = {name: f"{name}.list.element" if pyarrow.types.is_list(kind) else name for name, kind in _types(rows)}
    varied = [packed.pop(column.name) for column in _COLUMNS if column.is_varied and column.name in packed]
    stamped = rows.replace_schema_metadata({"commit": run_lib.commit()})
    # Of what hardly comes twice, bytes of one rank side by side, without a dictionary, are a third smaller.
    tables.write(
        path,
        stamped,
        compression="zstd",
        compression_level=9,
        use_dictionary=list(packed.values()),
        use_byte_stream_split=varied,
    )


def _types(rows: pyarrow.Table) -> list[tuple[str, pyarrow.DataType]]:
    return [(field.name, field.type) for field in rows.schema]


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
        rows = tables.read(path, _SCHEMAS, columns)
        commit = (rows.schema.metadata or {}).get(b"commit", b"unknown").decode("ascii", "replace")
        frames.append(rows.to_pandas().assign(commit=commit))
    return pandas.concat(frames, ignore_index=True)


def discounted_return(frame) -> np.ndarray:
    """Discounted returns of the episodes in a frame: the reward, discounted once for each action before the last."""
    return (frame.reward * frame.discount ** (frame.length - 1)).to_numpy()
