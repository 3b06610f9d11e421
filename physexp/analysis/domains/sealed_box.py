"""Facts about Sealed Box: presets, its ideal experimenter and its columns."""

from physexp.analysis.domains import base

_FRAMES = 4_000_000  # Of A3C and PPO.
_FIRST_VERSION = {"physics_timestep": 0.02}  # Of the tasks.


def _hypotheses():
    import numpy as np

    from physexp.suite.domains import sealed_box

    return np.arange(len(sealed_box.ALL_CONTENTS)), sealed_box.PRIOR


DOMAIN = base.search_domain(
    "sealed_box",
    _hypotheses,
    presets={
        "features": {
            "a3c": base.A3C_OF_BITS.replace(frames=_FRAMES),
            "ppo": base.PPO_OF_BITS.replace(frames=_FRAMES, gae_lambda=1.0),
        },
        "pixels": {
            **base.PRESETS_OF_BITS["pixels"],
            "ppo": base.PPO_OF_FEW_IMAGES.replace(frames=_FRAMES, gae_lambda=1.0),
        },
    },
    targets={
        "sealed_box-features": ("mean_return", 0.77),
        "sealed_box-pixels": ("mean_return", 0.75),
        "sealed_box-features-physics_timestep0.02": ("mean_return", 0.82),
        "sealed_box-pixels-physics_timestep0.02": ("mean_return", 0.76),
    },
    tracks={"exact": (_FIRST_VERSION,), "pixels": (_FIRST_VERSION,), "unseen": ({"control_timestep": 0.14},)},
    hidden_columns=lambda hidden: {"content": hidden},  # An index in `sealed_box.ALL_CONTENTS`.
)
