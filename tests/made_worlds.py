"""Made-up worlds in place of simulations: the reading of each action is given."""

import types

import numpy as np

from physexp.suite.domains.towers import PRIOR
from physexp.suite.parts import tower

PATTERNS = len(tower.PATTERNS)
COUNTS = [tower.num_bodies(pattern) for pattern in tower.PATTERNS]


class MadeWorld:
    """Hypotheses with sequences of actions as states; `tells` maps a sequence to a reading for each pattern."""

    start = ()

    def __init__(self, num_actions, tells, step_limit=26):
        rules = types.SimpleNamespace(step_limit=step_limit)
        options = types.SimpleNamespace(control_timestep=0.1)
        self.task = types.SimpleNamespace(num_interactions=num_actions, num_labels=5, options=options, rules=rules)
        self.hidden, self.prior, self.answers = np.arange(PATTERNS), PRIOR, np.array(COUNTS) - 1
        self.steps, self._tells = 0, tells

    def step(self, sequence, members, actions):
        return [self._try((*sequence, action), members) for action in actions]

    def _try(self, sequence, members):
        self.steps += len(members)
        values = np.array(self._tells(sequence), float)[list(members)]
        return abs(values[:, None] - values), sequence

    def observe(self, sequence, members, action):
        return {"positions": np.zeros((len(members), 5, 3), np.float32)}
