"""How much planning a question needs: the returns of experimenters that plan less than the ideal one (docs/ideal.md).

The greedy ones take an interaction that tells most about the label, and stop at the best moment. Others look a few
interactions ahead, as if they had to answer then. Interactions that are equally good are drawn uniformly.
"""

from collections.abc import Callable, Iterable, Sequence
import functools
import math
import statistics
from typing import Any

import numpy as np

from physexp.analysis.ideal import base, finite

HORIZONS = (1, 2, 4)
"""The numbers of interactions that experimenters look ahead."""
_TIE = 1e-9  # Interactions that differ by less, in bits or in return, are equally good.


def returns(states: finite.States, discount: float, step_limit: int, negligible: float = 0.0) -> dict[str, float]:
    """Returns expected returns by name, as `base.Solution.planning` has them.

    An answer follows in states that are reached with a negligible probability, times the discount. Therefore the
    returns are too low by `planning_error` at most, and where that is not 0, `greedy_lucky` is a lower bound.
    """
    planner = _Planner(states, discount, step_limit, negligible)
    drawn = {"greedy": planner.earned(planner.informative)}
    for horizon in HORIZONS:
        drawn[f"lookahead_{horizon}"] = planner.earned(functools.partial(planner.promising, horizon))
    lucky, _ = planner.earned(planner.informative, max)
    return {
        "floor": base.floor(planner.answer(planner.start), discount, step_limit),
        **{name: earned for name, (earned, _) in drawn.items()},
        "greedy_lucky": lucky,
        "planning_error": max(error for _, error in drawn.values()),
    }


class _Planner:
    """Chooses interactions in information states, and follows them."""

    def __init__(self, states: finite.States, discount: float, step_limit: int, negligible: float):
        self._states, self._discount, self._step_limit, self._negligible = states, discount, step_limit, negligible
        self.start = states.represented(states.start)
        self.answer = functools.cache(lambda state: float(base.answer_values(states.posterior(state).max())))
        self._bits = functools.cache(lambda state: _entropy(states.posterior(state)))
        self._options, self._best = functools.cache(self._find_options), functools.cache(self._find_best)
        self._informative, self._promising = functools.cache(self._tell_most), functools.cache(self._earn_most)

    def informative(self, state: Any, left: int) -> Sequence[int]:
        """Returns the interactions with the largest mutual information with the label."""
        return self._informative(state)

    def promising(self, horizon: int, state: Any, left: int) -> Sequence[int]:
        """Returns the first interactions of the best plans of some interactions and an answer; none to answer now."""
        return self._promising(state, min(horizon, left - 1))

    def earned(
        self, choose: Callable[[Any, int], Sequence[int]], join: Callable[[Iterable[float]], float] = statistics.fmean
    ) -> tuple[float, float]:
        """Returns the return of a policy that stops at the best moment, and how much too low it is at most.

        Args:
          choose: returns equally good interactions in a state with some steps left, none to answer.
          join: combines their values: the mean if one of them is drawn.
        """
        levels, reached, error = [], {self.start: 1.0}, 0.0  # States by step, with probabilities times the discount.
        for left in range(self._step_limit, 0, -1):
            level, following = dict[Any, Sequence[int]](), dict[Any, float]()
            for state, weight in reached.items():
                hope = self._discount - self.answer(state)  # The label could be known after one more interaction.
                level[state] = ()
                if left > 1 and hope > 0 and weight < self._negligible:
                    error += weight * hope
                elif left > 1 and hope > 0:
                    level[state] = choose(state, left)
                for chosen in level[state]:
                    for chance, after in self._options(state)[chosen]:
                        share = weight * self._discount * chance / len(level[state])
                        following[after] = following.get(after, 0) + share
            levels.append(level)
            reached = following
        values: dict[Any, float] = {}
        for level in reversed(levels):
            values = {
                state: max(self.answer(state), join(self._worth(state, one, values.__getitem__) for one in chosen))
                if chosen
                else self.answer(state)
                for state, chosen in level.items()
            }
        return values[self.start], error

    def _find_options(self, state: Any) -> list[list[tuple[float, Any]]]:
        """Returns the states that may follow each interaction, and their probabilities."""
        found = (self._states.following(state, interaction) for interaction in range(self._states.num_interactions))
        return [[(chance, self._states.represented(after)) for chance, after in one] for one in found]

    def _worth(self, state: Any, interaction: int, value: Callable[[Any], float]) -> float:
        """Returns the expected return after an interaction, from the values of the states after it."""
        return self._discount * sum(chance * value(after) for chance, after in self._options(state)[interaction])

    def _worths(self, state: Any, horizon: int) -> list[float]:
        """Returns the return of the best plan of some interactions and an answer that begins with each interaction."""
        best = functools.partial(self._best, horizon=horizon - 1)
        return [self._worth(state, interaction, best) for interaction in range(self._states.num_interactions)]

    def _find_best(self, state: Any, horizon: int) -> float:
        """Returns the return of the best plan of at most some interactions and an answer."""
        answer = self.answer(state)
        return answer if not horizon or answer >= self._discount else max(answer, *self._worths(state, horizon))

    def _tell_most(self, state: Any) -> Sequence[int]:
        return _largest([-sum(chance * self._bits(after) for chance, after in one) for one in self._options(state)])

    def _earn_most(self, state: Any, horizon: int) -> Sequence[int]:
        worths = self._worths(state, horizon)
        return _largest(worths) if max(worths) > self.answer(state) + _TIE else ()


def _largest(values: Sequence[float]) -> Sequence[int]:
    """Returns the indices of the largest values."""
    least = max(values) - _TIE
    return [number for number, value in enumerate(values) if value >= least]


def _entropy(chances: np.ndarray) -> float:
    """Returns an entropy in bits."""
    return -sum(chance * math.log2(chance) for chance in chances.tolist() if chance > 0)
