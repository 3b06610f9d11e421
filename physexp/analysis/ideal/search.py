"""The ideal experimenter among finitely many hypotheses, with deterministic and known physics (docs/ideal.md).

Only the hypothesis is hidden, so an experimenter learns which hypotheses' trajectories agree with its observations. The
best policy is found by search over sequences of interactions, with a lower and an upper bound on its value.
"""

from collections.abc import Sequence
import dataclasses
import functools
from typing import Any

import numpy as np

from physexp import checks
from physexp.agents import core
from physexp.analysis.ideal import base, branch_and_bound, random_play
from physexp.analysis.ideal import histories as histories_lib
from physexp.analysis.ideal import hypotheses as hypotheses_lib
from physexp.suite.engine import rules

OBJECTIVES = ("return", "time")
_MAX_STEPS = 2_000_000  # Control steps that the search for the policy may simulate.
_MAX_HISTORIES = 30_000  # Kept for judging: about 600 MB for 40 hypotheses.


class Solution(base.Solution):
    """The best policy; the search runs when a result of it is first needed.

    Attributes:
      hypotheses: the hypotheses about the hidden property.
      discount: the agent's gamma.
      objective: one of `OBJECTIVES`.
    """

    def __init__(
        self,
        hypotheses: hypotheses_lib.Hypotheses,
        resolution: float,
        discount: float,
        objective: str = "return",
        *,
        max_depth: int = 8,
        tolerance: float | None = None,
    ):
        """Prepares the search.

        Args:
          hypotheses: the hypotheses about the hidden property.
          resolution: the difference above which two observations are distinguished: in the readings' unit for features,
            in pixels for images. At 0 every bit counts, and the bound holds for every agent.
          discount: the agent's gamma.
          objective: `return`, the expected discounted return; or `time`, the fewest interactions until the right label
            is known for certain.
          max_depth: longest sequences of interactions that the search for the policy tries.
          tolerance: when actions are judged, states that differ by no more than this, m and m/s, share one value; see
            `Histories`.
        """
        self.hypotheses = hypotheses
        self.discount, self.objective = discount, objective
        self._resolution, self._tolerance = resolution, tolerance
        self._max_depth = max_depth
        self._everything = tuple(range(len(hypotheses.prior)))

    @functools.cached_property
    def histories(self) -> histories_lib.Histories:
        """The tree of sequences of interactions."""
        return histories_lib.Histories(self.hypotheses, self._resolution)

    @functools.cached_property
    def _search(self) -> branch_and_bound.Search:
        return branch_and_bound.Search(self._criterion, self.histories)

    @property
    def _criterion(self) -> branch_and_bound.Criterion:
        if self.objective == "return":
            return branch_and_bound.Criterion(self.discount, cost=0.0, known=1.0, guesses=True)
        return branch_and_bound.Criterion(discount=1.0, cost=1.0, known=0.0, guesses=False)

    @functools.cached_property
    def _found(self) -> tuple[float, float, branch_and_bound.Node]:
        """The value and the bound of the objective, and the policy."""
        root = self.histories.start, self._everything, self.hypotheses.task.rules.step_limit
        low, high = self._search.run(*root, self._max_depth, _MAX_STEPS)
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
        return _Player(self)

    def beliefs(self, episode: base.Episode) -> np.ndarray:
        supports = self.supports(self._true_hypothesis(episode), episode.actions)
        return np.array([self.histories.probabilities(support) for support in supports])

    def supports(self, hypothesis: int, actions: Sequence[int] | np.ndarray) -> list[histories_lib.Support]:
        """Returns the hypotheses consistent with the observations, before the first and after each of T actions."""
        supports, history = [self._everything], self._complete_histories.start
        for action in map(int, actions):
            following = supports[-1]
            if action < self.hypotheses.task.num_interactions:  # An answer reveals nothing.
                partition, history = self._complete_histories.successor(history, supports[-1], action)
                following = _part_with(hypothesis, partition)
            supports.append(following)
        return supports

    def judge(self, episode: base.Episode) -> base.Judgement:
        """Returns the beliefs in an episode, and the values of its actions; the objective must be `return`.

        The value of an interaction is exact if it was taken or is best, and a lower bound otherwise. States closer than
        the tolerance share one value.
        """
        if self.objective != "return":
            raise ValueError(f"objective is {self.objective!r}; to judge actions, solve for the return")
        hypothesis, num_interactions = self._true_hypothesis(episode), self.hypotheses.task.num_interactions
        if self._judging.histories.count > _MAX_HISTORIES:
            self._judging = self._new_judging()
        history, support = self._judging.histories.start, self._everything
        beliefs, values, is_informative = [], [], []
        for step, action in enumerate(map(int, episode.actions)):
            left = self.hypotheses.task.rules.step_limit - step
            beliefs.append(self.histories.probabilities(support))
            interactions = self._interaction_values(history, support, left, action)
            values.append(np.concatenate([interactions, base.answer_values(beliefs[-1])]))
            partition: histories_lib.Partition = [(1.0, support)]
            if action < num_interactions:
                partition, history = self._judging.histories.successor(history, support, action)
            is_informative.append(len(partition) > 1)
            support = _part_with(hypothesis, partition)
        beliefs.append(self.histories.probabilities(support))
        return base.Judgement(np.array(beliefs), np.array(values), np.array(is_informative))

    def _interaction_values(self, history, support, left: int, taken: int) -> np.ndarray:
        """Returns the values of all interactions, float64 [A]; exact for the best one and the one taken."""
        count, search = self.hypotheses.task.num_interactions, self._judging
        if left == 1:
            return np.full(count, float(rules.WRONG))
        if self.histories.is_determined(support):
            return np.full(count, self.discount * rules.RIGHT)
        search.run(history.representative, support, left)
        if taken < count:
            partition, following = search.histories.successor(history, support, taken)
            for _, part in partition:
                search.run(following.representative, part, left - 1)
        places = [history if action == taken else history.representative for action in range(count)]
        return np.array([search.bounds_of(place, support, left, action)[0] for action, place in enumerate(places)])

    @functools.cached_property
    def _judging(self) -> branch_and_bound.Search:
        return self._search if self._tolerance is None else self._new_judging()

    def _new_judging(self) -> branch_and_bound.Search:
        histories = histories_lib.Histories(self.hypotheses, self._resolution, tolerance=self._tolerance)
        return branch_and_bound.Search(self._criterion, histories)

    @functools.cached_property
    def _complete_histories(self) -> histories_lib.Histories:
        return histories_lib.Histories(self.hypotheses, self._resolution, splits_determined=True)

    def _true_hypothesis(self, episode: base.Episode) -> int:
        known = self.hypotheses
        is_true = (known.hidden == episode.hidden).reshape(len(known.hidden), -1).all(axis=1)
        if not is_true.any():
            raise ValueError(f"hidden is {checks.shown(episode.hidden)}, which is none of the hypotheses")
        return int(is_true.argmax())

    def outcomes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
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

    def summary(self) -> dict[str, Any]:
        """Returns the statistics of `figures`, and for the return those of `random_play.Bounds`."""
        if self.objective != "return":
            return self.figures()
        return {**self.figures(), **dataclasses.asdict(self._random_bounds)}

    @property
    def at_once(self) -> float:
        return self._random_bounds.at_once

    @property
    def random_value(self) -> float:
        """A lower bound on the return of random interactions with the best answers at the best moment."""
        return self._random_bounds.random_value

    @functools.cached_property
    def _random_bounds(self) -> random_play.Bounds:
        return random_play.bounds(self.histories, self.discount)


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


def _part_with(hypothesis: int, partition: histories_lib.Partition) -> histories_lib.Support:
    return next(part for _, part in partition if hypothesis in part)


class _Player(core.EpisodicActor):
    """Plays a solution."""

    def __init__(self, solution: Solution):
        self._first, self._hypotheses = solution.policy, solution.hypotheses

    def _begin(self, timestep):
        self._node = self._first

    def _choose(self, observation) -> int:
        node = self._node
        return self._hypotheses.task.num_interactions + node.label if node.action is None else node.action

    def _note(self, action, next_timestep):
        node = self._node
        if node.expected is None or next_timestep.last():
            return
        nearest = self._hypotheses.nearest(next_timestep.observation, node.expected)
        self._node = node.children[node.support[nearest]]
