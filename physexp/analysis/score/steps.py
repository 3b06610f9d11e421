"""The table of steps: a row for each action, with the observations before and after it, and the hidden property."""

import numpy as np
import pyarrow

from physexp.analysis.data import episodes
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.score import log, protocol

_KEYS, _TAKEN = list(log.TAKEN)[:5], list(log.TAKEN)[5:]


def schema(question: protocol.Question) -> pyarrow.Schema:
    """Returns names and types of the columns of a task; arrays are lists, their last index the fastest."""
    hidden, num_labels = protocol.drawn(question, 1)[0], len(question.label_names)
    seen = {name: _type(spec.dtype, spec.shape) for name, spec in question.observation_spec.items()}
    counts = {"belief": num_labels, "next_belief": num_labels, "values": question.num_actions}
    judged = counts if protocol.is_judged(question) else {}
    return pyarrow.schema(
        [
            *_KEYS,
            *((f"observation_{name}", kind) for name, kind in seen.items()),
            *_TAKEN,
            ("terminated", pyarrow.bool_()),
            ("truncated", pyarrow.bool_()),  # The simulation has diverged: the episode has no outcome.
            *((f"next_observation_{name}", kind) for name, kind in seen.items()),
            ("hidden", _type(hidden.dtype, hidden.shape)),
            ("answer", pyarrow.int32()),  # The right label of the current question.
            *((name, _type(np.dtype(float), (count,))) for name, count in judged.items()),
        ]
    )


def rows(
    question: protocol.Question, episode: episodes.Episode, judged: ideal_base.Judgement | None
) -> dict[str, np.ndarray]:
    """Returns the columns of an episode with T actions, arrays [T, ...], and its judgement if it is known."""
    count = len(episode.actions)
    found = {
        **log.taken(question, episode),
        **ends(question, episode),
        "hidden": np.repeat(episode.hidden[None], count, axis=0),
        "answer": episode.answers[episode.asked(question.num_interactions)],
    }
    for name, seen in episode.observations.items():
        found |= {f"observation_{name}": seen[:-1], f"next_observation_{name}": seen[1:]}
    if judged is not None:
        found |= {"belief": judged.beliefs[:-1], "next_belief": judged.beliefs[1:], "values": judged.values}
    return found


def ends(question: protocol.Question, episode: episodes.Episode) -> dict[str, np.ndarray]:
    """Returns after which of T actions an episode is `terminated`, and after which `truncated`, bool [T] each."""
    last = np.arange(len(episode.actions)) == len(episode.actions) - 1
    # Every other end has an answer, or costs 1 for each missing one.
    is_lost = last & (episode.rewards == 0) & (episode.actions < question.num_interactions)
    return {"terminated": last & ~is_lost, "truncated": is_lost}


def _type(dtype: np.dtype, shape: tuple[int, ...]) -> pyarrow.DataType:
    kind = pyarrow.from_numpy_dtype(dtype)
    return pyarrow.list_(kind, int(np.prod(shape))) if shape else kind
