"""The configuration of PPO."""

import dataclasses
from typing import ClassVar

from physexp import checks
from physexp.agents import config
from physexp.checks import checked


@dataclasses.dataclass(frozen=True, kw_only=True)
class PPOConfig(config.ActorCriticConfig):
    """Hyperparameters of PPO; a value out of range raises ValueError."""

    algorithm: ClassVar[str] = "ppo"

    num_environments: int = checked(
        256, checks.whole(1, 65_536), "environments; an update is made from one episode in each"
    )
    num_threads: int = checked(2, checks.whole(1, 1_024), "threads for simulation and for convolutions")
    num_minibatches: int = checked(4, checks.whole(1, 65_536), "minibatches of whole episodes in each epoch")

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.num_minibatches > self.num_environments:
            raise ValueError(
                f"num_minibatches is {self.num_minibatches}; give at most num_environments, "
                f"{self.num_environments}: a minibatch has whole episodes"
            )
