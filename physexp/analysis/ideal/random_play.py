"""Bounds on the return of random interactions with the best answers at the best moment, among finitely many hypotheses.

Lower bound: a policy that answers once the likeliest label exceeds a threshold, tuned on separate sequences. Upper
bound: a policy that knows the interactions that will be drawn. Both are means over drawn sequences of interactions,
with a standard error below 0.01.
"""

from collections.abc import Iterator
import dataclasses
import functools

import numpy as np

from physexp.analysis.ideal import base
from physexp.analysis.ideal import histories as histories_lib

_NUM_SEQUENCES = 512
_NUM_TRIALS = 64  # Further sequences, to tune the threshold.


@dataclasses.dataclass(frozen=True)
class _Belief:
    """The support of a belief after some of a sequence of interactions."""

    probability: float  # Of the support.
    max_probability: float  # Of a label, given the support.
    parts: tuple["_Belief", ...]  # By the next interaction; empty at the last step, or when the label is determined.

    @property
    def answer(self) -> float:
        """The return of the best answer, times the probability."""
        return self.probability * base.answer_values(self.max_probability)

    def prophet_return(self, discount: float) -> float:
        """Returns the best return if the interactions to come are known, times the probability."""
        if not self.parts:
            return self.answer
        return max(self.answer, discount * sum(part.prophet_return(discount) for part in self.parts))

    def return_at(self, discount: float, confidence: float) -> float:
        """Returns the return of answering once the likeliest label reaches a confidence, times the probability."""
        if self.max_probability >= confidence or not self.parts:
            return self.answer
        return discount * sum(part.return_at(discount, confidence) for part in self.parts)

    def levels(self) -> Iterator[float]:
        """Yields the rounded probabilities of the likeliest label, now and later."""
        yield round(self.max_probability, 6)
        for part in self.parts:
            yield from part.levels()


def bounds(histories: histories_lib.Histories, discount: float) -> dict[str, float]:
    """Returns expected discounted returns, from the tree of sequences of interactions.

    Returns:
      `at_once`, of the likeliest label without any interaction; `random_value`, of random interactions until the
      likeliest label exceeds a threshold; and `random_bound`, an upper bound for random interactions with the best
      answers at the best moment.
    """
    length = histories.hypotheses.task.rules.step_limit - 1  # The last action before the time limit is the answer.
    size = _NUM_TRIALS + _NUM_SEQUENCES, length
    drawn = np.random.default_rng(0).integers(histories.num_interactions, size=size)
    roots = [_along(histories, histories.start, sequence) for sequence in drawn.tolist()]
    trials, roots = roots[:_NUM_TRIALS], roots[_NUM_TRIALS:]

    def mean_return(played: list[_Belief], level: float) -> float:
        return float(np.mean([root.return_at(discount, level - 1e-6) for root in played]))

    levels = sorted({level for root in trials for level in root.levels()})
    confidence = max(levels, key=functools.partial(mean_return, trials))
    return {
        "at_once": base.answer_values(roots[0].max_probability),
        "random_value": mean_return(roots, confidence),
        "random_bound": float(np.mean([root.prophet_return(discount) for root in roots])),
    }


def _along(histories: histories_lib.Histories, state: histories_lib.State, actions: list[int]) -> _Belief:
    """Returns a belief and its later parts along a sequence of actions, until the label is determined."""
    _, support = state
    parts: tuple[_Belief, ...] = ()
    if actions and not histories.is_determined(support):
        parts = tuple(_along(histories, after, actions[1:]) for _, after in histories.following(state, actions[0]))
    return _Belief(float(histories.hypotheses.prior[list(support)].sum()), histories.max_probability(support), parts)
