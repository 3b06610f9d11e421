"""The log of a score: a row for each action, with its evaluation against the ideal experimenter."""

from collections.abc import Mapping, Sequence
import hashlib
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
from pyarrow import compute

from physexp.analysis.data import episodes, tables
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import protocol

FILE = "actions.parquet"

TAKEN = pyarrow.schema(
    [
        ("domain", pyarrow.string()),
        ("task", pyarrow.string()),
        ("seed", pyarrow.int64()),  # Of the environment: with `episode`, it rebuilds the episode.
        ("episode", pyarrow.int64()),
        ("step", pyarrow.int32()),
        ("action", pyarrow.int32()),
        ("reward", pyarrow.float64()),
    ]
)
"""Columns of each action."""

PLAYED = pyarrow.schema([*TAKEN, ("observation", pyarrow.uint64())])  # A digest of the observation before the action.
"""Columns that are the same to the bit whenever the actions are played again."""

JUDGED = pyarrow.schema(
    [
        ("value", pyarrow.float64()),  # V, the value of the situation before the action.
        ("worth", pyarrow.float64()),  # Q, the value of the action.
        ("answering", pyarrow.float64()),  # The value of the best answer.
        ("tells", pyarrow.bool_()),  # Whether the action could change the belief in the answer.
        ("bits", pyarrow.float64()),  # Information about the answer from the action.
        ("regret", pyarrow.float64()),  # V - Q.
        ("mistake", pyarrow.dictionary(pyarrow.int32(), pyarrow.string())),  # Its kind; null for none.
    ]
)
"""Columns that follow from those, in floating point."""

SCHEMA = pyarrow.schema([*PLAYED, *JUDGED])

ACTIONS = JUDGED.names[:5]
"""Columns that hold the fields of `mistakes.Actions`, in their order."""

_NO_REGRET = 1e-9  # Less is an error of floating-point numbers.


def digest(observation: Mapping[str, np.ndarray]) -> int:
    """Returns 64 bits that depend on the names, types, shapes and bytes of an observation."""
    hashed = hashlib.blake2b(digest_size=8)
    for name in sorted(observation):
        array = observation[name]
        hashed.update(f"{name} {array.dtype.str} {array.shape} ".encode() + array.tobytes())
    return int.from_bytes(hashed.digest(), "little")


def taken(question: protocol.Question, episode: episodes.Episode) -> dict[str, Any]:
    """Returns the columns `TAKEN` of an episode, T rows."""
    count = len(episode.actions)
    keys = {**_task(question), "seed": episode.seed, "episode": episode.index}
    return {
        **{name: np.full(count, value) for name, value in keys.items()},
        "step": np.arange(count),
        "action": episode.actions,
        "reward": episode.rewards,
    }


def played(question: protocol.Question, episode: episodes.Episode) -> dict[str, Any]:
    """Returns the columns `PLAYED` of an episode, T rows."""
    seen = [
        {name: values[step] for name, values in episode.observations.items()} for step in range(len(episode.actions))
    ]
    return {**taken(question, episode), "observation": np.array([digest(each) for each in seen], np.uint64)}


def judged(question: protocol.Question, actions: np.ndarray, found: mistakes.Actions) -> dict[str, Any]:
    """Returns the columns `JUDGED` of the actions of one episode, T rows, from their judgement."""
    are_last = np.arange(len(actions)) == len(actions) - 1
    costs = mistakes.costs(found, actions >= question.num_interactions, are_last)
    kinds, table = np.array(list(costs), object), np.array(list(costs.values()))
    costliest = kinds[table.argmax(axis=0)]
    costliest[table.max(axis=0) <= _NO_REGRET] = None
    fields = dict(zip(ACTIONS, vars(found).values(), strict=True))
    return {**fields, "regret": found.value - found.worth, "mistake": costliest}


def _task(question: protocol.Question) -> dict[str, str]:
    """Returns the columns `domain` and `task`, the latter with its options: the parts of the question's name."""
    domain, _, task = question.name.partition("/")
    return {"domain": domain, "task": task}


def table(schema: pyarrow.Schema, parts: Sequence[Mapping[str, np.ndarray]]) -> pyarrow.Table:
    """Returns the table of the columns of some episodes, at least one; lists have the values of arrays [T, ...]."""
    columns = []
    for name, kind in zip(schema.names, schema.types, strict=True):
        values = np.concatenate([part[name] for part in parts])
        if pyarrow.types.is_fixed_size_list(kind):
            flat = pyarrow.array(values.ravel()).cast(kind.value_type)
            columns.append(pyarrow.FixedSizeListArray.from_arrays(flat, type=kind))
        else:
            columns.append(pyarrow.array(values).cast(kind))
    return pyarrow.table(columns, schema=schema)


def write(folder: Path, found: pyarrow.Table) -> None:
    """Writes the log of a folder; only text has dictionaries, which would enlarge digests and numbers."""
    texts = [field.name for field in SCHEMA if not pyarrow.types.is_primitive(field.type)]
    tables.write(folder / FILE, found, compression="zstd", compression_level=19, use_dictionary=texts)


def read(folder: Path) -> pyarrow.Table:
    """Returns the log of a folder; raises OSError if there is none, and ValueError if it is damaged."""
    return tables.read(folder / FILE, SCHEMA)


def of_task(found: pyarrow.Table, question: protocol.Question) -> dict[str, np.ndarray]:
    """Returns the columns of one task's rows, in their order."""
    domain, task = (compute.equal(found[column], value) for column, value in _task(question).items())
    return as_columns(found.filter(compute.and_(domain, task)))


def as_columns(found: pyarrow.Table) -> dict[str, np.ndarray]:
    """Returns the columns of a log as arrays."""
    kinds = np.array(found["mistake"].to_pylist(), object)  # A dictionary without words has no array.
    return {name: kinds if name == "mistake" else found[name].to_numpy() for name in found.column_names}


def split(columns: Mapping[str, np.ndarray]) -> list[dict[str, np.ndarray]]:
    """Returns the columns of each episode; an episode begins with step 0."""
    starts = np.flatnonzero(columns["step"] == 0)
    bounds = [0, *starts[1:], len(columns["step"])] if len(starts) else []
    return [{name: values[a:b] for name, values in columns.items()} for a, b in zip(bounds, bounds[1:], strict=False)]
