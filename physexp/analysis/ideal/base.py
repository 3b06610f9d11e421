"""The interface of all ideal experimenters."""

from collections.abc import Mapping
import dataclasses
import math
from typing import Any, Protocol, TypeVar

import numpy as np

from physexp.agents import core
from physexp.suite.engine import rules


class Episode(Protocol):
    """A recorded episode of T actions.

    Attributes:
      hidden: the hidden property, [...].
      actions: int64 [T].
      observations: by name, before each action and at the end, [T + 1, ...].
    """

    @property
    def hidden(self) -> np.ndarray: ...

    @property
    def actions(self) -> np.ndarray: ...

    @property
    def observations(self) -> Mapping[str, np.ndarray]: ...


@dataclasses.dataclass(frozen=True)
class Judgement:
    """The best possible beliefs in an episode of T actions, and the values of all actions.

    Attributes:
      beliefs: probability of each of L labels, at the start and after each action, float64 [T + 1, L].
      values: value of each action, interactions first, before each step, float64 [T, A]: for an answer, 2 b - 1, b
        being its probability; for an interaction, the ideal's expected return after it, times the discount, or -1 in
        the last step before the time limit.
      is_informative: whether the action taken could change the belief, bool [T]; False for answers.
    """

    beliefs: np.ndarray
    values: np.ndarray
    is_informative: np.ndarray


class Solution(Protocol):
    """The best policy for a question, and its value.

    Attributes:
      value: its expected discounted return from an episode's start.
      bound: an upper bound on any experimenter's; equal to the value if that is exact.
    """

    @property
    def value(self) -> float: ...

    @property
    def bound(self) -> float: ...

    def actor(self) -> core.Actor:
        """Returns an actor that plays the policy in the real environment, from observations alone.

        Raises:
          ValueError: if the task's observations do not suffice.
        """

    def beliefs(self, episode: Episode) -> np.ndarray:
        """Returns the best possible beliefs at the start and after each action, float64 [T + 1, L]."""

    def judge(self, episode: Episode) -> Judgement:
        """Returns the best possible beliefs and the values of the actions; uses no observations.

        Raises:
          ValueError: if they are not known exactly.
        """

    def figures(self) -> dict[str, Any]:
        """Returns the statistics of the function `figures`."""

    def summary(self) -> dict[str, Any]:
        """Returns the statistics of `figures`, and further ones, such as `at_once` and `random_value`."""


def figures(
    solution: Solution, interactions: np.ndarray, right: np.ndarray, shares: np.ndarray | None = None
) -> dict[str, Any]:
    """Returns statistics of a solution, by name.

    Args:
      solution: the solution.
      interactions: numbers of interactions before the answer in N kinds of episodes, int64 [N].
      right: whether the answers are right, bool [N].
      shares: the share of each kind among all episodes, float64 [N]; by default equal.

    Returns:
      `value` and `bound` of the solution, None if they are not finite; `accuracy`; `mean_interactions`; and
      `histogram`, the share of episodes for each number of interactions.
    """
    if shares is None:
        shares = np.full(len(right), 1 / len(right))
    histogram = np.bincount(interactions, shares)
    return {
        **{name: figure if math.isfinite(figure := getattr(solution, name)) else None for name in ("value", "bound")},
        "accuracy": float(shares @ right),
        "mean_interactions": float(shares @ interactions),
        "histogram": {number: float(share) for number, share in enumerate(histogram)},
    }


_Numbers = TypeVar("_Numbers", float, np.ndarray)


def worth_of_answers(beliefs: _Numbers) -> _Numbers:
    """Returns the values of answers that are right with these probabilities, a number or an array of any shape."""
    return rules.WRONG + (rules.RIGHT - rules.WRONG) * beliefs
