"""What can be known after a sequence of actions: which hypotheses about what is hidden cannot be told apart.

An observer of some resolution can tell two hypotheses apart once what they show has differed by more than that. What it
knows is a group of hypotheses that it cannot tell apart.
"""

from collections.abc import Iterable, Sequence
import dataclasses
import itertools

import numpy as np

from physexp.analysis.ideal import hypotheses as hypotheses_lib
from physexp.suite.engine import snapshots

Group = tuple[int, ...]  # Hypotheses that cannot be told apart, in increasing order.
Parts = list[tuple[float, Group]]  # What a group splits into: probabilities, given the group, and groups.


def split(groups: Sequence[Group], linked: np.ndarray, prior: Sequence[float]) -> dict[Group, Parts]:
    """Splits groups of hypotheses into those that can be told apart.

    Those that look alike are linked; a group is all that is linked, also through others.

    Args:
      groups: of n hypotheses together.
      linked: which of these, in increasing order, have looked alike so far, bool [n, n]; none of different groups.
      prior: the probabilities of all hypotheses.
    """
    first, before = np.arange(len(linked)), None
    while before is None or not np.array_equal(first, before):
        first, before = np.where(linked, first, len(linked)).min(axis=1), first
    home = {member: group for group in groups for member in group}
    together: dict[int, list[int]] = {}
    for member, number in zip(sorted(home), first.tolist(), strict=True):
        together.setdefault(number, []).append(member)
    totals = {group: sum(prior[member] for member in group) for group in groups}
    found: dict[Group, Parts] = {group: [] for group in groups}
    for members in together.values():
        group = home[members[0]]
        found[group].append((sum(prior[member] for member in members) / totals[group], tuple(members)))
    return found


def label_chances(group: Group, prior: np.ndarray, answers: np.ndarray, num_labels: int) -> np.ndarray:
    """Returns the probabilities of the labels, float64 [L], given that the hypothesis is in a group.

    Args:
      group: the hypotheses that are possible.
      prior, answers: probability and right label of each hypothesis, [H].
      num_labels: L.
    """
    members = list(group)
    weights = np.bincount(answers[members], prior[members], minlength=num_labels)
    return weights / weights.sum()


@dataclasses.dataclass(eq=False)
class Situation:
    """The states of all hypotheses after a sequence of actions, and the groups that can be told apart.

    Attributes:
      moment: the states of the simulations.
      groups: the groups that are followed.
      linked: which of their n members, in increasing order, have looked alike so far, bool [n, n].
      after: by action, what its groups split into, and the situation that follows; of actions looked at.
      like: the situation that stands for it in searches: itself, or one that is the same within the tolerance.
    """

    moment: snapshots.Snapshot
    groups: tuple[Group, ...]
    linked: np.ndarray
    after: "dict[int, tuple[dict[Group, Parts], Situation]]" = dataclasses.field(default_factory=dict)
    like: "Situation" = dataclasses.field(init=False)

    def __post_init__(self):
        self.like = self


class Situations:
    """The situations that sequences of actions lead to, simulated when they are first looked at, and kept.

    Attributes:
      hypotheses: what is simulated.
      resolution: of the observer.
      start: the situation before the first action.
      count: situations simulated so far.
    """

    def __init__(
        self,
        hypotheses: hypotheses_lib.Hypotheses,
        resolution: float,
        *,
        tolerance: float | None = None,
        wholly: bool = False,
    ):
        """Starts with nothing looked at.

        Args:
          hypotheses: what is simulated.
          resolution: of the observer, in the readings' unit for features, in pixels for images.
          tolerance: after an action that tells nothing, an earlier situation stands for the one that follows if
            positions and velocities differ by no more than this, in m and m/s; by default none does.
          wholly: whether groups are followed also where their label is known.
        """
        self.hypotheses, self.resolution, self.count = hypotheses, resolution, 0
        self._tolerance, self._wholly = tolerance, wholly
        self._prior = hypotheses.prior.tolist()
        size = len(hypotheses.prior)
        self.start = Situation(hypotheses.start, (tuple(range(size)),), np.ones((size, size), bool))
        self._chances: dict[Group, np.ndarray] = {}
        self._likeliest: dict[Group, float] = {}
        self._untold: dict[tuple[tuple[Group, ...], bytes], list[Situation]] = {}
        if tolerance is not None:
            self._alike(self.start)

    def chances(self, group: Group) -> np.ndarray:
        """Returns the probabilities of the labels, float64 [L], given a group."""
        if group not in self._chances:
            known = self.hypotheses
            self._chances[group] = label_chances(group, known.prior, known.answers, known.task.num_labels)
        return self._chances[group]

    def likeliest(self, group: Group) -> float:
        """Returns the probability of the likeliest label, given a group."""
        if group not in self._likeliest:
            self._likeliest[group] = float(self.chances(group).max())
        return self._likeliest[group]

    def is_known(self, group: Group) -> bool:
        """Returns whether all hypotheses of a group have the same label."""
        return self.likeliest(group) == 1

    def follow(self, situation: Situation, group: Group, action: int) -> tuple[Parts, Situation]:
        """Returns the parts into which an action splits a group, and the situation that follows."""
        if not self._wholly and self.is_known(group):
            return [(1.0, group)], situation
        self._look_at(situation, [action])
        parts, following = situation.after[action]
        return parts[group], following

    def is_expanded(self, situation: Situation) -> bool:
        """Returns whether every action has been looked at."""
        return len(situation.after) == self.hypotheses.task.num_interactions

    def expand(self, situation: Situation) -> None:
        """Looks at every action."""
        self._look_at(situation, range(self.hypotheses.task.num_interactions))

    def _look_at(self, situation: Situation, actions: Iterable[int]) -> None:
        new = [action for action in actions if action not in situation.after]
        if not new:
            return
        members = sorted(itertools.chain(*situation.groups))
        seen = self.hypotheses.step(situation.moment, members, new)
        for action, (apart, moment) in zip(new, seen, strict=True):
            situation.after[action] = self._following(situation, members, apart, moment)

    def _following(
        self, situation: Situation, members: list[int], apart: np.ndarray, moment: snapshots.Snapshot
    ) -> tuple[dict[Group, Parts], Situation]:
        """Returns the parts into which an action splits the groups of a situation, and the situation that follows.

        Args:
          situation: the situation before the action.
          members: the members of its groups.
          apart: distances of their observations after it, [n, n].
          moment: their states after it.
        """
        self.count += 1
        linked = situation.linked & (apart <= self.resolution)
        found = split(situation.groups, linked, self._prior)
        parts = [part for of_group in found.values() for _, part in of_group]
        groups = tuple(part for part in parts if self._wholly or not self.is_known(part))
        rows = np.searchsorted(members, sorted(itertools.chain(*groups)))
        following = Situation(moment, groups, linked[np.ix_(rows, rows)])
        if self._tolerance is not None and len(groups) == 1 and groups == situation.groups:  # It told nothing.
            following.like = self._alike(following)
        return found, following

    def _alike(self, situation: Situation) -> Situation:
        """Returns the first situation that was looked at and is the same within the tolerance, or this one."""
        alike = self._untold.setdefault((situation.groups, situation.linked.tobytes()), [])
        for other in alike:
            pairs = zip(other.moment.coordinates, situation.moment.coordinates, strict=True)
            if all(np.abs(one - another).max() <= self._tolerance for one, another in pairs):
                return other
        alike.append(situation)
        return situation
