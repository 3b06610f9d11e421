"""What the analysis knows of Threshold: presets of its agents, its ideal, its columns."""

from collections.abc import Mapping
import dataclasses
from typing import Any

from physexp.analysis.domains import base

_NAME = "threshold"
_DISCOUNT = 0.95


@dataclasses.dataclass(frozen=True, kw_only=True)
class IdealOptions:
    """What can be chosen of the ideal experimenter, to whom each push tells whether the block slides.

    Attributes:
      difficulty: the skew of the prior over levels, a number >= 1, the larger the easier; by default the task's.
    """

    difficulty: float | None = None


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float):
    """Returns the ideal experimenter; it plays from features."""
    from physexp.analysis.ideal import intervals, resting
    from physexp.suite.domains import threshold

    def apparatus(options):
        return intervals.Thresholds(threshold.prior(options.difficulty))

    return resting.of_task(_NAME, task, task_kwargs, discount, apparatus, _slid)


def _slid(observation) -> int:
    return int(observation["slid"][0])


DOMAIN = base.Domain(
    name=_NAME,
    skill="halve what is left",
    discount=_DISCOUNT,
    presets=base.PRESETS_OF_BITS,
    targets={"threshold-features": ("mean_return", 0.84), "threshold-pixels": ("mean_return", 0.76)},
    ideal=base.Ideal(_NAME, _solve, IdealOptions),
    hidden_columns=lambda hidden: {"friction": hidden},  # N
)
