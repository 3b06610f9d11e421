"""Best-first search for the best policy among finitely many hypotheses, with a lower and an upper bound on its value.

A sequence of actions makes one trajectory of each hypothesis; an observer of some resolution can tell two of them apart
once they have differed by more than that. What it knows is a group of hypotheses that it cannot tell apart.
"""

from collections.abc import Mapping
import dataclasses
import functools
import math

import numpy as np

PRECISION = 1e-9
_WIDTH = 4  # Actions looked into at a time.

Group = tuple[int, ...]  # Hypotheses that cannot be told apart, in increasing order.


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
        return 2 * chance - 1 if self.guesses else -math.inf

    def act(self, value: float) -> float:
        """Returns what an interaction is worth after which this value is expected."""
        return self.discount * value - self.cost


def split(group: Group, apart: np.ndarray, resolution: float, prior: np.ndarray) -> list[tuple[float, Group]]:
    """Splits a group of hypotheses into those that can be told apart.

    Those that differ by no more than the resolution are linked; a group is all that is linked, also through others.

    Args:
      group: the hypotheses.
      apart: the largest distances between their observations so far, [H, H].
      resolution: of the observer.
      prior: their probabilities, float64 [H].

    Returns:
      Probabilities, given the group, and groups.
    """
    members = np.array(group)
    linked, left, parts = apart[np.ix_(members, members)] <= resolution, np.ones(len(members), bool), []
    while left.any():
        part = linked[left.argmax()]
        while not np.array_equal(part, grown := linked[part].any(axis=0)):
            part = grown
        parts.append(tuple(members[part].tolist()))
        left &= ~part
    total = prior[members].sum()
    return [(float(prior[list(part)].sum() / total), part) for part in parts]


def label_chances(group: Group, prior: np.ndarray, answers: np.ndarray, num_labels: int) -> np.ndarray:
    """Returns the probabilities of the labels, float64 [L], given that the hypothesis is in a group.

    Args:
      group: the hypotheses that are possible.
      prior, answers: probability and right label of each hypothesis, [H].
      num_labels: L.
    """
    members = list(group)
    weights = np.bincount(answers[members], prior[members], minlength=num_labels)
    return weights / weights.sum()


@dataclasses.dataclass(frozen=True)
class Node:
    """A decision: an action and what follows each of its outcomes, or an answer.

    Attributes:
      group: the hypotheses that are possible.
      action: the interaction action, or None to answer.
      label: the label to answer with.
      seen: what is seen after the action, arrays with a leading axis [H]; None for an answer.
      children: what to do next, for each hypothesis of the group.
    """

    group: Group
    action: int | None
    label: int
    seen: Mapping[str, np.ndarray] | None = None
    children: Mapping[int, "Node"] = dataclasses.field(default_factory=dict)


class Search:
    """The search, over sequences of actions and the groups of hypotheses that each leaves together."""

    def __init__(self, objective: Objective, resolution: float, trajectories, max_depth: int):
        """Starts with nothing but the first decision.

        Args:
          objective: what is to be as large as possible.
          resolution: of the observer.
          trajectories: a `Trajectories`.
          max_depth: longest sequences of actions looked at.
        """
        self._objective, self._resolution, self._max_depth = objective, resolution, max_depth
        self._trajectories = trajectories
        self._actions = range(trajectories.task.num_interactions)
        self._everything = tuple(range(len(trajectories.prior)))
        self._parts: dict[tuple, list[tuple[float, Group]]] = {}
        self._bounds = functools.cache(self._find_bounds)

    def run(self, max_steps: int) -> tuple[float, float]:
        """Searches until the bounds meet or so many steps have been simulated; returns the bounds."""
        while True:
            low, high = self._bounds((), self._everything)
            leaves: dict[tuple[int, ...], set[int]] = {}
            self._collect((), self._everything, leaves)
            if high - low < PRECISION or not leaves or self._trajectories.steps >= max_steps:
                return low, high
            self._trajectories.expand(leaves)
            self._bounds.cache_clear()

    def policy(self) -> Node:
        """Returns the policy that earns the lower bound."""
        return self._decide((), self._everything)

    def _chances(self, group) -> np.ndarray:
        known = self._trajectories
        return label_chances(group, known.prior, known.answers, known.task.num_labels)

    def _answer(self, group) -> float:
        """Returns what it is worth to answer now."""
        return self._objective.answer(float(self._chances(group).max()))

    def _after(self, sequence, group, action) -> list[tuple[float, Group]]:
        key = (*sequence, action), group
        if key not in self._parts:
            known = self._trajectories
            self._parts[key] = split(group, known.apart(key[0]), self._resolution, known.prior)
        return self._parts[key]

    def _find_bounds(self, sequence, group) -> tuple[float, float]:
        """Returns what is earned at least and at most from a group after a sequence of actions."""
        answer, hope = self._answer(group), self._objective.act(self._objective.known)
        if answer == self._objective.known:
            return answer, answer
        if len(sequence) >= self._trajectories.task.rules.step_limit - 1:
            return answer, answer  # The last action in time is the answer.
        if not self._trajectories.is_expanded(sequence, group):
            return answer, max(answer, hope)
        values = [self._action_bounds(sequence, group, action) for action in self._actions]
        return max(answer, *(low for low, _ in values)), max(answer, *(high for _, high in values))

    def _action_bounds(self, sequence, group, action) -> tuple[float, float]:
        low = high = 0.0
        for chance, part in self._after(sequence, group, action):
            least, most = self._bounds((*sequence, action), part)
            low, high = low + chance * least, high + chance * most
        return self._objective.act(low), self._objective.act(high)

    def _collect(self, sequence, group, leaves) -> None:
        """Finds the sequences to look beyond, those of the most promising actions, and the hypotheses to do it with."""
        low, high = self._bounds(sequence, group)
        if high - low < PRECISION:
            return
        if not self._trajectories.is_expanded(sequence, group):
            if len(sequence) < self._max_depth:
                leaves.setdefault(sequence, set()).update(group)
            return
        highs = [self._action_bounds(sequence, group, action)[1] for action in self._actions]
        for action in np.argsort([-value for value in highs], kind="stable")[:_WIDTH]:
            if highs[action] > low + PRECISION:
                for _, part in self._after(sequence, group, int(action)):
                    self._collect((*sequence, int(action)), part, leaves)

    def _decide(self, sequence, group) -> Node:
        label, answer = int(self._chances(group).argmax()), self._answer(group)
        ends = len(sequence) >= self._trajectories.task.rules.step_limit - 1
        if ends or answer == self._objective.known or not self._trajectories.is_expanded(sequence, group):
            return Node(group, None, label)
        lows = [self._action_bounds(sequence, group, action)[0] for action in self._actions]
        action = int(np.argmax(lows))
        if answer >= lows[action]:
            return Node(group, None, label)
        children: dict[int, Node] = {}
        for _, part in self._after(sequence, group, action):
            children |= dict.fromkeys(part, self._decide((*sequence, action), part))
        seen = self._trajectories.observe((*sequence, action))
        return Node(group, action, label, seen, children)
