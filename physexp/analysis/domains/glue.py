"""An experimenter for Towers that nobody trained: cubes whose distance changes are not glued."""

from collections.abc import Sequence

import numpy as np

from physexp.agents import core

_CHANGE = 0.001  # m; contacts give way by a hundredth of it, and glued cubes by nothing.
_DEVIATIONS = 8  # Of noise, that are taken for no change.


class GlueRule(core.Actor):
    """Holds neighbours for glued while their distance has not changed by a millimetre.

    It repeats its interactions until the tower has moved and a control step has separated no more neighbours; then it
    answers with the number of bodies that it has seen.
    """

    def __init__(self, interactions: Sequence[int], num_interactions: int, noise: float = 0.0, wait: int | None = None):
        """Sets what it does.

        Args:
          interactions: those that it repeats.
          num_interactions: how many there are.
          noise: standard deviation of readings, m.
          wait: after how many interactions it answers, whatever it has seen; by default it decides that as above.
        """
        self._wait = wait
        self._interactions, self._num_interactions = tuple(interactions), num_interactions
        self._change = _CHANGE + _DEVIATIONS * noise

    def observe_first(self, timestep):
        self._first = timestep.observation["positions"].astype(float)
        self._are_apart = np.zeros(len(self._first) - 1, bool)
        self._has_moved = self._is_settled = False
        self._step = 0

    def select_action(self, observation) -> int:
        if self._is_settled:
            return self._num_interactions + int(self._are_apart.sum())
        return self._interactions[self._step % len(self._interactions)]

    def observe(self, action, next_timestep):
        self._step += 1
        positions = next_timestep.observation["positions"].astype(float)
        changes = np.abs(_distances(positions) - _distances(self._first))
        are_apart = self._are_apart | (changes > self._change)
        is_still = self._has_moved and bool((are_apart == self._are_apart).all())
        self._is_settled = is_still if self._wait is None else self._step >= self._wait
        self._has_moved |= bool((np.linalg.norm(positions - self._first, axis=-1) > self._change).any())
        self._are_apart = are_apart


def _distances(positions):
    """Returns the distances of neighbours, [4], of the centres of a tower's cubes, [5, 3]."""
    return np.linalg.norm(np.diff(positions, axis=0), axis=-1)
