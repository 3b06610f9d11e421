"""Facts about Balance: its ideal experimenter and its columns."""

from physexp.analysis.domains import base


def _apparatus(options, table=None):
    from physexp.analysis.ideal import counterfeit
    from physexp.suite.domains import balance

    asked = None if table is None else table[::2]  # One value for heavier and one for lighter.
    return counterfeit.Scale(balance.NUM_BLOCKS, balance.num_suspects(options.difficulty), options.latch, asked)


DOMAIN = base.resting_domain(
    "balance",
    _apparatus,
    read=lambda observation: int(observation["tilt"][0]),
    asked=_apparatus,
    presets=base.PRESETS_OF_BITS,
    targets={"balance-features": ("mean_return", 0.72), "balance-pixels": ("mean_return", 0.72)},
    tracks={
        "exact": ({},),
        "pixels": ({},),
        "plan": ({"latch": True},),
        "unseen": ({"difficulty": 2.0},),
    },
    hidden_columns=lambda hidden: {"weights": hidden},  # kg; and the number of the question.
)
