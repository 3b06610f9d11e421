"""Stated beliefs: how well a player knows the answers, compared with the best possible beliefs at the same readings.

Each answer counts: with the last belief that was stated about its question, or equal probabilities if none was.
"""

from collections.abc import Mapping, Sequence
import dataclasses
from pathlib import Path

import numpy as np
import pyarrow

from physexp.analysis.data import episodes, tables
from physexp.analysis.score import protocol, scores
from physexp.suite import words

FILE = "beliefs.parquet"
SCHEMA = pyarrow.schema(
    [
        ("task", pyarrow.string()),
        ("episode", pyarrow.int64()),
        ("step", pyarrow.int32()),
        ("probabilities", pyarrow.list_(pyarrow.float64())),  # Of each answer.
    ]
)

Stated = Mapping[int, Sequence[float]]
"""The beliefs of an episode: the probability of each answer, by the step of the action before which it was stated."""

Beliefs = Mapping[protocol.Question, Sequence[Stated]]
"""Those of the episodes of each task; empty if no belief was stated in any."""


def judged(question: protocol.Question, episode: episodes.Episode, stated: Stated) -> np.ndarray:
    """Returns the columns of `metrics` for each of N answers in an episode, float64 [N, 4]."""
    num_labels = len(question.label_names)
    best = protocol.ideal(question).beliefs(episode.hidden, episode.actions)
    asked, found, belief = episode.asked(question.num_interactions), [], None
    for step, action in enumerate(episode.actions):
        belief = stated.get(step, belief)
        if action >= question.num_interactions:
            ours = np.full(num_labels, 1 / num_labels) if belief is None else np.array(belief)
            mine, ideal = (np.log2(each.clip(words.LEAST_BELIEF)) for each in (ours, best[step]))
            right = episode.answers[asked[step]]
            lost = max(0.0, best[step] @ (ideal - mine))  # Less is rounding.
            found.append([belief is not None, mine[right], ideal[right], lost])
            belief = None
    return np.array(found, float).reshape(-1, 4)


def metrics(answers: np.ndarray) -> dict[str, float] | None:
    """Returns means over answers, [N, 4], by name; None without any answer.

    They are the share of those with a belief that was `stated`; the `log_score`, bits: the base-2 logarithm of the
    probability of the right answer; `ideal_log_score`, that of the best belief; and `bits_lost`, how much smaller the
    log score is than the best one in expectation over what is still possible, which has no luck.
    """
    names = "stated", "log_score", "ideal_log_score", "bits_lost"
    return dict(zip(names, answers.mean(axis=0).tolist(), strict=True)) if len(answers) else None


def added(
    found: Sequence[scores.TaskScore], answers: Mapping[protocol.Question, Sequence[np.ndarray]]
) -> list[scores.TaskScore]:
    """Returns the scores of tasks, each with the metrics of its episodes' answers, [N, 4], as `beliefs`."""
    return [
        dataclasses.replace(one, metrics={**one.metrics, "beliefs": metrics(np.concatenate(answers[one.question]))})
        for one in found
    ]


def write(folder: Path, stated: Beliefs) -> None:
    """Writes the beliefs into the folder of a score."""
    rows = [
        {"task": question.name, "episode": index, "step": step, "probabilities": belief}
        for question, its in stated.items()
        for index, one in enumerate(its)
        for step, belief in one.items()
    ]
    tables.write(folder / FILE, pyarrow.Table.from_pylist(rows, SCHEMA))


def read(folder: Path, questions: Sequence[protocol.Question], num_episodes: int) -> Beliefs:
    """Returns the beliefs in the folder of a score; raises OSError and ValueError for a faulty file."""
    path = folder / FILE
    if not path.exists():
        return {}
    found: dict[tuple[str, int], dict[int, list[float]]] = {
        (question.name, index): {} for question in questions for index in range(num_episodes)
    }
    counts = {question.name: len(question.label_names) for question in questions}
    for number, row in enumerate(tables.read(path, SCHEMA).to_pylist()):
        task, index = row["task"], row["episode"]
        if (task, index) not in found:
            raise ValueError(f"{path}, row {number} is of episode {index} of {task}, which is not in the score")
        try:
            found[task, index][row["step"]] = words.distribution(row["probabilities"], counts[task])
        except ValueError as error:
            raise ValueError(f"{path}, row {number}: {error}") from None
    return {question: [found[question.name, index] for index in range(num_episodes)] for question in questions}
