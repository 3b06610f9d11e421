"""What the analysis knows of Balance: its ideal and its columns."""

from collections.abc import Mapping
import dataclasses
from typing import Any

from physexp.analysis.domains import base

_NAME = "balance"
_DISCOUNT = 0.95


@dataclasses.dataclass(frozen=True, kw_only=True)
class IdealOptions:
    """What can be chosen of the ideal experimenter, who reads only to which side the beam tilts.

    Attributes:
      difficulty: 1 more than the number of blocks that are known not to be the odd one, 1 to 3, the larger
        the easier; by default the task's.
    """

    difficulty: float | None = None


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float):
    """Returns the ideal experimenter; it plays from features."""
    from physexp.analysis.ideal import counterfeit, resting
    from physexp.suite.domains import balance

    def apparatus(options):
        return counterfeit.Scale(balance.NUM_BLOCKS, balance.num_suspects(options.difficulty))

    return resting.of_task(_NAME, task, task_kwargs, discount, apparatus, _tilt)


def _tilt(observation) -> int:
    return int(observation["tilt"][0])


DOMAIN = base.Domain(
    name=_NAME,
    skill="use a tool",
    discount=_DISCOUNT,
    presets=base.PRESETS_OF_BITS,
    targets={"balance-features": ("mean_return", 0.72), "balance-pixels": ("mean_return", 0.72)},
    ideal=base.Ideal(_NAME, _solve, IdealOptions),
    hidden_columns=lambda hidden: {"weights": hidden},  # kg
)
