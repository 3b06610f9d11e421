"""What the analysis knows of Strings: its ideal and its columns."""

from collections.abc import Mapping
from typing import Any

from physexp.analysis.domains import base

_NAME = "strings"


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float):
    """Returns the ideal experimenter; it plays from features."""
    from physexp.analysis.ideal import bands, resting
    from physexp.suite.domains import strings

    def apparatus(options):
        return bands.Clamped(strings.NUM_PUCKS, strings.prior(options.difficulty))

    return resting.of_task(_NAME, task, task_kwargs, discount, apparatus, _away)


def _away(observation) -> int:
    """Returns which pucks are away from home, as a bit mask."""
    return sum(1 << k for k, is_away in enumerate(observation["away"]) if is_away)


DOMAIN = base.Domain(
    name=_NAME,
    skill="control confounds",
    presets=base.PRESETS_OF_BITS,
    targets={"strings-features": ("mean_return", 0.82), "strings-pixels": ("mean_return", 0.82)},
    ideal=base.Ideal(_NAME, _solve),
    hidden_columns=lambda hidden: {"slacks": hidden},  # m; 0 where there is no band
)
