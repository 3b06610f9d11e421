"""What a score stands beside: how the ideal experimenter fares on the same instances, and what is earned at random."""

import dataclasses
import functools

import numpy as np

from physexp.agents import core
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import episodes, protocol
from physexp.suite.engine import rules


@dataclasses.dataclass(frozen=True)
class Reference:
    """Means over the first episodes of a task.

    Attributes:
      interactions: of an episode.
      gains: bits of information about the answer from the first interaction, the second and so on; none once an
        episode is over. float64 [K].
    """

    interactions: float
    gains: np.ndarray

    @property
    def bits_per_interaction(self) -> float:
        """Returns 0 where there is no interaction."""
        return float(self.gains.sum() / self.interactions) if self.interactions else 0.0


@functools.cache
def of(asked: protocol.Question, num_episodes: int) -> Reference | None:
    """Plays the ideal experimenter; returns None where it cannot play from what is observed.

    What is hidden decides how it plays, so that it plays each hidden property once.
    """
    solution = protocol.ideal(asked)
    try:
        actor = solution.actor()
    except ValueError:
        return None
    hidden, counts = np.unique(protocol.drawn(asked, num_episodes), axis=0, return_counts=True)
    environment = protocol.load(asked)
    played = [_play(environment, actor, solution, one) for one in hidden]
    environment.close()
    lengths = np.array([len(gains) for gains in played])
    padded = np.array([np.pad(gains, (0, lengths.max() - len(gains))) for gains in played])
    return Reference(float(counts @ lengths / num_episodes), counts @ padded / num_episodes)


def _play(environment, actor: core.Actor, solution: ideal_base.Solution, hidden: np.ndarray) -> np.ndarray:
    """Plays an episode; returns the bits that each interaction brought."""
    played = episodes.play(environment, episodes.chosen_by(actor), hidden=hidden)
    return mistakes.information(solution.beliefs(played))[:-1]


def random_return(asked: protocol.Question) -> float:
    """Returns what is expected of actions that are all alike likely: one answer of L is right, whatever is hidden."""
    num_labels = asked.num_actions - asked.num_interactions
    goes_on = asked.num_interactions / asked.num_actions
    steps = np.arange(asked.step_limit)
    answer = rules.WRONG + (rules.RIGHT - rules.WRONG) / num_labels
    answered = np.sum((asked.discount * goes_on) ** steps) * (1 - goes_on) * answer
    return float(answered + asked.discount ** steps[-1] * goes_on**asked.step_limit * rules.WRONG)
