"""Facts about Strings: its ideal experimenter and its columns."""

from physexp.analysis.domains import base


def _apparatus(options):
    from physexp.analysis.ideal import bands
    from physexp.suite.domains import strings

    weights = strings.prior(options.difficulty, options.num_pucks)
    return bands.Clamped(options.num_pucks, weights, options.num_clamps)


def _moved(observation) -> int:
    """Returns which pucks are away from their start, as a bit mask."""
    return sum(1 << k for k, is_away in enumerate(observation["away"]) if is_away)


DOMAIN = base.resting_domain(
    "strings",
    _apparatus,
    read=_moved,
    presets=base.PRESETS_OF_BITS,
    targets={"strings-features": ("mean_return", 0.82), "strings-pixels": ("mean_return", 0.82)},
    tracks={
        "exact": ({},),
        "pixels": ({},),
        "plan": ({"num_pucks": 4, "num_clamps": 2, "time_limit": 4.0},),
        "questions": ({"questions": "held_out"}, {"questions": "held_out", "num_questions": 4}),
        "unseen": ({"difficulty": 2.0},),
    },
    hidden_columns=lambda hidden: {"slacks": hidden},  # m; 0 where there is no band; and the numbers of questions.
)
