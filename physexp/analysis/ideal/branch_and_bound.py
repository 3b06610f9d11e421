"""Best-first search for the best policy among finitely many hypotheses, with lower and upper bounds on its value."""

from collections.abc import Mapping
import dataclasses
import math

import numpy as np

from physexp.analysis.ideal import base
from physexp.analysis.ideal import situations as situations_lib
from physexp.analysis.ideal.situations import Group, Situation

PRECISION = 1e-9
_WIDTH = 4  # Actions looked into at a time.


@dataclasses.dataclass(frozen=True)
class Objective:
    """What the search maximizes: a reward, discounted for each interaction before it.

    Attributes:
      discount: for each interaction.
      cost: of each interaction.
      known: what an answer is worth when the right label is known.
      guesses: whether an answer may be given before, for 2 P - 1, P being the probability that it is right.
    """

    discount: float
    cost: float
    known: float
    guesses: bool

    def answer(self, chance: float) -> float:
        """Returns what it is worth to give an answer that is right with this probability."""
        if chance > 1 - PRECISION:
            return self.known
        return base.worth_of_answers(chance) if self.guesses else -math.inf

    def act(self, value: float) -> float:
        """Returns what an interaction is worth after which this value is expected."""
        return self.discount * value - self.cost


@dataclasses.dataclass(frozen=True)
class Node:
    """A decision: an action and what follows each of its outcomes, or an answer.

    Attributes:
      group: the hypotheses that are possible.
      action: the interaction action, or None to answer.
      label: the label to answer with.
      seen: what each of them shows after the action, arrays [size of the group, ...]; None for an answer.
      children: what to do next, for each hypothesis of the group.
    """

    group: Group
    action: int | None
    label: int
    seen: Mapping[str, np.ndarray] | None = None
    children: Mapping[int, "Node"] = dataclasses.field(default_factory=dict)


class Search:
    """The search, over situations and the groups of hypotheses that each leaves together.

    Where it starts, and how much time is left there, can be chosen; what has been found out is used again.

    Attributes:
      situations: what actions lead to.
    """

    def __init__(self, objective: Objective, situations: situations_lib.Situations):
        """Starts with nothing found out.

        Args:
          objective: what is to be as large as possible.
          situations: what actions lead to.
        """
        self._objective, self.situations = objective, situations
        self._hypotheses = situations.hypotheses
        self._actions = range(self._hypotheses.task.num_interactions)
        self._closed: dict[tuple[Situation, Group, int], tuple[float, float]] = {}  # Where the bounds have met.
        self._open: dict[tuple[Situation, Group, int], tuple[float, float]] = {}  # Elsewhere, by what is known so far.
        self._known = 0  # How many situations that is.

    def run(
        self, situation: Situation, group: Group, left: int, max_depth: float = math.inf, max_steps: float = math.inf
    ) -> tuple[float, float]:
        """Searches until the bounds meet or so many steps have been simulated.

        Args:
          situation, group: where to start, and what is possible there.
          left: actions left in the episode, the answer included.
          max_depth: longest sequences of actions looked at.
          max_steps: control steps that may be simulated.

        Returns:
          What is earned from there at least and at most.
        """
        end = self._hypotheses.steps + max_steps
        while True:
            if self._known != self.situations.count:
                self._open.clear()
                self._known = self.situations.count
            low, high = self._bounds(situation, group, left)
            if high - low < PRECISION:
                return low, high
            passed: dict[tuple[Situation, Group, int], bool] = {}
            self._collect(situation, group, left, left - max_depth, passed)
            leaves = dict.fromkeys(leaf for (leaf, _, _), is_leaf in passed.items() if is_leaf)
            if not leaves or self._hypotheses.steps >= end:
                return low, high
            for leaf in leaves:
                self.situations.expand(leaf)

    def acting(self, situation: Situation, group: Group, left: int, action: int) -> tuple[float, float]:
        """Returns the lower and the upper bound on the worth of an interaction that follow from the search so far."""
        low = high = 0.0
        parts, following = self.situations.follow(situation, group, action)
        for chance, part in parts:
            least, most = self._bounds(following.like, part, left - 1)
            low, high = low + chance * least, high + chance * most
        return self._objective.act(low), self._objective.act(high)

    def policy(self, situation: Situation, group: Group, left: int) -> Node:
        """Returns the policy that earns the lower bound."""
        label, answer = int(self.situations.chances(group).argmax()), self._answer(group)
        if left == 1 or answer == self._objective.known or not self.situations.is_expanded(situation):
            return Node(group, None, label)
        lows = [self.acting(situation, group, left, action)[0] for action in self._actions]
        action = int(np.argmax(lows))
        if answer >= lows[action]:
            return Node(group, None, label)
        children: dict[int, Node] = {}
        parts, following = self.situations.follow(situation, group, action)
        for _, part in parts:
            children |= dict.fromkeys(part, self.policy(following, part, left - 1))
        seen = self._hypotheses.observe(situation.moment, group, action)
        return Node(group, action, label, seen, children)

    def _answer(self, group) -> float:
        """Returns what it is worth to answer now."""
        return self._objective.answer(self.situations.likeliest(group))

    def _bounds(self, situation, group, left) -> tuple[float, float]:
        """Returns what is earned at least and at most from a group, with so many actions left."""
        key = situation, group, left
        if key in self._closed:
            return self._closed[key]
        if key not in self._open:
            low, high = self._find_bounds(situation, group, left)
            (self._closed if high - low < PRECISION else self._open)[key] = low, high
            return low, high
        return self._open[key]

    def _find_bounds(self, situation, group, left) -> tuple[float, float]:
        answer, hope = self._answer(group), self._objective.act(self._objective.known)
        if answer == self._objective.known or left == 1:  # The last action in time is the answer.
            return answer, answer
        if not self.situations.is_expanded(situation):
            return answer, max(answer, hope)
        values = [self.acting(situation, group, left, action) for action in self._actions]
        return max(answer, *(low for low, _ in values)), max(answer, *(high for _, high in values))

    def _collect(self, situation, group, left, least_left, passed) -> None:
        """Goes where the most promising actions lead, and finds out what to look beyond.

        Args:
          situation, group, left: where to start.
          least_left: how many actions are left where nothing is looked at any more.
          passed: where it has been, and whether that is to be looked beyond; written to.
        """
        low, high = self._bounds(situation, group, left)
        if left == 1 or high - low < PRECISION or (situation, group, left) in passed:
            return
        is_expanded = self.situations.is_expanded(situation)
        passed[situation, group, left] = not is_expanded and left > least_left
        if not is_expanded:
            return
        highs = [self.acting(situation, group, left, action)[1] for action in self._actions]
        for action in np.argsort([-value for value in highs], kind="stable")[:_WIDTH]:
            if highs[action] > low + PRECISION:
                parts, following = self.situations.follow(situation, group, int(action))
                for _, part in parts:
                    self._collect(following.like, part, left - 1, least_left, passed)
