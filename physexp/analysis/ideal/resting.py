"""The ideal experimenter of an apparatus that rests between interactions.

The reading after an interaction then depends only on the interaction, on the setting of the apparatus, which is
visible, and on the right label. The information state is thus the set of possible labels and the setting. There are
finitely many such states, and the best policy is found exactly by dynamic programming.
"""

import abc
from collections.abc import Callable, Hashable, Mapping, Sequence

import numpy as np

from physexp.agents import core
from physexp.analysis.ideal import base
from physexp.suite.engine import rules

_TIE = 1e-12  # Returns that differ by less are equal; then the policy with fewer interactions is taken.

State = tuple[int, Hashable]
"""An information state: the possible labels, as a bit mask, and the setting."""


class Apparatus(abc.ABC):
    """An apparatus that rests between interactions.

    Attributes:
      weights: probabilities of the L labels, up to a common factor, float64 [L].
      num_interactions: number of interactions, A.
      start: the information state at the start.
    """

    def __init__(self, weights: Sequence[float] | np.ndarray, num_interactions: int, start: State):
        """Takes the attributes."""
        self.weights, self.num_interactions, self.start = np.array(weights, np.float64), num_interactions, start

    @abc.abstractmethod
    def readings(self, setting: Hashable) -> np.ndarray:
        """Returns the reading after each interaction, for each right label, int [A, L]."""

    def set_by(self, setting: Hashable, interaction: int) -> Hashable:
        """Returns the setting after an interaction; by default it never changes."""
        return setting

    def canonical(self, state: State) -> tuple[State, Sequence[int]]:
        """Returns one state for all states that are equal up to a permutation of things; by default the state itself.

        Returns:
          The state, and for each of its actions the corresponding action in the given state, [A + L].
        """
        return state, range(self.num_interactions + len(self.weights))

    def after(self, state: State, interaction: int, reading: int) -> State:
        """Returns the information state after an interaction.

        Raises:
          ValueError: if none of the possible labels causes the reading.
        """
        possible, setting = state
        parts = split(possible, self.readings(setting)[interaction])
        if reading not in parts:
            raise ValueError(f"after interaction {interaction} the reading is {reading}; expected one of {list(parts)}")
        return parts[reading], self.set_by(setting, interaction)

    def posterior(self, state: State) -> np.ndarray:
        """Returns the probabilities of the labels, float64 [L]."""
        weights = self.weights * (state[0] >> np.arange(len(self.weights)) & 1)
        return weights / weights.sum()


def mask(possible: Sequence[bool] | np.ndarray) -> int:
    """Returns a bit mask of the possible labels, [L]."""
    return sum(1 << label for label, is_possible in enumerate(possible) if is_possible)


def split(possible: int, readings: Sequence[int] | np.ndarray) -> dict[int, int]:
    """Returns the possible labels for each reading, as bit masks; `readings` has the reading for each label, [L]."""
    parts: dict[int, int] = {}
    for label, reading in enumerate(readings):
        if possible >> label & 1:
            parts[int(reading)] = parts.get(int(reading), 0) | 1 << label
    return parts


class _States:
    """All S information states that can be reached, in canonical form.

    Attributes:
      index: their numbers, the start's first.
      answer: value of the best answer, [S].
      label: the best answer, int [S].
    """

    def __init__(self, apparatus: Apparatus):
        self._num_interactions = apparatus.num_interactions
        first, _ = apparatus.canonical(apparatus.start)
        self.index, states = {first: 0}, [first]
        outcomes: list[tuple[int, float, int]] = []  # Interaction and state in one number, probability, next state.
        chances = []
        for state in states:  # The list grows during the loop.
            possible, setting = state
            chances.append(apparatus.posterior(state))
            for interaction, readings in enumerate(apparatus.readings(setting).tolist()):
                following = apparatus.set_by(setting, interaction)
                for part in split(possible, readings).values():
                    chance = sum(share for label, share in enumerate(chances[-1]) if part >> label & 1)
                    after, _ = apparatus.canonical((part, following))
                    if after not in self.index:
                        self.index[after] = len(states)
                        states.append(after)
                    outcomes.append(
                        ((len(chances) - 1) * apparatus.num_interactions + interaction, chance, self.index[after])
                    )
        self._moves, self._chances, self._following = (np.array(column) for column in zip(*outcomes, strict=True))
        self._first = np.searchsorted(self._moves, np.arange(len(states) + 1) * apparatus.num_interactions)
        self.label = np.argmax(chances, axis=1)
        self.answer = base.answer_values(np.max(chances, axis=1))

    def after(self, values: np.ndarray) -> np.ndarray:
        """Returns the expected value after each interaction, [S, A], from the values of the states, [S]."""
        return np.bincount(self._moves, self._chances * values[self._following]).reshape(-1, self._num_interactions)

    def after_one(self, number: int, values: np.ndarray) -> np.ndarray:
        """Returns the row of `after` for one state, [A]."""
        outcomes = slice(self._first[number], self._first[number + 1])
        expected = self._chances[outcomes] * values[self._following[outcomes]]
        return np.bincount(self._moves[outcomes] - number * self._num_interactions, expected)


class Solution(base.Solution):
    """The best policy and its value, exact.

    Attributes:
      apparatus: the apparatus, with A interactions and L labels.
      discount: for each interaction.
      step_limit: number of steps in an unanswered episode.
    """

    def __init__(
        self,
        apparatus: Apparatus,
        discount: float,
        step_limit: int,
        read: Callable[[Mapping[str, np.ndarray]], int] | None = None,
        label: Callable[[np.ndarray], int] | None = None,
    ):
        """Finds the policy.

        An answer after n interactions earns discount^n, times -1 if it is wrong; an unanswered episode earns -1 after
        the last step.

        Args:
          apparatus, discount, step_limit: see the class.
          read: returns the reading in an observation; None if observations do not contain it.
          label: returns the right label for a hidden property; needed to judge episodes.
        """
        self.apparatus, self.discount, self.step_limit = apparatus, discount, step_limit
        self._read, self._label = read, label
        self._states = states = _States(apparatus)
        answers = apparatus.num_interactions + states.label
        # The best actions, int [S], and the values, float64 [S], of all states, by the number of steps left, from 1 on.
        # In the last step an answer is best.
        self._policy, self._best = [answers], [states.answer]
        best, at_random, length = states.answer, states.answer, np.zeros(len(answers))
        for _ in range(step_limit - 1):
            before = best, at_random, length
            values = discount * states.after(best)
            most = values.max(axis=1)
            lengths = np.where(values >= most[:, None] - _TIE, 1 + states.after(length), np.inf)
            going_on = most > states.answer + _TIE
            self._policy.append(np.where(going_on, lengths.argmin(axis=1), answers))
            length = np.where(going_on, lengths.min(axis=1), 0.0)
            best = np.maximum(states.answer, most)
            self._best.append(best)
            at_random = np.maximum(states.answer, discount * states.after(at_random).mean(axis=1))
            if all(np.array_equal(*pair) for pair in zip(before, (best, at_random, length), strict=True)):
                break  # More steps change nothing.
        self._at_random = at_random

    @property
    def value(self) -> float:
        return float(self._best[-1][0])

    @property
    def at_once(self) -> float:
        return float(self._states.answer[0])

    @property
    def random_value(self) -> float:
        return float(self._at_random[0])

    def action(self, state: State, step: int) -> int:
        """Returns the best action in a state after `step` interactions, fewer than `step_limit`."""
        canonical, actions = self.apparatus.canonical(state)
        left = min(self.step_limit - step, len(self._policy))  # More steps change nothing.
        return int(actions[self._policy[left - 1][self._states.index[canonical]]])

    def actor(self) -> core.Actor:
        if self._read is None:
            raise ValueError("the ideal experimenter reads features, not images; choose a task with features")
        return _Player(self, self._read)

    def values(self, state: State, step: int) -> np.ndarray:
        """Returns the value of each action in a state after `step` interactions, interactions first, [A + L]."""
        answers = base.answer_values(self.apparatus.posterior(state))
        left = min(self.step_limit - step, len(self._best) + 1)
        if left <= 1:  # The episode ends unanswered.
            return np.append(np.full(self.apparatus.num_interactions, float(rules.WRONG)), answers)
        canonical, actions = self.apparatus.canonical(state)
        after = self._states.after_one(self._states.index[canonical], self._best[left - 2])
        interactions = np.empty(len(after))
        interactions[list(actions[: len(after)])] = self.discount * after
        return np.append(interactions, answers)

    def beliefs(self, episode: base.Episode) -> np.ndarray:
        return np.array([self.apparatus.posterior(state) for state in self._visited(episode)])

    def judge(self, episode: base.Episode) -> base.Judgement:
        states = self._visited(episode)
        return base.Judgement(
            beliefs=np.array([self.apparatus.posterior(state) for state in states]),
            values=np.array([self.values(state, step) for step, state in enumerate(states[:-1])]),
            is_informative=np.array(list(map(self._is_informative, states[:-1], episode.actions.tolist()))),
        )

    def _visited(self, episode: base.Episode) -> list[State]:
        """Returns the information states at the start and after each action, T + 1."""
        assert self._label is not None
        label, states = self._label(episode.hidden), [self.apparatus.start]
        for action in map(int, episode.actions):
            is_answer = action >= self.apparatus.num_interactions  # It reveals nothing.
            states.append(states[-1] if is_answer else self._successor(states[-1], action, label))
        return states

    def _is_informative(self, state: State, action: int) -> bool:
        """Returns whether an action has several possible readings."""
        if action >= self.apparatus.num_interactions:
            return False
        possible, setting = state
        return len(split(possible, self.apparatus.readings(setting)[action])) > 1

    def _successor(self, state: State, interaction: int, label: int) -> State:
        """Returns the information state after an interaction, given the right label."""
        return self.apparatus.after(state, interaction, int(self.apparatus.readings(state[1])[interaction, label]))

    def play(self, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Plays episodes without physics.

        Args:
          labels: the right ones, int64 [N].

        Returns:
          Interactions, int64 [N], and whether the answer was right, bool [N].
        """
        found = np.zeros((len(self.apparatus.weights), 2), np.int64)
        for label in np.unique(labels):  # All episodes with one label are equal.
            state, step = self.apparatus.start, 0
            while (action := self.action(state, step)) < self.apparatus.num_interactions:
                state, step = self._successor(state, action, label), step + 1
            found[label] = step, action - self.apparatus.num_interactions == label
        return found[labels, 0], found[labels, 1].astype(bool)

    def outcomes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        prior = self.apparatus.posterior(self.apparatus.start)
        (labels,) = prior.nonzero()
        return *self.play(labels), prior[labels]


class _Player(core.EpisodicActor):
    """Plays a solution."""

    def __init__(self, solution: Solution, read: Callable[[Mapping[str, np.ndarray]], int]):
        self._solution, self._read = solution, read

    def _begin(self, timestep):
        self._state, self._step = self._solution.apparatus.start, 0

    def _choose(self, observation) -> int:
        return self._solution.action(self._state, self._step)

    def _note(self, action, next_timestep):
        if next_timestep.last():
            return
        reading = self._read(next_timestep.observation)
        self._state = self._solution.apparatus.after(self._state, int(action), reading)
        self._step += 1
