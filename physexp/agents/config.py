"""The hyperparameters that all agents share. Imports nothing heavy, since the command line is made from it."""

from collections.abc import Mapping
import dataclasses
from typing import Any, ClassVar, Literal, Self, get_args

from physexp import checks
from physexp.checks import checked

Device = Literal["auto", "cpu", "cuda"]


def logits(name: str, value: Any) -> tuple[float, ...]:
    """Checks finite numbers, one for each action."""
    if isinstance(value, (tuple, list)) and all(map(checks.is_number, value)):
        return tuple(map(float, value))
    raise ValueError(f"{name} is {checks.shown(value)}; give finite numbers, one for each action")


@dataclasses.dataclass(frozen=True, kw_only=True)
class AgentConfig:
    """Hyperparameters of every agent; a value out of range raises ValueError."""

    algorithm: ClassVar[str]
    """The learner's name."""
    metrics: ClassVar[Mapping[str, str]] = {"gradient_norm": "before clipping", "learning_rate": ""}
    """Names of the learner's metrics, and their meaning if the name does not say it."""

    discount: float = checked(
        0.95, checks.discount, "discount factor gamma, which is the cost of information (paper, Section 3)"
    )
    frames: int = checked(8_000_000, checks.whole(1), "environment steps to train for")
    seed: int = checked(0, checks.whole(0), "random seed of weights, environments and actions")
    device: Device = checked(
        "auto",
        checks.word(*get_args(Device)),
        "device for convolutions: cpu, cuda, or auto for a GPU if there is one",
    )
    checkpoint_seconds: float = checked(60.0, checks.above(0), "time between checkpoints, s")

    def replace(self, **changes: Any) -> Self:
        """Returns a copy with some values changed."""
        return dataclasses.replace(self, **changes)

    def progress(self, frames: int) -> float:
        """Returns the share of training that is done after some frames, at most 1."""
        return min(1.0, frames / self.frames)

    @property
    def title(self) -> str:
        """Returns the learner's name in names of runs; a variant has its own."""
        return self.algorithm

    @property
    def advice(self) -> str:
        """Returns advice for an agent that has learned nothing."""
        raise NotImplementedError

    @property
    def num_workers(self) -> int:
        """Returns how many processes act and learn."""
        return 1

    def __post_init__(self) -> None:
        checks.check_fields(self)


@dataclasses.dataclass(frozen=True, kw_only=True)
class ActorCriticConfig(AgentConfig):
    """Hyperparameters of a recurrent actor-critic; a value out of range raises ValueError."""

    metrics: ClassVar[Mapping[str, str]] = {
        "entropy": "mean entropy of the policy, nats",
        "policy_loss": "",
        "baseline_loss": "",
        **AgentConfig.metrics,
        "entropy_cost": "",
    }

    learning_rate: float = checked(
        5e-3, checks.above(0), "Adam's initial learning rate; it decays linearly to zero over training"
    )
    entropy_cost: float = checked(0.15, checks.at_least(0), "initial weight of the entropy bonus")
    final_entropy_cost: float = checked(
        0.0001, checks.at_least(0), "final weight of the entropy bonus; the decay is exponential, or linear to 0"
    )
    kl_to_prior: bool = checked(
        False, checks.flag, "regularize the policy towards initial_logits instead of the uniform policy"
    )
    gae_lambda: float = checked(
        1.0,
        checks.within(0, 1),
        "lambda of generalized advantage estimation; 1, as in the paper, is Monte Carlo returns minus the baseline",
    )
    baseline_cost: float = checked(0.5, checks.at_least(0), "weight of the value loss")
    observation_scale: float = checked(
        40.0,
        checks.above(0),
        "factor on features (m) or on pixels in [0, 1]; their changes should be about one",
    )
    initial_logits: tuple[float, ...] = checked(
        (), logits, "initial logits of the policy, one for each action; none for a uniform policy, as in the paper"
    )
    relative_pixels: bool = checked(
        True, checks.flag, "subtract the image at the start of episodes from every image; False is the paper's"
    )

    @property
    def advice(self) -> str:
        """Returns advice for an agent that has learned nothing."""
        return f"a larger --entropy-cost than {self.entropy_cost:g}"

    @property
    def entropy_prior(self) -> tuple[float, ...]:
        """Returns the logits that the entropy bonus is relative to; none for the uniform policy."""
        return self.initial_logits if self.kl_to_prior else ()

    def at(self, frames: int) -> tuple[float, float]:
        """Returns the learning rate and the weight of the entropy bonus after some frames."""
        progress = self.progress(frames)
        if self.entropy_cost and self.final_entropy_cost:
            entropy_cost = self.entropy_cost ** (1 - progress) * self.final_entropy_cost**progress
        else:
            entropy_cost = self.entropy_cost * (1 - progress)
        return self.learning_rate * (1 - progress), entropy_cost


def shown(value: Any) -> str:
    """Returns an option's value in the shortest words that mean it to the last digit: 5 for 5.0."""
    if not checks.is_float(value):
        return str(value)
    short = f"{value:g}"
    return short if float(short) == value else str(value)
