"""Which is Heavier, as the analysis sees it: presets of its agents, and the paper's names of its conditions."""

from physexp.agents.a3c import config as a3c
from physexp.analysis.domains import base

_DISCOUNT = 0.95

_FEATURES = a3c.A3CConfig(discount=_DISCOUNT, envs_per_worker=128, trace=0.98, observation_scale=80.0)
# Every frame passes the convolutions, which is what pixels cost: small updates, and no frame more than is needed.
_PIXELS = a3c.A3CConfig(
    discount=_DISCOUNT, frames=500_000, envs_per_worker=64, learning_rate=1e-3, trace=0.9, observation_scale=8.0
)

DOMAIN = base.Domain(
    name="which_is_heavier",
    discount=_DISCOUNT,
    presets={
        "features": {"a3c": _FEATURES, "ppo": base.ppo_like(_FEATURES, frames=1_500_000, learning_rate=3e-3)},
        "pixels": {"a3c": _PIXELS, "ppo": base.ppo_like(_PIXELS, learning_rate=5e-4, num_environments=64)},
    },
    labels={"features": "{difficulty:g}-F", "pixels": "{difficulty:g}-P"},
)
