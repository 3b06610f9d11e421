"""The ideal experimenter of an apparatus that rests between interactions.

What is read after an interaction then follows from the interaction, from how the apparatus was set before, which is
seen, and from the right label. What an experimenter knows is thus which labels are still possible and how the apparatus
is set. There are finitely many such states, and the best policy is found exactly by going back from the last step.
"""

import abc
from collections.abc import Callable, Hashable, Mapping, Sequence
import dataclasses
from typing import Any

import numpy as np

from physexp.agents import core
from physexp.analysis.ideal import base
from physexp.suite.engine import rules

_TIE = 1e-12  # Returns that differ by less are equal: the shorter way is taken.

State = tuple[int, Hashable]
"""What is known, that is the labels that are possible, a bit mask, and the setting."""


class Apparatus(abc.ABC):
    """An apparatus that rests between interactions.

    Attributes:
      weights: how probable the L labels are, relative to each other, float64 [L].
      num_interactions: A.
      start: what is known at first.
    """

    def __init__(self, weights: Sequence[float] | np.ndarray, num_interactions: int, start: State):
        """Sets what all have."""
        self.weights, self.num_interactions, self.start = np.array(weights, np.float64), num_interactions, start

    @abc.abstractmethod
    def readings(self, setting: Hashable) -> np.ndarray:
        """Returns what is read after each interaction, for each right label, int [A, L]."""

    def set_by(self, setting: Hashable, interaction: int) -> Hashable:
        """Returns the setting after an interaction: by default there is only one."""
        return setting

    def alike(self, state: State) -> tuple[State, Sequence[int]]:
        """Returns the state that stands for all that differ from this one in names only, by default itself.

        Returns:
          The state, and for each of its actions the action that is meant here, [A + L].
        """
        return state, range(self.num_interactions + len(self.weights))

    def after(self, state: State, interaction: int, reading: int) -> State:
        """Returns what is known after an interaction.

        Raises:
          ValueError: if the reading follows from none of the possible labels.
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
    """Returns as a bit mask which labels are possible, [L]."""
    return sum(1 << label for label, is_possible in enumerate(possible) if is_possible)


def split(possible: int, readings: Sequence[int] | np.ndarray) -> dict[int, int]:
    """Returns which of the possible labels, a bit mask, explain each reading, of the reading that each brings, [L]."""
    parts: dict[int, int] = {}
    for label, reading in enumerate(readings):
        if possible >> label & 1:
            parts[int(reading)] = parts.get(int(reading), 0) | 1 << label
    return parts


class _States:
    """All states that can be reached.

    Attributes:
      index: their numbers, the start's first.
      answer: what the best answer is worth, [S].
      label: which it is, int [S].
    """

    def __init__(self, apparatus: Apparatus):
        self._num_interactions = apparatus.num_interactions
        first, _ = apparatus.alike(apparatus.start)
        self.index, states = {first: 0}, [first]
        outcomes: list[tuple[int, float, int]] = []  # Interaction and state in one number, probability, next state.
        chances = []
        for state in states:  # It grows while it is gone through.
            possible, setting = state
            chances.append(apparatus.posterior(state))
            for interaction, readings in enumerate(apparatus.readings(setting).tolist()):
                following = apparatus.set_by(setting, interaction)
                for part in split(possible, readings).values():
                    chance = sum(share for label, share in enumerate(chances[-1]) if part >> label & 1)
                    after, _ = apparatus.alike((part, following))
                    if after not in self.index:
                        self.index[after] = len(states)
                        states.append(after)
                    outcomes.append(
                        ((len(chances) - 1) * apparatus.num_interactions + interaction, chance, self.index[after])
                    )
        self._moves, self._chances, self._following = (np.array(column) for column in zip(*outcomes, strict=True))
        self._first = np.searchsorted(self._moves, np.arange(len(states) + 1) * apparatus.num_interactions)
        self.label = np.argmax(chances, axis=1)
        self.answer = base.worth_of_answers(np.max(chances, axis=1))

    def after(self, values: np.ndarray) -> np.ndarray:
        """Returns what is expected after each interaction, [S, A], of values of states, [S]."""
        return np.bincount(self._moves, self._chances * values[self._following]).reshape(-1, self._num_interactions)

    def after_one(self, number: int, values: np.ndarray) -> np.ndarray:
        """Returns the same as `after` of a single state, [A]."""
        outcomes = slice(self._first[number], self._first[number + 1])
        expected = self._chances[outcomes] * values[self._following[outcomes]]
        return np.bincount(self._moves[outcomes] - number * self._num_interactions, expected)


@dataclasses.dataclass(frozen=True, eq=False)
class Solution:
    """The best policy there is, and what it is worth.

    Attributes:
      apparatus: with A interactions and L labels.
      discount: for each interaction.
      step_limit: steps in an unanswered episode.
      value: expected discounted return from an episode's start.
      random_value: the same of interactions drawn uniformly, with the best answers at the best moment.
      read: returns the reading of an observation; None where observations do not tell it.
      label: returns the right label of a hidden property; None where it is not known.
    """

    apparatus: Apparatus
    discount: float
    step_limit: int
    value: float
    random_value: float
    _states: _States
    _policy: Sequence[np.ndarray]  # The best action of each state, int [S], by the steps that are left, from 1 on.
    _best: Sequence[np.ndarray]  # What each state is worth, float64 [S], by the same.
    read: Callable[[Mapping[str, np.ndarray]], int] | None = None
    label: Callable[[np.ndarray], int] | None = None

    @property
    def bound(self) -> float:
        """Returns the upper bound, which is the value, since that is exact."""
        return self.value

    @property
    def at_once(self) -> float:
        """Expected return of the likeliest label, given without any interaction."""
        return float(self._states.answer[0])

    def action(self, state: State, step: int) -> int:
        """Returns the best action in a state after so many interactions, fewer than `step_limit`."""
        alike, meant = self.apparatus.alike(state)
        left = min(self.step_limit - step, len(self._policy))  # With more left, nothing changes.
        return int(meant[self._policy[left - 1][self._states.index[alike]]])

    def actor(self) -> core.Actor:
        """Returns an actor that reads the apparatus from observations.

        Raises:
          ValueError: if it cannot be read from what the task observes.
        """
        if self.read is None:
            raise ValueError("the ideal experimenter reads features, not images; choose a task with features")
        return _Player(self, self.read)

    def values(self, state: State, step: int) -> np.ndarray:
        """Returns what each action is worth in a state after so many interactions, interactions first, [A + L]."""
        answers = base.worth_of_answers(self.apparatus.posterior(state))
        left = min(self.step_limit - step, len(self._best) + 1)
        if left <= 1:  # Silence.
            return np.append(np.full(self.apparatus.num_interactions, float(rules.WRONG)), answers)
        alike, meant = self.apparatus.alike(state)
        after = self._states.after_one(self._states.index[alike], self._best[left - 2])
        interactions = np.empty(len(after))
        interactions[list(meant[: len(after)])] = self.discount * after
        return np.append(interactions, answers)

    def beliefs(self, episode: base.Episode) -> np.ndarray:
        """Returns the posterior at the start and after each action of an episode, float64 [T + 1, L].

        Raises:
          ValueError: if it was not told how the right label follows from what is hidden.
        """
        return np.array([self.apparatus.posterior(state) for state in self._passed(episode)])

    def judge(self, episode: base.Episode) -> base.Judgement:
        """Returns what could be known in an episode, and what its actions were worth.

        Raises:
          ValueError: as `beliefs` does.
        """
        states = self._passed(episode)
        return base.Judgement(
            beliefs=np.array([self.apparatus.posterior(state) for state in states]),
            values=np.array([self.values(state, step) for step, state in enumerate(states[:-1])]),
            tells=np.array([self._tells(*taken) for taken in zip(states[:-1], map(int, episode.actions), strict=True)]),
        )

    def _passed(self, episode: base.Episode) -> list[State]:
        """What is known at the start and after each action, T + 1."""
        if self.label is None:
            raise ValueError("this ideal experimenter was not told how the label follows from what is hidden")
        label, states = self.label(episode.hidden), [self.apparatus.start]
        for action in map(int, episode.actions):
            is_answer = action >= self.apparatus.num_interactions  # It tells nothing.
            states.append(states[-1] if is_answer else self._follow(states[-1], action, label))
        return states

    def _tells(self, state: State, action: int) -> bool:
        """Whether an action has several possible readings."""
        if action >= self.apparatus.num_interactions:
            return False
        possible, setting = state
        return len(split(possible, self.apparatus.readings(setting)[action])) > 1

    def _follow(self, state: State, interaction: int, label: int) -> State:
        """What is known after an interaction where a label is right."""
        return self.apparatus.after(state, interaction, int(self.apparatus.readings(state[1])[interaction, label]))

    def play(self, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Plays episodes without physics.

        Args:
          labels: the right ones, int64 [N].

        Returns:
          Interactions, int64 [N], and whether the answer was right, bool [N].
        """
        found = np.zeros((len(self.apparatus.weights), 2), np.int64)
        for label in np.unique(labels):  # A label's episodes are all alike.
            state, step = self.apparatus.start, 0
            while (action := self.action(state, step)) < self.apparatus.num_interactions:
                state, step = self._follow(state, action, label), step + 1
            found[label] = step, action - self.apparatus.num_interactions == label
        return found[labels, 0], found[labels, 1].astype(bool)

    def figures(self) -> dict[str, Any]:
        """Returns what `base.figures` does."""
        prior = self.apparatus.posterior(self.apparatus.start)
        (labels,) = prior.nonzero()
        return base.figures(self, *self.play(labels), prior[labels])

    def summary(self) -> dict[str, Any]:
        """Returns the figures, `at_once` and `random_value`."""
        return {**self.figures(), "at_once": self.at_once, "random_value": self.random_value}


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


def solve(
    apparatus: Apparatus,
    discount: float,
    step_limit: int,
    read: Callable[[Mapping[str, np.ndarray]], int] | None = None,
    label: Callable[[np.ndarray], int] | None = None,
) -> Solution:
    """Finds the best policy, exactly.

    An answer after n interactions earns discount^n, times -1 if it is wrong; no answer earns discount^(step_limit - 1)
    times -1.

    Args:
      apparatus: the apparatus.
      discount: the agent's gamma.
      step_limit: number of steps in an unanswered episode.
      read, label: as in `Solution`.
    """
    states = _States(apparatus)
    answers = apparatus.num_interactions + states.label
    policy, worth = [answers], [states.answer]  # In the last step an answer is best.
    best, at_random, length = states.answer, states.answer, np.zeros(len(answers))
    for _ in range(step_limit - 1):
        before = best, at_random, length
        values = discount * states.after(best)
        most = values.max(axis=1)
        lengths = np.where(values >= most[:, None] - _TIE, 1 + states.after(length), np.inf)
        going_on = most > states.answer + _TIE
        policy.append(np.where(going_on, lengths.argmin(axis=1), answers))
        length = np.where(going_on, lengths.min(axis=1), 0.0)
        best = np.maximum(states.answer, most)
        worth.append(best)
        at_random = np.maximum(states.answer, discount * states.after(at_random).mean(axis=1))
        if all(np.array_equal(*pair) for pair in zip(before, (best, at_random, length), strict=True)):
            break  # More steps change nothing.
    value, random_value = float(best[0]), float(at_random[0])
    return Solution(apparatus, discount, step_limit, value, random_value, states, policy, worth, read, label)
