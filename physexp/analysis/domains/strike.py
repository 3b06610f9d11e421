"""What the analysis knows of Strike: its ideal and its columns."""

from collections.abc import Mapping
import dataclasses
from typing import Any

from physexp.analysis.domains import base

_NAME = "strike"
_DISCOUNT = 0.95


@dataclasses.dataclass(frozen=True, kw_only=True)
class IdealOptions:
    """What can be chosen of the ideal experimenter, who knows the physics.

    Attributes:
      task: the task.
      difficulty: how finely pokes are read, 1 to 3, the larger the easier; by default the task's.
      goal_distance: from the puck to the middle of the goal, m; by default the task's.
    """

    task: str = "features"
    difficulty: float | None = None
    goal_distance: float | None = None


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float):
    """Returns the ideal experimenter, to whom every difference in what is observed is one."""
    import numpy as np

    from physexp.analysis.ideal import kept, search
    from physexp.suite.domains import strike

    pucks = np.arange(len(strike.PUCKS))
    prior = np.full(len(pucks), 1 / len(pucks))
    known = kept.Hypotheses(_NAME, task, pucks, prior, task_kwargs, read_as="features")
    return search.solve(known, 0.0, discount)


DOMAIN = base.Domain(
    name=_NAME,
    skill="learn for a goal",
    discount=_DISCOUNT,
    presets={
        **base.PRESETS_OF_BITS,
        "pixels": {**base.PRESETS_OF_BITS["pixels"], "ppo": base.PPO_OF_FEW_IMAGES.replace(frames=3_000_000)},
    },
    targets={"strike-features": ("mean_return", 0.75), "strike-pixels": ("mean_return", 0.70)},
    ideal=base.Ideal(_NAME, _solve, IdealOptions),
    hidden_columns=lambda hidden: {"puck": hidden},  # An index in `strike.PUCKS`.
)
