"""How the ideal experimenter fares on the instances of the protocol."""

import dataclasses
import functools

import numpy as np

from physexp.agents import core
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import episodes, protocol


@dataclasses.dataclass(frozen=True)
class Reference:
    """Means over the first episodes of a task.

    Attributes:
      interactions: of an episode.
      bits: of information about the answer, for each interaction; 0 where there is none.
    """

    interactions: float
    bits: float


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
    found = np.array([_play(environment, actor, solution, one) for one in hidden])
    environment.close()
    interactions, bits = counts @ found / num_episodes
    return Reference(float(interactions), float(bits / interactions) if interactions else 0.0)


def _play(environment, actor: core.Actor, solution: ideal_base.Solution, hidden: np.ndarray) -> tuple[int, float]:
    """Plays an episode; returns interactions, and bits in all."""
    action: int | None = None

    def act(step: int, timestep) -> int:
        nonlocal action
        episodes.show(actor, action, timestep)
        action = int(actor.select_action(timestep.observation))
        return action

    played = episodes.play(environment, act, hidden=hidden)
    bits = mistakes.information(solution.beliefs(played))
    return len(played.actions) - 1, float(bits.sum())
