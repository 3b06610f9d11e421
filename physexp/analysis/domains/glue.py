"""A hand-written baseline for Towers: neighbouring cubes whose distance changes are not glued."""

from collections.abc import Sequence
import math

import numpy as np

from physexp.agents import core

# m. Distances of glued cubes change by at most 0.04 um, by rounding to float32. Distances of other neighbours change by
# more at the first touch in all but one of 20,000 towers with variation.
_CHANGE = 1e-7
_DEVIATIONS = 8  # Standard deviations of the noise that count as no change.


class GlueRule(core.EpisodicActor):
    """Takes neighbours for glued until their distance changes.

    It repeats its interactions until a cube has moved, then answers with the number of bodies. With noise, it waits
    until a control step separates no further neighbours. In the last step before the time limit it always answers.
    """

    def __init__(
        self,
        interactions: Sequence[int],
        num_interactions: int,
        noise: float = 0.0,
        wait: int | None = None,
        step_limit: float = math.inf,
    ):
        """Makes the rule.

        Args:
          interactions: the interactions to repeat, in turn, of `num_interactions`.
          num_interactions, step_limit: of the task.
          noise: standard deviation of readings, m.
          wait: number of interactions before the answer; by default, as described above.
        """
        self._wait, self._is_noisy, self._step_limit = wait, noise > 0, step_limit
        self._interactions, self._num_interactions = tuple(interactions), num_interactions
        self._change = _CHANGE + _DEVIATIONS * noise

    def _begin(self, timestep):
        self._first = timestep.observation["positions"].astype(float)
        self._are_apart = np.zeros(len(self._first) - 1, bool)
        self._has_moved = self._is_settled = False
        self._step = 0

    def _choose(self, observation) -> int:
        if self._is_settled or self._step + 1 >= self._step_limit:
            return self._num_interactions + int(self._are_apart.sum())
        return self._interactions[self._step % len(self._interactions)]

    def _note(self, action, next_timestep):
        self._step += 1
        positions = next_timestep.observation["positions"].astype(float)
        changes = np.abs(_distances(positions) - _distances(self._first))
        are_apart = self._are_apart | (changes > self._change)
        had_moved = self._has_moved
        self._has_moved |= bool((np.linalg.norm(positions - self._first, axis=-1) > self._change).any())
        is_still = had_moved and bool((are_apart == self._are_apart).all())
        has_seen_all = is_still if self._is_noisy else self._has_moved
        self._is_settled = has_seen_all if self._wait is None else self._step >= self._wait
        self._are_apart = are_apart


def _distances(positions):
    """Returns the distances of neighbours, [4], of the centres of a tower's cubes, [5, 3]."""
    return np.linalg.norm(np.diff(positions, axis=0), axis=-1)
