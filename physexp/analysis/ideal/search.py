"""The ideal experimenter among finitely many hypotheses, when physics is deterministic and known (docs/ideal.md).

Nothing but the hypothesis is hidden, so an experimenter learns which of their trajectories it is on. The best policy is
found by search over sequences of actions, with a lower and an upper bound: where they meet, nobody can do better.
"""

from collections.abc import Sequence
import dataclasses
import functools
import math
from typing import Any

import numpy as np

from physexp.agents import core
from physexp.analysis.ideal import base, branch_and_bound, random_play
from physexp.analysis.ideal import trajectories as trajectories_lib
from physexp.suite.engine import checks

OBJECTIVES = ("return", "time")


class Solution:
    """The best policy found. It is searched for when something is first asked that only a search can tell.

    Attributes:
      trajectories: of the hypotheses.
      resolution: of the observer.
      discount: the agent's gamma.
      objective: one of `OBJECTIVES`.
    """

    def __init__(
        self,
        trajectories: trajectories_lib.Trajectories,
        resolution: float,
        discount: float,
        objective: str,
        max_depth: int,
        max_steps: int,
    ):
        """Prepares the search; for the arguments see `solve`."""
        self.trajectories = trajectories
        self.resolution, self.discount, self.objective = resolution, discount, objective
        self._max_depth, self._max_steps = max_depth, max_steps

    @functools.cached_property
    def _found(self) -> tuple[float, float, branch_and_bound.Node]:
        """The value and the bound of the objective, and the first decision."""
        is_return = self.objective == "return"
        aim = branch_and_bound.Objective(
            discount=self.discount if is_return else 1.0,
            cost=0.0 if is_return else 1.0,
            known=1.0 if is_return else 0.0,
            guesses=is_return,
        )
        search = branch_and_bound.Search(aim, self.resolution, self.trajectories, self._max_depth)
        low, high = search.run(self.trajectories.steps + self._max_steps)
        sign = 1.0 if is_return else -1.0
        return sign * low, sign * high, search.policy()

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
        known = self.trajectories
        is_it = (known.hidden == episode.hidden).reshape(len(known.hidden), -1).all(axis=1)
        if not is_it.any():
            raise ValueError(f"hidden is {checks.shown(episode.hidden)}, which is none of the hypotheses")
        return np.array(
            [
                branch_and_bound.label_chances(group, known.prior, known.answers, known.task.num_labels)
                for group in self.left(int(is_it.argmax()), episode.actions)
            ]
        )

    def left(self, hypothesis: int, actions: Sequence[int] | np.ndarray) -> list[branch_and_bound.Group]:
        """Returns the hypotheses that cannot be told from the true one at the start and after each action, T + 1."""
        known = self.trajectories
        taken = tuple(int(action) for action in actions if action < known.task.num_interactions)
        groups = [tuple(range(len(known.hidden)))]
        for apart in known.follow(taken):
            parts = branch_and_bound.split(groups[-1], apart, self.resolution, known.prior)
            groups += [part for _, part in parts if hypothesis in part]
        return groups + [groups[-1]] * (len(actions) - len(taken))  # An answer tells nothing.

    def outcomes(self) -> np.ndarray:
        """Returns for each hypothesis the interactions before the answer and whether it is right, int64 [H, 2]."""
        found = []
        for hypothesis, answer in enumerate(self.trajectories.answers):
            node, interactions = self.policy, 0
            while node.action is not None:
                node, interactions = node.children[hypothesis], interactions + 1
            found.append((interactions, node.label == answer))
        return np.array(found, np.int64)

    def summary(self) -> dict[str, Any]:
        """Returns what `figures` does, and for the return what others earn, see `random_play.Bounds`."""
        if self.objective != "return":
            return self.figures()
        others = random_play.bounds(self.trajectories, self.resolution, self.discount)
        return {**self.figures(), **dataclasses.asdict(others)}

    def figures(self) -> dict[str, Any]:
        """Returns `value`, `bound`, `accuracy`, `mean_interactions`, `mean_seconds` and `histogram`.

        The value is None where the right label cannot be known for certain within the depth of the search.
        """
        interactions, right = self.outcomes().T
        prior = self.trajectories.prior
        mean = float(prior @ interactions)
        shares = np.bincount(interactions, prior)
        value, bound = (figure if math.isfinite(figure) else None for figure in (self.value, self.bound))
        return {
            "value": value,
            "bound": bound,
            "accuracy": float(prior @ right),
            "mean_interactions": mean,
            "mean_seconds": mean * self.trajectories.task.control_timestep,
            "histogram": {number: float(share) for number, share in enumerate(shares)},
        }


def solve(
    trajectories: trajectories_lib.Trajectories,
    resolution: float,
    discount: float,
    objective: str = "return",
    *,
    max_depth: int = 8,
    max_steps: int = 2_000_000,
) -> Solution:
    """Returns the best policy.

    Args:
      trajectories: of the hypotheses; what they have simulated already is used.
      resolution: by how much two observations must differ to be told apart: in the readings' unit for features, pixels
        for images. At 0 every bit counts, and the bound holds for every agent.
      discount: the agent's gamma, in (0, 1].
      objective: `return`, the expected discounted return; or `time`, as few interactions as possible until the right
        label is known for certain.
      max_depth: longest sequences of actions looked at.
      max_steps: control steps that may be simulated.

    Raises:
      ValueError: for a value that makes no sense.
    """
    if not (isinstance(resolution, (int, float)) and 0 <= resolution < math.inf):
        raise ValueError(f"resolution is {resolution!r}; give a finite number >= 0 (m, or pixels)")
    base.check_discount(discount)
    for name, limit in (("max_depth", max_depth), ("max_steps", max_steps)):
        if not isinstance(limit, int) or limit < 1:
            raise ValueError(f"{name} is {limit!r}; give an integer >= 1")
    if objective not in OBJECTIVES:
        raise ValueError(f"objective is {objective!r}; choose from {', '.join(OBJECTIVES)}")
    return Solution(trajectories, resolution, discount, objective, max_depth, max_steps)


def curve(
    trajectories: trajectories_lib.Trajectories, resolutions: Sequence[float], discount: float
) -> list[dict[str, Any]]:
    """Returns figures for both objectives at several resolutions, with `resolution` and `objective` beside them."""
    return [
        {
            "resolution": resolution,
            "objective": objective,
            **solve(trajectories, resolution, discount, objective).figures(),
        }
        for resolution in resolutions
        for objective in OBJECTIVES
    ]


class _Player(core.Actor):
    """Plays a solution."""

    def __init__(self, solution: Solution):
        """Prepares to play in the environments of the solution's task."""
        self._first, self._trajectories = solution.policy, solution.trajectories

    def observe_first(self, timestep):
        self._node = self._first

    def select_action(self, observation) -> int:
        node = self._node
        return self._trajectories.task.num_interactions + node.label if node.action is None else node.action

    def observe(self, action, next_timestep):
        node = self._node
        if node.seen is None or next_timestep.last():
            return
        members = list(node.group)
        both = {
            name: np.concatenate([next_timestep.observation[name][None], value[members]])
            for name, value in node.seen.items()
        }
        self._node = node.children[members[int(self._trajectories.distances(both)[0, 1:].argmin())]]

    def update(self):
        """Does nothing: it knows all that can be known."""
