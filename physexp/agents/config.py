"""The hyperparameters that all agents share. Imports nothing heavy, since the command line is made from it."""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
import functools
from typing import Any, ClassVar, Literal, Self, get_args

from physexp import checks

Device = Literal["auto", "cpu", "cuda"]
Check = Callable[[str, Any], Any]
"""Takes an option's name and value; returns the value as Python's own, or raises ValueError."""

POSITIVE: Check = functools.partial(checks.number, minimum=0, strictly=True)
NOT_NEGATIVE: Check = functools.partial(checks.number, minimum=0)
SHARE: Check = functools.partial(checks.between, minimum=0, maximum=1)
BELOW_ONE: Check = functools.partial(checks.between, minimum=0, maximum=1, without=1)


def at_least(minimum: int, maximum: int = checks.LARGEST) -> Check:
    """Returns a check for integers."""
    return functools.partial(checks.integer, minimum=minimum, maximum=maximum)


def one_of(choices: Sequence[str]) -> Check:
    """Returns a check for words."""

    def check(name: str, value) -> str:
        if value in choices:
            return value
        raise ValueError(f"{name} is {checks.shown(value)}; choose from {', '.join(choices)}")

    return check


def logits(name: str, value) -> tuple[float, ...]:
    """Checks finite numbers, one for each action."""
    if isinstance(value, (tuple, list)) and all(map(checks.is_number, value)):
        return tuple(map(float, value))
    raise ValueError(f"{name} is {checks.shown(value)}; give finite numbers, one for each action")


@dataclasses.dataclass(frozen=True, kw_only=True)
class AgentConfig:
    """Hyperparameters that every agent has; a value out of range raises ValueError.

    Attributes:
      discount: the agent's discount factor gamma, which is the cost of information (paper, Section 3).
      frames: environment steps to train for.
      seed: random seed of weights, environments and actions.
      learning_rate: Adam's initial learning rate; it decays linearly to zero over training.
      max_gradient_norm: gradients are clipped to this norm.
      device: where convolutions are computed: cpu, cuda, or auto for the GPU where there is one.
      checkpoint_seconds: time between checkpoints, s.
    """

    algorithm: ClassVar[str]
    """The learner's name."""
    metrics: ClassVar[Mapping[str, str]] = {"gradient_norm": "before clipping", "learning_rate": ""}
    """Names of what the learner measures in each update, and what they mean where the name does not say it."""
    allowed: ClassVar[Mapping[str, Check]] = {
        "discount": checks.discount,
        "frames": at_least(1),
        "seed": at_least(0),
        "learning_rate": POSITIVE,
        "max_gradient_norm": POSITIVE,
        "device": one_of(get_args(Device)),
        "checkpoint_seconds": POSITIVE,
    }
    """What each hyperparameter may be."""

    discount: float = 0.95
    frames: int = 8_000_000
    seed: int = 0
    learning_rate: float = 5e-3
    max_gradient_norm: float = 1.0
    device: Device = "auto"
    checkpoint_seconds: float = 60.0

    def replace(self, **changes) -> Self:
        """Returns a copy with some values changed."""
        return dataclasses.replace(self, **changes)

    def progress(self, frames: int) -> float:
        """Returns the share of training that is done after some frames, 1 where it went on for longer."""
        return min(1.0, frames / self.frames)

    def learning_rate_at(self, frames: int) -> float:
        """Returns the step size after some frames."""
        return self.learning_rate * (1 - self.progress(frames))

    @property
    def title(self) -> str:
        """Returns the learner's name in names of runs; a variant has its own."""
        return self.algorithm

    @property
    def advice(self) -> str:
        """Returns, in words, what to try when an agent has learned nothing."""
        return f"a smaller --learning-rate than {self.learning_rate:g}"

    @property
    def num_workers(self) -> int:
        """Returns how many processes act and learn."""
        return 1

    def __post_init__(self):
        for name, check in self.allowed.items():
            object.__setattr__(self, name, check(name, getattr(self, name)))


@dataclasses.dataclass(frozen=True, kw_only=True)
class ActorCriticConfig(AgentConfig):
    """Hyperparameters of a recurrent actor-critic; a value out of range raises ValueError.

    Attributes:
      entropy_cost: initial weight of the entropy bonus.
      final_entropy_cost: final weight of the entropy bonus; the decay is exponential, or linear to 0.
      relative_entropy: regularize the policy towards the action prior (KL divergence) instead of towards the uniform
        policy, as in the paper.
      trace: lambda of generalized advantage estimation; 1, as in the paper, is Monte Carlo returns minus the baseline.
      baseline_cost: weight of the value loss.
      lstm_units: hidden units of the LSTM (paper: 100).
      observation_scale: factor on features (m) or on pixels in [0, 1]; choose it so that what matters in them is of the
        order of one.
      action_prior: initial logits of the policy, one for each action; none for a uniform policy, as in the paper.
      relative_pixels: subtract the image at the start of episodes from every image; False is the paper's.
    """

    metrics: ClassVar[Mapping[str, str]] = {
        "entropy": "mean entropy of the policy, nats",
        "policy_loss": "",
        "baseline_loss": "",
        **AgentConfig.metrics,
        "entropy_cost": "",
    }
    allowed: ClassVar[Mapping[str, Check]] = {
        **AgentConfig.allowed,
        "entropy_cost": NOT_NEGATIVE,
        "final_entropy_cost": NOT_NEGATIVE,
        "relative_entropy": checks.flag,
        "trace": SHARE,
        "baseline_cost": NOT_NEGATIVE,
        "lstm_units": at_least(1, 65_536),
        "observation_scale": POSITIVE,
        "action_prior": logits,
        "relative_pixels": checks.flag,
    }

    entropy_cost: float = 0.15
    final_entropy_cost: float = 0.0001
    relative_entropy: bool = False
    trace: float = 1.0
    baseline_cost: float = 0.5
    lstm_units: int = 100
    observation_scale: float = 40.0
    action_prior: tuple[float, ...] = ()
    relative_pixels: bool = True

    @property
    def advice(self):
        return f"a larger --entropy-cost than {self.entropy_cost:g}"

    @property
    def entropy_prior(self) -> tuple[float, ...]:
        """Returns what the entropy bonus is relative to, logits of the actions; none for the uniform policy."""
        return self.action_prior if self.relative_entropy else ()

    def at(self, frames: int) -> tuple[float, float]:
        """Returns step size and weight of the entropy bonus after some frames."""
        progress = self.progress(frames)
        if self.entropy_cost and self.final_entropy_cost:
            entropy_cost = self.entropy_cost ** (1 - progress) * self.final_entropy_cost**progress
        else:
            entropy_cost = self.entropy_cost * (1 - progress)
        return self.learning_rate_at(frames), entropy_cost


def shown(value: Any) -> str:
    """Returns an option's value in the shortest words that mean it to the last digit: 5 for 5.0."""
    if not checks.is_float(value):
        return str(value)
    short = f"{value:g}"
    return short if float(short) == value else str(value)
