"""Best-first search for the best policy among finitely many hypotheses, with lower and upper bounds on its value."""

from collections.abc import Mapping
import dataclasses
import math

import numpy as np

from physexp.analysis.ideal import base
from physexp.analysis.ideal import histories as histories_lib
from physexp.analysis.ideal.histories import History, Support

PRECISION = 1e-9
_WIDTH = 4  # Actions explored at a time.

_State = tuple[History, Support, int]  # A history, the support of the belief, and the number of actions left.


@dataclasses.dataclass(frozen=True)
class Criterion:
    """The expected value that the search maximizes.

    Attributes:
      discount: for each interaction.
      cost: of each interaction.
      known: value of an answer when the right label is known.
      guesses: whether the policy may answer before, for 2 P - 1, P being the probability that the answer is right.
    """

    discount: float
    cost: float
    known: float
    guesses: bool

    def answer(self, probability: float) -> float:
        """Returns the value of an answer that is right with some probability."""
        if probability > 1 - PRECISION:
            return self.known
        return base.answer_values(probability) if self.guesses else -math.inf

    def act(self, value: float) -> float:
        """Returns the value of an interaction, given the expected value after it."""
        return self.discount * value - self.cost


@dataclasses.dataclass(frozen=True)
class Node:
    """A decision: an interaction and the decisions after each of its outcomes, or an answer.

    Attributes:
      support: the possible hypotheses.
      action: the interaction, or None to answer.
      label: the label to answer with.
      expected: the observations after the interaction for each of them, arrays [size of the support, ...]; None for an
        answer.
      children: the next decision, for each hypothesis of the support.
    """

    support: Support
    action: int | None
    label: int
    expected: Mapping[str, np.ndarray] | None = None
    children: Mapping[int, "Node"] = dataclasses.field(default_factory=dict)


class Search:
    """The search, over histories and the supports that each may leave.

    It can start anywhere, with any number of actions left; later searches use the results of earlier ones.

    Attributes:
      histories: the tree of sequences of interactions.
    """

    def __init__(self, criterion: Criterion, histories: histories_lib.Histories):
        self._criterion, self.histories = criterion, histories
        self._hypotheses = histories.hypotheses
        self._actions = range(self._hypotheses.task.num_interactions)
        self._closed: dict[_State, tuple[float, float]] = {}  # Bounds that have met.
        self._open: dict[_State, tuple[float, float]] = {}  # Other bounds; they change when histories are added.
        self._count = 0  # The number of histories that these bounds use.

    def run(
        self, history: History, support: Support, left: int, max_depth: float = math.inf, max_steps: float = math.inf
    ) -> tuple[float, float]:
        """Searches until the bounds meet, or the limits are reached; returns the bounds.

        Args:
          history, support: the start of the search.
          left: actions left in the episode, including the answer.
          max_depth: longest sequences of interactions to try.
          max_steps: control steps that may be simulated.
        """
        end = self._hypotheses.steps + max_steps
        while True:
            if self._count != self.histories.count:
                self._open.clear()
                self._count = self.histories.count
            low, high = self._bounds(history, support, left)
            if high - low < PRECISION:
                return low, high
            visited: dict[_State, bool] = {}
            self._collect(history, support, left, left - max_depth, visited)
            leaves = dict.fromkeys(leaf for (leaf, _, _), is_leaf in visited.items() if is_leaf)
            if not leaves or self._hypotheses.steps >= end:
                return low, high
            for leaf in leaves:
                self.histories.expand(leaf)

    def bounds_of(self, history: History, support: Support, left: int, action: int) -> tuple[float, float]:
        """Returns the bounds on the value of an interaction that follow from the search so far."""
        low = high = 0.0
        partition, following = self.histories.successor(history, support, action)
        for probability, part in partition:
            part_low, part_high = self._bounds(following.representative, part, left - 1)
            low, high = low + probability * part_low, high + probability * part_high
        return self._criterion.act(low), self._criterion.act(high)

    def policy(self, history: History, support: Support, left: int) -> Node:
        """Returns the policy that earns the lower bound."""
        label, answer = int(self.histories.probabilities(support).argmax()), self._answer(support)
        if left == 1 or answer == self._criterion.known or not self.histories.is_expanded(history):
            return Node(support, None, label)
        lows = [self.bounds_of(history, support, left, action)[0] for action in self._actions]
        action = int(np.argmax(lows))
        if answer >= lows[action]:
            return Node(support, None, label)
        children: dict[int, Node] = {}
        partition, following = self.histories.successor(history, support, action)
        for _, part in partition:
            children |= dict.fromkeys(part, self.policy(following, part, left - 1))
        expected = self._hypotheses.observe(history.snapshot, support, action)
        return Node(support, action, label, expected, children)

    def _answer(self, support) -> float:
        return self._criterion.answer(self.histories.max_probability(support))

    def _bounds(self, history, support, left) -> tuple[float, float]:
        state = history, support, left
        if state in self._closed:
            return self._closed[state]
        if state not in self._open:
            low, high = self._find_bounds(history, support, left)
            (self._closed if high - low < PRECISION else self._open)[state] = low, high
            return low, high
        return self._open[state]

    def _find_bounds(self, history, support, left) -> tuple[float, float]:
        answer, hope = self._answer(support), self._criterion.act(self._criterion.known)
        if answer == self._criterion.known or left == 1:  # The last action before the time limit is the answer.
            return answer, answer
        if not self.histories.is_expanded(history):
            return answer, max(answer, hope)
        values = [self.bounds_of(history, support, left, action) for action in self._actions]
        return max(answer, *(low for low, _ in values)), max(answer, *(high for _, high in values))

    def _collect(self, history, support, left, min_left, visited) -> None:
        """Visits the states that the most promising actions lead to, down to `min_left` actions left.

        Writes into `visited` whether the histories of these states should be expanded.
        """
        low, high = self._bounds(history, support, left)
        if left == 1 or high - low < PRECISION or (history, support, left) in visited:
            return
        is_expanded = self.histories.is_expanded(history)
        visited[history, support, left] = not is_expanded and left > min_left
        if not is_expanded:
            return
        highs = [self.bounds_of(history, support, left, action)[1] for action in self._actions]
        for action in np.argsort([-value for value in highs], kind="stable")[:_WIDTH]:
            if highs[action] > low + PRECISION:
                partition, following = self.histories.successor(history, support, int(action))
                for _, part in partition:
                    self._collect(following.representative, part, left - 1, min_left, visited)
