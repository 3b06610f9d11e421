"""The configuration of A3C."""

from collections.abc import Mapping
import dataclasses
from typing import ClassVar

from physexp.agents import config


@dataclasses.dataclass(frozen=True, kw_only=True)
class A3CConfig(config.AgentConfig):
    """What A3C may be told; a value that makes no sense raises ValueError.

    Attributes:
      num_workers: processes that act and learn asynchronously on shared parameters.
      envs_per_worker: episodes that a worker plays side by side for one update; 1 is the paper's learner.
      max_staleness: updates of others after which a gradient is too old to be applied.
    """

    algorithm: ClassVar[str] = "a3c"

    num_workers: int = 2
    envs_per_worker: int = 256
    max_staleness: int = 100

    _WHOLE: ClassVar[Mapping[str, tuple[int, int]]] = {
        **config.AgentConfig._WHOLE, "num_workers": (1, 10_000), "envs_per_worker": (1, 65_536),
        "max_staleness": (0, config.LARGEST),
    }  # fmt: skip
