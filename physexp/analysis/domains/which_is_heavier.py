"""Facts about Which is Heavier: presets, the paper's names of conditions, its ideal experimenter, its columns."""

from collections.abc import Mapping
import functools
from typing import Any

from physexp.agents.a3c import config as a3c
from physexp.analysis.domains import base

_NAME = "which_is_heavier"

_FEATURES = a3c.A3CConfig(envs_per_worker=128, gae_lambda=0.98, observation_scale=80.0)
# Every frame passes the convolutions, which makes frames expensive: few of them, in small updates.
_PIXELS = a3c.A3CConfig(frames=500_000, envs_per_worker=64, learning_rate=1e-3, gae_lambda=0.9, observation_scale=8.0)


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float):
    """Returns the ideal experimenter, to which one poke reveals a mass exactly.

    With noise, it is a policy that takes the noise into account. With variation, it is the policy without variation,
    which reads all heights as if the force were the usual one. The upper bound is the value without noise and
    variation: once the force of all pokes is known, each poke reveals a mass exactly.
    """
    from physexp import suite
    from physexp.analysis.ideal import bounds, calibration, noisy, odd_one_out
    from physexp.suite.domains import which_is_heavier

    if not bounds.is_certain(task_kwargs):
        certain = bounds.made_certain(task_kwargs)
        usual = _solve(task, certain, discount)
        make_actor = usual.actor
        if not task_kwargs.get("variation"):
            responses = calibration.Responses(_NAME, task, "heights", certain, noisy.VALUES)
            make_actor = functools.partial(noisy.Player, usual, responses, task_kwargs["noise"])
        return bounds.Solution(_NAME, task, task_kwargs, discount, make_actor, lambda: [usual.value])
    played = suite.load_task(_NAME, task, task_kwargs)
    prior = which_is_heavier.prior(played.options.difficulty, played.options.num_blocks)
    can_read = "features" in suite.tags(_NAME, task)
    find_read = functools.cache(functools.partial(calibration.calibrate, _NAME, task, "heights", task_kwargs))
    return odd_one_out.Solution(prior, discount, played.rules.step_limit, find_read if can_read else None)


def _hidden_columns(hidden):
    """Returns the masses, on the paper's scale, and the difference between the two largest."""
    from physexp.suite.domains import which_is_heavier

    return {"masses": hidden, "mass_gap": which_is_heavier.mass_gaps(hidden)}


DOMAIN = base.Domain(
    name=_NAME,
    presets={
        "features": {"a3c": _FEATURES, "ppo": base.ppo_like(_FEATURES, frames=1_500_000, learning_rate=3e-3)},
        "pixels": {"a3c": _PIXELS, "ppo": base.ppo_like(_PIXELS, learning_rate=5e-4, num_environments=64)},
    },
    labels={"features": "{difficulty:g}-F", "pixels": "{difficulty:g}-P"},
    targets={
        "which_is_heavier-features-difficulty3": ("mean_return", 0.82),
        "which_is_heavier-features-difficulty5": ("mean_return", 0.85),
        "which_is_heavier-features-difficulty10": ("mean_return", 0.88),
        "which_is_heavier-pixels-difficulty3": ("mean_return", 0.79),
        "which_is_heavier-pixels-difficulty5": ("mean_return", 0.84),
        "which_is_heavier-pixels-difficulty10": ("mean_return", 0.88),
    },
    ideal=base.Ideal(_NAME, _solve),
    tracks={
        "exact": ({},),
        "pixels": ({},),
        "unseen": ({"difficulty": 2.0},),
    },
    hidden_columns=_hidden_columns,
)
