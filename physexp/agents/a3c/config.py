"""The configuration of A3C."""

from collections.abc import Mapping
import dataclasses
from typing import ClassVar

from physexp import checks
from physexp.agents import config
from physexp.checks import checked


@dataclasses.dataclass(frozen=True, kw_only=True)
class A3CConfig(config.ActorCriticConfig):
    """Hyperparameters of A3C; a value out of range raises ValueError."""

    algorithm: ClassVar[str] = "a3c"
    metrics: ClassVar[Mapping[str, str]] = {
        **config.ActorCriticConfig.metrics,
        "staleness": "updates of other workers between reading the parameters and applying the gradient",
    }
    num_workers: int = checked(
        2, checks.whole(1, 10_000), "worker processes, which act and learn asynchronously on shared parameters"
    )
    envs_per_worker: int = checked(
        256,
        checks.whole(1, 65_536),
        "environments of each worker; an update is made from one episode in each. 1 in the paper",
    )

    @property
    def title(self) -> str:
        """Returns the learner's name in names of runs; a variant has its own."""
        hints = (self.initial_logits, self.relative_pixels)
        variants = {
            "paper": self.envs_per_worker == self.gae_lambda == self.observation_scale == 1 and not any(hints),
            "one_worker": self.num_workers == 1,
        }
        return "_".join([self.algorithm, *(name for name, is_one in variants.items() if is_one)])
