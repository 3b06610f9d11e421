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

    value = bound = float(rules.RIGHT)

    def __init__(self, domain: str, task: str, task_kwargs: Mapping[str, Any], discount: float):
        """Takes the task, as for `suite.load`, and the agent's gamma."""
        self.discount = discount
        self._task = suite.load_task(domain, task, dict(task_kwargs))

    def actor(self) -> core.Actor:
        return base.Player(
            begin=lambda observation: self._task.num_interactions + int(observation[observing.ANSWER].argmax()),
            choose=lambda answer, step: answer,
            follow=lambda answer, action, observation: answer,
        )

    def judge(self, hidden, actions):
        belief = np.eye(self._task.num_labels)[self._task.answers(np.asarray(hidden)[None])[0]]
        interactions = np.full((len(actions), self._task.num_interactions), self.discount * rules.RIGHT)
        interactions[self._task.rules.step_limit - 1 :] = rules.WRONG  # The episode ends unanswered.
        beliefs = np.repeat(belief[None], len(actions) + 1, axis=0)
        values = np.append(interactions, base.answer_values(beliefs[1:]), axis=1)
        return base.Judgement(beliefs, values, np.zeros(len(actions), bool))

    def outcomes(self):
        return np.zeros(1, np.int64), np.ones(1, bool), np.ones(1)

    def compared(self):
        return {"at_once": self.value, "random_value": self.value}
