"""The hyperparameters that all agents share. Imports nothing heavy, since the command line is made from it."""

from collections.abc import Mapping
import dataclasses
import math
import numbers
from typing import Any, ClassVar, Literal, Self, get_args

Device = Literal["auto", "cpu", "cuda"]
LARGEST = 2**63 - 1
"""The largest integer that a checkpoint can hold."""


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
    can_run_on_cluster: ClassVar[bool] = False
    """Whether its workers may be spread over machines."""

    discount: float = 0.95
    frames: int = 8_000_000
    seed: int = 0
    learning_rate: float = 5e-3
    max_gradient_norm: float = 1.0
    device: Device = "auto"
    checkpoint_seconds: float = 60.0

    _WHOLE: ClassVar[Mapping[str, tuple[int, int]]] = {  # With what they are at least and at most.
        "frames": (1, LARGEST),
        "seed": (0, LARGEST),
    }
    _POSITIVE: ClassVar[tuple[str, ...]] = ("learning_rate", "max_gradient_norm", "checkpoint_seconds")
    _NOT_NEGATIVE: ClassVar[tuple[str, ...]] = ()
    _SHARES: ClassVar[tuple[str, ...]] = ()  # From 0 to 1.
    _BELOW_ONE: ClassVar[tuple[str, ...]] = ()  # From 0 to less than 1.
    _FLAGS: ClassVar[tuple[str, ...]] = ()
    _CHOICES: ClassVar[Mapping[str, tuple[str, ...]]] = {"device": get_args(Device)}

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
        for field in dataclasses.fields(self):
            object.__setattr__(self, field.name, as_python(getattr(self, field.name)))
        for name, (least, most) in self._WHOLE.items():
            value = getattr(self, name)
            if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
                raise ValueError(f"{name} is {value!r}; give an integer >= {least} and <= {most}")
        for name in (*self._POSITIVE, *self._NOT_NEGATIVE):
            value, positive = getattr(self, name), name in self._POSITIVE
            if not is_number(value) or value < 0 or (positive and value == 0):
                raise ValueError(f"{name} is {value!r}; give a finite number {'> 0' if positive else '>= 0'}")
        for name in (*self._SHARES, *self._BELOW_ONE):
            value, below = getattr(self, name), name in self._BELOW_ONE
            if not is_number(value) or not 0 <= value <= 1 or (below and value == 1):
                raise ValueError(f"{name} is {value!r}; give a number in [0, 1{')' if below else ']'}")
        for name in self._FLAGS:
            if not isinstance(getattr(self, name), bool):
                raise ValueError(f"{name} is {getattr(self, name)!r}; give True or False")
        for name, choices in self._CHOICES.items():
            if getattr(self, name) not in choices:
                raise ValueError(f"{name} is {getattr(self, name)!r}; choose from {', '.join(choices)}")
        if not is_number(self.discount) or not 0 < self.discount <= 1:
            raise ValueError(f"discount is {self.discount!r}; give a number in (0, 1]")


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

    entropy_cost: float = 0.15
    final_entropy_cost: float = 0.0001
    relative_entropy: bool = False
    trace: float = 1.0
    baseline_cost: float = 0.5
    lstm_units: int = 100
    observation_scale: float = 40.0
    action_prior: tuple[float, ...] = ()
    relative_pixels: bool = True

    _WHOLE: ClassVar[Mapping[str, tuple[int, int]]] = {**AgentConfig._WHOLE, "lstm_units": (1, 65_536)}
    _POSITIVE: ClassVar[tuple[str, ...]] = (*AgentConfig._POSITIVE, "observation_scale")
    _NOT_NEGATIVE: ClassVar[tuple[str, ...]] = ("entropy_cost", "final_entropy_cost", "baseline_cost")
    _SHARES: ClassVar[tuple[str, ...]] = ("trace",)
    _FLAGS: ClassVar[tuple[str, ...]] = ("relative_entropy", "relative_pixels")

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

    def __post_init__(self):
        super().__post_init__()
        if not isinstance(self.action_prior, tuple) or not all(map(is_number, self.action_prior)):
            raise ValueError(f"action_prior is {self.action_prior!r}; give finite numbers, one for each action")


def as_python(value: Any) -> Any:
    """Returns a number of another kind, such as NumPy's, as Python's own, which JSON can hold; all else as it is."""
    if not isinstance(value, numbers.Real) or isinstance(value, (int, float)):
        return value
    return int(value) if isinstance(value, numbers.Integral) else float(value)


def is_number(value) -> bool:
    """Returns whether a value is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def shown(value: Any) -> str:
    """Returns an option's value in the shortest words that mean it to the last digit: 5 for 5.0."""
    if not isinstance(value, float):
        return str(value)
    short = f"{value:g}"
    return short if float(short) == value else str(value)
