"""Made-up worlds in the place of simulated trajectories: what an action tells is given."""

import types

import numpy as np

from physexp.suite.domains.towers import PRIOR
from physexp.suite.parts import tower

PATTERNS = len(tower.PATTERNS)
COUNTS = [tower.num_bodies(pattern) for pattern in tower.PATTERNS]


class MadeWorld:
    """Trajectories in which each action tells a label of the patterns, and after which others may be told apart.

    `tells` maps a sequence of actions to what it makes visible: a number for each pattern.
    """

    def __init__(self, num_actions, tells, step_limit=26):
        rules = types.SimpleNamespace(step_limit=step_limit)
        self.task = types.SimpleNamespace(num_interactions=num_actions, num_labels=5, control_timestep=0.1, rules=rules)
        self.hidden, self.prior, self.answers = np.arange(PATTERNS), PRIOR, np.array(COUNTS) - 1
        self.steps, self._tells, self._expanded = 0, tells, {()}
        self._num_actions = num_actions

    def is_expanded(self, sequence, members):
        return (*sequence, 0) in self._expanded

    def expand(self, sequences):
        for sequence in sequences:
            self._expanded |= {(*sequence, action) for action in range(self._num_actions)}
        self.steps += len(sequences)

    def apart(self, sequence):
        assert sequence in self._expanded
        return self._told_apart(sequence)

    def _told_apart(self, sequence):
        total = np.zeros((PATTERNS, PATTERNS))
        for end in range(1, len(sequence) + 1):
            values = np.array(self._tells(sequence[:end]), float)
            total = np.maximum(total, abs(values[:, None] - values))
        return total

    def follow(self, sequence):
        for end in range(1, len(sequence) + 1):
            yield self._told_apart(sequence[:end])

    def observe(self, sequence):
        return {"positions": np.zeros((PATTERNS, 5, 3), np.float32)}
