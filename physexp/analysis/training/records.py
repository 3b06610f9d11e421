"""Records of played episodes: tidy tables, one row an episode, in Parquet files."""

from collections.abc import Mapping, Sequence
import functools
from pathlib import Path

import numpy as np
import pyarrow

from physexp import suite
from physexp.analysis import domains
from physexp.analysis.data import episodes, provenance, tables
from physexp.analysis.training import config as config_lib

SCHEMA = pyarrow.schema(
    [
        ("domain", pyarrow.string()),
        ("task", pyarrow.string()),
        ("difficulty", pyarrow.float32()),  # Null where none was chosen.
        ("discount", pyarrow.float32()),  # That the agent was trained with.
        ("training_seed", pyarrow.int64()),
        ("interaction", pyarrow.string()),  # Learned or random.
        ("control_timestep", pyarrow.float32()),  # s
        ("seed", pyarrow.int64()),  # Of the environment: with `episode`, it rebuilds the episode.
        ("episode", pyarrow.int64()),
        ("actions", pyarrow.list_(pyarrow.int32())),
        ("answer", pyarrow.int32()),  # The right label.
        ("label", pyarrow.int32()),  # The label given, -1 when time ran out.
        ("reward", pyarrow.float32()),
        ("length", pyarrow.int32()),  # Actions, the label among them.
    ]
)
"""The columns of every file. What was hidden is drawn again when it is asked for."""

RECKONED = pyarrow.schema(
    [
        ("interactions", pyarrow.int32()),
        ("time", pyarrow.float32()),  # Of interaction before the label, s.
    ]
)
"""The columns that follow from these whenever a file is read."""

_RECKONED_FROM = ("label", "length", "control_timestep")
_DRAWN_BY = ("domain", "task", "difficulty", "seed", "episode", "answer")  # Columns that tell what was hidden.


def table(
    played: episodes.Episodes, config: config_lib.TrainConfig, interaction: str, control_timestep: float | np.ndarray
) -> pyarrow.Table:
    """Returns the rows of some episodes, as `SCHEMA` has them.

    Args:
      played: the episodes.
      config: of the agent that played them.
      interaction: `learned` or `random`.
      control_timestep: time between actions, s; one for all, or of each, float64 [number of episodes].
    """
    return played.table(
        SCHEMA,
        domain=config.domain,
        task=config.task,
        difficulty=config.task_kwargs.get("difficulty"),
        discount=config.agent.discount,
        training_seed=config.agent.seed,
        interaction=interaction,
        control_timestep=control_timestep,
    )


def write(path: Path, rows: pyarrow.Table) -> None:
    """Writes rows and the commit that made them: the whole file, or nothing.

    Raises:
      OSError: if it cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    stamped = rows.replace_schema_metadata({"commit": provenance.commit()})
    tables.write(path, stamped, compression="zstd", compression_level=9)


def read(paths: list[Path], columns: Sequence[str] = (*SCHEMA.names, *RECKONED.names)):
    """Returns the rows of some files as a pandas DataFrame; `commit` is what made them.

    Args:
      paths: files that `write` has written, each with the episodes of one agent.
      columns: which columns: of `SCHEMA` and `RECKONED`, and of what was hidden, as `hidden_columns` of the domain has
        them.

    Raises:
      OSError: if a file cannot be opened.
      ValueError: if a file is damaged, or other properties are hidden today than when it was played; it names the file.
    """
    import pandas

    needed = [name for name in columns if name in SCHEMA.names]
    reckoned = [name for name in columns if name in RECKONED.names]
    hidden = [name for name in columns if name not in (*SCHEMA.names, *RECKONED.names)]
    needed += [*(_RECKONED_FROM if reckoned else ()), *(_DRAWN_BY if hidden else ())]
    frames = []
    for path in paths:
        rows = tables.read(path, SCHEMA, [*dict.fromkeys(needed)])
        commit = (rows.schema.metadata or {}).get(b"commit", b"unknown").decode("ascii", "replace")
        frame = rows.to_pandas()
        if reckoned:
            interactions = frame.length - (frame.label >= 0)
            seconds = interactions * frame.control_timestep.map(_chosen)
            frame = frame.assign(interactions=interactions, time=seconds.astype(np.float32))
        if hidden:
            frame = frame.assign(**_draw_again(frame, path))
        frames.append(frame[[*columns]].assign(commit=commit))
    return pandas.concat(frames, ignore_index=True)


def _draw_again(frame, path: Path) -> Mapping[str, Sequence]:
    """Returns the columns of what was hidden in the episodes of a file; what has several values each is a list."""
    [(domain, task, difficulty)] = frame[["domain", "task", "difficulty"]].drop_duplicates().to_numpy()
    played = _load_task(domain, task, None if np.isnan(difficulty) else _chosen(difficulty))
    hidden = played.draw(frame.seed.to_numpy(), frame.episode.to_numpy())
    if (played.answers(hidden) != frame.answer).any():
        raise ValueError(f"{path} has episodes that are drawn otherwise today; remove it, and its agent plays again")
    return {name: list(values) for name, values in domains.find(domain).hidden_columns(hidden).items()}


@functools.cache
def _chosen(value: float) -> float:
    """Returns what was chosen, of all that single precision does not tell apart: what has the fewest digits."""
    return float(str(np.float32(value)))


@functools.cache
def _load_task(domain: str, task: str, difficulty: float | None):
    return suite.load_task(domain, task, {} if difficulty is None else {"difficulty": difficulty})


def discounted_return(frame) -> np.ndarray:
    """Returns discounted returns of the episodes in a frame, as `Episodes.returns` does, in single precision."""
    return (frame.reward * frame.discount ** (frame.length - 1).astype(np.float32)).to_numpy()
