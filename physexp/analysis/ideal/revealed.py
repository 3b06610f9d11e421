"""The ideal experimenter of a task that reveals the right answer: it answers at once."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from physexp import suite
from physexp.agents import core
from physexp.analysis.ideal import base
from physexp.suite.engine import observing, rules


class Solution:
    """The best policy, which gives the answer that it observes."""

    value = bound = at_once = random_value = float(rules.RIGHT)

    def __init__(self, domain: str, task: str, task_kwargs: Mapping[str, Any], discount: float):
        """Takes the task, as for `suite.load`, and the agent's gamma."""
        self.discount = discount
        self._task = suite.load_task(domain, task, dict(task_kwargs))

    def actor(self) -> core.Actor:
        """Returns an actor that gives the answer that it observes."""
        return _Player(self._task.num_interactions)

    def beliefs(self, episode: base.Episode) -> np.ndarray:
        """Returns one at the right label and 0 elsewhere, at the start and after each action, float64 [T + 1, L]."""
        return np.repeat(self._known(episode)[None], len(episode.actions) + 1, axis=0)

    def judge(self, episode: base.Episode) -> base.Judgement:
        """Returns the values of the actions: for an interaction, that of the right answer a step later."""
        num_interactions, num_actions = self._task.num_interactions, self._task.rules.num_actions
        values = np.empty((len(episode.actions), num_actions))
        values[:, :num_interactions] = self.discount * rules.RIGHT
        values[self._task.rules.step_limit - 1 :, :num_interactions] = rules.WRONG  # The episode ends unanswered.
        values[:, num_interactions:] = base.worth_of_answers(self._known(episode))
        return base.Judgement(self.beliefs(episode), values, np.zeros(len(episode.actions), bool))

    def _known(self, episode: base.Episode) -> np.ndarray:
        return np.eye(self._task.num_labels)[self._task.answers(np.asarray(episode.hidden)[None])[0]]

    def figures(self) -> dict[str, Any]:
        """Returns the statistics of `base.figures`."""
        return base.figures(self, np.zeros(1, np.int64), np.ones(1, bool))

    def summary(self) -> dict[str, Any]:
        """Returns the statistics of `figures`, `at_once` and `random_value`, which are the value."""
        return {**self.figures(), "at_once": self.value, "random_value": self.value}


class _Player(core.EpisodicActor):
    """Plays the solution."""

    def __init__(self, num_interactions: int):
        self._num_interactions = num_interactions

    def _begin(self, timestep):
        """Does nothing: every observation has the answer."""

    def _choose(self, observation) -> int:
        return self._num_interactions + int(observation[observing.ANSWER].argmax())

    def _note(self, action, next_timestep):
        """Does nothing: every observation has the answer."""
