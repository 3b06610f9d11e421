"""What random interactions earn among finitely many hypotheses, with good answers at a good moment.

Somebody who draws interactions does not know which come next. From below: who answers as soon as the likeliest label
has some probability, the best one for all episodes. From above: who is told the interactions that will be drawn.
"""

from collections.abc import Iterator
import dataclasses

import numpy as np

from physexp.analysis.ideal import branch_and_bound
from physexp.analysis.ideal import trajectories as trajectories_lib

_NUM_SEQUENCES = 64


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
        answer = self.chance * (2 * self.likeliest - 1)
        if not self.parts:
            return answer
        return max(answer, discount * sum(part.prophet(discount) for part in self.parts))

    def cautious(self, discount: float, enough: float) -> float:
        """Returns what is earned, times the chance, by one who answers when the likeliest label is likely enough."""
        if self.likeliest >= enough or not self.parts:
            return self.chance * (2 * self.likeliest - 1)
        return discount * sum(part.cautious(discount, enough) for part in self.parts)

    def all(self) -> Iterator["_Group"]:
        """Returns this group and all that may be left of it."""
        yield self
        for part in self.parts:
            yield from part.all()


def bounds(trajectories: trajectories_lib.Trajectories, resolution: float, discount: float) -> Bounds:
    """Returns what is earned without thought; figures of random interactions are means of 64 drawn sequences.

    Args:
      trajectories: of the hypotheses.
      resolution: of the observer, as for `search.solve`.
      discount: the agent's gamma.
    """
    task = trajectories.task
    length = task.rules.step_limit - 1  # The last action in time is the answer.
    drawn = np.random.default_rng(0).integers(task.num_interactions, size=(_NUM_SEQUENCES, length))
    roots = [_grown(trajectories, resolution, tuple(sequence.tolist())) for sequence in drawn]
    levels = sorted({round(group.likeliest, 6) for root in roots for group in root.all()})
    returns = [np.mean([root.cautious(discount, level - 1e-6) for root in roots]) for level in levels]
    return Bounds(
        at_once=2 * roots[0].likeliest - 1,
        random_value=float(max(returns)),
        random_bound=float(np.mean([root.prophet(discount) for root in roots])),
    )


def _grown(trajectories: trajectories_lib.Trajectories, resolution: float, sequence: tuple[int, ...]) -> _Group:
    """Returns the group of all hypotheses, and all that is left of it along a sequence, until every label is known."""
    prior, answers = trajectories.prior, trajectories.answers

    def is_known(members: branch_and_bound.Group) -> bool:
        return len(set(answers[list(members)])) == 1

    def group_of(members: branch_and_bound.Group, step: int) -> _Group:
        labels = branch_and_bound.label_chances(members, prior, answers, trajectories.task.num_labels)
        return _Group(
            chance=float(prior[list(members)].sum()),
            likeliest=float(labels.max()),
            parts=tuple(group_of(part, step + 1) for part in parts.get((step, members), ())),
        )

    everything = tuple(range(len(prior)))
    parts: dict[tuple[int, branch_and_bound.Group], list[branch_and_bound.Group]] = {}
    unknown = [everything]
    for step, apart in enumerate(trajectories.follow(sequence)):
        for members in unknown:
            parts[step, members] = [part for _, part in branch_and_bound.split(members, apart, resolution, prior)]
        unknown = [part for members in unknown for part in parts[step, members] if not is_known(part)]
        if not unknown:
            break
    return group_of(everything, 0)
