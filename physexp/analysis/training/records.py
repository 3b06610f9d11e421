"""Rows of the tables of results: runs, learning curves, evaluations and episodes."""

from collections.abc import Mapping, Sequence
import itertools
import json
from typing import Any

import numpy as np
import pyarrow
from pyarrow import compute

from physexp import suite
from physexp.analysis import domains
from physexp.analysis.data import episodes, provenance
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

_RUN = [("condition", pyarrow.string()), ("training_seed", pyarrow.int32())]
_TRIAL = [("condition", pyarrow.string()), ("trial", pyarrow.string()), ("training_seed", pyarrow.int32())]
_COUNTS = ("frames", "updates", "episodes")
_OF_LEARNERS = itertools.chain(*(agent.metrics for agent in config_lib.ALGORITHMS.values()))
METRICS = tuple(dict.fromkeys([*run_lib.METRICS, *_OF_LEARNERS]))
"""The metrics of all learners, by name."""

RUNS = pyarrow.schema(
    [
        ("run", pyarrow.string()),
        *_RUN,
        ("domain", pyarrow.string()),
        ("task", pyarrow.string()),
        ("learner", pyarrow.string()),
        ("frames", pyarrow.int64()),
        ("seconds", pyarrow.float32()),
        ("config", pyarrow.string()),  # JSON of `TrainConfig`.
        ("versions", pyarrow.string()),  # JSON.
        ("commit", pyarrow.string()),
        ("renderer", pyarrow.string()),
    ]
)
"""A row a run."""

CURVES = pyarrow.schema(_RUN + [(name, pyarrow.int64() if name in _COUNTS else pyarrow.float32()) for name in METRICS])
"""The rows of `metrics.csv`: single precision holds their six digits; null for metrics of other learners."""

EVALUATIONS = pyarrow.schema(
    [
        *_TRIAL,
        ("episodes", pyarrow.int64()),
        ("success_rate", pyarrow.float64()),
        ("mean_return", pyarrow.float64()),  # Discounted.
        ("mean_interactions", pyarrow.float64()),
        ("timeouts", pyarrow.int64()),
        ("commit", pyarrow.string()),
    ]
)
"""A row for each trial that a run has played."""

EPISODES = pyarrow.schema(
    [
        *_TRIAL,
        ("seed", pyarrow.int64()),  # Of the environment: with `episode`, it rebuilds the episode.
        ("episode", pyarrow.int32()),
        ("control_timestep", pyarrow.float32()),  # s
        ("answer", pyarrow.uint16()),  # The right label.
        ("actions", pyarrow.list_(pyarrow.uint16())),
    ]
)
"""A row an episode. `completed` adds the columns that follow from these."""

STORED = tuple(name for name in EPISODES.names if name not in ("condition", "trial"))
"""The columns that `completed` needs."""


def condition_id(config: config_lib.TrainConfig) -> str:
    """Returns the id of a condition: the name of its runs without the seed."""
    return config.name.removesuffix(f"-seed{config.agent.seed}")


def of_run(run: run_lib.Run) -> pyarrow.Table:
    """Returns the row of `RUNS` of a finished run."""
    facts, config, last = run.facts, run.config, run.metrics()[-1]
    row = {
        "run": config.name,
        **_named(config),
        "domain": config.domain,
        "task": config.task,
        "learner": config.agent.title,
        "frames": int(last["frames"]),
        "seconds": last["seconds"],
        "config": json.dumps(config.to_json(), sort_keys=True),
        "versions": json.dumps(facts["versions"], sort_keys=True),
        "commit": facts["commit"],
        "renderer": facts["renderer"],
    }
    return pyarrow.Table.from_pylist([row], RUNS)


def of_curve(run: run_lib.Run) -> pyarrow.Table:
    """Returns the rows of `CURVES` of a run."""
    named = _named(run.config)
    rows = [{**named, **row, **{name: int(row[name]) for name in _COUNTS}} for row in run.metrics()]
    return pyarrow.Table.from_pylist(rows, CURVES)


def of_evaluation(
    rows: pyarrow.Table, config: config_lib.TrainConfig, trial: str, task_kwargs: Mapping[str, Any]
) -> pyarrow.Table:
    """Returns the row of `EVALUATIONS` of the rows of `EPISODES` that a run has played in a trial; see `completed`."""
    frame = completed(rows, config, ["reward", "length", "interactions", "label"], task_kwargs=task_kwargs)
    row = {
        **_named(config),
        "trial": trial,
        "episodes": len(frame),
        "success_rate": float((frame.reward > 0).mean()),
        "mean_return": float((frame.reward * config.agent.discount ** (frame.length - 1)).mean()),
        "mean_interactions": float(frame.interactions.mean()),
        "timeouts": int((frame.label < 0).sum()),
        "commit": provenance.commit(),
    }
    return pyarrow.Table.from_pylist([row], EVALUATIONS)


def of_episodes(
    played: episodes.Episodes, config: config_lib.TrainConfig, trial: str, control_timestep: np.ndarray
) -> pyarrow.Table:
    """Returns an agent's episodes in a trial as rows of `EPISODES`, with the time between actions, s [N]."""
    return played.table(EPISODES, **_named(config), trial=trial, control_timestep=control_timestep)


def _named(config: config_lib.TrainConfig) -> dict[str, Any]:
    return {"condition": condition_id(config), "training_seed": config.agent.seed}


def curves(rows: pyarrow.Table) -> Any:
    """Returns rows of `CURVES` as a DataFrame of the recorded numbers, which have six digits."""
    frame = rows.to_pandas()
    for name in METRICS:
        values = frame[name].to_numpy()
        frame[name] = values.astype(np.float64) if name in _COUNTS else _shortest(values)
    return frame


def _shortest(values: np.ndarray) -> np.ndarray:
    """Returns the shortest decimal numbers, float64, that equal these, float32."""
    return values.astype(str).astype(np.float64)


def completed(
    rows: pyarrow.Table,
    config: config_lib.TrainConfig,
    columns: Sequence[str],
    interaction: str = "learned",
    task_kwargs: Mapping[str, Any] | None = None,
) -> Any:
    """Returns episodes of one condition as a pandas DataFrame, with columns that follow from the stored ones.

    `columns` may be those of `EPISODES`; `domain`, `task`, `difficulty`, `discount` and `interaction` of the condition;
    `label` (-1 after a timeout), `reward`, `length`, `interactions` and `time` (s); and the hidden properties, by the
    names that the domain gives them. `task_kwargs` are options of the task that differ from those of training.

    Raises:
      ValueError: if the hidden properties that are drawn again belong to other answers than the stored ones.
    """
    import pandas

    task = suite.load_task(config.domain, config.task, {**config.task_kwargs, **(task_kwargs or {})})
    actions = rows["actions"].combine_chunks().cast(pyarrow.list_(pyarrow.int32()))
    length = compute.list_value_length(actions).to_numpy()
    last = actions.flatten().to_numpy()[np.cumsum(length) - 1]
    label = np.where(last >= task.num_interactions, last - task.num_interactions, -1)
    answer = rows["answer"].to_numpy().astype(np.int32)
    interactions = length - (label >= 0)
    seconds = _shortest(rows["control_timestep"].to_numpy())
    known = {
        "domain": config.domain,
        "task": config.task,
        "difficulty": np.float32(config.task_kwargs.get("difficulty", np.nan)),
        "discount": np.float32(config.agent.discount),
        "interaction": interaction,
        "answer": answer,
        "label": label,
        "reward": np.where(label == answer, 1, -1).astype(np.float32),
        "length": length,
        "interactions": interactions,
        "time": (interactions * seconds).astype(np.float32),
    }
    if hidden_names := [name for name in columns if name not in known and name not in rows.column_names]:
        hidden = task.draw(rows["seed"].to_numpy(), rows["episode"].to_numpy())
        if (task.answers(hidden) != answer).any():
            raise ValueError(
                f"episodes of {condition_id(config)} are drawn otherwise today; let its agents play again in another "
                "--results-dir"
            )
        drawn = domains.find(config.domain).hidden_columns(hidden)
        known |= {name: list(drawn[name]) for name in hidden_names}
    others = [name for name in dict.fromkeys(columns) if name not in known and name != "actions"]
    stored = rows.select(others).to_pandas()
    if "actions" in columns:
        known["actions"] = actions.to_pandas()
    values = {name: known[name] if name in known else stored[name] for name in columns}
    return pandas.DataFrame(values, index=range(len(rows)))


def discounted_return(frame: Any) -> np.ndarray:
    """Returns discounted returns of the episodes in a frame, in single precision."""
    return (frame.reward * frame.discount ** (frame.length - 1).astype(np.float32)).to_numpy()
