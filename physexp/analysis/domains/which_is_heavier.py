"""What the analysis knows of Which is Heavier: presets, the paper's names of conditions, its ideal, its columns."""

from collections.abc import Mapping
import dataclasses
import functools
from typing import Any

from physexp.agents.a3c import config as a3c
from physexp.analysis.domains import base

_NAME = "which_is_heavier"

_FEATURES = a3c.A3CConfig(envs_per_worker=128, trace=0.98, observation_scale=80.0)
# Every frame passes the convolutions, which is what pixels cost: small updates, and no frame more than is needed.
_PIXELS = a3c.A3CConfig(frames=500_000, envs_per_worker=64, learning_rate=1e-3, trace=0.9, observation_scale=8.0)


@dataclasses.dataclass(frozen=True, kw_only=True)
class IdealOptions:
    """What can be chosen of the ideal experimenter, to whom one poke reveals a mass exactly.

    Attributes:
      blocks: how many blocks; by default the task's.
    """

    blocks: int | None = None


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float, *, blocks: int | None = None):
    """Returns the ideal experimenter; with another number of blocks than the task's it cannot play.

    With noise it is a policy that counts with it; with variation, the ideal one without, which takes all readings for
    those of a usual episode. Nobody earns more than where there is neither, since the force of all pokes, once known,
    tells each mass exactly.
    """
    from physexp import checks, suite
    from physexp.analysis.ideal import bounds, calibration, noisy, odd_one_out
    from physexp.suite.domains import which_is_heavier

    if not bounds.is_certain(task_kwargs):
        if blocks is not None:
            raise ValueError(
                f"blocks is {blocks}; give none where there is noise or variation, since it has to be played"
            )
        usual = _solve(task, bounds.made_certain(task_kwargs), discount)
        make_actor = usual.actor
        if not task_kwargs.get("variation"):
            make_actor = noisy.players(usual, _NAME, task, "heights", task_kwargs)
        return bounds.Solution(_NAME, task, task_kwargs, discount, make_actor, lambda: [usual.value])
    played = suite.load_task(_NAME, task, dict(task_kwargs))
    prior = which_is_heavier.prior(played.options.difficulty)
    if blocks is not None:
        prior = dataclasses.replace(prior, num_things=checks.integer("blocks", blocks, 2, odd_one_out.MOST_THINGS))
    can_read = "features" in suite.tags(_NAME, task) and blocks is None
    find_read = functools.partial(calibration.calibrate, _NAME, task, "heights", dict(task_kwargs))
    return odd_one_out.solve(prior, discount, played.rules.step_limit, find_read if can_read else None)


def _hidden_columns(hidden):
    """Returns masses, on the paper's scale, and by how much the heaviest block is heavier than the second."""
    from physexp.suite.domains import which_is_heavier

    return {"masses": hidden, "mass_gap": which_is_heavier.mass_gaps(hidden)}


DOMAIN = base.Domain(
    name=_NAME,
    skill="know when to stop",
    presets={
        "features": {"a3c": _FEATURES, "ppo": base.ppo_like(_FEATURES, frames=1_500_000, learning_rate=3e-3)},
        "pixels": {
            "a3c": _PIXELS,
            "ppo": base.ppo_like(_PIXELS, learning_rate=5e-4, num_environments=64),
        },
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
    ideal=base.Ideal(_NAME, _solve, IdealOptions),
    hidden_columns=_hidden_columns,
)
