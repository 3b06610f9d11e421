"""Facts about Strike: presets, its ideal experimenter and its columns."""

from physexp.analysis.domains import base


def _hypotheses():
    import numpy as np

    from physexp.suite.domains import strike

    return np.arange(len(strike.PUCKS)), strike.PRIOR


DOMAIN = base.search_domain(
    "strike",
    _hypotheses,
    presets={
        **base.PRESETS_OF_BITS,
        "pixels": {**base.PRESETS_OF_BITS["pixels"], "ppo": base.PPO_OF_FEW_IMAGES.replace(frames=3_000_000)},
    },
    targets={"strike-features": ("mean_return", 0.75), "strike-pixels": ("mean_return", 0.70)},
    tracks={
        "exact": ({},),
        "pixels": ({},),
        "plan": ({"difficulty": 1.0},),
        "unseen": ({"control_timestep": 0.15},),
    },
    hidden_columns=lambda hidden: {"puck": hidden},  # An index in `strike.PUCKS`.
)
