"""Claims: sentences of the paper or of ours, each with a statistic, a wanted range and a verdict.

The claims of the package's experiments, with the words of their figures, are in `claims.toml`.
"""

import collections
from collections.abc import Callable, Mapping, Sequence
import dataclasses
import functools
import importlib.resources
import math
import tomllib
from typing import Any

from physexp.analysis.data import estimates

HOLDS, FAILS, UNDECIDED = "holds", "fails", "undecided"
OURS = "ours"
_LEVEL = 0.05  # Of significance.

Statistic = Callable[[Any, str], estimates.Estimate]
"""Returns the estimate from an experiment's data, a DataFrame, under a condition; raises `NoRows` without data."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Claim:
    """A claim.

    Attributes:
      id: its name in the experiment, also the name of its statistic.
      text: the claim in a sentence.
      section: of the paper; `OURS` if there is none.
      on: the conditions it is tested on; a comma begins a remark, as in `3-F, each agent`.
      statistic: the measured quantity, in words.
      above, below: the claim holds if the statistic lies between these; numbers, or a number for each condition.
      quote: the paper's words, which the range makes precise.
      is_check: whether it could fail only if something were broken; then it is not counted.
      is_found: whether the statistic was found in the data that it is tested on.
      reason: our explanation, if it fails.
      plainly: by verdict, a sentence of the report's first paragraph; a condition in braces is its estimate.
    """

    id: str
    text: str
    section: str = OURS
    on: Sequence[str]
    statistic: str
    above: float | Mapping[str, float] = -math.inf
    below: float | Mapping[str, float] = math.inf
    quote: str = ""
    is_check: bool = False
    is_found: bool = False
    reason: str = ""
    plainly: Mapping[str, str] = dataclasses.field(default_factory=dict)

    def tested(self, condition: str, estimate: estimates.Estimate) -> "Tested":
        """Returns the claim with the estimate of its statistic under a condition."""
        name, ends = named(condition), {"above": self.above, "below": self.below}
        limits = {side: end[name] if isinstance(end, Mapping) else end for side, end in ends.items()}
        return Tested(**(vars(self) | limits), condition=condition, estimate=estimate)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Tested(Claim):
    """A claim tested on one condition, with the range of this condition.

    Attributes:
      condition: one of `on`.
      estimate: the statistic, with its 95 % interval.
    """

    condition: str
    estimate: estimates.Estimate
    above: float
    below: float

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
        """The two-sided p-value of the verdict; if undecided, that of the nearer verdict."""
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
        """The claim's range in words."""
        return wanted(self.above, self.below)


def wanted(above: float, below: float) -> str:
    """Returns a range in words."""
    if math.isinf(below):
        return f"> {above:g}"
    return f"< {below:g}" if math.isinf(above) else f"{above:g} to {below:g}"


def named(condition: str) -> str:
    """Returns the name of a condition without the remark that may follow it."""
    return condition.partition(",")[0]


class NoRows(LookupError):
    """Data without the rows that a statistic needs: the claim is not tested there."""


def rows(frame: Any, **values: Any) -> Any:
    """Returns the rows of a DataFrame with these values of columns.

    Raises:
      NoRows: if there are none.
    """
    for column, value in values.items():
        frame = frame[frame[column] == value]
    if frame.empty:
        raise NoRows(values)
    return frame


def by_agent(rows: Any, along: str, column: str) -> Any:
    """Returns the values of a column in a row for each agent and a column for each value of `along`."""
    return rows.pivot(index="training_seed", columns=along, values=column)


def of_rows(statistic: Callable[[Any], estimates.Estimate]) -> Statistic:
    """Returns the statistic that has an estimate from the rows of a condition."""
    return lambda frame, condition: statistic(rows(frame, condition=named(condition)))


def mean_of_agents(value: Callable[[Any], Any], middle: Callable[[Any], estimates.Estimate]) -> Statistic:
    """Returns the statistic that takes the mean of a value of each row by agent, and the middle of these."""
    return of_rows(lambda its: middle(value(its).groupby(its.training_seed).mean()))


def corrected(found: Sequence[Tested]) -> list[str]:
    """Returns the verdicts of claims, corrected for the number of conditions of each (Holm, 1979).

    From the smallest p-value on, each is compared with the level of significance over the number of tests that are
    left; from the first that is larger, all are undecided. An estimate from too few agents is no test.
    """
    verdicts = [claim.verdict for claim in found]
    families = collections.defaultdict(list)
    for index, claim in enumerate(found):
        if claim.estimate.can_be_tested:
            families[claim.id].append((claim.p_value, index))
    for tests in families.values():
        rejects = True
        for rank, (p_value, index) in enumerate(sorted(tests)):
            rejects = rejects and p_value <= _LEVEL / (len(tests) - rank)
            if not rejects:
                verdicts[index] = UNDECIDED
    return verdicts


@functools.cache
def table() -> dict[str, dict[str, Any]]:
    """Returns the content of `claims.toml`, by the names of experiments."""
    return tomllib.loads(importlib.resources.files(__package__).joinpath("claims.toml").read_text())


def described(experiment: str) -> dict[str, Any]:
    """Returns the title, section, caption and claims of an experiment of `claims.toml`."""
    row = table()[experiment]
    return {
        "name": experiment,
        "title": row["title"],
        "section": row.get("section", OURS),
        "caption": row["caption"],
        "claims": tuple(Claim(**({"on": row.get("on")} | its), id=id) for id, its in row["claims"].items()),
    }
