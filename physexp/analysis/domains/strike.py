"""What the analysis knows of Strike: its ideal and its columns."""

from collections.abc import Mapping
from typing import Any

from physexp.analysis.domains import base

_NAME = "strike"


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float):
    """Returns the ideal experimenter, to whom every difference in what is observed is one."""
    import numpy as np

    from physexp.analysis.ideal import hypotheses, search
    from physexp.suite.domains import strike

    pucks = np.arange(len(strike.PUCKS))
    prior = np.full(len(pucks), 1 / len(pucks))
    known = hypotheses.Hypotheses(_NAME, task, pucks, prior, task_kwargs, read_as="features")
    return search.solve(known, 0.0, discount)


DOMAIN = base.Domain(
    name=_NAME,
    skill="learn for a goal",
    presets={
        **base.PRESETS_OF_BITS,
        "pixels": {**base.PRESETS_OF_BITS["pixels"], "ppo": base.PPO_OF_FEW_IMAGES.replace(frames=3_000_000)},
    },
    targets={"strike-features": ("mean_return", 0.75), "strike-pixels": ("mean_return", 0.70)},
    ideal=base.Ideal(_NAME, _solve),
    hidden_columns=lambda hidden: {"puck": hidden},  # An index in `strike.PUCKS`.
)
