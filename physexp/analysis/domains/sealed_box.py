"""What the analysis knows of Sealed Box: its ideal and its columns."""

from collections.abc import Mapping
from typing import Any

from physexp.analysis.domains import base

_NAME = "sealed_box"
_FRAMES = 4_000_000  # Of A3C and PPO.


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float):
    """Returns the ideal experimenter, to whom every difference in what is observed is one."""
    import numpy as np

    from physexp.analysis.ideal import hypotheses, search
    from physexp.suite.domains import sealed_box

    contents = np.arange(len(sealed_box.ALL_CONTENTS))
    known = hypotheses.Hypotheses(_NAME, task, contents, sealed_box.PRIOR, task_kwargs, read_as="features")
    return search.solve(known, 0.0, discount)


DOMAIN = base.Domain(
    name=_NAME,
    skill="excite and watch",
    presets={
        "features": {
            "a3c": base.A3C_OF_BITS.replace(frames=_FRAMES),
            "ppo": base.PPO_OF_BITS.replace(frames=_FRAMES, trace=1.0),
        },
        "pixels": {
            **base.PRESETS_OF_BITS["pixels"],
            "ppo": base.PPO_OF_FEW_IMAGES.replace(frames=_FRAMES, trace=1.0),
        },
    },
    targets={"sealed_box-features": ("mean_return", 0.82), "sealed_box-pixels": ("mean_return", 0.76)},
    ideal=base.Ideal(_NAME, _solve),
    hidden_columns=lambda hidden: {"content": hidden},  # An index in `sealed_box.ALL_CONTENTS`.
)
