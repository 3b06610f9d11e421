"""Actors that are scored: users' policies, trained networks, and baselines."""

from collections.abc import Callable, Mapping
import itertools
from typing import Any

import numpy as np

from physexp.agents import core
from physexp.analysis.score import episodes, protocol


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


class Network(core.Actor):
    """Plays a trained network; the index of an episode is the seed of its draws."""

    def __init__(self, network, greedy: bool, first: int = 0):
        self._network, self._greedy, self._number = network, greedy, first - 1

    def observe_first(self, timestep):
        from physexp.agents import acting

        self._number += 1
        self._actor = acting.RecurrentActor(self._network, self._number, self._greedy)
        self._actor.observe_first(timestep)

    def select_action(self, observation):
        return self._actor.select_action(observation)

    def observe(self, action, next_timestep):
        self._actor.observe(action, next_timestep)


def _random(question: protocol.Question, first: int) -> core.Actor:
    seeds = itertools.count(first)  # The indices of the episodes.

    def policy(observation, generator):
        generator = generator or np.random.default_rng(next(seeds))
        return int(generator.integers(question.num_actions)), generator

    return Policy(policy)


def _at_once(question: protocol.Question, first: int) -> core.Actor:
    unplayed = episodes.Episode(protocol.drawn(question, 1)[0], np.zeros(0, np.int64), np.zeros(0), [])
    likeliest = int(protocol.ideal(question).beliefs(unplayed)[0].argmax())
    return Policy(lambda observation, state: (question.num_interactions + likeliest, None))


BASELINES: Mapping[str, Callable[[protocol.Question, int], core.Actor]] = {
    "random": _random,
    "at_once": _at_once,
    "silent": lambda question, first: Policy(lambda observation, state: (0, None)),
    "ideal": lambda question, first: protocol.ideal(question).actor(),
}
"""Experimenters for every task: random actions, the likeliest answer at once, no answer, and the ideal experimenter."""
