"""Claims: sentences of the paper or of ours, each with a statistic of our data and a verdict."""

import collections
from collections.abc import Sequence
import dataclasses
import math

from physexp.analysis.data import estimates

HOLDS, FAILS, UNDECIDED = "holds", "fails", "undecided"
OURS = "ours"
_LEVEL = 0.05  # Of significance.


@dataclasses.dataclass(frozen=True, kw_only=True)
class Claim:
    """A claim, tested.

    Attributes:
      text: the claim, as the paper has it.
      section: of the paper; `OURS` where there is none.
      condition: what it was tested on.
      statistic: what was measured, in words.
      estimate: what came out, with its 95 % interval.
      above, below: the claim holds if the statistic lies between these.
      words: the paper's, which these make precise.
      is_sanity_check: whether it could fail only if something were broken; then it is not counted.
      reason: our explanation, if it fails.
    """

    text: str
    section: str = OURS
    condition: str
    statistic: str
    estimate: estimates.Estimate
    above: float = -math.inf
    below: float = math.inf
    words: str = ""
    is_sanity_check: bool = False
    reason: str = ""

    @property
    def verdict(self) -> str:
        """Whether the interval lies inside the claim's range, outside of it, or across its border."""
        low, high = self.estimate.low, self.estimate.high
        if self.above < low and high < self.below:
            return HOLDS
        if high <= self.above or self.below <= low:
            return FAILS
        return UNDECIDED

    @property
    def p_value(self) -> float:
        """The two-sided p-value of the verdict; where it is undecided, of the one that is nearer."""
        test = self.estimate.p_value
        inside, outside = [], []
        if math.isfinite(self.above):
            inside.append(test(self.above, "greater"))
            outside.append(test(self.above, "less"))
        if math.isfinite(self.below):
            inside.append(test(self.below, "less"))
            outside.append(test(self.below, "greater"))
        return min(1.0, 2 * min(max(inside), min(outside)))

    @property
    def wanted(self) -> str:
        """Returns the claim's range in words."""
        if math.isinf(self.below):
            return f"> {self.above:g}"
        if math.isinf(self.above):
            return f"< {self.below:g}"
        return f"{self.above:g} to {self.below:g}"


def corrected(found: Sequence[Claim]) -> list[str]:
    """Returns the verdicts of claims, corrected for the number of tests of the same sentence (Holm, 1979).

    From the smallest p-value on, each is compared with the level of significance over the number of tests that are
    left; from the first that is larger, all are undecided. What too few agents tell nothing about is no test.
    """
    verdicts = [claim.verdict for claim in found]
    families = collections.defaultdict(list)
    for index, claim in enumerate(found):
        if claim.estimate.can_be_tested:
            families[claim.text, claim.section].append((claim.p_value, index))
    for tests in families.values():
        rejects = True
        for rank, (p_value, index) in enumerate(sorted(tests)):
            rejects = rejects and p_value <= _LEVEL / (len(tests) - rank)
            if not rejects:
                verdicts[index] = UNDECIDED
    return verdicts
