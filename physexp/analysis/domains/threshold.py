"""Threshold, as the analysis sees it: presets of its agents."""

from physexp.agents.a3c import config as a3c
from physexp.analysis.domains import base

_DISCOUNT = 0.95

_FEATURES = a3c.A3CConfig(discount=_DISCOUNT, envs_per_worker=128, trace=0.95, observation_scale=2.0)

DOMAIN = base.Domain(
    name="threshold",
    discount=_DISCOUNT,
    presets={"features": {"a3c": _FEATURES}},
)
