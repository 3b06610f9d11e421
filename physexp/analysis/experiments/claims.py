"""Claims: sentences of the paper, each with a statistic of our data and a verdict."""

import dataclasses
import math

from physexp.analysis.data import estimates

HOLDS, FAILS, UNDECIDED = "holds", "fails", "undecided"


@dataclasses.dataclass(frozen=True, kw_only=True)
class Claim:
    """A claim, tested.

    Attributes:
      text: the claim, as the paper has it.
      section: of the paper; ours where there is none.
      condition: what it was tested on.
      statistic: what was measured, in words.
      estimate: what came out, with its 95 % interval.
      above, below: the claim holds if the statistic lies between these.
      reason: our explanation, if it fails.
    """

    text: str
    section: str
    condition: str
    statistic: str
    estimate: estimates.Estimate
    above: float = -math.inf
    below: float = math.inf
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
    def wanted(self) -> str:
        """Returns the claim's range in words."""
        if math.isinf(self.below):
            return f"> {self.above:g}"
        if math.isinf(self.above):
            return f"< {self.below:g}"
        return f"{self.above:g} to {self.below:g}"
