"""The configuration of PPO."""

from collections.abc import Mapping
import dataclasses
from typing import ClassVar

from physexp.agents import config


@dataclasses.dataclass(frozen=True, kw_only=True)
class PPOConfig(config.AgentConfig):
    """What PPO may be told; a value that makes no sense raises ValueError.

    Attributes:
      num_environments: episodes that are played side by side between updates.
      num_threads: threads that simulate, and that compute convolutions.
      num_epochs: how often an update goes through the episodes.
      num_minibatches: parts, of whole episodes, that it goes through them in.
      clip: how far the probability of an action may move in an update, as a factor of 1 + clip or 1 - clip.
    """

    algorithm: ClassVar[str] = "ppo"

    num_environments: int = 256
    num_threads: int = 2
    num_epochs: int = 4
    num_minibatches: int = 4
    clip: float = 0.2

    _WHOLE: ClassVar[Mapping[str, tuple[int, int]]] = {
        **config.AgentConfig._WHOLE, "num_environments": (1, 65_536), "num_threads": (1, 1_024),
        "num_epochs": (1, 1_000), "num_minibatches": (1, 65_536),
    }  # fmt: skip
    _POSITIVE: ClassVar[tuple[str, ...]] = (*config.AgentConfig._POSITIVE, "clip")

    def __post_init__(self):
        super().__post_init__()
        if self.num_minibatches > self.num_environments:
            raise ValueError(f"num_minibatches is {self.num_minibatches}; give at most num_environments, "
                             f"{self.num_environments}: a part has whole episodes")  # fmt: skip
