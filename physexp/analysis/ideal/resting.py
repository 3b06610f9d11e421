"""The ideal experimenter of an apparatus that rests between interactions.

The reading after an interaction then depends only on the interaction, on the setting of the apparatus, which is
visible, and on the hypothesis that is true. The information state is thus the set of possible hypotheses and the
setting. There are finitely many such states, and the best policy is found exactly by dynamic programming.

Hypotheses are labels, unless a question about them is told; then it belongs to the setting.
"""

import abc
from collections.abc import Callable, Hashable, Mapping, Sequence

import numpy as np

from physexp.agents import core
from physexp.analysis.ideal import base, finite, planning
from physexp.suite.engine import rules

_TIE = 1e-12  # Returns that differ by less are equal; then the policy with fewer interactions is taken.

State = tuple[int, Hashable]
"""An information state: the possible hypotheses, as a bit mask, and the setting."""


class Apparatus(abc.ABC):
    """An apparatus that rests between interactions, and its information states.

    Attributes:
      weights: probabilities of the H hypotheses, up to a common factor, float64 [H].
      num_interactions: number of interactions, A.
      start: the information state at the start.
    """

    def __init__(self, weights: Sequence[float] | np.ndarray, num_interactions: int, start: State):
        """Takes the attributes."""
        self.weights, self.num_interactions, self.start = np.array(weights, np.float64), num_interactions, start

    @abc.abstractmethod
    def readings(self, setting: Hashable) -> np.ndarray:
        """Returns the reading after each interaction, for each hypothesis, int [A, H]."""

    def set_by(self, setting: Hashable, interaction: int, reading: int) -> Hashable:
        """Returns the setting after an interaction and its reading; by default it never changes."""
        return setting

    def canonical(self, state: State) -> tuple[State, Sequence[int]]:
        """Returns one state for all states that are equal up to a permutation of things; by default the state itself.

        Returns:
          The state, and for each of its actions the corresponding action in the given state, [A + L].
        """
        return state, range(self.num_interactions + len(self.weights))

    def represented(self, state: State) -> State:
        """Returns the state whose values are used for a state."""
        return self.canonical(state)[0]

    def posterior(self, state: State) -> np.ndarray:
        """Returns the probabilities of the L labels, float64 [L]; by default those of the hypotheses."""
        return self.chances(state)

    def chances(self, state: State) -> np.ndarray:
        """Returns the probabilities of the hypotheses, float64 [H]."""
        weights = self.weights * bits(state[0], len(self.weights))
        return weights / weights.sum()

    def following(self, state: State, interaction: int) -> list[tuple[float, State]]:
        """Returns the information states that may follow an interaction, and their probabilities."""
        return list(self.by_reading(state, interaction, self.readings(state[1])[interaction]).values())

    def by_reading(self, state: State, interaction: int, readings: np.ndarray) -> dict[int, tuple[float, State]]:
        """Returns the information states after an interaction, and their probabilities, by the readings, int [H]."""
        (possible, setting), chances = state, self.chances(state).tolist()
        parts, shares = dict[int, int](), dict[int, float]()
        for hypothesis, reading in enumerate(readings.tolist()):
            if possible >> hypothesis & 1:
                parts[reading] = parts.get(reading, 0) | 1 << hypothesis
                shares[reading] = shares.get(reading, 0) + chances[hypothesis]
        return {
            reading: (shares[reading], (part, self.set_by(setting, interaction, reading)))
            for reading, part in parts.items()
        }

    def after(self, state: State, interaction: int, reading: int) -> State:
        """Returns the information state after an interaction.

        Raises:
          ValueError: if none of the possible hypotheses causes the reading.
        """
        found = self.by_reading(state, interaction, self.readings(state[1])[interaction])
        if reading not in found:
            raise ValueError(f"after interaction {interaction} the reading is {reading}; expected one of {list(found)}")
        return found[reading][1]

    def allows(self, state: State, hypothesis: int) -> bool:
        """Returns whether a hypothesis is possible."""
        return bool(state[0] >> hypothesis & 1)


def mask(possible: Sequence[bool] | np.ndarray) -> int:
    """Returns a bit mask of the possible hypotheses, [H]."""
    return sum(1 << hypothesis for hypothesis, is_possible in enumerate(possible) if is_possible)


def bits(number: int, count: int) -> np.ndarray:
    """Returns the lowest bits of a number, the lowest one first, bool [count]."""
    octets = np.frombuffer(number.to_bytes(-(-count // 8), "little"), np.uint8)
    return np.unpackbits(octets, count=count, bitorder="little").astype(bool)


class _States:
    """All S information states that can be reached from some, in canonical form.

    Attributes:
      index: their numbers.
      starts: the numbers of those that they are reached from, [Q].
      answer: value of the best answer, [S].
      label: the best answer, int [S].
    """

    def __init__(self, apparatus: Apparatus, starts: Sequence[State]):
        self._num_interactions = apparatus.num_interactions
        first = [apparatus.represented(start) for start in starts]
        states = list(dict.fromkeys(first))
        self.index = {state: number for number, state in enumerate(states)}
        self.starts = [self.index[state] for state in first]
        outcomes: list[tuple[int, float, int]] = []  # Interaction and state in one number, probability, next state.
        for number, state in enumerate(states):  # The list grows during the loop.
            for interaction, readings in enumerate(apparatus.readings(state[1])):
                for chance, following in apparatus.by_reading(state, interaction, readings).values():
                    after, _ = apparatus.canonical(following)
                    if after not in self.index:
                        self.index[after] = len(states)
                        states.append(after)
                    outcomes.append((number * apparatus.num_interactions + interaction, chance, self.index[after]))
        self._moves, self._chances, self._following = (np.array(column) for column in zip(*outcomes, strict=True))
        posteriors = np.array([apparatus.posterior(state) for state in states])
        self.label = posteriors.argmax(axis=1)
        self.answer = base.answer_values(posteriors.max(axis=1))

    def after(self, values: np.ndarray) -> np.ndarray:
        """Returns the expected value after each interaction, [S, A], from the values of the states, [S]."""
        return np.bincount(self._moves, self._chances * values[self._following]).reshape(-1, self._num_interactions)


class Solution(base.Solution):
    """The best policy and its value, exact.

    An answer after n interactions earns discount^n, times -1 if it is wrong; an unanswered episode earns -1 at its end.
    """

    def __init__(
        self,
        apparatus: Apparatus,
        discount: float,
        step_limit: int,
        read: Callable[[Mapping[str, np.ndarray]], int] | None = None,
        find: Callable[[np.ndarray], tuple[int, Sequence[int]]] | None = None,
        ask: Callable[[Mapping[str, np.ndarray]], int] = lambda observation: 0,
        told: Sequence[Apparatus] | None = None,
    ):
        """Finds the policy.

        Args:
          apparatus, discount, step_limit: the apparatus, gamma, and the number of steps in an unanswered episode.
          read: returns the reading in an observation; None if observations do not contain it.
          find: returns the hypothesis and the number of the question, [1], for a hidden property; needed to judge.
          ask: returns the number of the question in an observation.
          told: the apparatus for each of Q questions, which are equally likely and told; they differ in their start
            alone. By default, there is one question, and it is not told.
        """
        self.apparatus, self.discount, self.step_limit = apparatus, discount, step_limit
        self._read, self._find, self._ask, self._told = read, find, ask, told or [apparatus]
        self._states = states = _States(apparatus, [each.start for each in self._told])
        answers = apparatus.num_interactions + states.label
        # By the number of steps left: the best actions in all states, int [S], from 1 step on, in which an answer is
        # best; and the values of all interactions, float64 [S, A], from 2 on.
        self._policy, self._worths = [answers], []
        best, at_random, length = states.answer, states.answer, np.zeros(len(answers))
        for _ in range(step_limit - 1):
            before = best, at_random, length
            worths = discount * states.after(best)
            most = worths.max(axis=1)
            lengths = np.where(worths >= most[:, None] - _TIE, 1 + states.after(length), np.inf)
            going_on = most > states.answer + _TIE
            self._policy.append(np.where(going_on, lengths.argmin(axis=1), answers))
            self._worths.append(worths)
            length = np.where(going_on, lengths.min(axis=1), 0.0)
            best = np.maximum(states.answer, most)
            at_random = np.maximum(states.answer, discount * states.after(at_random).mean(axis=1))
            if all(np.array_equal(*pair) for pair in zip(before, (best, at_random, length), strict=True)):
                break  # More steps change nothing.
        self._value, at_once, at_random = (
            float(each[states.starts].mean()) for each in (best, states.answer, at_random)
        )
        self._compared = {"at_once": at_once, "random_value": at_random}

    @property
    def value(self) -> float:
        return self._value

    def compared(self):
        return self._compared

    def planning(self):
        _, places, counts = np.unique(self._states.starts, return_index=True, return_counts=True)
        found = [planning.returns(self._told[place], self.discount, self.step_limit) for place in places]
        return {name: float(np.average([each[name] for each in found], weights=counts)) for name in found[0]}

    def action(self, state: State, step: int) -> int:
        """Returns the best action in a state after `step` interactions, fewer than `step_limit`."""
        canonical, actions = self.apparatus.canonical(state)
        left = min(self.step_limit - step, len(self._policy))
        return int(actions[self._policy[left - 1][self._states.index[canonical]]])

    def _interaction_values(self, state: State, step: int, taken: int) -> np.ndarray:
        """Returns the value of each interaction in a state after `step` interactions, float64 [A]."""
        left = min(self.step_limit - step, len(self._worths) + 1)
        found = np.full(self.apparatus.num_interactions, float(rules.WRONG))
        if left > 1:  # Otherwise the episode ends unanswered.
            canonical, actions = self.apparatus.canonical(state)
            found[list(actions[: len(found)])] = self._worths[left - 2][self._states.index[canonical]]
        return found

    def actor(self) -> core.Actor:
        read = base.readable(self._read)
        return base.Player(
            begin=lambda observation: self._told[self._ask(observation)].start,
            choose=self.action,
            follow=lambda state, action, observation: self.apparatus.after(state, action, read(observation)),
        )

    def judge(self, hidden, actions):
        assert self._find is not None
        hypothesis, (question,) = self._find(np.asarray(hidden))
        return finite.judge(self._told[question], hypothesis, actions, self._interaction_values)

    def outcomes(self):
        found = []
        for told in self._told:
            prior = told.chances(told.start) / len(self._told)
            for hypothesis in prior.nonzero()[0].tolist():
                state, step = told.start, 0
                while (action := self.action(state, step)) < told.num_interactions:
                    state, step = finite.after(told, state, action, hypothesis), step + 1
                truth = told.posterior((1 << hypothesis, state[1])).argmax()
                found.append((step, action - told.num_interactions == truth, prior[hypothesis]))
        interactions, right, shares = (np.array(column) for column in zip(*found, strict=True))
        return interactions, right, shares
