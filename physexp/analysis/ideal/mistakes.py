"""What actions cost against the ideal experimenter, by kind of mistake (docs/ideal.md).

With V what was known before an action is worth, and Q the action, an action costs V - Q. What an episode returned is
the ideal's value, minus what its actions cost, plus luck, all discounted; and luck is 0 on average, whatever is done.
"""

from collections.abc import Mapping, Sequence
import dataclasses

import numpy as np

from physexp.analysis.ideal import base

KINDS: Mapping[str, str] = {
    "uninformative": "an interaction that could tell nothing new, where another one was best",
    "inferior": "an interaction that could tell something, where another one was best",
    "late": "an interaction where answering was best",
    "early": "an answer where an interaction was best",
    "wrong": "another answer than the likeliest",
    "silence": "an interaction in place of the last answer in time",
}
"""The kinds of mistakes, in words."""


@dataclasses.dataclass(frozen=True)
class Actions:
    """N actions, of any number of episodes, and what the ideal experimenter says of them.

    Attributes:
      value: V, what was known before each action is worth, float64 [N].
      worth: Q, what the action was worth, float64 [N].
      answering: what the best answer was worth, float64 [N].
      tells: whether the action could change what is known of the label, bool [N].
      bits: by how much the entropy of the belief fell, float64 [N].
    """

    value: np.ndarray
    worth: np.ndarray
    answering: np.ndarray
    tells: np.ndarray
    bits: np.ndarray


def actions(judgement: base.Judgement, taken: np.ndarray) -> Actions:
    """Returns what a judgement says of the actions of an episode, int64 [T]."""
    num_labels = judgement.beliefs.shape[1]
    return Actions(
        value=judgement.values.max(axis=1),
        worth=judgement.values[np.arange(len(taken)), taken],
        answering=judgement.values[:, -num_labels:].max(axis=1),
        tells=judgement.tells,
        bits=information(judgement.beliefs),
    )


def of_episodes(
    judged: Sequence[base.Judgement], taken: Sequence[np.ndarray], discount: float
) -> dict[str, np.ndarray]:
    """Returns what the mistakes of episodes cost, discounted, by kind, float64 [N] each.

    Args:
      judged: the episodes, N.
      taken: their actions, N arrays int64 [T].
      discount: gamma.
    """
    lengths = np.array([len(actions) for actions in taken])
    ends = lengths.cumsum()
    chosen, values = np.concatenate(taken), np.concatenate([judgement.values for judgement in judged])
    num_interactions = values.shape[1] - judged[0].beliefs.shape[1]
    rows = np.arange(len(chosen))
    bits = information(np.concatenate([judgement.beliefs for judgement in judged]))
    between = (lengths + 1).cumsum()[:-1] - 1  # From the last belief of an episode to the first of the next one.
    together = Actions(
        value=values.max(axis=1),
        worth=values[rows, chosen],
        answering=values[:, num_interactions:].max(axis=1),
        tells=np.concatenate([judgement.tells for judgement in judged]),
        bits=np.delete(bits, between),
    )
    found = costs(together, chosen >= num_interactions, np.isin(rows, ends - 1))
    factors = discount ** (rows - np.repeat(ends - lengths, lengths))
    return {kind: np.add.reduceat(factors * cost, ends - lengths) for kind, cost in found.items()}


def information(beliefs: np.ndarray) -> np.ndarray:
    """Returns by how many bits the entropy of beliefs, [T + 1, L], falls with each of T actions, float64 [T]."""
    return np.diff(np.sum(beliefs * np.log2(beliefs.clip(1e-300)), axis=1))


def costs(judged: Actions, are_answers: np.ndarray, are_last: np.ndarray) -> dict[str, np.ndarray]:
    """Returns what actions cost, by kind, float64 [N] each; together V - Q.

    Args:
      judged: the actions.
      are_answers: which are answers, bool [N].
      are_last: which ended an episode, bool [N].
    """
    cost = judged.value - judged.worth
    are_silent, goes_on = ~are_answers & are_last, ~are_answers & ~are_last
    is_late = judged.answering >= judged.value
    return {
        "uninformative": np.where(goes_on & ~is_late & ~judged.tells, cost, 0.0),
        "inferior": np.where(goes_on & ~is_late & judged.tells, cost, 0.0),
        "late": np.where(goes_on & is_late, cost, 0.0),
        "early": np.where(are_answers, judged.value - judged.answering, 0.0),
        "wrong": np.where(are_answers, judged.answering - judged.worth, 0.0),
        "silence": np.where(are_silent, cost, 0.0),
    }
