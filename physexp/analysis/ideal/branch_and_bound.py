"""Best-first search for the best policy among finitely many hypotheses, with lower and upper bounds on its value."""

from collections.abc import Mapping
import dataclasses
import math

import numpy as np

from physexp.analysis.ideal import base
from physexp.analysis.ideal import histories as histories_lib
from physexp.analysis.ideal.histories import State, Support

PRECISION = 1e-9
_WIDTH = 4  # Actions explored at a time.


@dataclasses.dataclass(frozen=True)
class Criterion:
    """The expected value that the search maximizes."""

    discount: float  # For each interaction.
    cost: float  # Of each interaction.
    known: float  # Value of an answer when the right label is known.
    guesses: bool  # Whether the policy may answer before, for 2 P - 1 if the answer is right with probability P.

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
    """A decision: an interaction and the decisions after each of its outcomes, or an answer."""

    support: Support  # The n possible hypotheses.
    action: int | None  # The interaction, or None to answer.
    label: int  # To answer with.
    expected: Mapping[str, np.ndarray] = dataclasses.field(default_factory=dict)  # Observations after it, [n, ...].
    children: Mapping[int, "Node"] = dataclasses.field(default_factory=dict)  # For each hypothesis of the support.


class Search:
    """The search, over the information states that sequences of interactions may leave.

    It can start anywhere, with any number of actions left; later searches use the results of earlier ones.

    Attributes:
      histories: the tree of sequences of interactions.
    """

    def __init__(self, criterion: Criterion, histories: histories_lib.Histories):
        self._criterion, self.histories = criterion, histories
        self._hypotheses, self._actions = histories.hypotheses, range(histories.num_interactions)
        # Bounds by state and number of actions left. Open ones have not met; they change when histories are added.
        self._closed: dict[tuple[State, int], tuple[float, float]] = {}
        self._open: dict[tuple[State, int], tuple[float, float]] = {}
        self._count = 0  # The number of histories that the open bounds use.

    def run(
        self, state: State, left: int, max_depth: float = math.inf, max_steps: float = math.inf
    ) -> tuple[float, float]:
        """Searches from a state on, with some actions left including the answer, until the bounds meet; returns them.

        It ends earlier when it has tried all sequences of `max_depth` interactions, or simulated `max_steps` control
        steps.
        """
        end = self._hypotheses.steps + max_steps
        while True:
            if self._count != self.histories.count:
                self._open.clear()
                self._count = self.histories.count
            low, high = self._bounds(state, left)
            if high - low < PRECISION:
                return low, high
            leaves: dict[tuple[State, int], bool] = {}
            self._collect(state, left, left - max_depth, leaves)
            unexpanded = dict.fromkeys(history for ((history, _), _), is_leaf in leaves.items() if is_leaf)
            if not unexpanded or self._hypotheses.steps >= end:
                return low, high
            for history in unexpanded:
                self.histories.expand(history)

    def bounds_of(self, state: State, left: int, action: int) -> tuple[float, float]:
        """Returns the bounds on the value of an interaction that follow from the search so far."""
        low = high = 0.0
        for probability, following in self.histories.following(state, action):
            part_low, part_high = self._bounds(self.histories.represented(following), left - 1)
            low, high = low + probability * part_low, high + probability * part_high
        return self._criterion.act(low), self._criterion.act(high)

    def policy(self, state: State, left: int) -> Node:
        """Returns the policy that earns the lower bound."""
        history, support = state
        label, answer = int(self.histories.posterior(state).argmax()), self._answer(support)
        if left == 1 or answer == self._criterion.known or not self.histories.is_expanded(history):
            return Node(support, None, label)
        lows = [self.bounds_of(state, left, action)[0] for action in self._actions]
        action = int(np.argmax(lows))
        if answer >= lows[action]:
            return Node(support, None, label)
        children: dict[int, Node] = {}
        for _, following in self.histories.following(state, action):
            children |= dict.fromkeys(following[1], self.policy(following, left - 1))
        return Node(support, action, label, self._hypotheses.observe(history.snapshot, support, action), children)

    def _answer(self, support: Support) -> float:
        return self._criterion.answer(self.histories.max_probability(support))

    def _bounds(self, state: State, left: int) -> tuple[float, float]:
        key = state, left
        if key in self._closed:
            return self._closed[key]
        if key not in self._open:
            low, high = self._find_bounds(state, left)
            (self._closed if high - low < PRECISION else self._open)[key] = low, high
            return low, high
        return self._open[key]

    def _find_bounds(self, state: State, left: int) -> tuple[float, float]:
        answer, hope = self._answer(state[1]), self._criterion.act(self._criterion.known)
        if answer == self._criterion.known or left == 1:  # The last action before the time limit is the answer.
            return answer, answer
        if not self.histories.is_expanded(state[0]):
            return answer, max(answer, hope)
        values = [self.bounds_of(state, left, action) for action in self._actions]
        return max(answer, *(low for low, _ in values)), max(answer, *(high for _, high in values))

    def _collect(self, state: State, left: int, min_left: float, leaves: dict[tuple[State, int], bool]) -> None:
        """Visits the states that the most promising actions lead to, down to `min_left` actions left.

        Writes into `leaves` whether the histories of these states should be expanded.
        """
        low, high = self._bounds(state, left)
        if left == 1 or high - low < PRECISION or (state, left) in leaves:
            return
        is_expanded = self.histories.is_expanded(state[0])
        leaves[state, left] = not is_expanded and left > min_left
        if not is_expanded:
            return
        highs = [self.bounds_of(state, left, action)[1] for action in self._actions]
        for action in np.argsort([-value for value in highs], kind="stable")[:_WIDTH]:
            if highs[action] > low + PRECISION:
                for _, following in self.histories.following(state, int(action)):
                    self._collect(self.histories.represented(following), left - 1, min_left, leaves)
