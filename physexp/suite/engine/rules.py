"""The rules that all questions share (paper, Section 3): interaction actions, numbered from 0, act on the world.

The labeling actions that follow answer the question. The last answer ends the episode; an answer before it takes no
simulated time, and the next question follows. When time runs out, every question that is left counts as a wrong answer.
"""

import dataclasses
from typing import Any

import numpy as np

from physexp import checks

RIGHT, WRONG = 1.0, -1.0


@dataclasses.dataclass(frozen=True)
class Rules:
    """How actions are read.

    Attributes:
      num_interactions: number of interaction actions.
      num_labels: number of labeling actions.
      step_limit: control steps after which an unanswered episode ends.
      num_questions: questions in an episode.
    """

    num_interactions: int
    num_labels: int
    step_limit: int
    num_questions: int = 1

    @property
    def num_actions(self) -> int:
        return self.num_interactions + self.num_labels

    def check_type(self, actions: Any, shape: tuple[int, ...]) -> np.ndarray:
        """Returns `actions` as an array; raises ValueError unless it holds integers in the given shape."""
        try:
            array = np.asarray(actions)
        except ValueError:
            kind = "lists of different lengths"
        else:
            if array.shape == shape and array.dtype.kind in "iu":
                return array
            kind = f"shape {array.shape}, {array.dtype}"
        raise ValueError(
            f"action is {checks.shown(actions)} ({kind}); "
            f"give integers of shape {shape} from 0 to {self.num_actions - 1}"
        )

    def check_range(self, actions: np.ndarray) -> None:
        """Raises ValueError unless every action is one of `num_actions`."""
        if actions.size and (actions.min() < 0 or actions.max() >= self.num_actions):
            bad = actions[(actions < 0) | (actions >= self.num_actions)].flat[0]
            raise ValueError(
                f"action is {bad}; allowed are 0 to {self.num_interactions - 1} (interact) and "
                f"{self.num_interactions} to {self.num_actions - 1} (label)"
            )
