"""Facts about Threshold: its ideal experimenter and its columns."""

import dataclasses
from typing import Any

from physexp.analysis.domains import base

_NAME = "threshold"


def _apparatus(options):
    from physexp.analysis.ideal import intervals
    from physexp.suite.domains import threshold

    return intervals.Thresholds(threshold.prior(options.difficulty))


def _read(observation) -> int:
    """Returns the flag."""
    return int(observation["slid"][0])


def _hidden_columns(hidden):
    """Returns the friction, N."""
    from physexp.suite.domains import threshold

    return {"friction": threshold.frictions(hidden)}


_OF_RIGHT_FLAGS = base.resting_domain(
    _NAME,
    _apparatus,
    read=_read,
    presets=base.PRESETS_OF_BITS,
    targets={"threshold-features": ("mean_return", 0.84), "threshold-pixels": ("mean_return", 0.76)},
    tracks={
        "exact": ({},),
        "pixels": ({},),
        "noise": ({"flag_noise": 0.1},),
        "unseen": ({"difficulty": 2.0},),
    },
    hidden_columns=_hidden_columns,
)


def _solve(task, task_kwargs, discount):
    """Returns the ideal experimenter, which knows how often the flag is wrong."""
    from physexp import suite
    from physexp.analysis.ideal import noisy_intervals
    from physexp.suite.domains import threshold

    if not task_kwargs.get("flag_noise"):
        assert _OF_RIGHT_FLAGS.ideal is not None
        return _OF_RIGHT_FLAGS.ideal(task, task_kwargs, discount)
    played: Any = suite.load_task(_NAME, task, task_kwargs)
    return noisy_intervals.Solution(
        threshold.prior(played.options.difficulty),
        played.options.flag_noise,
        discount,
        played.rules.step_limit,
        read=_read if "features" in suite.tags(_NAME, task) else None,
        results=played.flags,
    )


DOMAIN = dataclasses.replace(_OF_RIGHT_FLAGS, ideal=base.Ideal(_NAME, _solve))
