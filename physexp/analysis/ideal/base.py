"""The interface of all ideal experimenters."""

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np

from physexp.agents import core
from physexp.suite.engine import checks


class Episode(Protocol):
    """A recorded episode of T actions.

    Attributes:
      hidden: the hidden property, [...].
      actions: int64 [T].
      observations: for each name, what was seen before each action and at the end, [T + 1, ...].
    """

    @property
    def hidden(self) -> np.ndarray: ...

    @property
    def actions(self) -> np.ndarray: ...

    @property
    def observations(self) -> Mapping[str, np.ndarray]: ...


class Solution(Protocol):
    """The best policy for a question, and what it is worth.

    Attributes:
      value: its expected discounted return from an episode's start.
      bound: an upper bound on any experimenter's; equal to the value where that is exact.
    """

    @property
    def value(self) -> float: ...

    @property
    def bound(self) -> float: ...

    def actor(self) -> core.Actor:
        """Returns an actor that plays the policy in the real environment, from observations alone.

        Raises:
          ValueError: if it cannot be played from what the task observes.
        """

    def beliefs(self, episode: Episode) -> np.ndarray:
        """Returns what could be believed at the start and after each action: of each label, float64 [T + 1, L]."""

    def summary(self) -> dict[str, Any]:
        """Returns figures by name: `value`, `accuracy`, `mean_interactions`, `histogram`, and the family's own.

        The histogram is the share of episodes for each number of interactions.
        """


def check_discount(discount) -> float:
    """Returns `discount` as a float.

    Raises:
      ValueError: if it is no number in (0, 1].
    """
    if not (isinstance(discount, (int, float)) and 0 < discount <= 1):
        raise ValueError(f"discount is {checks.shown(discount)}; give a number in (0, 1]")
    return float(discount)
