"""The log of a score: every action that was played, a row each, and what the ideal experimenter says of it."""

from collections.abc import Iterable, Mapping
import hashlib
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
from pyarrow import compute

from physexp.analysis.data import tables, untrusted
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import episodes, protocol

FILE = "actions.parquet"

PLAYED = pyarrow.schema(
    [
        ("domain", pyarrow.string()),
        ("task", pyarrow.string()),
        ("seed", pyarrow.int64()),  # Of the environment: with `episode`, it rebuilds the episode.
        ("episode", pyarrow.int64()),
        ("step", pyarrow.int32()),
        ("action", pyarrow.int32()),
        ("reward", pyarrow.float64()),
        ("observation", pyarrow.uint64()),  # A digest of what was observed before the action.
    ]
)
"""Columns that are the same to the bit whenever the actions are played again."""

JUDGED = pyarrow.schema(
    [
        ("value", pyarrow.float64()),  # What was known before the action was worth: V.
        ("worth", pyarrow.float64()),  # What the action was worth then: Q.
        ("answering", pyarrow.float64()),  # What the best answer was worth then.
        ("tells", pyarrow.bool_()),  # Whether the action could change what was known of the answer.
        ("bits", pyarrow.float64()),  # Of information about the answer that it brought.
        ("regret", pyarrow.float64()),  # V - Q.
        ("mistake", pyarrow.dictionary(pyarrow.int32(), pyarrow.string())),  # Its kind; null where there is none.
    ]
)
"""Columns that follow from those, in floating point."""

SCHEMA = pyarrow.schema([*PLAYED, *JUDGED])

ACTIONS = JUDGED.names[:5]
"""Columns that hold the fields of `mistakes.Actions`, in their order."""

_NO_REGRET = 1e-9  # Less is an error of floating-point numbers.


def digest(observation: Mapping[str, np.ndarray]) -> int:
    """Returns 64 bits that depend on the names, types, shapes and bytes of what is observed."""
    hashed = hashlib.blake2b(digest_size=8)
    for name in sorted(observation):
        array = observation[name]
        hashed.update(f"{name} {array.dtype.str} {array.shape} ".encode() + array.tobytes())
    return int.from_bytes(hashed.digest(), "little")


def rows(
    asked: protocol.Question, seed: int, number: int, episode: episodes.Episode, actions: mistakes.Actions
) -> dict[str, Any]:
    """Returns all columns of one episode, T rows.

    Args:
      asked, seed, number, episode: as for `played`.
      actions: the judgement of its actions.
    """
    return {**played(asked, seed, number, episode), **judged(asked, episode.actions, actions)}


def played(asked: protocol.Question, seed: int, number: int, episode: episodes.Episode) -> dict[str, Any]:
    """Returns the columns `PLAYED` of one episode, T rows.

    Args:
      asked: the task.
      seed: of the environment.
      number: the episode's index.
      episode: what was played.
    """
    count = len(episode.actions)
    return {
        "domain": np.full(count, asked.domain),
        "task": np.full(count, asked.task),
        "seed": np.full(count, seed),
        "episode": np.full(count, number),
        "step": np.arange(count),
        "action": episode.actions,
        "reward": episode.rewards,
        "observation": np.array([digest(seen.observation) for seen in episode.timesteps[:-1]], np.uint64),
    }


def judged(asked: protocol.Question, actions: np.ndarray, found: mistakes.Actions) -> dict[str, Any]:
    """Returns the columns `JUDGED` of the actions of one episode, T rows."""
    fields = dict(zip(ACTIONS, vars(found).values(), strict=True))
    return {**fields, "regret": found.value - found.worth, "mistake": _kinds(asked, actions, found)}


def _kinds(asked: protocol.Question, actions: np.ndarray, judged: mistakes.Actions) -> np.ndarray:
    """Returns of which kind each action of an episode is, or is most, object [T]; None for no mistake."""
    are_last = np.arange(len(actions)) == len(actions) - 1
    costs = mistakes.costs(judged, actions >= asked.num_interactions, are_last)
    kinds, table = np.array(list(costs), object), np.array(list(costs.values()))
    found = kinds[table.argmax(axis=0)]
    found[table.max(axis=0) <= _NO_REGRET] = None
    return found


def table(played: Iterable[Mapping[str, Any]]) -> pyarrow.Table:
    """Returns the table of what `rows` returned for some episodes, at least one."""
    columns = list(played)
    joined = {name: np.concatenate([part[name] for part in columns]) for name in SCHEMA.names}
    return pyarrow.table({name: pyarrow.array(joined[name]).cast(SCHEMA.field(name).type) for name in joined}, SCHEMA)


def write(folder: Path, found: pyarrow.Table) -> None:
    """Writes the log of a folder. Only words get dictionaries: those of digests and numbers would save nothing."""
    words = [field.name for field in SCHEMA if not pyarrow.types.is_primitive(field.type)]
    tables.write(folder / FILE, found, compression="zstd", compression_level=19, use_dictionary=words)


def read(folder: Path) -> pyarrow.Table:
    """Returns the log of a folder.

    Raises:
      OSError: if there is none.
      ValueError: if it is damaged; it names the file.
    """
    return untrusted.read_table(folder / FILE, SCHEMA)


def of_task(found: pyarrow.Table, asked: protocol.Question) -> dict[str, np.ndarray]:
    """Returns the columns of one task's rows, in their order."""
    is_its = compute.and_(compute.equal(found["domain"], asked.domain), compute.equal(found["task"], asked.task))
    its = found.filter(is_its)
    kinds = np.array(its["mistake"].to_pylist(), object)  # A dictionary without words has no array.
    return {name: kinds if name == "mistake" else its[name].to_numpy() for name in its.column_names}


def split(columns: Mapping[str, np.ndarray]) -> list[dict[str, np.ndarray]]:
    """Returns the columns of each episode of a task; an episode begins with step 0."""
    starts = np.flatnonzero(columns["step"] == 0)
    bounds = [0, *starts[1:], len(columns["step"])] if len(starts) else []
    return [{name: values[a:b] for name, values in columns.items()} for a, b in zip(bounds, bounds[1:], strict=False)]
