"""The ideal experimenter of a task that reveals the right answer: it answers at once."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from physexp import suite
from physexp.agents import core
from physexp.analysis.ideal import base
from physexp.suite.engine import observing, rules


class Solution(base.Solution):
    """The best policy, which gives the answer that it observes."""

    value = bound = at_once = random_value = float(rules.RIGHT)

    def __init__(self, domain: str, task: str, task_kwargs: Mapping[str, Any], discount: float):
        """Takes the task, as for `suite.load`, and the agent's gamma."""
        self.discount = discount
        self._task = suite.load_task(domain, task, dict(task_kwargs))

    def actor(self) -> core.Actor:
        return _Player(self._task.num_interactions)

    def judge(self, episode: base.Episode) -> base.Judgement:
        belief = np.eye(self._task.num_labels)[self._task.answers(np.asarray(episode.hidden)[None])[0]]
        num_interactions, num_actions = self._task.num_interactions, self._task.rules.num_actions
        values = np.empty((len(episode.actions), num_actions))
        values[:, :num_interactions] = self.discount * rules.RIGHT
        values[self._task.rules.step_limit - 1 :, :num_interactions] = rules.WRONG  # The episode ends unanswered.
        values[:, num_interactions:] = base.answer_values(belief)
        beliefs = np.repeat(belief[None], len(episode.actions) + 1, axis=0)
        return base.Judgement(beliefs, values, np.zeros(len(episode.actions), bool))

    def outcomes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return np.zeros(1, np.int64), np.ones(1, bool), np.ones(1)


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
