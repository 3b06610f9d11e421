"""The table of steps: a row for each action, with the observations before and after it, and the hidden property."""

from collections.abc import Mapping, Sequence

import numpy as np
import pyarrow

from physexp import suite
from physexp.analysis.score import episodes, judging, log, protocol

_KEYS, _TAKEN = list(log.TAKEN)[:5], list(log.TAKEN)[5:]
_ENDED = pyarrow.schema(
    [
        ("terminated", pyarrow.bool_()),
        ("truncated", pyarrow.bool_()),  # The simulation has diverged: the episode has no outcome.
    ]
)

OBSERVED, NEXT = "observation_", "next_"
"""Prefixes of columns: those with observations, and those after the action."""


class Steps:
    """The steps of a task's episodes.

    Attributes:
      question: the task.
      is_judged: whether an ideal experimenter gives beliefs and values.
      schema: names and types of the columns; arrays are lists, their last index the fastest.
    """

    def __init__(self, question: protocol.Question, environment_seed: int):
        """Describes the columns of a task, played with a seed of the environment."""
        self.question, self._seed = question, environment_seed
        self._task = suite.load_task(question.domain, question.task)
        self.is_judged = protocol.is_judged(question.domain)
        self._judge = judging.Judge(protocol.ideal(question)) if self.is_judged else None
        hidden = protocol.drawn(question, 1)[0]
        num_labels = len(question.label_names)
        judged = {"belief": num_labels, f"{NEXT}belief": num_labels, "values": question.num_actions}
        self.schema = pyarrow.schema(
            [
                *_KEYS,
                *self._observed(""),
                *_TAKEN,
                *_ENDED,
                *self._observed(NEXT),
                pyarrow.field("hidden", _type(hidden.dtype, hidden.shape)),
                pyarrow.field("answer", pyarrow.int32()),  # The right label.
                *(pyarrow.field(name, _type(np.dtype(float), (n,))) for name, n in judged.items() if self.is_judged),
            ]
        )

    def _observed(self, prefix: str) -> list[pyarrow.Field]:
        specs = self.question.observation_spec
        return [
            pyarrow.field(f"{prefix}{OBSERVED}{name}", _type(spec.dtype, spec.shape)) for name, spec in specs.items()
        ]

    def rows(self, number: int, episode: episodes.Episode) -> dict[str, np.ndarray]:
        """Returns the columns of the episode of an index, with T actions, arrays [T, ...]."""
        count = len(episode.actions)
        last = np.arange(count) == count - 1
        is_lost = last & (episode.rewards == 0)  # Every other end is right or wrong.
        found = {
            **log.taken(self.question, self._seed, number, episode),
            "terminated": last & ~is_lost,
            "truncated": is_lost,
            "hidden": np.repeat(episode.hidden[None], count, axis=0),
            "answer": np.repeat(self._task.answers(episode.hidden[None]), count),
        }
        for name in self.question.observation_spec:
            seen = np.array([timestep.observation[name] for timestep in episode.timesteps])
            found[f"{OBSERVED}{name}"], found[f"{NEXT}{OBSERVED}{name}"] = seen[:-1], seen[1:]
        if self._judge is not None:
            judged = self._judge.judgement(episode)
            found |= {"belief": judged.beliefs[:-1], f"{NEXT}belief": judged.beliefs[1:], "values": judged.values}
        return found

    def table(self, rows: Sequence[Mapping[str, np.ndarray]]) -> pyarrow.Table:
        """Returns the table of the columns of some episodes, at least one."""
        columns = {
            field.name: _column(np.concatenate([part[field.name] for part in rows]), field.type)
            for field in self.schema
        }
        return pyarrow.table(columns, self.schema)


def array(column: pyarrow.ChunkedArray) -> np.ndarray:
    """Returns a column of a table as an array, [N] or, of lists, [N, K]."""
    if not pyarrow.types.is_fixed_size_list(column.type):
        return column.to_numpy()
    return column.combine_chunks().flatten().to_numpy(zero_copy_only=False).reshape(len(column), -1)


def _type(dtype: np.dtype, shape: tuple[int, ...]) -> pyarrow.DataType:
    kind = pyarrow.from_numpy_dtype(dtype)
    return pyarrow.list_(kind, int(np.prod(shape))) if shape else kind


def _column(values: np.ndarray, kind: pyarrow.DataType) -> pyarrow.Array:
    if not pyarrow.types.is_fixed_size_list(kind):
        return pyarrow.array(values).cast(kind)
    return pyarrow.FixedSizeListArray.from_arrays(pyarrow.array(values.ravel()).cast(kind.value_type), type=kind)
