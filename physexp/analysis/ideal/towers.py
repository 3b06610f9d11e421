"""The ideal experimenter of Towers (paper, Section 6; theory: docs/ideal.md).

It knows the physics, so a sequence of actions makes one trajectory of each of the 16 glue patterns; an observer of some
resolution can tell two of them apart once they have differed by more than that. The best policy is found by search over
sequences of actions, with a lower and an upper bound for each of them: where the two meet, nobody can do better.
"""

from collections.abc import Mapping, Sequence
import dataclasses
import functools
import math
from typing import Any

import numpy as np

from physexp import suite
from physexp.agents import core
from physexp.analysis import domains
from physexp.analysis.ideal import trajectories as trajectories_lib
from physexp.suite.domains import towers
from physexp.suite.parts import tower

_DISCOUNT = domains.find("towers").discount
OBJECTIVES = ("return", "time")
_COUNTS, _PRIOR = towers.NUM_BODIES, towers.PRIOR
_EVERYTHING = tuple(range(len(_COUNTS)))
_PRECISION = 1e-9
_WIDTH = 4  # Actions looked into at a time.

Group = tuple[int, ...]  # Patterns that cannot be told apart, in increasing order.


@dataclasses.dataclass(frozen=True)
class Objective:
    """What is to be as large as possible: the sum of what is earned, discounted for each interaction before it.

    Attributes:
      discount: for each interaction.
      cost: of each interaction.
      known: what an answer is worth when the count is known.
      guesses: whether an answer may be given before, for 2 P - 1, P being the probability that it is right.
    """

    discount: float
    cost: float
    known: float
    guesses: bool

    def answer(self, group: Group) -> float:
        """What it is worth to answer now."""
        chance = float(_count_chances(group).max())
        if chance > 1 - _PRECISION:
            return self.known
        return 2 * chance - 1 if self.guesses else -math.inf

    def act(self, value: float) -> float:
        """What an interaction is worth after which this value is expected."""
        return self.discount * value - self.cost


def _count_chances(group: Group) -> np.ndarray:
    """Probabilities of 1 to 5 bodies, [5], given that the pattern is in a group."""
    weights = np.bincount(_COUNTS[list(group)] - 1, _PRIOR[list(group)], minlength=tower.NUM_BLOCKS)
    return weights / weights.sum()


def split(group: Group, apart: np.ndarray, resolution: float) -> list[tuple[float, Group]]:
    """Splits a group of patterns into those that can be told apart.

    Patterns that differ by no more than the resolution are linked; a group is all that is linked, also through others.

    Args:
      group: the patterns.
      apart: how far apart they have looked at most, [16, 16].
      resolution: of the observer.

    Returns:
      Probabilities, given the group, and groups.
    """
    linked, left, parts = apart <= resolution, list(group), []
    while left:
        part, frontier = {left[0]}, [left[0]]
        while frontier:
            near = [other for other in left if linked[frontier[-1], other] and other not in part]
            frontier.pop()
            part.update(near)
            frontier += near
        parts.append(tuple(sorted(part)))
        left = [pattern for pattern in left if pattern not in part]
    total = _PRIOR[list(group)].sum()
    return [(float(_PRIOR[list(part)].sum() / total), part) for part in parts]


@dataclasses.dataclass(frozen=True)
class Node:
    """A decision: an action and what follows each of its outcomes, or an answer.

    Attributes:
      group: the patterns that are possible.
      action: the interaction action, or None to answer.
      label: the label to answer with, 0 to 4.
      seen: what is seen after the action, arrays with a leading axis of the 16 patterns; None for an answer.
      children: what to do next, for each pattern of the group.
    """

    group: Group
    action: int | None
    label: int
    seen: Mapping[str, np.ndarray] | None = None
    children: Mapping[int, "Node"] = dataclasses.field(default_factory=dict)


@dataclasses.dataclass(frozen=True)
class Solution:
    """The best policy found.

    Attributes:
      task, resolution, objective: of what it is the best.
      value: what it earns: expected discounted return, or expected interactions until the count is known.
      bound: what nobody can beat; equal to the value where the search was complete.
      control_timestep: s.
      policy: the first decision.
    """

    task: str
    resolution: float
    objective: str
    value: float
    bound: float
    control_timestep: float
    policy: Node

    def outcomes(self) -> np.ndarray:
        """For each pattern the interactions before the answer and whether it is right, int64 [16, 2]."""
        found = []
        for pattern, count in enumerate(_COUNTS):
            node, interactions = self.policy, 0
            while node.action is not None:
                node, interactions = node.children[pattern], interactions + 1
            found.append((interactions, node.label + 1 == count))
        return np.array(found, np.int64)

    def summary(self) -> dict[str, Any]:
        """`value`, `bound`, `accuracy`, `mean_interactions`, `mean_seconds`, `histogram` of interactions.

        The value is None where the count cannot be known for certain within the depth of the search.
        """
        interactions, right = self.outcomes().T
        mean = float(_PRIOR @ interactions)
        shares = np.bincount(interactions, _PRIOR)
        value, bound = (figure if math.isfinite(figure) else None for figure in (self.value, self.bound))
        return {
            "value": value,
            "bound": bound,
            "accuracy": float(_PRIOR @ right),
            "mean_interactions": mean,
            "mean_seconds": mean * self.control_timestep,
            "histogram": {number: float(share) for number, share in enumerate(shares)},
        }


def solve(
    task: str = "fist_features",
    resolution: float = 0.0,
    discount: float = _DISCOUNT,
    objective: str = "return",
    *,
    max_depth: int = 8,
    max_steps: int = 2_000_000,
    trajectories: trajectories_lib.Trajectories | None = None,
    task_kwargs: Mapping[str, Any] | None = None,
) -> Solution:
    """Searches for the best policy.

    Args:
      task: a task of the towers.
      resolution: by how much two observations must differ to be told apart: m for features, pixels for images. At 0
        every bit counts, and the bound holds for every agent.
      discount: the agent's gamma, in (0, 1].
      objective: `return`, the expected discounted return; or `time`, as few interactions as possible until the count
        is known for certain.
      max_depth: longest sequences of actions looked at.
      max_steps: control steps that may be simulated.
      trajectories: what has been simulated already of this task; by default nothing.
      task_kwargs: as for `suite.load`.

    Raises:
      ValueError: for a value that makes no sense.
    """
    if task not in suite.TASKS_BY_DOMAIN["towers"]:
        raise ValueError(f"task is {task!r}; choose from {', '.join(suite.TASKS_BY_DOMAIN['towers'])}")
    if not (isinstance(resolution, (int, float)) and 0 <= resolution < math.inf):
        raise ValueError(f"resolution is {resolution!r}; give a finite number >= 0 (m, or pixels)")
    if not (isinstance(discount, (int, float)) and 0 < discount <= 1):
        raise ValueError(f"discount is {discount!r}; give a number in (0, 1]")
    for name, limit in (("max_depth", max_depth), ("max_steps", max_steps)):
        if not isinstance(limit, int) or limit < 1:
            raise ValueError(f"{name} is {limit!r}; give an integer >= 1")
    if objective not in OBJECTIVES:
        raise ValueError(f"objective is {objective!r}; choose from {', '.join(OBJECTIVES)}")
    trajectories = trajectories or trajectories_lib.Trajectories(task, task_kwargs)
    aim = Objective(discount, 0.0, 1.0, True) if objective == "return" else Objective(1.0, 1.0, 0.0, False)
    search = Search(aim, resolution, trajectories, max_depth)
    low, high = search.run(trajectories.steps + max_steps)
    sign = 1.0 if objective == "return" else -1.0
    return Solution(
        task, resolution, objective, sign * low, sign * high, trajectories.task.control_timestep, search.policy()
    )


def curve(task: str, resolutions: Sequence[float], discount: float = _DISCOUNT) -> list[dict[str, Any]]:
    """Summaries for both objectives at several resolutions, with `resolution` and `objective` beside them."""
    trajectories = trajectories_lib.Trajectories(task)
    return [
        {
            "resolution": resolution,
            "objective": objective,
            **solve(task, resolution, discount, objective, trajectories=trajectories).summary(),
        }
        for resolution in resolutions
        for objective in OBJECTIVES
    ]


class Search:
    """Best-first search with bounds, over sequences of actions and the groups of patterns that each leaves together."""

    def __init__(self, objective: Objective, resolution: float, trajectories, max_depth: int):
        """Starts with nothing but the first decision; `trajectories` as in `Trajectories`."""
        self._objective, self._resolution, self._max_depth = objective, resolution, max_depth
        self._trajectories = trajectories
        self._actions = range(trajectories.task.num_interactions)
        self._parts: dict[tuple, list[tuple[float, Group]]] = {}
        self._bounds = functools.cache(self._find_bounds)

    def run(self, max_steps: int) -> tuple[float, float]:
        """Searches until the bounds meet or so many steps have been simulated; returns the bounds."""
        while True:
            low, high = self._bounds((), _EVERYTHING)
            leaves: dict[tuple[int, ...], None] = {}
            self._collect((), _EVERYTHING, leaves)
            if high - low < _PRECISION or not leaves or self._trajectories.steps >= max_steps:
                return low, high
            self._trajectories.expand(list(leaves))
            self._bounds.cache_clear()

    def _after(self, sequence, group, action) -> list[tuple[float, Group]]:
        key = (*sequence, action), group
        if key not in self._parts:
            self._parts[key] = split(group, self._trajectories.apart(key[0]), self._resolution)
        return self._parts[key]

    def _find_bounds(self, sequence, group) -> tuple[float, float]:
        """What is earned at least and at most from a group after a sequence of actions."""
        answer, hope = self._objective.answer(group), self._objective.act(self._objective.known)
        if answer == self._objective.known:
            return answer, answer
        if len(sequence) >= self._trajectories.task.rules.step_limit - 1:
            return answer, answer  # The last action in time is the answer.
        if not self._trajectories.is_expanded(sequence):
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
        """Finds the sequences to look beyond: those of the most promising actions."""
        low, high = self._bounds(sequence, group)
        if high - low < _PRECISION:
            return
        if not self._trajectories.is_expanded(sequence):
            if len(sequence) < self._max_depth:
                leaves[sequence] = None
            return
        highs = [self._action_bounds(sequence, group, action)[1] for action in self._actions]
        for action in np.argsort([-value for value in highs], kind="stable")[:_WIDTH]:
            if highs[action] > low + _PRECISION:
                for _, part in self._after(sequence, group, int(action)):
                    self._collect((*sequence, int(action)), part, leaves)

    def policy(self) -> Node:
        """The policy that earns the lower bound."""
        return self._decide((), _EVERYTHING)

    def _decide(self, sequence, group) -> Node:
        label = int(_count_chances(group).argmax())
        answer = self._objective.answer(group)
        ends = len(sequence) >= self._trajectories.task.rules.step_limit - 1
        if ends or answer == self._objective.known or not self._trajectories.is_expanded(sequence):
            return Node(group, None, label)
        lows = [self._action_bounds(sequence, group, action)[0] for action in self._actions]
        action = int(np.argmax(lows))
        if answer >= lows[action]:
            return Node(group, None, label)
        children: dict[int, Node] = {}
        for _, part in self._after(sequence, group, action):
            children |= dict.fromkeys(part, self._decide((*sequence, action), part))
        (seen,) = self._trajectories.observe([(*sequence, action)])
        return Node(group, action, label, seen, children)


class IdealExperimenter(core.Actor):
    """Plays a policy in the real environment from its observations alone: it recognises the trajectories it expects."""

    def __init__(self, solution: Solution):
        """Prepares to play a solution in the environments of its task."""
        self._solution = solution
        self._num_interactions = suite.load_task("towers", solution.task).num_interactions

    def observe_first(self, timestep):
        self._node = self._solution.policy

    def select_action(self, observation) -> int:
        node = self._node
        return self._num_interactions + node.label if node.action is None else node.action

    def observe(self, action, next_timestep):
        node = self._node
        if node.seen is None or next_timestep.last():
            return
        members = list(node.group)
        both = {
            name: np.concatenate([next_timestep.observation[name][None], value[members]])
            for name, value in node.seen.items()
        }
        self._node = node.children[members[int(trajectories_lib.distances(both)[0, 1:].argmin())]]

    def update(self):
        """Needs nothing: it knows the physics."""
