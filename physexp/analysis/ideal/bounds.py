"""Bounds on the ideal experimenter's return with noisy readings or random variation between episodes.

Lower bound: the mean return of a policy. Upper bound: the value of an informed experimenter, which reads without noise
and knows the random variation of an episode; another family solves it.
"""

from collections.abc import Callable, Mapping, Sequence
import functools
import math
from typing import Any

import numpy as np
from scipy import stats

from physexp import suite
from physexp.agents import core
from physexp.analysis.ideal import base, rollouts

NUM_EPISODES = 6400  # The standard error of their mean return is at most 0.005.
_NUM_ACTORS = 64  # That play side by side.
SEED = 1  # Of their environments.


def is_certain(task_kwargs: Mapping[str, Any]) -> bool:
    """Returns whether a task with these options has no noise and no variation."""
    return not task_kwargs.get("noise") and not task_kwargs.get("variation")


def made_certain(task_kwargs: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the options of the same task without noise and variation."""
    return {name: value for name, value in task_kwargs.items() if name not in ("noise", "variation")}


class Solution(base.Solution):
    """A policy, its mean return in played episodes, and an upper bound on any experimenter's expected return."""

    def __init__(
        self,
        domain: str,
        task: str,
        task_kwargs: Mapping[str, Any],
        discount: float,
        make_actor: Callable[[], core.Actor],
        find_bounds: Callable[[], Sequence[float]],
    ):
        """Prepares the episodes, which are played on first use; raises ValueError for an unknown task or a bad option.

        Args:
          domain, task, task_kwargs: as for `suite.load`.
          discount: the agent's gamma.
          make_actor: makes an actor that plays the policy.
          find_bounds: returns the values of informed experimenters in the first episode of each of the first
            environments of `SEED`; a single one if it is the same in all episodes.
        """
        suite.load_task(domain, task, task_kwargs)  # Refuses bad options before any episode.
        self._played, self.discount = (domain, task, task_kwargs), discount
        self._make_actor, self._find_bounds = make_actor, find_bounds

    @functools.cached_property
    def _episodes(self) -> tuple[np.ndarray, np.ndarray]:
        """Final rewards and numbers of actions; the first episodes of all actors come first."""
        actors = [self.actor() for _ in range(_NUM_ACTORS)]
        rewards, lengths = rollouts.play(actors, *self._played, NUM_EPISODES // _NUM_ACTORS, SEED)
        return rewards.ravel(), lengths.ravel()

    @property
    def _returns(self) -> np.ndarray:
        rewards, lengths = self._episodes
        return rewards * self.discount ** (lengths - 1)

    @functools.cached_property
    def _bounds(self) -> np.ndarray:
        """Estimates of the bound, one or more, whose mean is the bound.

        Informed experimenters and the policy earn more in the same episodes. To reduce the variance, the bound is the
        policy's mean return in all episodes, plus the mean difference between the two in some episodes.
        """
        found = np.asarray(self._find_bounds(), float)
        return found if len(found) == 1 else self.value + found - self._returns[: len(found)]

    @property
    def value(self) -> float:
        """The mean discounted return of the policy."""
        return float(self._returns.mean())

    @property
    def bound(self) -> float:
        """The upper bound on any experimenter's expected return."""
        return float(self._bounds.mean())

    def actor(self):
        return self._make_actor()

    def judge(self, hidden, actions):
        raise ValueError("beliefs and values of actions are only known without noise and variation")

    def outcomes(self):
        rewards, lengths = self._episodes
        return lengths - 1, rewards > 0, np.full(len(rewards), 1 / len(rewards))

    def compared(self):
        """Returns the standard errors `value_error` and `bound_error`."""
        value_error, bound_error = float(stats.sem(self._returns)), 0.0
        if len(self._bounds) > 1:
            bound_error = math.hypot(value_error, stats.sem(self._bounds))
        return {"value_error": value_error, "bound_error": bound_error}
