"""Bounds on what an ideal experimenter earns where readings are noisy, or episodes differ in what cannot be seen.

A policy that is played earns no more than the best one. Nobody earns more than one who is told what an episode differs
in and reads without noise, whose best policy another family finds.
"""

from collections.abc import Callable, Mapping, Sequence
import functools
import math
from typing import Any

import numpy as np

from physexp import checks, suite
from physexp.agents import core
from physexp.analysis.ideal import base, rollouts

NUM_EPISODES = 6400  # Played; their mean is known to 0.005 or better.
_NUM_ACTORS = 64  # Side by side.
_SEED = 1  # Of the episodes.


def is_certain(task_kwargs: Mapping[str, Any]) -> bool:
    """Returns whether a task with these options has neither noise nor variation."""
    return not task_kwargs.get("noise") and not task_kwargs.get("variation")


def made_certain(task_kwargs: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the options of the same task without noise and variation."""
    return {name: value for name, value in task_kwargs.items() if name not in ("noise", "variation")}


class Solution:
    """A policy, what it earns on average in episodes that are played, and a bound on what anybody does."""

    def __init__(
        self,
        domain: str,
        task: str,
        task_kwargs: Mapping[str, Any],
        discount: float,
        make_actor: Callable[[], core.Actor],
        find_bounds: Callable[[], Sequence[float]],
    ):
        """Prepares the episodes, which are played when something is first asked that they tell.

        Args:
          domain, task, task_kwargs: what is played, as for `suite.load`.
          discount: the agent's gamma, above 0 and at most 1.
          make_actor: makes an actor that plays the policy.
          find_bounds: finds the values of ideal experimenters who are told all that episodes differ in, one for each of
            some episodes that are drawn at random; one alone where it is the same in all.

        Raises:
          ValueError: for a value that makes no sense.
        """
        suite.load_task(domain, task, dict(task_kwargs))  # Refuses now what could not be played later.
        self._played = (domain, task, dict(task_kwargs))
        self.discount = checks.discount("discount", discount)
        self._make_actor = make_actor
        self._find_bounds = find_bounds

    @functools.cached_property
    def _bounds(self) -> np.ndarray:
        return np.asarray(self._find_bounds(), float)

    @functools.cached_property
    def _episodes(self) -> tuple[np.ndarray, np.ndarray]:
        """Final rewards and numbers of actions."""
        actors = [self._make_actor() for _ in range(_NUM_ACTORS)]
        rewards, lengths = rollouts.play(actors, *self._played, NUM_EPISODES // _NUM_ACTORS, _SEED)
        return rewards.ravel(), lengths.ravel()

    @property
    def _returns(self) -> np.ndarray:
        rewards, lengths = self._episodes
        return rewards * self.discount ** (lengths - 1)

    @property
    def value(self) -> float:
        """Returns the mean discounted return of the policy."""
        return float(self._returns.mean())

    @property
    def bound(self) -> float:
        """Returns what nobody's expected return exceeds, but for `bound_error`."""
        return float(self._bounds.mean())

    def actor(self) -> core.Actor:
        """Returns an actor that plays the policy."""
        return self._make_actor()

    def beliefs(self, episode: base.Episode) -> np.ndarray:
        """Raises ValueError: of what the policy does not see it believes nothing."""
        raise ValueError("beliefs are known where there is neither noise nor variation")

    def judge(self, episode: base.Episode) -> base.Judgement:
        """Raises ValueError, as `beliefs` does."""
        raise ValueError("what actions are worth is known where there is neither noise nor variation")

    def figures(self) -> dict[str, Any]:
        """Returns what `base.figures` does."""
        rewards, lengths = self._episodes
        return base.figures(self, lengths - 1, rewards > 0)

    def summary(self) -> dict[str, Any]:
        """Returns the figures, and the standard errors of value and bound: `value_error`, `bound_error`."""
        spread = self._bounds.std(ddof=1) / math.sqrt(len(self._bounds)) if len(self._bounds) > 1 else 0.0
        error = self._returns.std(ddof=1) / math.sqrt(len(self._returns))
        return {**self.figures(), "value_error": float(error), "bound_error": float(spread)}
