"""The configuration of A3C. Imports nothing heavy, since the command line is made from it."""

import dataclasses
import math
from typing import Literal, get_args

Device = Literal["auto", "cpu", "cuda"]


@dataclasses.dataclass(frozen=True, kw_only=True)
class A3CConfig:
    """What A3C may be told; a value that makes no sense raises ValueError.

    Attributes:
      discount: the agent's gamma: the cost of information (paper, Section 3).
      frames: environment steps to train for.
      seed: seed of everything random: weights, environments, actions.
      num_workers: processes that act and learn asynchronously on shared parameters.
      envs_per_worker: episodes that a worker plays side by side for one update; 1 is the paper's learner.
      learning_rate: step size of Adam, decaying linearly to zero over `frames`.
      entropy_cost: weight of the entropy bonus at the start.
      final_entropy_cost: the same at the end; the decay is exponential over `frames`.
      trace: how far along an episode advantages look for what an action brought (lambda of generalized advantage
        estimation); 1 is the paper's, which looks to the end.
      baseline_cost: weight of the value loss.
      max_gradient_norm: gradients are scaled down to this norm.
      lstm_units: hidden units of the LSTM (paper: 100).
      observation_scale: factor on features, which are in metres, or on pixels in [0, 1]. What matters in them, a
        centimetre or a tenth of a metre, should be of the order of one.
      action_prior: logits that the policy starts from, one for each action, or none for a uniform start; the paper's is
        uniform.
      relative_pixels: show the network how pixels differ from those at an episode's start; False is the paper's.
      device: where convolutions are computed: `cpu`, `cuda`, or `auto` for the GPU where there is one.
      checkpoint_seconds: time between checkpoints, s.

    """

    discount: float = 0.95
    frames: int = 8_000_000
    seed: int = 0
    num_workers: int = 2
    envs_per_worker: int = 256
    learning_rate: float = 5e-3
    entropy_cost: float = 0.15
    final_entropy_cost: float = 0.0001
    trace: float = 1.0
    baseline_cost: float = 0.5
    max_gradient_norm: float = 1.0
    lstm_units: int = 100
    observation_scale: float = 40.0
    action_prior: tuple[float, ...] = ()
    relative_pixels: bool = True
    device: Device = "auto"
    checkpoint_seconds: float = 60.0

    def replace(self, **changes) -> "A3CConfig":
        """A copy with some values changed."""
        return dataclasses.replace(self, **changes)

    def __post_init__(self):
        whole = {"frames": 1, "seed": 0, "num_workers": 1, "envs_per_worker": 1, "lstm_units": 1}
        for name, minimum in whole.items():
            value = getattr(self, name)
            if not isinstance(value, int) or isinstance(value, bool) or not minimum <= value < 2**63:
                raise ValueError(f"{name} is {value!r}; give an integer >= {minimum}")
        positive = ("learning_rate", "max_gradient_norm", "observation_scale", "checkpoint_seconds")
        for name in (*positive, "entropy_cost", "final_entropy_cost", "baseline_cost"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0) or (name in positive and value == 0):
                raise ValueError(f"{name} is {value!r}; give a finite number {'> 0' if name in positive else '>= 0'}")
        if self.device not in get_args(Device):
            raise ValueError(f"device is {self.device!r}; choose from {', '.join(get_args(Device))}")
        if not all(isinstance(logit, (int, float)) and math.isfinite(logit) for logit in self.action_prior):
            raise ValueError(f"action_prior is {self.action_prior!r}; give finite numbers, one for each action")
        if not 0 <= self.trace <= 1:
            raise ValueError(f"trace is {self.trace!r}; give a number in [0, 1]")
        if not 0 < self.discount <= 1:
            raise ValueError(f"discount is {self.discount!r}; give a number in (0, 1]")
