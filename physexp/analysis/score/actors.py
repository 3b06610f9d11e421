"""Actors that are scored: baselines that look at nothing, the ideal, trained networks, and users' policies."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from physexp.agents import core
from physexp.analysis.score import episodes, protocol


class Policy(core.Actor):
    """Plays a policy in Gymnasium's manner: of an observation and a state, None at first, to an action and a state."""

    def __init__(self, policy: Callable[[Any, Any], tuple[int, Any]]):
        self._policy, self._state = policy, None

    def observe_first(self, timestep):
        self._state = None

    def select_action(self, observation):
        returned = self._policy(observation, self._state)
        if not isinstance(returned, (tuple, list)) or len(returned) != 2:
            raise TypeError(f"a policy returns an action and the next state; this one has returned {returned!r:.100}")
        action, self._state = returned
        return action

    def observe(self, action, next_timestep):
        """Does nothing: the policy sees the next observation when it is asked."""


class _Baseline(core.Actor):
    """An experimenter that looks at nothing."""

    def __init__(self, asked: protocol.Question, first: int = 0):
        self._asked, self._number = asked, first - 1

    def observe_first(self, timestep):
        self._number += 1

    def observe(self, action, next_timestep):
        """Does nothing."""


class Random(_Baseline):
    """Draws every action, interactions and answers alike; the index of an episode is the seed."""

    def observe_first(self, timestep):
        super().observe_first(timestep)
        self._generator = np.random.default_rng(self._number)

    def select_action(self, observation):
        return int(self._generator.integers(self._asked.num_actions))


class AtOnce(_Baseline):
    """Gives the likeliest answer at once."""

    def __init__(self, asked, first=0):
        super().__init__(asked, first)
        hidden = protocol.drawn(asked, 1)[0]
        nothing = episodes.Episode(hidden, np.zeros(0, np.int64), np.zeros(0), [])
        self._label = int(protocol.ideal(asked).beliefs(nothing)[0].argmax())

    def select_action(self, observation):
        return self._asked.num_interactions + self._label


class Silent(_Baseline):
    """Never answers."""

    def select_action(self, observation):
        return 0


def ideal(asked: protocol.Question, first: int = 0) -> core.Actor:
    """Returns the ideal experimenter of a task, which plays each episode as if it were the first."""
    return protocol.ideal(asked).actor()


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


BASELINES: Mapping[str, Callable[..., core.Actor]] = {
    "random": Random,
    "at_once": AtOnce,
    "silent": Silent,
    "ideal": ideal,
}
"""Experimenters that every task has, each made from a task and the index of the first episode that it plays."""
