"""The bookkeeping of episodes: one ledger, of one row in composer's environment and of thousands in a batch."""

from typing import Any

import numpy as np

from physexp import checks
from physexp.suite.engine import seeding
from physexp.suite.engine.rules import RIGHT, WRONG


class Ledger:
    """Keeps the current episode and the number of steps of N environments of a task.

    Attributes:
      seeds: seeds of the environments, int64 [N].
      next_episodes: indices of the episodes that start next, int64 [N].
      answers: indices of the right labels of all K questions, int64 [N, K].
      num_answered: questions answered, int64 [N].
      num_right: right answers, int64 [N].
      returns: sums of the rewards, discounted with the task's gamma, float64 [N].
      structures: the compiled model of each episode, int64 [N].
      nuisances: values of the random variation, in [-1, 1], float64 [N, number of nuisances].
      substeps: physics steps in a control step of each episode, int64 [N].
      steps: control steps taken, int64 [N].
      touched: whether each held entity has moved, bool [N, number of held entities].
      over: whether the episode has ended, or none has begun, bool [N].
    """

    def __init__(self, task: Any, size: int):
        self._task = task
        self._hidden: np.ndarray | None = None
        self.answers = np.zeros((size, task.rules.num_questions), np.int64)
        self.structures, self.substeps, self.steps, self.num_answered, self.num_right = np.zeros((5, size), np.int64)
        self.returns = np.zeros(size)
        self.nuisances = np.zeros((size, task.num_nuisances if task.options.variation else 0))
        self.touched = np.zeros((size, len(task.scene.held)), bool)
        self.reseed(np.zeros(size, np.int64))

    def reseed(self, seeds: np.ndarray) -> None:
        """Takes other seeds, int64 [N]: every environment starts its first episode next."""
        self.seeds = seeds
        self.next_episodes = np.zeros(len(seeds), np.int64)
        self.over = np.ones(len(seeds), bool)

    @property
    def hidden(self) -> np.ndarray:
        """The hidden properties of the current episodes, [N, ...]; raises RuntimeError before the first."""
        if self._hidden is None:
            raise RuntimeError("no episode has been started; call reset() first")
        return self._hidden

    @property
    def correct_answers(self) -> np.ndarray:
        """Indices of the right labels of the current questions, or the last ones, int64 [N]; raises as `hidden`."""
        return self.answers[np.arange(len(self.hidden)), self._asked]

    @property
    def _asked(self) -> np.ndarray:
        return np.minimum(self.num_answered, self._task.rules.num_questions - 1)

    def told(self, rows: np.ndarray) -> np.ndarray:
        """Returns the values of the sensors that the task tells in some environments, float64 [K, number of values]."""
        return self._task.tell(self.hidden[rows], self._asked[rows], self.steps[rows])

    def begin(self, rows: np.ndarray, hidden: Any = None, nuisances: Any = None, episode: int | None = None) -> None:
        """Starts an episode of some environments, int [K]: by default the next one of each.

        Hidden properties, [K, ...], and nuisances, [K, number of them], are drawn from seed and episode by default. For
        given ones without the shape, the type and the range of drawn values, it raises ValueError and changes nothing.
        """
        indices = self.next_episodes[rows] if episode is None else np.full(len(rows), episode)
        options, drawn = self._task.options, self._task.draw(self.seeds[rows], indices)
        differing = self.nuisances[rows]
        if differing.size:
            differing = options.variation * seeding.variations(self.seeds[rows], indices, differing.shape[1])
        if nuisances is not None:
            differing = _checked("nuisances", nuisances, differing, -1, 1)
        if hidden is not None:
            drawn = _checked("hidden", hidden, drawn, 0, self._task.largest_hidden)
        answers, structures = self._task.answers(drawn), self._task.structures(drawn)
        if self._hidden is None:
            self._hidden = np.zeros((len(self.seeds), *drawn.shape[1:]), drawn.dtype)
        self._hidden[rows] = drawn
        self.answers[rows], self.structures[rows] = answers.reshape(self.answers[rows].shape), structures
        self.nuisances[rows] = differing
        self.substeps[rows] = options.draw_substeps(self.seeds[rows], indices)
        self.next_episodes[rows] = indices + 1
        for count in (self.steps, self.num_answered, self.num_right, self.returns):
            count[rows] = 0
        self.touched[rows] = False
        self.over[rows] = False

    def judge(self, rows: np.ndarray, actions: np.ndarray, lost: Any = False) -> tuple[np.ndarray, np.ndarray]:
        """Returns rewards, float64 [K], and whether episodes end, bool [K], after actions, int [K], of some rows.

        Episodes that are lost, bool [K], since their simulation has diverged, end without a reward.
        """
        rules = self._task.rules
        labels = actions - rules.num_interactions
        right = labels == self.answers[rows, self.num_answered[rows]]
        self.num_answered[rows] += labels >= 0
        self.num_right[rows] += right
        left = rules.num_questions - self.num_answered[rows]
        last = (left == 0) | (self.steps[rows] >= rules.step_limit) | lost
        earned = np.where(right, RIGHT, np.where(labels >= 0, WRONG, 0.0)) + WRONG * np.where(last, left, 0)
        rewards = np.where(lost, 0.0, earned)
        self.returns[rows] += rewards * self._task.discount ** (self.steps[rows] - 1.0)
        self.over[rows] = last
        return rewards, last


def _checked(name: str, given: Any, drawn: np.ndarray, least: float, largest: Any) -> np.ndarray:
    """Returns given values in place of drawn ones, if they have their shape, type and range."""
    values = np.asarray(given)
    if values.shape != drawn.shape or not np.can_cast(values.dtype, drawn.dtype, "same_kind"):
        raise ValueError(f"{name} is {checks.shown(given)}; give an array of shape {drawn.shape}, {drawn.dtype}")
    if not np.isfinite(values).all():
        raise ValueError(f"{name} is {checks.shown(given)}; give finite numbers")
    limits = np.broadcast_to(largest, values.shape)
    are_bad = (values < least) | (values > limits)
    if are_bad.any():
        limit = limits[are_bad][0]
        raise ValueError(f"{name} is {checks.shown(given)}; give values from {least:g} to {limit:g}")
    return values.astype(drawn.dtype)
