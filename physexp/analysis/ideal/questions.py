"""The ideal experimenter where questions with the answers no and yes are drawn, told, and asked one after the other.

The apparatus rests between interactions, see `resting`; its labels are the hypotheses that the questions are about. The
reward of an answer tells whether it was right, and so rules out hypotheses before the next question. An information
state is a state of the apparatus, the current question, and the number of questions left.
"""

from collections.abc import Callable, Mapping
import functools
from typing import NamedTuple

import numpy as np
from scipy import sparse

from physexp.agents import core
from physexp.analysis.ideal import base, planning, resting

_TIE = 1e-12  # Returns that differ by less are equal; then it answers.
_COUNT = 2  # Of the labels.


class Played(NamedTuple):
    """N kinds of episodes of a policy.

    Attributes:
      value: the expected discounted return.
      by_question: the mean number of interactions before each answer, float64 [K].
      interactions: their number in an episode, int64 [N].
      right: the share of right answers, float64 [N].
      shares: of all episodes, float64 [N].
    """

    value: float
    by_question: np.ndarray
    interactions: np.ndarray
    right: np.ndarray
    shares: np.ndarray


class _States:
    """All S states of an apparatus that interactions and answers lead to, the start first.

    Attributes:
      all: the states.
      index: their numbers.
      posteriors: probabilities of the hypotheses, [S, H].
      yes: probability of the answer yes to each question, [S, Q].
      after: the state after each interaction for each hypothesis, int [S, A, H]; -1 for one that is ruled out.
      told: the state after an answer, if the right one is no or yes, int [2, S, Q].
      forgotten: the same after forgetting everything but the setting.
    """

    def __init__(self, apparatus: resting.Apparatus, tables: np.ndarray):
        self.all, self.index = [apparatus.start], {apparatus.start: 0}
        sides = [resting.mask(side) for answers in (~tables, tables) for side in answers]
        after: list[list[list[int]]] = []
        told = []
        for possible, setting in self.all:  # The list grows during the loop.
            after.append([])
            for interaction, readings in enumerate(apparatus.readings(setting)):
                found = apparatus.by_reading((possible, setting), interaction, readings)
                numbers = {reading: self._number(state) for reading, (_, state) in found.items()}
                after[-1].append([numbers.get(reading, -1) for reading in readings.tolist()])
            told.append([self._number((possible & side or possible, setting)) for side in sides])
        self.posteriors = np.array([apparatus.posterior(state) for state in self.all])
        self.yes = self.posteriors @ tables.T
        self.after = np.where(self.posteriors[:, None] > 0, after, -1)
        self.told = np.array(told).T.reshape(_COUNT, len(tables), -1).swapaxes(1, 2)
        fresh = np.array([self.index[apparatus.start[0], setting] for _, setting in self.all])
        self.forgotten = np.broadcast_to(fresh[:, None], self.told.shape)
        rows, interactions, hypotheses = np.nonzero(self.after >= 0)
        places = interactions * len(self.all) + rows, self.after[rows, interactions, hypotheses]
        self._shape = apparatus.num_interactions, *self.yes.shape
        shape = apparatus.num_interactions * len(self.all), len(self.all)
        self._chances = sparse.csr_matrix((self.posteriors[rows, hypotheses], places), shape)

    def _number(self, state: resting.State) -> int:
        if state not in self.index:
            self.index[state] = len(self.all)
            self.all.append(state)
        return self.index[state]

    def expected(self, values: np.ndarray) -> np.ndarray:
        """Returns the expected value after each interaction, [A, S, Q], from values [S, Q]."""
        return (self._chances @ values).reshape(self._shape)


class Solution(base.Solution):
    """The best policy for K questions and its value, exact."""

    def __init__(
        self,
        apparatus: resting.Apparatus,
        tables: np.ndarray,
        num_questions: int,
        discount: float,
        step_limit: int,
        read: Callable[[Mapping[str, np.ndarray]], int] | None,
        ask: Callable[[Mapping[str, np.ndarray]], int],
        find: Callable[[np.ndarray], tuple[int, np.ndarray]],
    ):
        """Finds the policy.

        Args:
          apparatus, discount, step_limit, read: as for `resting.Solution`.
          tables: whether each hypothesis means yes, in each of Q questions, bool [Q, H].
          num_questions: K; each question is drawn uniformly, whatever the others are.
          ask: returns the number of the question in an observation.
          find: returns the hypothesis and the numbers of the questions, int [K], for a hidden property.
        """
        self.apparatus, self.discount, self.step_limit = apparatus, discount, step_limit
        self._tables, self._num_questions, self._read, self.ask, self._find = tables, num_questions, read, ask, find
        self._states = _States(apparatus, tables)
        self._values, self._policy = self._solve(self._states.told)

    def _solve(
        self, told: np.ndarray, choose: Callable[[np.ndarray], np.ndarray] = lambda worths: worths.max(axis=0)
    ) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Returns values and actions, [K + 1, S, Q], by the numbers of steps and of questions left, from 0 on.

        Answers lead to the states `told`, see `_States`; `choose` returns the values of going on, [S, Q], from those of
        all interactions, [A, S, Q].
        """
        num_interactions, yes = self.apparatus.num_interactions, self._states.yes
        wrong = -np.arange(self._num_questions + 1.0) / self.discount  # As all that are left when time runs out.
        values = [np.broadcast_to(wrong[:, None, None], (len(wrong), *yes.shape))]
        policy = [np.zeros(values[0].shape, np.int8)]
        labels = num_interactions + (yes > 0.5)
        for _ in range(self.step_limit):
            before, best, actions = values[-1], np.zeros(values[0].shape), np.zeros(values[0].shape, np.int8)
            for left in range(1, len(best)):
                answering = base.answer_values(np.maximum(yes, 1 - yes)) + self._following(before[left - 1], told)
                worths = self.discount * self._states.expected(before[left])
                going_on = choose(worths)
                actions[left] = np.where(going_on > answering + _TIE, worths.argmax(axis=0), labels)
                best[left] = np.maximum(answering, going_on)
            values.append(best)
            policy.append(actions)
            if np.array_equal(best, before):
                break  # More steps change nothing.
        return values, policy

    def _following(self, values: np.ndarray, told: np.ndarray) -> np.ndarray:
        """Returns the discounted value of the next question after answers, [S, Q], from the values then, [S, Q]."""
        no, yes = values.mean(axis=1)[told]
        return self.discount * (no + (yes - no) * self._states.yes)

    def _play(self, policy: list[np.ndarray], told: np.ndarray) -> Played:
        """Returns the episodes of a policy; arguments as `_solve` returns and takes them."""
        states, num_interactions, count = self._states, self.apparatus.num_interactions, self._num_questions
        (hypotheses,) = states.posteriors[0].nonzero()
        size = len(self._tables)
        hypothesis, question = (each.ravel() for each in np.meshgrid(hypotheses, np.arange(size)))
        share, state, right = states.posteriors[0][hypothesis] / size, 0 * question, 0 * question
        left, value, by_question = count + right, 0.0, np.zeros(count + 1)
        ended: list[tuple[float, float, float]] = []
        for step in range(self.step_limit):
            action = policy[min(self.step_limit - step, len(policy) - 1)][left, state, question]
            answers, truth = action >= num_interactions, self._tables[question, hypothesis].astype(int)
            is_right = action - num_interactions == truth
            by_question += np.bincount(count - left, share * ~answers, count + 1)
            earned = np.where(answers, base.answer_values(is_right.astype(float)), 0.0)
            interacted = states.after[state, np.where(answers, 0, action), hypothesis]
            state = np.where(answers, told[truth, state, question], interacted)
            left, right = left - answers, right + is_right
            over = (left == 0) | (step == self.step_limit - 1)
            value += self.discount**step * float(share @ np.where(over, earned - left, earned))
            ended += zip(step + 1 - count + left[over], right[over] / count, share[over], strict=True)
            goes_on, asks = ~answers & ~over, answers & ~over
            kinds, places = np.unique(np.stack([hypothesis, state, left, right])[:, asks], axis=1, return_inverse=True)
            fresh = np.repeat(np.bincount(places.ravel(), share[asks], kinds.shape[1]) / size, size)
            next_question = np.tile(np.arange(size), kinds.shape[1])
            hypothesis, state, left, right, question, share = (
                np.concatenate([old[goes_on], new])
                for old, new in zip(
                    (hypothesis, state, left, right, question, share),
                    (*np.repeat(kinds, size, axis=1), next_question, fresh),
                    strict=True,
                )
            )
        interactions, are_right, shares = np.array(ended).T
        return Played(value, by_question[:-1], interactions.astype(int), are_right, shares)

    @functools.cached_property
    def _played(self) -> Played:
        return self._play(self._policy, self._states.told)

    @property
    def value(self) -> float:
        return float(self._values[-1][-1, 0].mean())

    def outcomes(self):
        return self._played[2:]

    def compared(self):
        """Returns statistics by name; with several questions, the figures of transfer, too.

        They are `by_question`, the interactions before each answer; and the same, and the return, of an experimenter
        that forgets its findings after each answer and otherwise does its best, `forgetful_by_question` and
        `forgetful_value`.
        """
        without = functools.partial(self._solve, self._states.told)
        at_once, _ = without(lambda worths: np.full_like(worths[0], -np.inf))
        at_random, _ = without(lambda worths: worths.mean(axis=0))
        found = {"at_once": float(at_once[-1][-1, 0].mean()), "random_value": float(at_random[-1][-1, 0].mean())}
        if self._num_questions == 1:
            return found
        _, policy = self._solve(self._states.forgotten)
        forgetful = self._play(policy, self._states.forgotten)
        return found | {
            "by_question": self._played.by_question.tolist(),
            "forgetful_value": forgetful.value,
            "forgetful_by_question": forgetful.by_question.tolist(),
        }

    def planning(self):
        """Returns means over the questions; nothing for several of them."""
        if self._num_questions > 1:
            return {}
        found = [
            planning.returns(_OneQuestion(self.apparatus, table), self.discount, self.step_limit)
            for table in self._tables
        ]
        return {name: float(np.mean([each[name] for each in found])) for name in found[0]}

    def actor(self) -> core.Actor:
        return _Actor(self, base.readable(self._read))

    def judge(self, hidden, actions):
        hypothesis, questions = self._find(np.asarray(hidden))
        state = Asked(0, int(questions[0]), self._num_questions, 0)
        beliefs, values, is_informative = [self._beliefs(state)], [], []
        for action in map(int, actions):
            values.append(self._worths(state))
            after = self._states.after[state.number, min(action, self.apparatus.num_interactions - 1)]
            is_answer = action >= self.apparatus.num_interactions
            is_informative.append(not is_answer and len(np.unique(after[after >= 0])) > 1)
            if is_answer and state.left == 1:
                beliefs.append(beliefs[-1])
            else:
                following = questions[self._num_questions - state.left + is_answer]
                truth = int(self._tables[state.question, hypothesis])
                state = self.after_answer(state, truth, following) if is_answer else state.moved(after[hypothesis])
                beliefs.append(self._beliefs(state))
        return base.Judgement(np.array(beliefs), np.array(values), np.array(is_informative))

    def first(self, observation: Mapping[str, np.ndarray]) -> "Asked":
        """Returns the information state at the first observation."""
        return Asked(0, self.ask(observation), self._num_questions, 0)

    def after_reading(self, state: "Asked", interaction: int, reading: int) -> "Asked":
        """Returns the information state after an interaction; raises ValueError as `resting.Apparatus.after`."""
        found = self.apparatus.after(self._states.all[state.number], interaction, reading)
        return state.moved(self._states.index[found])

    def after_answer(self, state: "Asked", truth: int, following: int) -> "Asked":
        """Returns the information state after an answer, if the right one is `truth`, with the following question."""
        number = int(self._states.told[truth, state.number, state.question])
        return Asked(number, int(following), state.left - 1, state.step + 1)

    def best(self, state: "Asked") -> int:
        """Returns the best action in an information state."""
        policy = self._policy[min(self.step_limit - state.step, len(self._policy) - 1)]
        return int(policy[state.left, state.number, state.question])

    def _beliefs(self, state: "Asked") -> np.ndarray:
        yes = self._states.yes[state.number, state.question]
        return np.array([1 - yes, yes])

    def _worths(self, state: "Asked") -> np.ndarray:
        """Returns the value of each action in an information state, float64 [A + 2]."""
        place, after = (state.number, state.question), min(self.step_limit - state.step, len(self._values)) - 1
        values = self._values[after]
        interacting = self.discount * self._states.expected(values[state.left])[:, *place]
        following = self._following(values[state.left - 1], self._states.told)[place]
        return np.append(interacting, base.answer_values(self._beliefs(state)) + following)


class Asked(NamedTuple):
    """An information state: numbers of the apparatus's state and of the question, questions left, and steps taken."""

    number: int
    question: int
    left: int
    step: int

    def moved(self, number: int) -> "Asked":
        """Returns the state after an interaction."""
        return self._replace(number=int(number), step=self.step + 1)


class _Actor(core.EpisodicActor):
    """Plays the best policy."""

    def __init__(self, solution: Solution, read: Callable[[Mapping[str, np.ndarray]], int]):
        self._solution, self._read = solution, read

    def _begin(self, timestep):
        self._state = self._solution.first(timestep.observation)

    def _choose(self, observation) -> int:
        return self._solution.best(self._state)

    def _note(self, action, next_timestep):
        solution, seen = self._solution, next_timestep.observation
        label = action - solution.apparatus.num_interactions
        if next_timestep.last():
            return
        if label < 0:
            self._state = solution.after_reading(self._state, action, self._read(seen))
        else:
            truth = label if next_timestep.reward > 0 else 1 - label
            self._state = solution.after_answer(self._state, truth, solution.ask(seen))


class _OneQuestion:
    """The information states of one question that is told, as `finite.States`."""

    def __init__(self, apparatus: resting.Apparatus, table: np.ndarray):
        self.num_interactions, self.start, self.allows = apparatus.num_interactions, apparatus.start, apparatus.allows
        self.following, self._hypotheses = apparatus.following, apparatus.posterior
        self._answers = np.stack([~table, table], axis=1)

    def posterior(self, state: resting.State) -> np.ndarray:
        """Returns the probabilities of the answers no and yes, float64 [2]."""
        return self._hypotheses(state) @ self._answers

    def represented(self, state: resting.State) -> resting.State:
        """Returns the state itself."""
        return state
