"""The ideal experimenter among finitely many hypotheses, with deterministic and known physics (docs/ideal.md).

Only the hypothesis is hidden, so an experimenter learns which hypotheses' trajectories agree with its observations. The
best policy is found by search over sequences of interactions, with a lower and an upper bound on its value.
"""

from collections.abc import Sequence
import functools
from typing import Any

import numpy as np

from physexp import checks
from physexp.agents import core
from physexp.analysis.ideal import base, branch_and_bound, finite, planning, random_play
from physexp.analysis.ideal import histories as histories_lib
from physexp.analysis.ideal import hypotheses as hypotheses_lib
from physexp.suite.engine import rules

OBJECTIVES = ("return", "time")
_MAX_DEPTH = 8  # Of sequences of interactions that the search for the policy tries.
_MAX_STEPS = 2_000_000  # Control steps that it may simulate.
_NEGLIGIBLE = 1e-6  # Probability, times the discount, of states in which planning less is not followed further.
_MAX_HISTORIES = 30_000  # Kept for judging: about 600 MB for 40 hypotheses.


class Solution(base.Solution):
    """The best policy; the search runs when a result of it is first needed."""

    def __init__(
        self,
        hypotheses: hypotheses_lib.Hypotheses,
        resolution: float,
        discount: float,
        objective: str = "return",
        tolerance: float | None = None,
    ):
        """Prepares the search.

        Args:
          hypotheses, discount: the hypotheses about the hidden property, and the agent's gamma.
          resolution: the difference above which two observations are distinguished: in the readings' unit for features,
            in pixels for images. At 0 every bit counts, and the bound holds for every agent.
          objective: `return`, the expected discounted return; or `time`, the fewest interactions until the right label
            is known for certain.
          tolerance: when actions are judged, states that differ by no more than this, m and m/s, share one value; see
            `Histories`.
        """
        self.hypotheses, self.discount, self.objective = hypotheses, discount, objective
        self._new_histories = functools.partial(histories_lib.Histories, hypotheses, resolution)
        self._tolerance, self._step_limit = tolerance, hypotheses.task.rules.step_limit

    def _searching(self, **kwargs: Any) -> branch_and_bound.Search:
        if self.objective == "return":
            criterion = branch_and_bound.Criterion(self.discount, cost=0.0, known=1.0, guesses=True)
        else:
            criterion = branch_and_bound.Criterion(discount=1.0, cost=1.0, known=0.0, guesses=False)
        return branch_and_bound.Search(criterion, self._new_histories(**kwargs))

    @functools.cached_property
    def _search(self) -> branch_and_bound.Search:
        return self._searching()

    @functools.cached_property
    def _judging(self) -> branch_and_bound.Search:
        return self._search if self._tolerance is None else self._searching(tolerance=self._tolerance)

    @functools.cached_property
    def _complete_histories(self) -> histories_lib.Histories:
        return self._new_histories(splits_determined=True)

    @functools.cached_property
    def _found(self) -> tuple[float, float, branch_and_bound.Node]:
        """The value and the bound of the objective, and the policy."""
        root = self._search.histories.start, self._step_limit
        low, high = self._search.run(*root, _MAX_DEPTH, _MAX_STEPS)
        sign = 1.0 if self.objective == "return" else -1.0
        return sign * low, sign * high, self._search.policy(*root)

    @property
    def value(self) -> float:
        """The expected discounted return, or the expected number of interactions until the right label is known."""
        return self._found[0]

    @property
    def bound(self) -> float:
        """An upper bound on the value; equal to it if the search was complete."""
        return self._found[1]

    @property
    def policy(self) -> branch_and_bound.Node:
        """The policy: its first decision, with the further ones below it."""
        return self._found[2]

    def actor(self) -> core.Actor:
        first = self.policy

        def choose(node: branch_and_bound.Node, step: int) -> int:
            return self.hypotheses.task.num_interactions + node.label if node.action is None else node.action

        def follow(node: branch_and_bound.Node, action: int, observation) -> branch_and_bound.Node:
            return node.children[node.support[self.hypotheses.nearest(observation, node.expected)]]

        return base.Player(begin=lambda observation: first, choose=choose, follow=follow)

    def beliefs(self, hidden, actions):
        known = self._complete_histories
        return np.array([known.posterior(state) for state in finite.visited(known, self._hypothesis(hidden), actions)])

    def supports(self, hypothesis: int, actions: Sequence[int] | np.ndarray) -> list[histories_lib.Support]:
        """Returns the hypotheses consistent with the observations, before the first and after each of T actions."""
        return [support for _, support in finite.visited(self._complete_histories, hypothesis, actions)]

    def judge(self, hidden, actions):
        """Returns the beliefs in an episode, and the values of its actions; the objective must be `return`.

        The value of an interaction is exact if it was taken or is best, and a lower bound otherwise. States closer than
        the tolerance share one value.
        """
        if self.objective != "return":
            raise ValueError(f"objective is {self.objective!r}; to judge actions, solve for the return")
        if self._judging.histories.count > _MAX_HISTORIES:
            self._judging = self._searching(tolerance=self._tolerance)
        known = self._judging.histories
        return finite.judge(known, self._hypothesis(hidden), actions, self._interaction_values)

    def _interaction_values(self, state: histories_lib.State, step: int, taken: int) -> np.ndarray:
        """Returns the values of all interactions, float64 [A]; exact for the best one and the one taken."""
        search, left = self._judging, self._step_limit - step
        interactions = range(search.histories.num_interactions)
        if left == 1:
            return np.full(len(interactions), float(rules.WRONG))
        if search.histories.is_determined(state[1]):
            return np.full(len(interactions), self.discount * rules.RIGHT)
        usual = search.histories.represented(state)
        search.run(usual, left)
        if taken in interactions:
            for _, following in search.histories.following(state, taken):
                search.run(search.histories.represented(following), left - 1)
        states = [state if interaction == taken else usual for interaction in interactions]
        return np.array([search.bounds_of(one, left, interaction)[0] for interaction, one in enumerate(states)])

    def _hypothesis(self, hidden) -> int:
        """Returns the number of the hypothesis that is true."""
        is_true = (self.hypotheses.hidden == hidden).reshape(len(self.hypotheses.hidden), -1).all(axis=1)
        if not is_true.any():
            raise ValueError(f"hidden is {checks.shown(hidden)}, which is none of the hypotheses")
        return int(is_true.argmax())

    def outcomes(self):
        interactions, right = [], []
        for hypothesis, answer in enumerate(self.hypotheses.answers):
            node, count = self.policy, 0
            while node.action is not None:
                node, count = node.children[hypothesis], count + 1
            interactions.append(count)
            right.append(node.label == answer)
        return np.array(interactions), np.array(right), self.hypotheses.prior

    def figures(self) -> dict[str, Any]:
        """Returns the statistics of `base.Solution.figures`, and `mean_seconds`.

        The value is None if the search found no certain way to the right label.
        """
        found = super().figures()
        return {**found, "mean_seconds": found["mean_interactions"] * self.hypotheses.task.options.control_timestep}

    def compared(self):
        """Returns the returns of `random_play.bounds`, if the objective is the return."""
        return self._random_bounds if self.objective == "return" else {}

    def planning(self):
        if self.objective != "return":
            return {}
        # States that are equal to the last bit are one.
        known = self._new_histories(tolerance=self._tolerance or 0.0, tries_all=True)
        return planning.returns(known, self.discount, self._step_limit, _NEGLIGIBLE)

    @functools.cached_property
    def _random_bounds(self) -> dict[str, float]:
        return random_play.bounds(self._search.histories, self.discount)


def curve(hypotheses: hypotheses_lib.Hypotheses, resolutions: Sequence[float], discount: float) -> list[dict[str, Any]]:
    """Returns statistics for both objectives at several resolutions, with `resolution` and `objective`."""
    return [
        {
            "resolution": resolution,
            "objective": objective,
            **Solution(hypotheses, resolution, discount, objective).figures(),
        }
        for resolution in resolutions
        for objective in OBJECTIVES
    ]
