"""Actors that are scored: baselines that observe nothing, the ideal, trained networks, and users' policies."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from physexp.agents import core
from physexp.analysis.score import episodes, protocol


class Policy(core.Actor):
    """Plays a policy: a function of an observation and a state, None at first, that returns an action and a state."""

    def __init__(self, policy: Callable[[Any, Any], tuple[int, Any]]):
        self._policy, self._state = policy, None

    def observe_first(self, timestep):
        """Forgets the state."""
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


class Baseline(core.Actor):
    """Chooses actions without observations."""

    def __init__(self, choose: Callable[[np.random.Generator], int], first: int):
        """Makes an actor.

        Args:
          choose: returns an action, from random numbers whose seed is the index of the episode.
          first: the index of the first episode.
        """
        self._choose, self._number = choose, first - 1

    def observe_first(self, timestep):
        """Seeds the random numbers."""
        self._number += 1
        self._generator = np.random.default_rng(self._number)

    def select_action(self, observation):
        """Returns the next action."""
        return self._choose(self._generator)

    def observe(self, action, next_timestep):
        """Does nothing."""


class Network(core.Actor):
    """Plays a trained network; the index of an episode is the seed of its draws."""

    def __init__(self, network, greedy: bool, first: int = 0):
        self._network, self._greedy, self._number = network, greedy, first - 1

    def observe_first(self, timestep):
        """Begins the next episode."""
        from physexp.agents import acting

        self._number += 1
        self._actor = acting.RecurrentActor(self._network, self._number, self._greedy)
        self._actor.observe_first(timestep)

    def select_action(self, observation):
        """Returns the network's action."""
        return self._actor.select_action(observation)

    def observe(self, action, next_timestep):
        """Notes an action and the time step that followed."""
        self._actor.observe(action, next_timestep)


def _random(question: protocol.Question, first: int) -> core.Actor:
    return Baseline(lambda generator: int(generator.integers(question.num_actions)), first)


def _at_once(question: protocol.Question, first: int) -> core.Actor:
    unplayed = episodes.Episode(protocol.drawn(question, 1)[0], np.zeros(0, np.int64), np.zeros(0), [])
    likeliest = int(protocol.ideal(question).beliefs(unplayed)[0].argmax())
    return Baseline(lambda generator: question.num_interactions + likeliest, first)


BASELINES: Mapping[str, Callable[[protocol.Question, int], core.Actor]] = {
    "random": _random,
    "at_once": _at_once,
    "silent": lambda question, first: Baseline(lambda generator: 0, first),
    "ideal": lambda question, first: protocol.ideal(question).actor(),
}
"""Experimenters for every task: random actions, the likeliest answer at once, no answer, and the ideal experimenter."""
