"""Records of played episodes: tidy tables, one row an episode, in Parquet files."""

from pathlib import Path

import numpy as np
import pyarrow

from physexp.analysis import domains
from physexp.analysis.data import episodes, provenance, tables
from physexp.analysis.domains import base
from physexp.analysis.training import config as config_lib

_HEAD = [
    ("domain", pyarrow.string()),
    ("task", pyarrow.string()),
    ("difficulty", pyarrow.float32()),  # Null where none was chosen.
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


_COLUMNS = {column.name: column for domain in domains.DOMAINS.values() for column in domain.columns}
_EVERYWHERE = [column for column in _COLUMNS.values() if column.is_everywhere]

SCHEMA = pyarrow.schema([*_HEAD, *map(_field, _EVERYWHERE), *_TAIL])
"""The columns of every file; those of domains are null for others."""


def schema(domain_name: str) -> pyarrow.Schema:
    """Returns the columns of a file with episodes of a domain: those of every file, and then its own."""
    own = [pyarrow.field(*_field(column)) for column in domains.find(domain_name).columns if not column.is_everywhere]
    return pyarrow.schema([*SCHEMA, *own])


_SCHEMAS = [SCHEMA, *map(schema, domains.DOMAINS)]


def table(
    played: episodes.Episodes, config: config_lib.TrainConfig, interaction: str, control_timestep: float
) -> pyarrow.Table:
    """Returns the rows of some episodes, as `schema` has them.

    Args:
      played: the episodes.
      config: of the agent that played them.
      interaction: `learned` or `random`.
      control_timestep: time between actions, s.
    """
    return played.table(
        schema(config.domain),
        domain=config.domain,
        task=config.task,
        difficulty=config.task_kwargs.get("difficulty"),
        discount=config.agent.discount,
        training_seed=config.agent.seed,
        interaction=interaction,
        control_timestep=control_timestep,
        time=played.interactions * control_timestep,
        **{column.name: None for column in _EVERYWHERE} | _filled(domains.find(config.domain), played.hidden),
    )


def _filled(domain: base.Domain, hidden: np.ndarray) -> dict[str, np.ndarray | pyarrow.Array]:
    """Returns the domain's own columns, of hidden properties, [N, ...]."""
    filled = domain.fill(hidden)
    found: dict[str, np.ndarray | pyarrow.Array] = {}
    for column in domain.columns:
        values = np.asarray(filled[column.name]).astype(pyarrow.type_for_alias(column.type).to_pandas_dtype())
        is_list = column.is_list
        found[column.name] = episodes.lists(values.ravel(), np.full(*values.shape)) if is_list else values
    return found


def write(path: Path, rows: pyarrow.Table) -> None:
    """Writes rows and the commit that made them: the whole file, or nothing.

    Raises:
      OSError: if it cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    stamped = rows.replace_schema_metadata({"commit": provenance.commit()})
    # Of what hardly comes twice, bytes of one rank side by side, without a dictionary, are a third smaller.
    packed: dict[bool, list[str]] = {True: [], False: []}
    for field in rows.schema:
        is_varied = field.name in _COLUMNS and _COLUMNS[field.name].is_varied
        packed[is_varied].append(f"{field.name}.list.element" if pyarrow.types.is_list(field.type) else field.name)
    tables.write(
        path,
        stamped,
        compression="zstd",
        compression_level=9,
        use_dictionary=packed[False],
        use_byte_stream_split=packed[True],
    )


def read(paths: list[Path], columns: list[str] | None = None):
    """Returns the rows of some files as a pandas DataFrame; `commit` is what made them.

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
    """Returns discounted returns of the episodes in a frame, as `Episodes.returns` does."""
    return (frame.reward * frame.discount ** (frame.length - 1)).to_numpy()
