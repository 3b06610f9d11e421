"""What the analysis knows of Threshold: presets of its agents, its ideal, its columns."""

from collections.abc import Mapping
import dataclasses
from typing import Any

from physexp.agents.a3c import config as a3c
from physexp.agents.belief import config as belief
from physexp.analysis.domains import base

_DISCOUNT = 0.95

# Rewards tell of the last of three or four bits only, so policies must stay broad until those are used: much entropy at
# first, and many episodes to an update.
_FEATURES = a3c.A3CConfig(
    discount=_DISCOUNT,
    frames=3_000_000,
    envs_per_worker=128,
    learning_rate=3e-3,
    trace=0.95,
    entropy_cost=0.2,
    final_entropy_cost=0.002,
    observation_scale=2.0,
)
# There are 17 different images, and only different ones pass the convolutions: the larger an update, the cheaper.
_PIXELS = _FEATURES.replace(frames=1_500_000, envs_per_worker=64, learning_rate=1e-3, observation_scale=8.0)


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

    return resting.of_task("threshold", task, task_kwargs, discount, apparatus, _slid)


def _slid(observation) -> int:
    return int(observation["slid"][0])


DOMAIN = base.Domain(
    name="threshold",
    discount=_DISCOUNT,
    presets={
        "features": {"a3c": _FEATURES, "ppo": base.ppo_like(_FEATURES, frames=1_200_000, num_environments=512)},
        "pixels": {
            "a3c": _PIXELS,
            "ppo": base.ppo_like(_PIXELS, num_environments=1024),
            "belief": belief.FROM_IMAGES.replace(discount=_DISCOUNT),
        },
    },
    targets={"threshold-features": ("mean_return", 0.84), "threshold-pixels": ("mean_return", 0.76)},
    ideal=base.Ideal(_solve, IdealOptions),
    columns=(base.Column("friction", "float32", is_varied=True),),  # N
    fill=lambda hidden: {"friction": hidden},
)
