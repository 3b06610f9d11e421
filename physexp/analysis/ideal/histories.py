"""Sequences of interactions, and the hypotheses about the hidden property that they leave indistinguishable.

An observer with some resolution distinguishes two hypotheses once their observations have differed by more than that.
The support of its belief is a set of hypotheses that it cannot distinguish; each interaction partitions it.
"""

from collections.abc import Iterable, Sequence
import dataclasses
import itertools

import numpy as np

from physexp.analysis.ideal import hypotheses as hypotheses_lib
from physexp.suite.engine import snapshots

Support = tuple[int, ...]  # Indistinguishable hypotheses, in increasing order.
Partition = list[tuple[float, Support]]  # The parts of a support, and their probabilities given the support.


def split(
    supports: Sequence[Support], indistinguishable: np.ndarray, prior: Sequence[float]
) -> dict[Support, Partition]:
    """Returns the partition of each support.

    Two hypotheses stay in one part if a chain of indistinguishable hypotheses joins them.

    Args:
      supports: disjoint sets of hypotheses, n together.
      indistinguishable: which of these, in increasing order, have looked alike so far, bool [n, n]; False for
        hypotheses of different supports.
      prior: the probabilities of all hypotheses.
    """
    first, before = np.arange(len(indistinguishable)), None
    while before is None or not np.array_equal(first, before):
        first, before = np.where(indistinguishable, first, len(indistinguishable)).min(axis=1), first
    home = {member: support for support in supports for member in support}
    together: dict[int, list[int]] = {}
    for member, number in zip(sorted(home), first.tolist(), strict=True):
        together.setdefault(number, []).append(member)
    totals = {support: sum(prior[member] for member in support) for support in supports}
    found: dict[Support, Partition] = {support: [] for support in supports}
    for members in together.values():
        support = home[members[0]]
        found[support].append((sum(prior[member] for member in members) / totals[support], tuple(members)))
    return found


@dataclasses.dataclass(eq=False)
class History:
    """A sequence of interactions: the states of all hypotheses after it, and the supports that it may leave.

    Attributes:
      snapshot: the states of the simulations.
      supports: the supports that are followed further.
      indistinguishable: which of their n members, in increasing order, have looked alike so far, bool [n, n].
      successors: for each interaction that was tried, the partitions of the supports, and the longer history.
      representative: the history whose values are used for this one: itself, or an earlier one with the same state
        within the tolerance.
    """

    snapshot: snapshots.Snapshot
    supports: tuple[Support, ...]
    indistinguishable: np.ndarray
    successors: "dict[int, tuple[dict[Support, Partition], History]]" = dataclasses.field(default_factory=dict)
    representative: "History" = dataclasses.field(init=False)

    def __post_init__(self):
        self.representative = self


class Histories:
    """The tree of histories; each is simulated when it is first needed, and kept.

    Attributes:
      hypotheses: the hypotheses.
      start: the history without interactions.
      count: number of histories simulated so far.
    """

    def __init__(
        self,
        hypotheses: hypotheses_lib.Hypotheses,
        resolution: float,
        *,
        tolerance: float | None = None,
        splits_determined: bool = False,
    ):
        """Starts with the empty history.

        Args:
          hypotheses: see the class.
          resolution: of the observer, in the readings' unit for features, in pixels for images.
          tolerance: an interaction that revealed nothing leads to an earlier history instead of a new one if positions
            and velocities differ by no more than this, m and m/s; by default, never.
          splits_determined: whether to split supports further whose hypotheses all have one label.
        """
        self.hypotheses, self.count = hypotheses, 0
        self._resolution, self._tolerance, self._splits_determined = resolution, tolerance, splits_determined
        self._prior = hypotheses.prior.tolist()
        size = len(hypotheses.prior)
        self.start = History(hypotheses.start, (tuple(range(size)),), np.ones((size, size), bool))
        self._probabilities: dict[Support, np.ndarray] = {}
        self._maxima: dict[Support, float] = {}
        self._uninformative: dict[tuple[tuple[Support, ...], bytes], list[History]] = {}
        if tolerance is not None:
            self._representative(self.start)

    def probabilities(self, support: Support) -> np.ndarray:
        """Returns the probabilities of the labels given a support, float64 [L]."""
        if support not in self._probabilities:
            known, members = self.hypotheses, list(support)
            weights = np.bincount(known.answers[members], known.prior[members], minlength=known.task.num_labels)
            self._probabilities[support] = weights / weights.sum()
        return self._probabilities[support]

    def max_probability(self, support: Support) -> float:
        """Returns the probability of the likeliest label given a support."""
        if support not in self._maxima:
            self._maxima[support] = float(self.probabilities(support).max())
        return self._maxima[support]

    def is_determined(self, support: Support) -> bool:
        """Returns whether all hypotheses of a support have the same label."""
        return self.max_probability(support) == 1

    def successor(self, history: History, support: Support, action: int) -> tuple[Partition, History]:
        """Returns the partition of a support by an interaction, and the history that follows."""
        if not self._splits_determined and self.is_determined(support):
            return [(1.0, support)], history
        self._try(history, [action])
        partitions, following = history.successors[action]
        return partitions[support], following

    def is_expanded(self, history: History) -> bool:
        """Returns whether every interaction has been tried."""
        return len(history.successors) == self.hypotheses.task.num_interactions

    def expand(self, history: History) -> None:
        """Tries every interaction."""
        self._try(history, range(self.hypotheses.task.num_interactions))

    def _try(self, history: History, actions: Iterable[int]) -> None:
        new = [action for action in actions if action not in history.successors]
        if not new:
            return
        members = sorted(itertools.chain(*history.supports))
        outcomes = self.hypotheses.step(history.snapshot, members, new)
        for action, (distances, snapshot) in zip(new, outcomes, strict=True):
            history.successors[action] = self._following(history, members, distances, snapshot)

    def _following(
        self, history: History, members: list[int], distances: np.ndarray, snapshot: snapshots.Snapshot
    ) -> tuple[dict[Support, Partition], History]:
        """Returns the partitions of all supports by an interaction, and the history that follows.

        After it, the n members of the supports have these distances between their observations, [n, n], and states.
        """
        self.count += 1
        indistinguishable = history.indistinguishable & (distances <= self._resolution)
        partitions = split(history.supports, indistinguishable, self._prior)
        parts = [part for partition in partitions.values() for _, part in partition]
        supports = tuple(part for part in parts if self._splits_determined or not self.is_determined(part))
        rows = np.searchsorted(members, sorted(itertools.chain(*supports)))
        following = History(snapshot, supports, indistinguishable[np.ix_(rows, rows)])
        if self._tolerance is not None and len(supports) == 1 and supports == history.supports:  # Nothing revealed.
            following.representative = self._representative(following)
        return partitions, following

    def _representative(self, history: History) -> History:
        """Returns the first history with the same state within the tolerance: an earlier one, or this one."""
        same_belief = self._uninformative.setdefault((history.supports, history.indistinguishable.tobytes()), [])
        for other in same_belief:
            pairs = zip(other.snapshot.coordinates, history.snapshot.coordinates, strict=True)
            if all(np.abs(one - another).max() <= self._tolerance for one, another in pairs):
                return other
        same_belief.append(history)
        return history
