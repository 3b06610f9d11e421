"""The configuration of the belief learner."""

from collections.abc import Mapping
import dataclasses
from typing import ClassVar, Literal, get_args

from physexp import checks
from physexp.agents import config

Memory = Literal["attention", "lstm"]


@dataclasses.dataclass(frozen=True, kw_only=True)
class BeliefConfig(config.AgentConfig):
    """Hyperparameters of the belief learner, the same for all tasks; a value out of range raises ValueError.

    Attributes:
      answers_revealed: learn from the right label, which is told when an episode is over; otherwise from the reward
        alone, as the paper's agents did.
      every_step: learn the belief at every step of an episode; otherwise only at the one that was answered at.
      memory: what a member remembers an episode with: attention looks back at all steps, and an LSTM carries a state.
      num_members: members of the network, each of which learns from all environments but its own share of them, and
        judges what was played there.
      units: units of each of the four heads of the attention; a layer, or an LSTM, has as many as all of them.
      num_environments: environments that play side by side, one episode each between two rounds of learning.
      num_threads: threads for simulation and for convolutions.
      most_interactions: how many interactions an episode has at most; then it is answered.
      greedy: share of the episodes in training that are played as well as the agent can; they say how well that is.
      cut: share of the other episodes that are answered after a number of interactions drawn at random.
      exploration: share of the interactions that are drawn at random in the environment that explores most.
      trace: lambda, how far the return of the greedy actions that followed is believed against the network's values.
      frames_per_step: environment steps for each step of Adam; fewer learn more from each.
      batch_size: episodes in a step of Adam, a multiple of the members.
      replay_episodes: episodes that are kept to learn from; the oldest go.
      dropout: share of what is remembered that the heads learn without; beliefs are less sure of what was seen once.
      weight_decay: each step of Adam shrinks the weights, but not the biases, by this times the learning rate.
      averaging: the network that acts is a moving average of the one that learns; this share stays in each step.
    """

    algorithm: ClassVar[str] = "belief"
    metrics: ClassVar[Mapping[str, str]] = {
        "belief_loss": "cross-entropy of the labels, nats",
        "value_loss": "squared error of the values of interactions",
        "greedy_success_rate": "share of the greedy episodes with the right label",
        "greedy_return": "mean discounted return of the greedy episodes",
        "brier_score": "of the belief in the answer of the last 1024 greedy episodes",
        "calibration_error": "of that belief, expected, in ten bins",
        **config.AgentConfig.metrics,
    }
    allowed: ClassVar[Mapping[str, config.Check]] = {
        **config.AgentConfig.allowed,
        "answers_revealed": checks.flag,
        "every_step": checks.flag,
        "memory": config.one_of(get_args(Memory)),
        "num_members": config.at_least(2, 1_024),
        "units": config.at_least(1, 65_536),
        "num_environments": config.at_least(2, 65_536),
        "num_threads": config.at_least(1, 1_024),
        "most_interactions": config.at_least(1, 10_000),
        "greedy": config.SHARE,
        "cut": config.SHARE,
        "exploration": config.SHARE,
        "trace": config.SHARE,
        "frames_per_step": config.at_least(1),
        "batch_size": config.at_least(1, 65_536),
        "replay_episodes": config.at_least(1, 100_000_000),
        "dropout": config.BELOW_ONE,
        "weight_decay": config.NOT_NEGATIVE,
        "averaging": config.BELOW_ONE,
    }

    frames: int = 100_000
    learning_rate: float = 4e-3
    answers_revealed: bool = False
    every_step: bool = True
    memory: Memory = "attention"
    num_members: int = 4
    units: int = 16
    num_environments: int = 16
    num_threads: int = 1
    most_interactions: int = 8
    greedy: float = 0.25
    cut: float = 0.5
    exploration: float = 0.6
    trace: float = 0.9
    frames_per_step: int = 4
    batch_size: int = 32
    replay_episodes: int = 60_000
    dropout: float = 0.1
    weight_decay: float = 0.02
    averaging: float = 0.99

    @property
    def title(self):
        variants = {
            "revealed": self.answers_revealed,
            "lstm": self.memory == "lstm",
            "last_step": not self.every_step,
            "no_replay": self.replay_episodes == self.num_environments,
        }
        return "_".join([self.algorithm, *(name for name, is_one in variants.items() if is_one)])

    @property
    def advice(self):
        return f"fewer --frames-per-step than {self.frames_per_step}"

    def __post_init__(self):
        super().__post_init__()
        if self.num_environments < self.num_members:
            raise ValueError(
                f"num_environments is {self.num_environments}; give at least num_members, {self.num_members}: "
                "what is played in some of them each member judges"
            )
        if self.batch_size % self.num_members:
            raise ValueError(f"batch_size is {self.batch_size}; give a multiple of num_members, {self.num_members}")
        if self.replay_episodes < self.num_environments:
            raise ValueError(
                f"replay_episodes is {self.replay_episodes}; give at least num_environments, {self.num_environments}: "
                "what has been played is kept until it has been learned from"
            )
