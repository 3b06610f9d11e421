"""The interface of all ideal experimenters."""

import abc
from collections.abc import Mapping
import dataclasses
import math
from typing import Any, Protocol, TypeVar

import numpy as np

from physexp.agents import core
from physexp.suite.engine import rules


class Episode(Protocol):
    """A recorded episode of T actions."""

    @property
    def hidden(self) -> np.ndarray:
        """The hidden property, [...]."""

    @property
    def actions(self) -> np.ndarray:
        """The actions, int64 [T]."""

    @property
    def observations(self) -> Mapping[str, np.ndarray]:
        """The observations by name, before each action and at the end, [T + 1, ...]."""


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


class Solution(abc.ABC):
    """The best policy for a question, and its value."""

    @property
    @abc.abstractmethod
    def value(self) -> float:
        """Its expected discounted return from an episode's start."""

    @property
    def bound(self) -> float:
        """An upper bound on any experimenter's expected return: the value, if that is exact."""
        return self.value

    @property
    @abc.abstractmethod
    def at_once(self) -> float:
        """Expected return of the likeliest label, without any interaction."""

    @property
    @abc.abstractmethod
    def random_value(self) -> float:
        """Expected return of interactions drawn uniformly, with the best answers at the best moment."""

    @abc.abstractmethod
    def actor(self) -> core.Actor:
        """Returns an actor that plays the policy in the real environment, from observations alone.

        Raises:
          ValueError: if the task's observations do not suffice.
        """

    @abc.abstractmethod
    def judge(self, episode: Episode) -> Judgement:
        """Returns the best possible beliefs and the values of the actions; uses no observations.

        Raises:
          ValueError: if they are not known exactly.
        """

    def beliefs(self, episode: Episode) -> np.ndarray:
        """Returns the best possible beliefs at the start and after each action, float64 [T + 1, L]."""
        return self.judge(episode).beliefs

    @abc.abstractmethod
    def outcomes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns N kinds of episodes of the policy.

        Returns:
          Numbers of interactions before the answer, int64 [N]; whether the answers are right, bool [N]; and the share
          of each kind among all episodes, float64 [N].
        """

    def figures(self) -> dict[str, Any]:
        """Returns statistics of the policy, by name.

        Returns:
          `value` and `bound`, None if they are not finite; `accuracy`; `mean_interactions`; and `histogram`, the share
          of episodes for each number of interactions.
        """
        interactions, right, shares = self.outcomes()
        finite = {name: getattr(self, name) for name in ("value", "bound")}
        return {
            **{name: value if math.isfinite(value) else None for name, value in finite.items()},
            "accuracy": float(shares @ right),
            "mean_interactions": float(shares @ interactions),
            "histogram": {number: float(share) for number, share in enumerate(np.bincount(interactions, shares))},
        }

    def summary(self) -> dict[str, Any]:
        """Returns the statistics of `figures` and further ones, usually `at_once` and `random_value`."""
        return {**self.figures(), "at_once": self.at_once, "random_value": self.random_value}


_Numbers = TypeVar("_Numbers", float, np.ndarray)


def answer_values(beliefs: _Numbers) -> _Numbers:
    """Returns the values of answers that are right with these probabilities, a number or an array of any shape."""
    return rules.WRONG + (rules.RIGHT - rules.WRONG) * beliefs
