"""What random interactions earn among finitely many hypotheses, with good answers at a good moment.

Somebody who draws interactions does not know which come next. From below: who answers as soon as the likeliest label
has some probability, one for all episodes that was best in others. From above: who is told the interactions that will
be drawn. Both are means over drawn sequences of interactions, which leave a standard error of less than 0.01.
"""

from collections.abc import Iterator
import dataclasses
import functools

import numpy as np

from physexp.analysis.ideal import base
from physexp.analysis.ideal import situations as situations_lib

_NUM_SEQUENCES = 512
_NUM_TRIALS = 64  # Further ones, which choose when to answer.


@dataclasses.dataclass(frozen=True)
class Bounds:
    """Expected discounted returns.

    Attributes:
      at_once: of the likeliest label, given without any interaction.
      random_value: of random interactions, with an answer as soon as the likeliest label is likely enough.
      random_bound: of random interactions, with the best answers at the best moment; an upper bound.
    """

    at_once: float
    random_value: float
    random_bound: float


@dataclasses.dataclass(frozen=True)
class _Group:
    """Hypotheses that cannot be told apart after so many interactions.

    Attributes:
      chance: that it is one of them.
      likeliest: the probability of the likeliest label, given that.
      parts: what is left of it after one interaction more; none at the last step, or where the label is known.
    """

    chance: float
    likeliest: float
    parts: tuple["_Group", ...]

    def prophet(self, discount: float) -> float:
        """Returns what is earned at best, times the chance, by one who knows the interactions to come."""
        answer = self.chance * base.worth_of_answers(self.likeliest)
        if not self.parts:
            return answer
        return max(answer, discount * sum(part.prophet(discount) for part in self.parts))

    def cautious(self, discount: float, enough: float) -> float:
        """Returns what is earned, times the chance, by one who answers when the likeliest label is likely enough."""
        if self.likeliest >= enough or not self.parts:
            return self.chance * base.worth_of_answers(self.likeliest)
        return discount * sum(part.cautious(discount, enough) for part in self.parts)

    def all(self) -> Iterator["_Group"]:
        """Returns this group and all that may be left of it."""
        yield self
        for part in self.parts:
            yield from part.all()


def bounds(situations: situations_lib.Situations, discount: float) -> Bounds:
    """Returns what is earned without thought.

    Args:
      situations: what actions lead to.
      discount: the agent's gamma.
    """
    task = situations.hypotheses.task
    length = task.rules.step_limit - 1  # The last action in time is the answer.
    drawn = np.random.default_rng(0).integers(task.num_interactions, size=(_NUM_TRIALS + _NUM_SEQUENCES, length))
    everything = tuple(range(len(situations.hypotheses.prior)))
    roots = [_grown(situations, situations.start, everything, sequence.tolist()) for sequence in drawn]
    trials, roots = roots[:_NUM_TRIALS], roots[_NUM_TRIALS:]

    def cautious(played: list[_Group], level: float) -> float:
        return float(np.mean([root.cautious(discount, level - 1e-6) for root in played]))

    levels = sorted({round(group.likeliest, 6) for root in trials for group in root.all()})
    enough = max(levels, key=functools.partial(cautious, trials))
    return Bounds(
        at_once=base.worth_of_answers(roots[0].likeliest),
        random_value=cautious(roots, enough),
        random_bound=float(np.mean([root.prophet(discount) for root in roots])),
    )


def _grown(
    situations: situations_lib.Situations,
    situation: situations_lib.Situation,
    members: situations_lib.Group,
    actions: list[int],
) -> _Group:
    """Returns a group, and all that is left of it along a sequence of actions, until every label is known."""
    parts: tuple[_Group, ...] = ()
    if actions and not situations.is_known(members):
        left, following = situations.follow(situation, members, actions[0])
        parts = tuple(_grown(situations, following, part, actions[1:]) for _, part in left)
    return _Group(
        chance=float(situations.hypotheses.prior[list(members)].sum()),
        likeliest=situations.likeliest(members),
        parts=parts,
    )
