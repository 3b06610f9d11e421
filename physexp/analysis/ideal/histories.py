"""Sequences of interactions, and the hypotheses about the hidden property that they leave indistinguishable.

An observer with some resolution distinguishes two hypotheses once their observations have differed by more than that.
The support of its belief is a set of hypotheses that it cannot distinguish; each interaction partitions it.
"""

from collections.abc import Iterable, Sequence
import dataclasses
import functools
import itertools

import numpy as np

from physexp.analysis.ideal import hypotheses as hypotheses_lib
from physexp.suite.engine import snapshots

Support = tuple[int, ...]  # Indistinguishable hypotheses, in increasing order.
Partition = list[tuple[float, Support]]  # The parts of a support, and their probabilities given the support.


def split(
    supports: Sequence[Support], indistinguishable: np.ndarray, prior: Sequence[float]
) -> dict[Support, Partition]:
    """Returns the partition of each of some disjoint supports, which have n members together.

    Two hypotheses stay in one part if a chain of indistinguishable hypotheses joins them.

    Args:
      supports, prior: the supports, and the probabilities of all hypotheses.
      indistinguishable: which members, in increasing order, have looked alike so far, bool [n, n]; False for members
        of different supports.
    """
    first, before = np.arange(len(indistinguishable)), None
    while before is None or not np.array_equal(first, before):
        first, before = np.where(indistinguishable, first, len(indistinguishable)).min(axis=1), first
    numbers = dict(zip(sorted(itertools.chain(*supports)), first.tolist(), strict=True))
    found: dict[Support, Partition] = {}
    for support in supports:
        groups: dict[int, list[int]] = {}
        for member in support:
            groups.setdefault(numbers[member], []).append(member)
        total = sum(prior[member] for member in support)
        found[support] = [(sum(prior[one] for one in group) / total, tuple(group)) for group in groups.values()]
    return found


@dataclasses.dataclass(eq=False)
class History:
    """A sequence of interactions: the states of all hypotheses after it, and the supports that it may leave."""

    snapshot: snapshots.Snapshot  # The states of the simulations.
    supports: tuple[Support, ...]  # Those that are followed further; they have n members together.
    indistinguishable: np.ndarray  # Which members, in increasing order, have looked alike so far, bool [n, n].
    # For each interaction that was tried and each support, the states that may follow, and their probabilities.
    successors: "dict[int, dict[Support, list[tuple[float, State]]]]" = dataclasses.field(default_factory=dict)
    # The history whose values are used: this one, or an earlier one with the same state within the tolerance.
    representative: "History" = dataclasses.field(init=False)

    def __post_init__(self):
        self.representative = self


State = tuple[History, Support]
"""An information state: what was done, and the hypotheses that are left."""


class Histories:
    """The tree of histories; each is simulated when it is first needed, and kept.

    Attributes:
      hypotheses: the hypotheses.
      num_interactions: number of interactions, A.
      start: the information state without interactions.
      count: number of histories simulated so far.
      max_probability: returns the probability of the likeliest label given a support.
    """

    def __init__(
        self,
        hypotheses: hypotheses_lib.Hypotheses,
        resolution: float,
        *,
        tolerance: float | None = None,
        splits_determined: bool = False,
        tries_all: bool = False,
    ):
        """Starts with the empty history.

        Args:
          hypotheses: see the class.
          resolution: of the observer, in the readings' unit for features, in pixels for images.
          tolerance: an interaction that revealed nothing leads to an earlier history instead of a new one if positions
            and velocities differ by no more than this, m and m/s; by default, never.
          splits_determined: whether to split supports further whose hypotheses all have one label.
          tries_all: whether `following` tries all interactions at once, which is faster if all are needed.
        """
        self.hypotheses, self.num_interactions, self.count = hypotheses, hypotheses.task.num_interactions, 0
        self._resolution, self._tolerance, self._splits_determined = resolution, tolerance, splits_determined
        self._tries_all = tries_all
        self._prior, size = hypotheses.prior.tolist(), len(hypotheses.prior)
        self._probabilities = functools.cache(self._find_probabilities)
        self.max_probability = functools.cache(lambda support: float(self._probabilities(support).max()))
        self._uninformative: dict[tuple[tuple[Support, ...], bytes], list[History]] = {}
        everything = tuple(range(size))
        first = History(hypotheses.start, (everything,), np.ones((size, size), bool))
        self.start: State = first, everything
        if tolerance is not None:
            self._representative(first)

    def _find_probabilities(self, support: Support) -> np.ndarray:
        known, members = self.hypotheses, list(support)
        weights = np.bincount(known.answers[members], known.prior[members], minlength=known.task.num_labels)
        return weights / weights.sum()

    def is_determined(self, support: Support) -> bool:
        """Returns whether all hypotheses of a support have the same label."""
        return self.max_probability(support) == 1

    def posterior(self, state: State) -> np.ndarray:
        """Returns the probabilities of the labels in a state, float64 [L]."""
        return self._probabilities(state[1])

    def represented(self, state: State) -> State:
        """Returns the state whose values are used for a state."""
        return state[0].representative, state[1]

    def allows(self, state: State, hypothesis: int) -> bool:
        """Returns whether a hypothesis is left."""
        return hypothesis in state[1]

    def following(self, state: State, interaction: int) -> list[tuple[float, State]]:
        """Returns the states that may follow an interaction, and their probabilities."""
        history, support = state
        if not self._splits_determined and self.is_determined(support):
            return [(1.0, state)]
        self._try(history, range(self.num_interactions) if self._tries_all else [interaction])
        return history.successors[interaction][support]

    def is_expanded(self, history: History) -> bool:
        """Returns whether every interaction has been tried."""
        return len(history.successors) == self.num_interactions

    def expand(self, history: History) -> None:
        """Tries every interaction."""
        self._try(history, range(self.num_interactions))

    def _try(self, history: History, actions: Iterable[int]) -> None:
        if new := [action for action in actions if action not in history.successors]:
            members = sorted(itertools.chain(*history.supports))
            outcomes = self.hypotheses.step(history.snapshot, members, new)
            for action, (distances, snapshot) in zip(new, outcomes, strict=True):
                history.successors[action] = self._following(history, members, distances, snapshot)

    def _following(
        self, history: History, members: list[int], distances: np.ndarray, snapshot: snapshots.Snapshot
    ) -> "dict[Support, list[tuple[float, State]]]":
        """Returns the states that may follow an interaction, and their probabilities, for each support.

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
        return {
            support: [(probability, (following, part)) for probability, part in partition]
            for support, partition in partitions.items()
        }

    def _representative(self, history: History) -> History:
        """Returns the first history with the same state within the tolerance: an earlier one, or this one."""
        same_belief = self._uninformative.setdefault((history.supports, history.indistinguishable.tobytes()), [])
        for other in same_belief:
            pairs = zip(other.snapshot.coordinates, history.snapshot.coordinates, strict=True)
            if all(np.abs(one - another).max() <= self._tolerance for one, another in pairs):
                return other
        same_belief.append(history)
        return history
