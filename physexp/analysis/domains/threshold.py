"""What the analysis knows of Threshold: presets of its agents, its ideal, its columns."""

from collections.abc import Mapping
from typing import Any

from physexp.analysis.domains import base

_NAME = "threshold"


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
    presets=base.PRESETS_OF_BITS,
    targets={"threshold-features": ("mean_return", 0.84), "threshold-pixels": ("mean_return", 0.76)},
    ideal=base.Ideal(_NAME, _solve),
    hidden_columns=lambda hidden: {"friction": hidden},  # N
)
