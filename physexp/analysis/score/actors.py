"""Actors that are scored: users' policies, trained networks, and baselines."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from physexp.agents import core
from physexp.analysis.score import protocol

Make = Callable[[protocol.Question, int], core.Actor]
"""Returns an actor for the episode of an index in a task."""


class Policy(core.Actor):
    """Plays a policy: a function of an observation and a state, None at first, that returns an action and a state."""

    def __init__(self, policy: Callable[[Any, Any], tuple[int, Any]]):
        self._policy, self._state = policy, None

    def observe_first(self, timestep):
        self._state = None

    def select_action(self, observation):
        """Returns the action of the policy; raises TypeError if it does not return an action and a state."""
        returned = self._policy(observation, self._state)
        if not isinstance(returned, (tuple, list)) or len(returned) != 2:
            raise TypeError(f"a policy returns an action and the next state; this one has returned {returned!r:.100}")
        action, self._state = returned
        return action

    def observe(self, action, next_timestep):
        """Does nothing: the policy gets the next observation with the next call."""


def _random(question: protocol.Question, index: int) -> core.Actor:
    generator = np.random.default_rng(index)
    return Policy(lambda observation, state: (int(generator.integers(question.num_actions)), None))


def _at_once(question: protocol.Question, index: int) -> core.Actor:
    belief = protocol.ideal(question).beliefs(protocol.drawn(question, 1)[0], np.zeros(0, np.int64))[0]
    return Policy(lambda observation, state: (question.num_interactions + int(belief.argmax()), None))


BASELINES: Mapping[str, Make] = {
    "random": _random,
    "at_once": _at_once,
    "silent": lambda question, index: Policy(lambda observation, state: (0, None)),
    "ideal": lambda question, index: protocol.ideal(question).actor(),
}
"""Experimenters for every task: random actions, the likeliest answer at once, no answer, and the ideal experimenter."""
