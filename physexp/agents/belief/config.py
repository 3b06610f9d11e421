"""The configuration of the belief learner."""

from collections.abc import Mapping
import dataclasses
from typing import ClassVar, Literal, get_args

from physexp import checks
from physexp.agents import config
from physexp.checks import checked

NUM_ENVIRONMENTS = 16
"""Environments that play side by side, one episode each between two rounds of learning."""

_MOST_UPDATES = 75_000  # With foresight.

Memory = Literal["attention", "lstm"]


@dataclasses.dataclass(frozen=True, kw_only=True)
class BeliefConfig(config.AgentConfig):
    """Hyperparameters of the belief learner, the same for all tasks; a value out of range raises ValueError."""

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

    frames: int = 100_000
    answers_revealed: bool = checked(
        False,
        checks.flag,
        "learn from the right label, revealed after the episode; otherwise from the reward alone, as in the paper",
    )
    every_step: bool = checked(
        True, checks.flag, "learn the belief at every step of an episode; otherwise only at the last one"
    )
    memory: Memory = checked(
        "attention",
        checks.word(*get_args(Memory)),
        "memory of an episode: attention looks back at all steps, and an LSTM carries a state",
    )
    foresight: bool = checked(
        False,
        checks.flag,
        "the belief adds up the evidence of all steps, and is learned at the last one unless answers are revealed; "
        "members learn to foresee observations; and some episodes of training begin with a random interaction",
    )
    max_interactions: int = checked(
        8,
        checks.whole(1, 10_000),
        "interactions of an episode at most; then it answers; with foresight, at least as many as rule out all answers "
        "but one",
    )
    frames_per_update: int = checked(
        4,
        checks.whole(1),
        "environment steps for each step of Adam; fewer learn more from each; with foresight, more if training would "
        f"have over {_MOST_UPDATES:,} steps of Adam",
    )
    replay_episodes: int = checked(
        60_000, checks.whole(NUM_ENVIRONMENTS, 100_000_000), "episodes that are kept to learn from; the oldest go"
    )
    num_threads: int = checked(1, checks.whole(1, 1_024), "threads for simulation and for convolutions")

    @property
    def title(self) -> str:
        """Returns the learner's name in names of runs; a variant has its own."""
        variants = {
            "revealed": self.answers_revealed,
            "foresight": self.foresight,
            "lstm": self.memory == "lstm",
            "last_step": not self.every_step,
            "no_replay": self.replay_episodes == NUM_ENVIRONMENTS,
        }
        return "_".join([self.algorithm, *(name for name, is_one in variants.items() if is_one)])

    @property
    def advice(self) -> str:
        """Returns advice for an agent that has learned nothing."""
        return f"fewer --frames-per-update than {self.period}"

    @property
    def period(self) -> int:
        """Returns the environment steps for each step of Adam."""
        return max(self.frames_per_update, self.frames // _MOST_UPDATES if self.foresight else 0)

    @property
    def learns_every_step(self) -> bool:
        """Returns whether the belief is learned at every step of an episode."""
        return self.every_step and (self.answers_revealed or not self.foresight)

    def longest(self, num_labels: int, step_limit: int) -> int:
        """Returns the interactions that an episode may have, at least one: an answer has to follow them in time."""
        return min(max(self.max_interactions, num_labels - 1 if self.foresight else 0), max(1, step_limit - 1))
