"""The ideal experimenter among finitely many hypotheses, when physics is deterministic and known (docs/ideal.md).

Nothing but the hypothesis is hidden, so an experimenter learns which of their trajectories it is on. The best policy is
found by search over sequences of actions, with a lower and an upper bound: where they meet, nobody can do better.
"""

from collections.abc import Sequence
import dataclasses
import functools
from typing import Any

import numpy as np

from physexp import checks
from physexp.agents import core
from physexp.analysis.ideal import base, branch_and_bound, random_play
from physexp.analysis.ideal import hypotheses as hypotheses_lib
from physexp.analysis.ideal import situations as situations_lib
from physexp.suite.engine import rules

OBJECTIVES = ("return", "time")
_MOST_SITUATIONS = 30_000  # Kept to judge others: about 600 MB for 40 hypotheses.


class Solution:
    """The best policy found. It is searched for when something is first asked that only a search can tell.

    Attributes:
      hypotheses: what may be hidden.
      discount: the agent's gamma.
      objective: one of `OBJECTIVES`.
    """

    def __init__(
        self,
        hypotheses: hypotheses_lib.Hypotheses,
        resolution: float,
        discount: float,
        objective: str,
        max_depth: int,
        max_steps: int,
        tolerance: float | None,
    ):
        """Prepares the search; for the arguments see `solve`."""
        self.hypotheses = hypotheses
        self.discount, self.objective = discount, objective
        self._resolution, self._tolerance = resolution, tolerance
        self._max_depth, self._max_steps = max_depth, max_steps
        self._everything = tuple(range(len(hypotheses.prior)))

    @functools.cached_property
    def situations(self) -> situations_lib.Situations:
        """What actions lead to."""
        return situations_lib.Situations(self.hypotheses, self._resolution)

    @functools.cached_property
    def _search(self) -> branch_and_bound.Search:
        return branch_and_bound.Search(self._aim, self.situations)

    @property
    def _aim(self) -> branch_and_bound.Objective:
        is_return = self.objective == "return"
        return branch_and_bound.Objective(
            discount=self.discount if is_return else 1.0,
            cost=0.0 if is_return else 1.0,
            known=1.0 if is_return else 0.0,
            guesses=is_return,
        )

    @functools.cached_property
    def _found(self) -> tuple[float, float, branch_and_bound.Node]:
        """The value and the bound of the objective, and the first decision."""
        first = self.situations.start, self._everything, self.hypotheses.task.rules.step_limit
        low, high = self._search.run(*first, self._max_depth, self._max_steps)
        sign = 1.0 if self.objective == "return" else -1.0
        return sign * low, sign * high, self._search.policy(*first)

    @property
    def value(self) -> float:
        """Returns the expected discounted return, or the expected interactions until the right label is known."""
        return self._found[0]

    @property
    def bound(self) -> float:
        """Returns an upper bound on the value; equal to it where the search was complete."""
        return self._found[1]

    @property
    def policy(self) -> branch_and_bound.Node:
        """The first decision."""
        return self._found[2]

    def actor(self) -> core.Actor:
        """Returns an actor that recognises, from observations alone, the trajectories that it expects."""
        return _Player(self)

    def beliefs(self, episode: base.Episode) -> np.ndarray:
        """Returns what this observer could believe at the start and after each action, float64 [T + 1, L].

        Raises:
          ValueError: if the hidden property of the episode is none of the hypotheses.
        """
        groups = self.left(self._true(episode), episode.actions)
        return np.array([self.situations.chances(group) for group in groups])

    def left(self, hypothesis: int, actions: Sequence[int] | np.ndarray) -> list[situations_lib.Group]:
        """Returns the hypotheses that cannot be told from the true one at the start and after each action, T + 1."""
        groups, situation = [self._everything], self._watching.start
        for action in map(int, actions):
            following = groups[-1]
            if action < self.hypotheses.task.num_interactions:  # An answer tells nothing.
                parts, situation = self._watching.follow(situation, groups[-1], action)
                following = _part_with(hypothesis, parts)
            groups.append(following)
        return groups

    def judge(self, episode: base.Episode) -> base.Judgement:
        """Returns the best possible beliefs in an episode, and the worth of its actions.

        The worth of an interaction that was neither taken nor best is a lower bound. Situations that are alike within
        the tolerance have the same worth.

        Raises:
          ValueError: if the hidden property of the episode is none of the hypotheses, or the objective is not the
            return.
        """
        if self.objective != "return":
            raise ValueError(f"objective is {self.objective!r}; to judge actions, solve for the return")
        hypothesis, num_interactions = self._true(episode), self.hypotheses.task.num_interactions
        if self._judging.situations.count > _MOST_SITUATIONS:
            self._judging = self._new_judging()
        situation, group = self._judging.situations.start, self._everything
        beliefs, values, tells = [], [], []
        for step, action in enumerate(map(int, episode.actions)):
            left = self.hypotheses.task.rules.step_limit - step
            beliefs.append(self.situations.chances(group))
            acting = self._worth_of_interactions(situation, group, left, action)
            values.append(np.concatenate([acting, base.worth_of_answers(beliefs[-1])]))
            parts: situations_lib.Parts = [(1.0, group)]
            if action < num_interactions:
                parts, situation = self._judging.situations.follow(situation, group, action)
            tells.append(len(parts) > 1)
            group = _part_with(hypothesis, parts)
        beliefs.append(self.situations.chances(group))
        return base.Judgement(np.array(beliefs), np.array(values), np.array(tells))

    def _worth_of_interactions(self, situation, group, left: int, action: int) -> np.ndarray:
        """Returns the worth of all interactions, float64 [number of them]; exact for the best one and the one taken."""
        count, search = self.hypotheses.task.num_interactions, self._judging
        if left == 1:
            return np.full(count, float(rules.WRONG))
        if self.situations.is_known(group):
            return np.full(count, self.discount * rules.RIGHT)
        search.run(situation.like, group, left)
        if action < count:
            parts, following = search.situations.follow(situation, group, action)
            for _, part in parts:
                search.run(following.like, part, left - 1)
        places = [situation if other == action else situation.like for other in range(count)]
        return np.array([search.acting(place, group, left, other)[0] for other, place in enumerate(places)])

    @functools.cached_property
    def _judging(self) -> branch_and_bound.Search:
        return self._search if self._tolerance is None else self._new_judging()

    def _new_judging(self) -> branch_and_bound.Search:
        situations = situations_lib.Situations(self.hypotheses, self._resolution, tolerance=self._tolerance)
        return branch_and_bound.Search(self._aim, situations)

    @functools.cached_property
    def _watching(self) -> situations_lib.Situations:
        return situations_lib.Situations(self.hypotheses, self._resolution, wholly=True)

    def _true(self, episode: base.Episode) -> int:
        """Returns the hypothesis that is right in an episode."""
        known = self.hypotheses
        is_it = (known.hidden == episode.hidden).reshape(len(known.hidden), -1).all(axis=1)
        if not is_it.any():
            raise ValueError(f"hidden is {checks.shown(episode.hidden)}, which is none of the hypotheses")
        return int(is_it.argmax())

    def outcomes(self) -> np.ndarray:
        """Returns for each hypothesis the interactions before the answer and whether it is right, int64 [H, 2]."""
        found = []
        for hypothesis, answer in enumerate(self.hypotheses.answers):
            node, interactions = self.policy, 0
            while node.action is not None:
                node, interactions = node.children[hypothesis], interactions + 1
            found.append((interactions, node.label == answer))
        return np.array(found, np.int64)

    def figures(self) -> dict[str, Any]:
        """Returns what `base.figures` does, and `mean_seconds`.

        The value is None where the right label cannot be known for certain within the depth of the search.
        """
        interactions, right = self.outcomes().T
        found = base.figures(self, interactions, right, self.hypotheses.prior)
        return {**found, "mean_seconds": found["mean_interactions"] * self.hypotheses.task.control_timestep}

    def summary(self) -> dict[str, Any]:
        """Returns what `figures` does, and for the return what others earn, see `random_play.Bounds`."""
        if self.objective != "return":
            return self.figures()
        return {**self.figures(), **dataclasses.asdict(self._others)}

    @functools.cached_property
    def _others(self) -> random_play.Bounds:
        return random_play.bounds(self.situations, self.discount)


def solve(
    hypotheses: hypotheses_lib.Hypotheses,
    resolution: float,
    discount: float,
    objective: str = "return",
    *,
    max_depth: int = 8,
    max_steps: int = 2_000_000,
    tolerance: float | None = None,
) -> Solution:
    """Returns the best policy.

    Args:
      hypotheses: what may be hidden.
      resolution: by how much two observations must differ to be told apart: in the readings' unit for features, pixels
        for images. At 0 every bit counts, and the bound holds for every agent.
      discount: the agent's gamma, above 0 and at most 1.
      objective: `return`, the expected discounted return; or `time`, as few interactions as possible until the right
        label is known for certain.
      max_depth: longest sequences of actions looked at for the policy.
      max_steps: control steps that may be simulated for the policy.
      tolerance: to judge what others do, situations of physics are taken for one that differ by no more than this, in m
        and m/s, as `Situations` has it.

    Raises:
      ValueError: for a value that makes no sense.
    """
    return Solution(hypotheses, resolution, discount, objective, max_depth, max_steps, tolerance)


def curve(hypotheses: hypotheses_lib.Hypotheses, resolutions: Sequence[float], discount: float) -> list[dict[str, Any]]:
    """Returns figures for both objectives at several resolutions, with `resolution` and `objective` beside them."""
    return [
        {
            "resolution": resolution,
            "objective": objective,
            **solve(hypotheses, resolution, discount, objective).figures(),
        }
        for resolution in resolutions
        for objective in OBJECTIVES
    ]


def _part_with(hypothesis: int, parts: situations_lib.Parts) -> situations_lib.Group:
    """Returns the group, of those that one splits into, that has a hypothesis."""
    return next(part for _, part in parts if hypothesis in part)


class _Player(core.EpisodicActor):
    """Plays a solution."""

    def __init__(self, solution: Solution):
        """Prepares to play in the environments of the solution's task."""
        self._first, self._hypotheses = solution.policy, solution.hypotheses

    def _begin(self, timestep):
        self._node = self._first

    def _choose(self, observation) -> int:
        node = self._node
        return self._hypotheses.task.num_interactions + node.label if node.action is None else node.action

    def _note(self, action, next_timestep):
        node = self._node
        if node.seen is None or next_timestep.last():
            return
        self._node = node.children[node.group[self._hypotheses.nearest(next_timestep.observation, node.seen)]]
