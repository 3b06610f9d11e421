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
class Bounds:
    """Expected discounted returns.

    Attributes:
      at_once: of the likeliest label, without any interaction.
      random_value: of random interactions until the likeliest label exceeds a threshold.
      random_bound: an upper bound for random interactions with the best answers at the best moment.
    """

    at_once: float
    random_value: float
    random_bound: float


@dataclasses.dataclass(frozen=True)
class _Belief:
    """The support of a belief after some of a sequence of interactions."""

    probability: float  # Of the support.
    max_probability: float  # Of a label, given the support.
    parts: tuple["_Belief", ...]  # By the next interaction; empty at the last step, or when the label is determined.

    def prophet_return(self, discount: float) -> float:
        """Returns the best return if the interactions to come are known, times the probability."""
        answer = self.probability * base.answer_values(self.max_probability)
        if not self.parts:
            return answer
        return max(answer, discount * sum(part.prophet_return(discount) for part in self.parts))

    def return_at(self, discount: float, confidence: float) -> float:
        """Returns the return of answering once the likeliest label reaches a confidence, times the probability."""
        if self.max_probability >= confidence or not self.parts:
            return self.probability * base.answer_values(self.max_probability)
        return discount * sum(part.return_at(discount, confidence) for part in self.parts)

    def all(self) -> Iterator["_Belief"]:
        """Yields this belief and all later ones."""
        yield self
        for part in self.parts:
            yield from part.all()


def bounds(histories: histories_lib.Histories, discount: float) -> Bounds:
    """Returns the bounds for an agent's gamma, from the tree of sequences of interactions."""
    task = histories.hypotheses.task
    length = task.rules.step_limit - 1  # The last action before the time limit is the answer.
    drawn = np.random.default_rng(0).integers(task.num_interactions, size=(_NUM_TRIALS + _NUM_SEQUENCES, length))
    everything = tuple(range(len(histories.hypotheses.prior)))
    roots = [_along(histories, histories.start, everything, sequence.tolist()) for sequence in drawn]
    trials, roots = roots[:_NUM_TRIALS], roots[_NUM_TRIALS:]

    def mean_return(played: list[_Belief], level: float) -> float:
        return float(np.mean([root.return_at(discount, level - 1e-6) for root in played]))

    levels = sorted({round(belief.max_probability, 6) for root in trials for belief in root.all()})
    confidence = max(levels, key=functools.partial(mean_return, trials))
    return Bounds(
        at_once=base.answer_values(roots[0].max_probability),
        random_value=mean_return(roots, confidence),
        random_bound=float(np.mean([root.prophet_return(discount) for root in roots])),
    )


def _along(
    histories: histories_lib.Histories,
    history: histories_lib.History,
    support: histories_lib.Support,
    actions: list[int],
) -> _Belief:
    """Returns a belief and its later parts along a sequence of actions, until the label is determined."""
    parts: tuple[_Belief, ...] = ()
    if actions and not histories.is_determined(support):
        partition, following = histories.successor(history, support, actions[0])
        parts = tuple(_along(histories, following, part, actions[1:]) for _, part in partition)
    return _Belief(
        probability=float(histories.hypotheses.prior[list(support)].sum()),
        max_probability=histories.max_probability(support),
        parts=parts,
    )
