"""Reference values of a score: statistics of the ideal experimenter on the same instances, and the return of chance."""

import dataclasses
import functools

import numpy as np

from physexp.analysis.ideal import mistakes
from physexp.analysis.score import episodes, protocol
from physexp.suite.engine import rules


@dataclasses.dataclass(frozen=True)
class Reference:
    """Means over the first episodes of a task.

    Attributes:
      interactions: in an episode.
      gains: bits of information about the answer from the first interaction, the second and so on, 0 after the end of
        an episode, float64 [K].
    """

    interactions: float
    gains: np.ndarray

    @property
    def bits_per_interaction(self) -> float:
        """Mean information from an interaction; 0 if there are none."""
        return float(self.gains.sum() / self.interactions) if self.interactions else 0.0


@functools.cache
def of(question: protocol.Question, num_episodes: int) -> Reference | None:
    """Plays the ideal experimenter; returns None if it cannot play from the observations of the task.

    The hidden property determines how it plays, so it plays one episode of each.
    """
    solution = protocol.ideal(question)
    try:
        actor = solution.actor()
    except ValueError:
        return None
    drawn = protocol.drawn(question, num_episodes)
    _, first, counts = np.unique(drawn, axis=0, return_index=True, return_counts=True)
    environment = protocol.load(question)
    played = [episodes.play(environment, actor, int(number)) for number in first]
    environment.close()
    gains = [mistakes.information(solution.beliefs(episode))[:-1] for episode in played]
    lengths = np.array([len(bits) for bits in gains])
    padded = np.array([np.pad(bits, (0, lengths.max() - len(bits))) for bits in gains])
    return Reference(float(counts @ lengths / num_episodes), counts @ padded / num_episodes)


def random_return(question: protocol.Question) -> float:
    """Returns the expected return of uniformly random actions; one of the L answers is right in each episode."""
    num_labels = question.num_actions - question.num_interactions
    goes_on = question.num_interactions / question.num_actions
    steps = np.arange(question.step_limit)
    answer = rules.WRONG + (rules.RIGHT - rules.WRONG) / num_labels
    answered = np.sum((question.discount * goes_on) ** steps) * (1 - goes_on) * answer
    return float(answered + question.discount ** steps[-1] * goes_on**question.step_limit * rules.WRONG)
