"""What the analysis knows of Balance: its ideal and its columns."""

from collections.abc import Mapping
from typing import Any

from physexp.analysis.domains import base

_NAME = "balance"


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
    presets=base.PRESETS_OF_BITS,
    targets={"balance-features": ("mean_return", 0.72), "balance-pixels": ("mean_return", 0.72)},
    ideal=base.Ideal(_NAME, _solve),
    hidden_columns=lambda hidden: {"weights": hidden},  # kg
)
