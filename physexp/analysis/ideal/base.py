"""The interface of all ideal experimenters."""

import abc
from collections.abc import Callable, Mapping
import dataclasses
import math
from typing import Any, TypeVar

import numpy as np

from physexp.agents import core
from physexp.suite.engine import rules


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

    @abc.abstractmethod
    def actor(self) -> core.Actor:
        """Returns an actor that plays from observations alone; raises ValueError if they do not suffice."""

    @abc.abstractmethod
    def judge(self, hidden: np.ndarray, actions: np.ndarray) -> Judgement:
        """Returns the best possible beliefs and the values of all actions in an episode.

        Args:
          hidden: the hidden property, [...].
          actions: the actions that were taken, int64 [T].

        Raises:
          ValueError: if they are not known exactly.
        """

    def beliefs(self, hidden: np.ndarray, actions: np.ndarray) -> np.ndarray:
        """Returns the best possible beliefs at the start and after each action, float64 [T + 1, L]; see `judge`."""
        return self.judge(hidden, actions).beliefs

    @abc.abstractmethod
    def outcomes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns N kinds of episodes of the policy.

        They have a number of interactions, int64 [N]; a right answer or not, bool [N]; and a share of all episodes,
        float64 [N].
        """

    def figures(self) -> dict[str, Any]:
        """Returns statistics of the policy, by name.

        They are `value` and `bound`, None if they are not finite; `accuracy`; `mean_interactions`; and `histogram`, the
        share of episodes for each number of interactions.
        """
        interactions, right, shares = self.outcomes()
        return {
            "value": self.value if math.isfinite(self.value) else None,
            "bound": self.bound if math.isfinite(self.bound) else None,
            "accuracy": float(shares @ right),
            "mean_interactions": float(shares @ interactions),
            "histogram": {number: float(share) for number, share in enumerate(np.bincount(interactions, shares))},
        }

    @abc.abstractmethod
    def compared(self) -> dict[str, float]:
        """Returns further statistics, by name, usually the expected returns of other policies.

        Most families have `at_once`, the return of the likeliest label without any interaction, and `random_value`, the
        return of interactions drawn uniformly, with the best answers at the best moment.
        """

    def planning(self) -> dict[str, float]:
        """Returns the returns of experimenters that plan less, by name; empty if they are not known.

        They are `greedy` and `greedy_lucky`, for information about the label, with ties drawn or broken in its favour;
        `lookahead_1`, `lookahead_2` and `lookahead_4`; `floor`, see the function; and `planning_error`, the most by
        which they are too low.
        """
        return {}

    def summary(self) -> dict[str, Any]:
        """Returns the statistics of `figures` and of `compared`."""
        return {**self.figures(), **self.compared()}


class Player(core.EpisodicActor):
    """Plays a policy that chooses by an information state, of any type."""

    def __init__(
        self,
        begin: Callable[[Mapping[str, np.ndarray]], Any],
        choose: Callable[[Any, int], int],
        follow: Callable[[Any, int, Mapping[str, np.ndarray]], Any],
    ):
        """Takes the policy.

        Args:
          begin: returns the information state at the first observation.
          choose: returns the action in an information state, given the number of actions before it.
          follow: returns the information state after an interaction in another one, given the observation after it.
        """
        self._begin_with, self._choose_by, self._follow = begin, choose, follow

    def _begin(self, timestep):
        self._state, self._step = self._begin_with(timestep.observation), 0

    def _choose(self, observation) -> int:
        return self._choose_by(self._state, self._step)

    def _note(self, action, next_timestep):
        if not next_timestep.last():
            self._state = self._follow(self._state, int(action), next_timestep.observation)
            self._step += 1


def floor(at_once: float, discount: float, step_limit: float) -> float:
    """Returns the best return without looking, given that of the likeliest answer at once.

    Each interaction before that answer discounts its return once more. So a loss is smallest in the last step in time,
    and silence, which loses 1 there, is never better.
    """
    return max(at_once, at_once * discount ** (step_limit - 1))


_Read = TypeVar("_Read")


def readable(read: _Read | None) -> _Read:
    """Returns the function that reads observations; raises ValueError if there is none, as for images."""
    if read is None:
        raise ValueError("the ideal experimenter reads features, not images; choose a task with features")
    return read


_Numbers = TypeVar("_Numbers", float, np.ndarray)


def answer_values(beliefs: _Numbers) -> _Numbers:
    """Returns the values of answers that are right with these probabilities, a number or an array of any shape."""
    return rules.WRONG + (rules.RIGHT - rules.WRONG) * beliefs
