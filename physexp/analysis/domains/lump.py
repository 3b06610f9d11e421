"""Facts about Lump: presets, its ideal experimenter and its columns."""

from physexp.analysis.domains import base


def _hypotheses():
    import numpy as np

    from physexp.suite.domains import lump

    return np.arange(len(lump.ALL_LUMPS)), lump.PRIOR


DOMAIN = base.search_domain(
    "lump",
    _hypotheses,
    presets=base.PRESETS_OF_BITS,
    targets={"lump-features": ("mean_return", 0.77), "lump-pixels": ("mean_return", 0.75)},
    tracks={"unseen": ({"control_timestep": 0.15},)},
    hidden_columns=lambda hidden: {"lump": hidden},  # An index in `lump.ALL_LUMPS`.
)
