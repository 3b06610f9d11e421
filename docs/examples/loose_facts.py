"""Facts about Which is Loose: presets, and its ideal experimenter by search among four hypotheses."""

from physexp.analysis.domains import base


def _hypotheses():
    import loose  # Here, since the command line is made from this module.
    import numpy as np

    return np.arange(loose.NUM_BLOCKS), loose.PRIOR


DOMAIN = base.search_domain("loose", _hypotheses, presets=base.PRESETS_OF_BITS)
