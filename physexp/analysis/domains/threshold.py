"""Threshold, as the analysis sees it: presets of its agents, its ideal, its columns."""

from collections.abc import Mapping
import dataclasses
from typing import Any

from physexp.agents.a3c import config as a3c
from physexp.analysis.domains import base

_DISCOUNT = 0.95

_FEATURES = a3c.A3CConfig(discount=_DISCOUNT, envs_per_worker=128, trace=0.95, observation_scale=2.0)


@dataclasses.dataclass(frozen=True, kw_only=True)
class IdealOptions:
    """What can be chosen of the ideal experimenter, to whom each push tells whether the block slides.

    Attributes:
      difficulty: the skew of the prior over levels, a number >= 1, the larger the easier; by default the task's.
    """

    difficulty: float | None = None


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float):
    """Returns the ideal experimenter, which plays from features and from images alike."""
    from physexp.analysis.ideal import intervals
    from physexp.suite.domains import threshold

    options = threshold.Options(**task_kwargs)
    return intervals.solve(threshold.prior(options.difficulty), discount, options.step_limit)


DOMAIN = base.Domain(
    name="threshold",
    discount=_DISCOUNT,
    presets={"features": {"a3c": _FEATURES}},
    ideal=base.Ideal(_solve, IdealOptions),
    columns=(base.Column("friction", "float32", is_varied=True),),  # N
    fill=lambda hidden: {"friction": hidden},
)
