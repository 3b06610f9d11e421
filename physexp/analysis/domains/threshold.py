"""Facts about Threshold: its ideal experimenter and its columns."""

from physexp.analysis.domains import base


def _apparatus(options):
    from physexp.analysis.ideal import intervals
    from physexp.suite.domains import threshold

    return intervals.Thresholds(threshold.prior(options.difficulty))


DOMAIN = base.resting_domain(
    "threshold",
    _apparatus,
    read=lambda observation: int(observation["slid"][0]),
    presets=base.PRESETS_OF_BITS,
    targets={"threshold-features": ("mean_return", 0.84), "threshold-pixels": ("mean_return", 0.76)},
    hidden_columns=lambda hidden: {"friction": hidden},  # N
)
