"""The table of steps: a row for each action, with what was observed before and after it, and what is hidden."""

from collections.abc import Mapping, Sequence

import numpy as np
import pyarrow

from physexp import suite
from physexp.analysis.score import episodes, judging, protocol

_KEYS = pyarrow.schema(
    [
        ("domain", pyarrow.string()),
        ("task", pyarrow.string()),
        ("seed", pyarrow.int64()),  # Of the environment: with `episode`, it rebuilds the episode.
        ("episode", pyarrow.int64()),
        ("step", pyarrow.int32()),
    ]
)
_TAKEN = pyarrow.schema(
    [
        ("action", pyarrow.int32()),
        ("reward", pyarrow.float64()),
        ("terminated", pyarrow.bool_()),
        ("truncated", pyarrow.bool_()),  # The simulation has diverged: the episode has no outcome.
    ]
)

OBSERVED, NEXT = "observation_", "next_"
"""What the names of columns with observations begin with, and of those after the action."""


class Steps:
    """The steps of a task's episodes.

    Attributes:
      asked: the task.
      judged_by: the ideal experimenter that says what actions are worth; None where none is known.
      schema: names and types of the columns; what is an array is a list, its last index the fastest.
    """

    def __init__(self, asked: protocol.Question, environment_seed: int):
        """Describes the columns of a task, played with a seed of the environment."""
        self.asked, self._seed = asked, environment_seed
        self._task = suite.load_task(asked.domain, asked.task)
        self.judged_by = protocol.ideal(asked) if protocol.is_judged(asked.domain) else None
        self._judge = None if self.judged_by is None else judging.Judge(self.judged_by)
        hidden = protocol.drawn(asked, 1)[0]
        self.schema = pyarrow.schema([*_KEYS, *self._observed(""), *_TAKEN, *self._observed(NEXT)])
        self.schema = self.schema.append(pyarrow.field("hidden", _type(hidden.dtype, hidden.shape)))
        self.schema = self.schema.append(pyarrow.field("answer", pyarrow.int32()))  # The right label.
        if self.judged_by is not None:
            for name, length in (
                ("belief", len(asked.label_names)),
                (f"{NEXT}belief", len(asked.label_names)),
                ("values", asked.num_actions),
            ):
                self.schema = self.schema.append(pyarrow.field(name, _type(np.dtype(float), (length,))))

    def _observed(self, prefix: str) -> list[pyarrow.Field]:
        return [
            pyarrow.field(f"{prefix}{OBSERVED}{name}", _type(spec.dtype, spec.shape))
            for name, spec in self.asked.observation_spec.items()
        ]

    def rows(self, number: int, episode: episodes.Episode) -> dict[str, np.ndarray]:
        """Returns the columns of an episode of T actions, arrays [T, ...].

        Args:
          number: its index.
          episode: the played one.
        """
        count = len(episode.actions)
        last = np.arange(count) == count - 1
        is_lost = last & (episode.rewards == 0)  # Every other end is right or wrong.
        found = {
            "domain": np.full(count, self.asked.domain),
            "task": np.full(count, self.asked.task),
            "seed": np.full(count, self._seed),
            "episode": np.full(count, number),
            "step": np.arange(count),
            "action": episode.actions,
            "reward": episode.rewards,
            "terminated": last & ~is_lost,
            "truncated": is_lost,
            "hidden": np.repeat(episode.hidden[None], count, axis=0),
            "answer": np.repeat(self._task.answers(episode.hidden[None]), count),
        }
        for name in self.asked.observation_spec:
            seen = np.array([timestep.observation[name] for timestep in episode.timesteps])
            found[f"{OBSERVED}{name}"], found[f"{NEXT}{OBSERVED}{name}"] = seen[:-1], seen[1:]
        if self._judge is not None:
            judged = self._judge.judgement(episode)
            found |= {"belief": judged.beliefs[:-1], f"{NEXT}belief": judged.beliefs[1:], "values": judged.values}
        return found

    def table(self, played: Sequence[Mapping[str, np.ndarray]]) -> pyarrow.Table:
        """Returns the table of what `rows` returned for some episodes, at least one."""
        return pyarrow.table(
            {
                field.name: _column(np.concatenate([rows[field.name] for rows in played]), field.type)
                for field in self.schema
            },
            self.schema,
        )


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
