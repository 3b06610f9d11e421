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
      observations: for each name, what was seen before each action and at the end, [T + 1, ...].
    """

    @property
    def hidden(self) -> np.ndarray: ...

    @property
    def actions(self) -> np.ndarray: ...

    @property
    def observations(self) -> Mapping[str, np.ndarray]: ...


@dataclasses.dataclass(frozen=True)
class Judgement:
    """What could be known in an episode of T actions, and what its actions were worth.

    Attributes:
      beliefs: of each of L labels, at the start and after each action, float64 [T + 1, L].
      values: what each action was worth, interactions first, before each action, float64 [T, A]: an answer, 2 b - 1; an
        interaction, what the ideal expects to earn after it, times the discount, or -1 at the last step in time.
      tells: whether the action taken could change what is known of the label, bool [T]; False for answers.
    """

    beliefs: np.ndarray
    values: np.ndarray
    tells: np.ndarray


class Solution(Protocol):
    """The best policy for a question, and what it is worth.

    Attributes:
      value: its expected discounted return from an episode's start.
      bound: an upper bound on any experimenter's; equal to the value where that is exact.
    """

    @property
    def value(self) -> float: ...

    @property
    def bound(self) -> float: ...

    def actor(self) -> core.Actor:
        """Returns an actor that plays the policy in the real environment, from observations alone.

        Raises:
          ValueError: if it cannot be played from what the task observes.
        """

    def beliefs(self, episode: Episode) -> np.ndarray:
        """Returns what could be believed at the start and after each action: of each label, float64 [T + 1, L]."""

    def judge(self, episode: Episode) -> Judgement:
        """Returns what could be known in an episode, and what its actions were worth; uses no observations.

        Raises:
          ValueError: if it cannot be known.
        """

    def figures(self) -> dict[str, Any]:
        """Returns what the function `figures` does."""

    def summary(self) -> dict[str, Any]:
        """Returns the figures, and the family's own, such as what others earn: `at_once`, `random_value`."""


def figures(
    solution: Solution, interactions: np.ndarray, right: np.ndarray, shares: np.ndarray | None = None
) -> dict[str, Any]:
    """Returns what a solution is worth and how it plays, by name.

    Args:
      solution: what is played.
      interactions: numbers of interactions before the answer, of some episodes, int64 [N].
      right: whether the answers are right, bool [N].
      shares: what share of all episodes each of these stands for, float64 [N]; by default the same.

    Returns:
      `value` and `bound` of the solution, None where they are not finite; `accuracy`; `mean_interactions`; and
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
    """Returns what answers are worth that are right with these probabilities, a number or an array of any shape."""
    return rules.WRONG + (rules.RIGHT - rules.WRONG) * beliefs
