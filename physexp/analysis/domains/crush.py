"""Facts about Crush: its ideal experimenter and its columns."""

from physexp.analysis.domains import base


def _apparatus(options):
    from physexp.analysis.ideal import intervals
    from physexp.suite.domains import crush

    return intervals.Specimens(crush.PRIOR, options.num_cans)


DOMAIN = base.resting_domain(
    "crush",
    _apparatus,
    read=lambda observation: int(observation["crushed"].sum()),
    presets=base.PRESETS_OF_BITS,
    targets={"crush-features": ("mean_return", 0.65)},
    tracks={"plan": ({},)},
    hidden_columns=lambda hidden: {"can_strength": hidden},  # N
)
