"""Costs of actions against the ideal experimenter, by kind of mistake (docs/ideal.md).

With V the value of the information state before an action, and Q the value of the action, an action costs V - Q. The
return of an episode is the ideal's value, minus the costs of its actions, plus luck, all discounted. Luck is 0 on
average for every policy.
"""

from collections.abc import Mapping, Sequence
import dataclasses

import numpy as np

from physexp.analysis.ideal import base

KINDS: Mapping[str, str] = {
    "uninformative": "an interaction that could reveal nothing new, when another one was best",
    "inferior": "an interaction that could reveal something, when another one was best",
    "late": "an interaction when answering was best",
    "early": "an answer when an interaction was best",
    "wrong": "an answer other than the likeliest",
    "silence": "an interaction in the last step, instead of an answer",
}
"""The kinds of mistakes, and their descriptions."""


@dataclasses.dataclass(frozen=True)
class Actions:
    """The judgement of N actions, from any number of episodes."""

    value: np.ndarray  # V, the value before each action, float64 [N].
    worth: np.ndarray  # Q, the value of the action, float64 [N].
    answering: np.ndarray  # The value of the best answer, float64 [N].
    tells: np.ndarray  # Whether the action could change the belief, bool [N].
    bits: np.ndarray  # Decrease of the entropy of the belief, float64 [N].


def actions(judgement: base.Judgement, taken: np.ndarray) -> Actions:
    """Returns the judgement of the actions that were taken in an episode, int64 [T]."""
    num_labels = judgement.beliefs.shape[1]
    return Actions(
        value=judgement.values.max(axis=1),
        worth=judgement.values[np.arange(len(taken)), taken],
        answering=judgement.values[:, -num_labels:].max(axis=1),
        tells=judgement.is_informative,
        bits=information(judgement.beliefs),
    )


def of_episodes(
    judged: Sequence[base.Judgement], taken: Sequence[np.ndarray], discount: float
) -> dict[str, np.ndarray]:
    """Returns the discounted costs of the mistakes in N episodes with actions int64 [T], by kind, float64 [N] each."""
    found: dict[str, list[np.ndarray]] = {kind: [] for kind in KINDS}
    for judgement, chosen in zip(judged, taken, strict=True):
        steps, num_interactions = np.arange(len(chosen)), judgement.values.shape[1] - judgement.beliefs.shape[1]
        by_kind = costs(actions(judgement, chosen), chosen >= num_interactions, steps == steps[-1])
        for kind, cost in by_kind.items():
            found[kind].append(discount**steps * cost)
    starts = np.cumsum([0, *map(len, taken)])[:-1]
    return {kind: np.add.reduceat(np.concatenate(its), starts) for kind, its in found.items()}


def information(beliefs: np.ndarray) -> np.ndarray:
    """Returns the decrease of the entropy of beliefs, [T + 1, L], with each of T actions, bits, float64 [T]."""
    return np.diff(np.sum(beliefs * np.log2(beliefs.clip(1e-300)), axis=1))


def costs(judged: Actions, are_answers: np.ndarray, are_last: np.ndarray) -> dict[str, np.ndarray]:
    """Returns the costs of actions by kind, float64 [N] each; their sum is V - Q.

    Args:
      judged: the actions.
      are_answers: whether they are answers, bool [N].
      are_last: whether they ended an episode, bool [N].
    """
    cost = judged.value - judged.worth
    goes_on, is_late = ~are_answers & ~are_last, judged.answering >= judged.value
    where = {
        "uninformative": (goes_on & ~is_late & ~judged.tells, cost),
        "inferior": (goes_on & ~is_late & judged.tells, cost),
        "late": (goes_on & is_late, cost),
        "early": (are_answers, judged.value - judged.answering),
        "wrong": (are_answers, judged.answering - judged.worth),
        "silence": (~are_answers & are_last, cost),
    }
    return {kind: np.where(is_kind, its, 0.0) for kind, (is_kind, its) in where.items()}
