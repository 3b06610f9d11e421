"""The ideal experimenter of questions whose labels are in order and whose tests compare.

One of L labels is right. Each of L tests tells a single bit: test l is passed if the right label is at most l, so that
the last test tells nothing. What is known is thus an interval of labels, and the best policy is found exactly by going
back from the last step, over all intervals. What an interval is worth is kept times its probability: then parts add up.
"""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
from typing import Any

import numpy as np

from physexp.agents import core
from physexp.analysis.ideal import base
from physexp.suite.engine import checks, rules

_TIE = 1e-12  # Returns that differ by less are equal: the shorter way is taken.


def narrow(low, high, tests, passed) -> tuple[np.ndarray, np.ndarray]:
    """Returns the interval of labels that is left after a test.

    Args:
      low, high: the least and the greatest label that are possible before, int [N].
      tests: the tests made, int [N].
      passed: whether the right label is at most the test's number, bool [N].
    """
    return np.where(passed, low, np.maximum(low, np.add(tests, 1))), np.where(passed, np.minimum(high, tests), high)


@dataclasses.dataclass(frozen=True, eq=False)
class Solution:
    """The best policy there is, and what it is worth.

    Attributes:
      prior: probabilities of the labels, float64 [L].
      discount: for each interaction.
      step_limit: steps in an unanswered episode.
      value: expected discounted return from an episode's start.
      random_value: the same of tests chosen uniformly at random, with the best answers at the best moment.
      policy: the best action at each step, for each least and greatest label, int64 [step_limit, L, L].
      passed: tells from the observation after a test whether it was passed; None where that cannot be read.
      label: returns the right label of a hidden property; None where it is not known.
    """

    prior: np.ndarray
    discount: float
    step_limit: int
    value: float
    random_value: float
    policy: np.ndarray
    passed: Callable[[Mapping[str, np.ndarray]], bool] | None = None
    label: Callable[[np.ndarray], int] | None = None

    @property
    def bound(self) -> float:
        """Returns the upper bound, which is the value, since that is exact."""
        return self.value

    @property
    def at_once(self) -> float:
        """Expected return of the likeliest label, given without a test."""
        return float(2 * self.prior.max() - 1)

    def actions(self, low, high, step) -> np.ndarray:
        """Returns the best actions, int64 [N]: a test, or L plus the label to answer with.

        Args:
          low, high: the least and the greatest label that are possible, int [N].
          step: interactions so far in the episode, int [N], below `step_limit`.
        """
        return self.policy[step, low, high]

    def posterior(self, low, high) -> np.ndarray:
        """Returns the probabilities of the labels, float64 [N, L], in intervals as for `actions`."""
        labels = np.arange(len(self.prior))
        possible = (np.expand_dims(low, -1) <= labels) & (labels <= np.expand_dims(high, -1))
        weights = np.where(possible, self.prior, 0.0)
        return weights / weights.sum(axis=-1, keepdims=True)

    def actor(self) -> core.Actor:
        """Returns an actor that reads from observations whether a test was passed.

        Raises:
          ValueError: if that cannot be read from what the task observes.
        """
        if self.passed is None:
            raise ValueError("the ideal experimenter reads tests from features, not from images; choose such a task")
        return _Player(self, self.passed)

    def beliefs(self, episode: base.Episode) -> np.ndarray:
        """Returns the posterior at the start and after each action of an episode, float64 [T + 1, L].

        Raises:
          ValueError: if it was not told how the right label follows from what is hidden.
        """
        if self.label is None:
            raise ValueError("this ideal experimenter was not told how the label follows from what is hidden")
        label = self.label(episode.hidden)
        low, high = [0], [len(self.prior) - 1]
        for action in episode.actions:
            least, most = low[-1], high[-1]
            if action < len(self.prior):
                least, most = map(int, narrow(least, most, int(action), label <= action))
            low.append(least)
            high.append(most)
        return self.posterior(np.array(low), np.array(high))

    def play(self, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Plays episodes without physics.

        Args:
          labels: the right ones, int64 [N].

        Returns:
          Interactions, int64 [N], and whether the answer was right, bool [N].
        """
        size = len(self.prior)
        low, high = np.zeros_like(labels), np.full_like(labels, size - 1)
        interactions, answers = np.zeros_like(labels), np.full_like(labels, -1)
        going = np.arange(len(labels))
        for step in range(self.step_limit):
            actions = self.actions(low[going], high[going], step)
            testing = actions < size
            answers[going[~testing]] = actions[~testing] - size
            going, tests = going[testing], actions[testing]
            low[going], high[going] = narrow(low[going], high[going], tests, labels[going] <= tests)
            interactions[going] += 1
        return interactions, answers == labels

    def summary(self) -> dict[str, Any]:
        """`value`, `bound`, `at_once`, `random_value`, `accuracy`, `mean_interactions` and `histogram`."""
        interactions, right = self.play(np.arange(len(self.prior)))  # A label's episodes are all alike.
        shares = np.bincount(interactions, self.prior)
        return {
            "value": self.value,
            "bound": self.bound,
            "at_once": self.at_once,
            "random_value": self.random_value,
            "accuracy": float(self.prior @ right),
            "mean_interactions": float(self.prior @ interactions),
            "histogram": {number: float(share) for number, share in enumerate(shares)},
        }


class _Player(core.Actor):
    """Plays a solution."""

    def __init__(self, solution: Solution, passed: Callable[[Mapping[str, np.ndarray]], bool]):
        self._solution, self._passed = solution, passed

    def observe_first(self, timestep):
        self._low, self._high, self._step = 0, len(self._solution.prior) - 1, 0

    def select_action(self, observation) -> int:
        return int(self._solution.actions(self._low, self._high, self._step))

    def observe(self, action, next_timestep):
        if next_timestep.last():
            return
        passed = self._passed(next_timestep.observation)
        self._low, self._high = map(int, narrow(self._low, self._high, action, passed))
        self._step += 1

    def update(self):
        """Does nothing: it knows all that can be known."""


def solve(prior: Sequence[float] | np.ndarray, discount: float, step_limit: int) -> Solution:
    """Finds the best policy, exactly.

    An answer after n interactions earns discount^n, times -1 where it is wrong, and so does silence at the last step.

    Args:
      prior: probabilities of the labels in their order, [L], L >= 2.
      discount: the agent's gamma, in (0, 1].
      step_limit: steps in an unanswered episode, from 1 to 100 000.

    Raises:
      ValueError: for a value that makes no sense.
    """
    chances = np.asarray(prior, np.float64)
    if chances.ndim != 1 or len(chances) < 2 or not (chances >= 0).all() or abs(chances.sum() - 1) > 1e-9:
        raise ValueError(f"prior is {checks.shown(prior)}; give two or more probabilities whose sum is 1")
    discount = base.check_discount(discount)
    steps = checks.integer("step_limit", step_limit, 1, 100_000)
    size = len(chances)
    answer, labels, mass = _answers(chances)
    policy = np.tile(size + labels, (steps, 1, 1))  # At the last step nothing is worth more than an answer.
    best, at_random, length = answer, answer, np.zeros_like(answer)
    for step in reversed(range(steps - 1)):
        test = discount * _after(best)
        lengths = np.where(test >= test.max(axis=0) - _TIE, mass + _after(length), np.inf)
        testing = test.max(axis=0) > answer + _TIE
        policy[step] = np.where(testing, lengths.argmin(axis=0), policy[step])
        length = np.where(testing, lengths.min(axis=0), 0.0)
        best = np.maximum(answer, test.max(axis=0))
        at_random = np.maximum(answer, discount * _after(at_random).mean(axis=0))
    return Solution(chances, discount, steps, float(best[0, -1]), float(at_random[0, -1]), policy)


def _answers(prior: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For each least and greatest label, [L, L]: what the best answer is worth, the label, and the probability.

    What it is worth is times the probability of the interval. Where the least label is above the greatest all is 0.
    """
    worth, labels, mass = np.zeros((3, len(prior), len(prior)))
    for low, high in zip(*np.triu_indices(len(prior)), strict=True):
        inside = prior[low : high + 1]
        labels[low, high], mass[low, high] = low + inside.argmax(), inside.sum()
        worth[low, high] = rules.RIGHT * inside.max() + rules.WRONG * (inside.sum() - inside.max())
    return worth, labels.astype(np.int64), mass


def _after(worth: np.ndarray) -> np.ndarray:
    """What is expected after each test, float64 [L, L, L], of what intervals are worth, [L, L]: the sum over its parts.

    A test that does not divide an interval leaves it as it was.
    """
    after = np.tile(worth, (len(worth), 1, 1))
    for test in range(len(worth) - 1):
        below, above = slice(None, test + 1), slice(test + 1, None)
        after[test, below, above] = worth[below, test, None] + worth[test + 1, above]
    return after
