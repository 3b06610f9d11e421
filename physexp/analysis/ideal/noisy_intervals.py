"""The ideal experimenter of comparisons, as in `intervals`, with results that are wrong at times.

The belief follows from how much oftener each test was passed than failed. So an information state is a vector of
integers, one for each test, with a sum of absolute values no larger than the number of tests before. There are millions
of these states. Each is a pair of halves of the vector, of which there are thousands.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
import math

import numpy as np

from physexp.agents import core
from physexp.analysis.ideal import base, planning
from physexp.suite.engine import rules

MOST_STEPS = 15  # With eight labels, one more would double the time.
_TIE = 1e-9  # Returns, or amounts of information in bits, that differ by less are equal.
_BLOCK = 2**16  # States that are computed together.
_LEAST_ERROR = 1e-16  # Results that are wrong more rarely never are.

State = tuple[int, ...]
"""How much oftener each test was passed than failed, without the last one, which reveals nothing."""

Pairs = tuple[np.ndarray, np.ndarray]
"""The numbers of the first and of the second halves of n states, rows and columns, int64 [n] each."""


class _Half:
    """All N vectors of D integers with a sum of absolute values of at most R, in the order of that sum.

    Attributes:
      vectors: int64 [N, D].
      sums: the sums of absolute values, int64 [N].
      number: the number of each vector.
      moved: the numbers of the vectors that differ by -1 and by 1 in each integer, int64 [2, D, N]; 0 if there is none.
    """

    def __init__(self, size: int, radius: int):
        found = sorted(_vectors(size, radius), key=lambda vector: sum(map(abs, vector)))
        self.vectors = np.array(found, np.int64).reshape(len(found), size)
        self.sums, self.number = np.abs(self.vectors).sum(axis=1), {vector: k for k, vector in enumerate(found)}
        self.moved = np.array([
            [[self.number.get((*one[:k], one[k] + by, *one[k + 1 :]), 0) for one in found] for k in range(size)]
            for by in (-1, 1)
        ])  # fmt: skip


def _vectors(size: int, radius: int) -> Iterator[tuple[int, ...]]:
    """Yields all vectors of integers with a sum of absolute values of at most `radius`."""
    if not size:
        yield ()
        return
    for first in range(-radius, radius + 1):
        for others in _vectors(size - 1, radius - abs(first)):
            yield (first, *others)


class _States:
    """The information states.

    Attributes:
      start: the state at the start.
    """

    def __init__(self, prior: np.ndarray, error: float, most: int):
        """Takes the probabilities of the labels, that of a wrong result, and the largest number of tests."""
        self.start = (0,) * (len(prior) - 1)
        self._error = max(error, _LEAST_ERROR)
        self._cut = -(-len(self.start) // 2)  # Tests in the first half.
        self._halves = _Half(self._cut, most), _Half(len(self.start) - self._cut, most)
        # A result favours the labels on one side of a test, all by the same factor. So the ratio of a label's weight to
        # that of label 0 follows from the tests before it.
        first, second = (
            -math.log(1 / self._error - 1) * np.pad(half.vectors, ((0, 0), (1, 0))).cumsum(axis=1).T
            for half in self._halves
        )
        with np.errstate(divide="ignore"):
            logs = np.log(prior)[:, None]
        self._first, self._second = np.exp(logs[: self._cut] + first[:-1]), np.exp(logs[self._cut :] + second)
        self._factor = np.exp(first[-1])  # Of the weights of the labels of the second half.
        self._starts = [self._start(step) for step in range(most)]

    def _start(self, step: int) -> np.ndarray:
        """Returns the index of the first state in each row, and the number of all, int64 [rows + 1]."""
        first, second = (half.sums for half in self._halves)
        widths = np.searchsorted(second, step - first[first <= step], side="right")
        return np.concatenate([[0], widths.cumsum()])

    def count(self, step: int) -> int:
        """Returns the number of states after `step` tests, S."""
        return int(self._starts[step][-1])

    def index(self, step: int, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
        """Returns the indices of states among those after `step` tests, int64 [n]."""
        return self._starts[step][rows] + columns

    def at(self, step: int, indices: np.ndarray) -> Pairs:
        """Returns rows and columns of the states with some indices, int64 [n] each."""
        rows = np.searchsorted(self._starts[step], indices, side="right") - 1
        return rows, indices - self._starts[step][rows]

    def find(self, states: Sequence[State]) -> Pairs:
        """Returns rows and columns of some states, int64 [n] each."""
        first, second = self._halves
        rows, columns = (
            [first.number[one[: self._cut]] for one in states],
            [second.number[one[self._cut :]] for one in states],
        )
        return np.array(rows), np.array(columns)

    def posterior(self, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
        """Returns the probabilities of the labels, float64 [L, n]."""
        found = np.concatenate([self._first[:, rows], self._factor[rows] * self._second[:, columns]])
        return found / found.sum(axis=0)

    def passing(self, posterior: np.ndarray) -> np.ndarray:
        """Returns the probabilities to pass the tests, float64 [A, n], from those of the labels, [L, n]."""
        return self._error + (1 - 2 * self._error) * posterior.cumsum(axis=0)

    def moved(self, test: int, result: int, rows: np.ndarray, columns: np.ndarray) -> Pairs:
        """Returns rows and columns of the states after a result, 1 if the test was passed and 0 if it was failed."""
        if test < self._cut:
            return self._halves[0].moved[result, test][rows], columns
        if test < len(self.start):
            return rows, self._halves[1].moved[result, test - self._cut][columns]
        return rows, columns

    def after(self, step: int, rows: np.ndarray, columns: np.ndarray, values: np.ndarray) -> np.ndarray:
        """Returns the mean values after each test, float64 [..., A, n], from those of the next states, [..., S]."""
        found = []
        for test, chances in enumerate(self.passing(self.posterior(rows, columns))):
            places = (self.index(step + 1, *self.moved(test, result, rows, columns)) for result in (0, 1))
            failed, passed = (values[..., place] for place in places)
            found.append(failed + chances * (passed - failed))
        return np.stack(found, axis=-2)

    def backwards(
        self,
        steps: int,
        last: Callable[[np.ndarray], np.ndarray],
        before: Callable[[np.ndarray, np.ndarray], np.ndarray],
    ) -> Iterator[np.ndarray]:
        """Yields V values of all states, float64 [V, S], from those at the last step to that at the start.

        Args:
          steps: number of steps in an episode.
          last: returns the values at the last step, [V, n], from the posterior, [L, n].
          before: returns the values from the posterior and the mean values after each test, [V, A, n].
        """
        values = np.zeros(0)
        for step in reversed(range(steps)):
            following, size = values, self.count(step)
            for start in range(0, size, _BLOCK):
                states = self.at(step, np.arange(start, min(start + _BLOCK, size)))
                belief = self.posterior(*states)
                found = last(belief) if step == steps - 1 else before(belief, self.after(step, *states, following))
                if not start:
                    values = np.empty((len(found), size))
                values[:, start : start + _BLOCK] = found
            yield values


class Solution(base.Solution):
    """The best policy and its value, exact; see `resting.Solution`."""

    def __init__(
        self,
        prior: Sequence[float] | np.ndarray,
        error: float,
        discount: float,
        step_limit: int,
        read: Callable[[Mapping[str, np.ndarray]], int] | None = None,
        results: Callable[[np.ndarray, np.ndarray], np.ndarray] | None = None,
    ):
        """Finds the policy.

        Args:
          prior: probabilities of the L labels in their order, L >= 2.
          error: probability that a result is wrong, below 0.5.
          discount, step_limit, read: as for `resting.Solution`, at most `MOST_STEPS` steps.
          results: returns the results of an episode's tests, int64 [T], from its hidden property and the tests, int64
            [T]; needed to judge episodes.
        """
        if step_limit > MOST_STEPS:
            raise ValueError(
                f"an episode has {step_limit} steps; choose a time limit of at most {MOST_STEPS} steps, for which the "
                "ideal experimenter is known with wrong results"
            )
        self.discount, self._step_limit, self._read, self._results = discount, step_limit, read, results
        self._num_interactions = len(prior)
        self._states = _States(np.array(prior, np.float64), error, step_limit)
        self._first = self._states.find([self._states.start])

        def last(belief: np.ndarray) -> np.ndarray:
            return np.stack([_answers(belief)] * 2)

        def before(belief: np.ndarray, after: np.ndarray) -> np.ndarray:
            best, at_random = discount * after
            return np.maximum(_answers(belief), [best.max(axis=0), at_random.mean(axis=0)])

        self._values: list[np.ndarray] = []  # Of all states, by the number of interactions before.
        for values in self._states.backwards(step_limit, last, before):
            self._values.insert(0, values[0].copy())
        at_once = float(_answers(self._states.posterior(*self._first))[0])
        self._compared = {"at_once": at_once, "random_value": float(values[1, 0])}

    @property
    def value(self) -> float:
        return float(self._values[0][0])

    def compared(self):
        return self._compared

    def _actions(self, step: int, states: Pairs) -> np.ndarray:
        """Returns the best actions in states after `step` interactions, int64 [n]."""
        belief, worths = self._states.posterior(*states), self._interaction_values(step, states)
        goes_on = worths.max(axis=0) > _answers(belief) + _TIE
        return np.where(goes_on, worths.argmax(axis=0), self._num_interactions + belief.argmax(axis=0))

    def _interaction_values(self, step: int, states: Pairs) -> np.ndarray:
        """Returns the values of all interactions in states after `step` interactions, float64 [A, n]."""
        if step == self._step_limit - 1:  # The episode ends unanswered.
            return np.full((self._num_interactions, len(states[0])), float(rules.WRONG))
        return self.discount * self._states.after(step, *states, self._values[step + 1])

    def actor(self) -> core.Actor:
        read = base.readable(self._read)
        return base.Player(
            begin=lambda observation: self._states.start,
            choose=lambda state, step: int(self._actions(step, self._states.find([state]))[0]),
            follow=lambda state, action, observation: _after(state, action, read(observation)),
        )

    def judge(self, hidden, actions):
        assert self._results is not None
        tests = actions[actions < self._num_interactions]
        states = [self._states.start]
        for test, result in zip(tests.tolist(), self._results(hidden, tests).tolist(), strict=True):
            states.append(_after(states[-1], test, result))
        states += states[-1:] * (len(actions) - len(tests))  # An answer reveals nothing.
        rows, columns = self._states.find(states)
        beliefs, worths = self._states.posterior(rows, columns).T, []
        for step in range(len(actions)):
            one = rows[step : step + 1], columns[step : step + 1]
            worths.append(np.append(self._interaction_values(step, one), base.answer_values(beliefs[step])))
        return base.Judgement(beliefs, np.array(worths), actions < self._num_interactions - 1)

    def outcomes(self):
        reached, found = {self._states.start: 1.0}, []
        for step in range(self._step_limit):
            states, following = self._states.find(list(reached)), dict[State, float]()
            belief, ended = self._states.posterior(*states), np.zeros(2)  # Wrong and right.
            passing, actions = self._states.passing(belief), self._actions(step, states).tolist()
            for number, ((state, share), action) in enumerate(zip(reached.items(), actions, strict=True)):
                if action >= self._num_interactions:
                    right = belief[action - self._num_interactions, number]
                    ended += share * np.array([1 - right, right])
                    continue
                for result, chance in enumerate((1 - passing[action, number], passing[action, number])):
                    after = _after(state, action, result)
                    following[after] = following.get(after, 0.0) + share * chance
            found += [(step, right, share) for right, share in zip((False, True), ended, strict=True)]
            if not following:
                break
            reached = following
        interactions, right, shares = map(np.array, zip(*found, strict=True))
        return interactions, right, shares

    def planning(self):
        """Returns the returns that `planning.returns` has, of all states at once."""
        most = max(planning.HORIZONS)

        def last(belief: np.ndarray) -> np.ndarray:
            return np.stack([_bits(belief), *[_answers(belief)] * (most + 2 + len(planning.HORIZONS))])

        def before(belief: np.ndarray, after: np.ndarray) -> np.ndarray:
            # After each test: bits, the best plans of at most 0, 1 ... interactions, and what the experimenters earn.
            (bits,), worths, earned = np.split(after, [1, 1 + most])
            worths, earned, answer = self.discount * worths, self.discount * earned, _answers(belief)
            informative = bits <= bits.min(axis=0) + _TIE
            ahead = worths[[horizon - 1 for horizon in planning.HORIZONS]]
            best = ahead.max(axis=1, keepdims=True)
            chosen = np.stack([informative, *((ahead >= best - _TIE) & (best > answer + _TIE))])
            means = (chosen * earned[1:]).sum(axis=1) / chosen.sum(axis=1).clip(min=1)
            lucky = np.where(informative, earned[0], rules.WRONG).max(axis=0)
            values = [*worths[:-1].max(axis=1), lucky, *np.where(chosen.any(axis=1), means, rules.WRONG)]
            return np.stack([_bits(belief), answer, *np.maximum(answer, values)])

        for found in self._states.backwards(self._step_limit, last, before):
            lucky, greedy, *ahead = found[1 + most :, 0].tolist()
        return {
            "floor": base.floor(self._compared["at_once"], self.discount, self._step_limit),
            "greedy": greedy,
            **{f"lookahead_{horizon}": value for horizon, value in zip(planning.HORIZONS, ahead, strict=True)},
            "greedy_lucky": lucky,
            "planning_error": 0.0,
        }


def _after(state: State, test: int, result: int) -> State:
    """Returns the state after a result, 1 if the test was passed and 0 if it was failed."""
    return tuple(count + (2 * result - 1) * (test == number) for number, count in enumerate(state))


def _answers(belief: np.ndarray) -> np.ndarray:
    """Returns the values of the best answers, [n], from posteriors, [L, n]."""
    return base.answer_values(belief.max(axis=0))


def _bits(belief: np.ndarray) -> np.ndarray:
    """Returns the entropies of posteriors, [L, n], in bits, [n]."""
    return -(belief * np.log2(belief.clip(1e-300))).sum(axis=0)
