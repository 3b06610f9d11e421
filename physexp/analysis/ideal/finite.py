"""Walks through the information states of a question with finitely many hypotheses."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, Protocol

import numpy as np

from physexp.analysis.ideal import base


class States(Protocol):
    """The information states of a question, of any type.

    Attributes:
      num_interactions: number of interactions, A.
      start: the information state at the start.
    """

    num_interactions: int
    start: Any

    def posterior(self, state: Any) -> np.ndarray:
        """Returns the probabilities of the L labels, float64 [L]."""

    def following(self, state: Any, interaction: int) -> Sequence[tuple[float, Any]]:
        """Returns the states that may follow an interaction, with their probabilities; one if it reveals nothing."""

    def represented(self, state: Any) -> Any:
        """Returns the state whose values are used for a state."""

    def allows(self, state: Any, hypothesis: int) -> bool:
        """Returns whether a hypothesis is possible in a state."""


def after(states: States, state: Any, interaction: int, hypothesis: int) -> Any:
    """Returns the state after an interaction if a hypothesis is true."""
    return next(found for _, found in states.following(state, interaction) if states.allows(found, hypothesis))


def visited(states: States, hypothesis: int, actions: Sequence[int] | np.ndarray) -> Iterator[Any]:
    """Yields the states at the start and after each action of an episode, if a hypothesis is true."""
    yield (state := states.start)
    for action in map(int, actions):
        if action < states.num_interactions:  # An answer reveals nothing.
            state = after(states, state, action, hypothesis)
        yield state


def judge(
    states: States, hypothesis: int, actions: np.ndarray, values: Callable[[Any, int, int], np.ndarray]
) -> base.Judgement:
    """Returns the judgement of the T actions of an episode, if a hypothesis is true.

    Args:
      states, hypothesis, actions: as above.
      values: returns the values of all interactions, float64 [A], in a state, given the number of actions before and
        the action taken.
    """
    beliefs, worths, is_informative = [], [], []
    for step, state in enumerate(visited(states, hypothesis, actions)):
        beliefs.append(states.posterior(state))
        if step < len(actions):
            action = int(actions[step])
            worths.append(np.append(values(state, step, action), base.answer_values(beliefs[-1])))
            is_informative.append(action < states.num_interactions and len(states.following(state, action)) > 1)
    return base.Judgement(np.array(beliefs), np.array(worths), np.array(is_informative))
