"""Facts about Towers: presets, the paper's names of conditions, its ideal experimenter and its columns."""

from collections.abc import Mapping
import dataclasses
import functools
import math
from typing import TYPE_CHECKING, Any

from physexp import checks
from physexp.agents.a3c import config as a3c
from physexp.agents.ppo import config as ppo
from physexp.analysis.domains import base

if TYPE_CHECKING:
    from physexp.agents import core

_NAME = "towers"
_NUM_PUSHES, _NUM_MOVES, _NUM_LABELS = 20, 4, 5  # Of a cube, of the fist; and answers.

# Towers spend their time in simulation, not in learning: many small updates. Blocks move by their own size.
_FEATURES = a3c.A3CConfig(
    envs_per_worker=32,
    learning_rate=3e-3,
    gae_lambda=0.5,
    entropy_cost=0.01,
    final_entropy_cost=0.001,
    observation_scale=10.0,
)
_PIXELS = _FEATURES.replace(learning_rate=1e-3, observation_scale=16.0)


def _prior(num_interactions: int, label: float) -> tuple[float, ...]:
    """Returns initial logits that prefer interactions: before the tower is touched, an answer is a guess."""
    return (0.0,) * num_interactions + (label,) * _NUM_LABELS


_DIRECT = _prior(_NUM_PUSHES, -1.0)
# Only hits teach labels. A fist that moves at random hits the tower ten times in a thousand frames; one that prefers
# +x, where the tower is, forty times. Until labels are learned, the estimated values of moves are noise, and the fist
# drifts off unless the divergence from this preference is penalized.
_FIST = (1.0, *_prior(_NUM_MOVES - 1, -2.0))

_A3C = {
    "direct_features": _FEATURES.replace(frames=1_000_000, initial_logits=_DIRECT),
    "fist_features": _FEATURES.replace(frames=400_000, initial_logits=_FIST, entropy_cost=0.05, kl_to_prior=True),
    "direct_pixels": _PIXELS.replace(frames=400_000, initial_logits=_DIRECT),
    # Small steps, and a small weight of the value loss, keep 3136 inputs from saturating the LSTM before labels are
    # learned. A lambda of 0 keeps the luck of answers out of the advantages of moves.
    "fist_pixels": _PIXELS.replace(
        frames=600_000,
        initial_logits=_FIST,
        learning_rate=3e-4,
        gae_lambda=0.0,
        baseline_cost=0.05,
        entropy_cost=0.1,
        kl_to_prior=True,
    ),
}


def _ppo(task: str, learning_rate: float, entropy_cost: float) -> ppo.PPOConfig:
    changes = dict(learning_rate=learning_rate, entropy_cost=entropy_cost)
    return base.ppo_like(_A3C[task], **changes, num_environments=32, num_minibatches=2)


# Never to answer is worth as much as to answer at random. Several updates on one batch end there before anything is
# learned, unless enough entropy prevents it: more for the fist, whose hits are rare at first. Entropy costs are larger
# than A3C's because PPO standardizes advantages. From pixels only small steps learn.
_PPO = {
    "direct_features": _ppo("direct_features", 1e-3, 0.05),
    "direct_pixels": _ppo("direct_pixels", 1e-4, 0.05),
    "fist_features": _ppo("fist_features", 1e-3, 0.1),
    "fist_pixels": _ppo("fist_pixels", 5e-5, 1.0),
}


@dataclasses.dataclass(frozen=True, kw_only=True)
class IdealOptions:
    """Options of the ideal experimenter, which knows the physics."""

    resolution: float = checks.checked(
        0.0,
        checks.at_least(0, "m, or pixels"),
        help="smallest difference that it can observe: in m for features, in differing pixels for images; 0 for every "
        "bit",
    )


def hypotheses(task: str, task_kwargs: Mapping[str, Any] | None = None, nuisances=None):
    """Returns the `Hypotheses` of all glue patterns in a task of the towers; for `nuisances` see there."""
    import numpy as np

    from physexp.analysis.ideal import hypotheses as hypotheses_lib
    from physexp.suite.domains import towers

    patterns = np.arange(len(towers.PRIOR))
    return hypotheses_lib.Hypotheses(_NAME, task, patterns, towers.PRIOR, task_kwargs, nuisances)


def _tolerance(task: str, task_kwargs: Mapping[str, Any]) -> float | None:
    """Returns half of the fist's move in a control step, m and m/s; None where there is no fist.

    A moving fist can stand in countless places. Judging actions, one search serves all states that differ by no more.
    """
    from physexp.suite.domains import towers
    from physexp.suite.parts import actuators

    if not task.startswith("fist"):
        return None
    return actuators.FIST_SPEED * towers.Options(**{**task_kwargs, "random": 0}).control_timestep / 2


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float, *, resolution: float = IdealOptions.resolution):
    """Returns the ideal experimenter with some resolution.

    With noise or variation, the lower bound is the value of a rule, and the upper bound that of an experimenter with
    this resolution that reads without noise and knows all random parameters of an episode except the glue.
    """
    from physexp import suite
    from physexp.analysis.ideal import bounds, search

    if bounds.is_certain(task_kwargs):
        tolerance = _tolerance(task, task_kwargs)
        return search.Solution(hypotheses(task, task_kwargs), resolution, discount, tolerance=tolerance)
    if task not in _RULES:
        raise ValueError(f"task is {task!r}; with noise or variation, choose from {', '.join(_RULES)}")
    noiseless = {name: value for name, value in task_kwargs.items() if name != "noise"}
    upper = [
        search.Solution(hypotheses(task, noiseless, nuisances), resolution, discount)
        for nuisances in _drawn_nuisances(task, noiseless)
    ]
    step_limit = suite.load_task(_NAME, task, task_kwargs).rules.step_limit
    play = functools.partial(rule, task, task_kwargs.get("noise") or 0.0, step_limit=step_limit)
    return bounds.Solution(_NAME, task, task_kwargs, discount, play, lambda: [each.bound for each in upper])


def _drawn_nuisances(task: str, task_kwargs: Mapping[str, Any]):
    """Returns the random variation in episodes of `bounds`, [_NUM_NUISANCES, number of values]; [None] without any."""
    import numpy as np

    from physexp import suite
    from physexp.analysis.ideal import bounds
    from physexp.suite.engine import seeding

    if not task_kwargs.get("variation"):
        return [None]
    count = suite.load_task(_NAME, task, task_kwargs).num_nuisances
    seeds = np.array([suite.environment_seed(bounds.SEED, number) for number in range(_NUM_NUISANCES)])
    return task_kwargs["variation"] * seeding.variations(seeds, np.zeros_like(seeds), count)


_NUM_NUISANCES = 16
_COARSE = 0.001  # m, the resolution of the baseline `lookup`.
_RULES = {
    "direct_features": ((4, 14), _NUM_PUSHES),  # Push cube 1 to +x, and cube 3 to +y.
    "fist_features": ((0,), _NUM_MOVES),  # Move the fist to +x, where the tower is.
}


def rule(task: str, noise: float = 0.0, wait: int | None = None, step_limit: float = math.inf) -> "core.Actor":
    """Returns an actor that takes cubes for glued while their distance has not changed; see `glue.GlueRule`."""
    from physexp.analysis.domains import glue

    return glue.GlueRule(*_RULES[task], noise, wait, step_limit)


def _lookup(task: str) -> "core.Actor":
    """Returns an actor with a resolution of 1 mm, which takes each tower for the nearest of the 16 usual ones."""
    return _IDEAL(task, {}, DOMAIN.discount, resolution=_COARSE).actor()


_IDEAL = base.Ideal(_NAME, _solve, IdealOptions)

DOMAIN = base.Domain(
    name=_NAME,
    presets={task: {"a3c": _A3C[task], "ppo": _PPO[task]} for task in _A3C},
    labels={"direct_features": "D-F", "direct_pixels": "D-P", "fist_features": "F-F", "fist_pixels": "F-P"},
    targets={
        "towers-direct_features": ("mean_return", 0.97),
        "towers-fist_features": ("mean_return", 0.93),
        "towers-direct_pixels": ("mean_return", 0.97),
        "towers-fist_pixels": ("mean_return", 0.93),
    },
    ideal=_IDEAL,
    baselines={
        task: {"rule": functools.partial(rule, task), "lookup": functools.partial(_lookup, task)} for task in _RULES
    },
    tracks={
        "exact": ({},),
        "pixels": ({},),
        "unseen": ({"sliding_friction": 0.48}, {"control_timestep": 0.05}),
    },
    hidden_columns=lambda hidden: {"pattern": hidden},  # An index in `tower.PATTERNS`.
)
