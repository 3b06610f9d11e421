"""What the analysis knows of Towers: presets, the paper's names of conditions, its ideal, its columns."""

from collections.abc import Mapping
import dataclasses
import functools
import math
from typing import TYPE_CHECKING, Any

from physexp.agents.a3c import config as a3c
from physexp.agents.ppo import config as ppo
from physexp.analysis.domains import base

if TYPE_CHECKING:
    from physexp.agents import core

_NAME = "towers"
_NUM_LABELS = 5

# Simulation is what a tower costs, not learning: small updates and many of them. Blocks move by their own size.
_FEATURES = a3c.A3CConfig(
    envs_per_worker=32,
    learning_rate=3e-3,
    trace=0.5,
    entropy_cost=0.01,
    final_entropy_cost=0.001,
    observation_scale=10.0,
)
_PIXELS = _FEATURES.replace(learning_rate=1e-3, observation_scale=16.0)


def _prior(num_interactions: int, label: float) -> tuple[float, ...]:
    """Returns an action prior that prefers interactions: an answer before the tower was touched can only be a guess."""
    return (0.0,) * num_interactions + (label,) * _NUM_LABELS


_DIRECT = _prior(20, -1.0)
# Only hits teach labels. A fist that moves at random hits the tower ten times in a thousand frames; one that prefers
# +x, where the tower is, forty times. Until labels are known, what moves seem worth is noise, which carries the fist
# off unless entropy relative to this preference holds it.
_FIST = (1.0, *_prior(3, -2.0))

_A3C = {
    "direct_features": _FEATURES.replace(frames=1_000_000, action_prior=_DIRECT),
    "fist_features": _FEATURES.replace(frames=400_000, action_prior=_FIST, entropy_cost=0.05, relative_entropy=True),
    "direct_pixels": _PIXELS.replace(frames=400_000, action_prior=_DIRECT),
    # Small steps, of the values' loss hardly any, keep 3136 inputs from saturating the LSTM before labels are known. A
    # trace of 0 keeps the luck of answers out of what moves seem worth.
    "fist_pixels": _PIXELS.replace(
        frames=600_000,
        action_prior=_FIST,
        learning_rate=3e-4,
        trace=0.0,
        baseline_cost=0.05,
        entropy_cost=0.1,
        relative_entropy=True,
    ),
}


def _ppo(task: str, learning_rate: float, entropy_cost: float) -> ppo.PPOConfig:
    return base.ppo_like(
        _A3C[task],
        learning_rate=learning_rate,
        entropy_cost=entropy_cost,
        num_environments=32,
        num_minibatches=2,
    )


# Never to answer a tower is worth as much as to answer at random. Several steps on one round get there before anything
# has been learned, unless the entropy holds them back: more of it for the fist, whose hits are rare at first. It counts
# beside advantages that are standardized, which A3C's are not. From pixels only small steps learn.
_PPO = {
    "direct_features": _ppo("direct_features", 1e-3, 0.05),
    "direct_pixels": _ppo("direct_pixels", 1e-4, 0.05),
    "fist_features": _ppo("fist_features", 1e-3, 0.1),
    "fist_pixels": _ppo("fist_pixels", 5e-5, 1.0),
}


@dataclasses.dataclass(frozen=True, kw_only=True)
class IdealOptions:
    """Options of the ideal experimenter, which knows the physics.

    Attributes:
      resolution: the smallest difference that can be observed: in metres for features, in differing pixels for images;
        at 0 every bit counts.
    """

    resolution: float = 0.0


def hypotheses(task: str, task_kwargs: Mapping[str, Any] | None = None, nuisances=None):
    """Returns the `Hypotheses` of all glue patterns in a task of the towers; for `nuisances` see there."""
    import numpy as np

    from physexp.analysis.ideal import hypotheses as hypotheses_lib
    from physexp.suite.domains import towers

    patterns = np.arange(len(towers.PRIOR))
    return hypotheses_lib.Hypotheses(_NAME, task, patterns, towers.PRIOR, task_kwargs, nuisances)


def _solve(task: str, task_kwargs: Mapping[str, Any], discount: float, *, resolution: float = IdealOptions.resolution):
    """Returns the ideal experimenter, an observer of some resolution.

    With noise or variation, the value is that of a rule, and the bound that of experimenters of this resolution that
    know everything in which an episode differs except the glue, and read without noise.
    """
    from physexp import suite
    from physexp.analysis.ideal import bounds, search

    if bounds.is_certain(task_kwargs):
        return search.solve(hypotheses(task, task_kwargs), resolution, discount, tolerance=_TOLERANCES.get(task))
    if task not in _RULES:
        raise ValueError(f"task is {task!r}; with noise or variation, choose from {', '.join(_RULES)}")
    told = {name: value for name, value in task_kwargs.items() if name != "noise"}
    upper = [
        search.solve(hypotheses(task, told, nuisances), resolution, discount)
        for nuisances in _drawn_nuisances(task, told)
    ]
    step_limit = suite.load_task(_NAME, task, dict(task_kwargs)).rules.step_limit
    play = functools.partial(rule, task, task_kwargs.get("noise") or 0.0, step_limit=step_limit)
    return bounds.Solution(_NAME, task, task_kwargs, discount, play, lambda: [each.bound for each in upper])


def _drawn_nuisances(task: str, task_kwargs: Mapping[str, Any]):
    """Returns the circumstances of episodes of `bounds`, [_NUM_NUISANCES, number of them]; [None] without variation."""
    import numpy as np

    from physexp import suite
    from physexp.analysis.ideal import bounds
    from physexp.suite.engine import seeding

    if not task_kwargs.get("variation"):
        return [None]
    count = suite.load_task(_NAME, task, dict(task_kwargs)).num_nuisances
    seeds = np.array([suite.environment_seed(bounds.SEED, number) for number in range(_NUM_NUISANCES)])
    return task_kwargs["variation"] * seeding.variations(seeds, np.zeros_like(seeds), count)


_NUM_NUISANCES = 16
# m and m/s: a fist that wanders may stand at any of countless places, so when actions are judged, one search stands for
# all situations that differ by less than half of the fist's move in a control step.
_TOLERANCES = dict.fromkeys(("fist_features", "fist_pixels"), 0.05)
_COARSE = 0.001  # m, the resolution of an observer that is compared with the ideal one.
_RULES = {
    "direct_features": (4, 14),  # Push cube 1 to +x, and cube 3 to +y.
    "fist_features": (0,),  # Move the fist to +x, where the tower is.
}


def rule(task: str, noise: float = 0.0, wait: int | None = None, step_limit: float = math.inf) -> "core.Actor":
    """Returns an actor that takes cubes for glued while their distance has not changed; see `glue.GlueRule`."""
    from physexp.analysis.domains import glue

    return glue.GlueRule(_RULES[task], _num_interactions(task), noise, wait, step_limit)


@functools.cache
def _num_interactions(task: str) -> int:
    """Returns the number of interactions of a task, which takes longer to load than an episode of a rule."""
    from physexp import suite

    return suite.load_task(_NAME, task).num_interactions


@functools.cache
def _seen(task: str):
    """Returns the best policy of an observer of 1 mm, in a task without variation."""
    return _solve(task, {}, DOMAIN.discount, resolution=_COARSE)


def _lookup(task: str) -> "core.Actor":
    """Returns an actor that plays that policy, and takes each tower for the nearest of the 16."""
    return _seen(task).actor()


_BASELINES = {
    task: {"rule": functools.partial(rule, task), "lookup": functools.partial(_lookup, task)} for task in _RULES
}


DOMAIN = base.Domain(
    name=_NAME,
    skill="look for motion",
    presets={task: {"a3c": _A3C[task], "ppo": _PPO[task]} for task in _A3C},
    labels={"direct_features": "D-F", "direct_pixels": "D-P", "fist_features": "F-F", "fist_pixels": "F-P"},
    targets={
        "towers-direct_features": ("mean_return", 0.97),
        "towers-fist_features": ("mean_return", 0.93),
        "towers-direct_pixels": ("mean_return", 0.97),
        "towers-fist_pixels": ("mean_return", 0.93),
    },
    ideal=base.Ideal(_NAME, _solve, IdealOptions),
    baselines=_BASELINES,
    hidden_columns=lambda hidden: {"pattern": hidden},  # An index in `tower.PATTERNS`.
)
