"""The configuration of PPO."""

from collections.abc import Mapping
import dataclasses
from typing import ClassVar

from physexp.agents import config


@dataclasses.dataclass(frozen=True, kw_only=True)
class PPOConfig(config.ActorCriticConfig):
    """Hyperparameters of PPO; a value out of range raises ValueError.

    Attributes:
      num_environments: environments; an update is made from one episode in each.
      num_threads: threads for simulation and for convolutions.
      num_epochs: passes over the episodes in each update.
      num_minibatches: minibatches of whole episodes in each pass.
      clip: the probability ratio is clipped to [1 - clip, 1 + clip].
    """

    algorithm: ClassVar[str] = "ppo"
    allowed: ClassVar[Mapping[str, config.Check]] = {
        **config.ActorCriticConfig.allowed,
        "num_environments": config.at_least(1, 65_536),
        "num_threads": config.at_least(1, 1_024),
        "num_epochs": config.at_least(1, 1_000),
        "num_minibatches": config.at_least(1, 65_536),
        "clip": config.POSITIVE,
    }

    num_environments: int = 256
    num_threads: int = 2
    num_epochs: int = 4
    num_minibatches: int = 4
    clip: float = 0.2

    def __post_init__(self):
        super().__post_init__()
        if self.num_minibatches > self.num_environments:
            raise ValueError(
                f"num_minibatches is {self.num_minibatches}; give at most num_environments, "
                f"{self.num_environments}: a part has whole episodes"
            )
