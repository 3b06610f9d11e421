"""What the 16 towers look like after sequences of actions: simulated when asked for, and remembered."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from physexp import suite
from physexp.suite.parts import tower

NUM_PATTERNS = len(tower.PATTERNS)
_SEQUENCES = 32  # Simulated side by side.

Actions = tuple[int, ...]  # A sequence of interaction actions.


class Trajectories:
    """How far apart the towers look under sequences of actions.

    Physics is deterministic: a glue pattern and a sequence of actions make one trajectory.

    Attributes:
      task: what is played, a `QuestionTask`.
      steps: control steps simulated so far.
    """

    def __init__(self, task_name: str, task_kwargs: Mapping[str, Any] | None = None, num_threads: int = 2):
        """Prepares the simulations.

        Args:
          task_name: a task of the towers.
          task_kwargs: as for `suite.load`.
          num_threads: threads that simulate.

        Raises:
          ValueError: for an unknown task or a bad keyword argument.
        """
        kwargs = {**(task_kwargs or {}), "random": 0}
        self._batch = suite.load_batch("towers", task_name, NUM_PATTERNS * _SEQUENCES, kwargs, num_threads)
        self.task = self._batch.task
        self.steps = 0
        self._apart: dict[Actions, np.ndarray] = {(): np.zeros((NUM_PATTERNS, NUM_PATTERNS))}

    def is_expanded(self, sequence: Actions) -> bool:
        """Whether what follows a sequence has been simulated."""
        return (*sequence, 0) in self._apart

    def apart(self, sequence: Actions) -> np.ndarray:
        """How far apart the towers have looked at most so far, [16, 16]; of a sequence that has been simulated."""
        return self._apart[sequence]

    def expand(self, sequences: Sequence[Actions]) -> None:
        """Simulates every action after each of some sequences."""
        actions = range(self.task.num_interactions)
        longer = [(*sequence, action) for sequence in sequences for action in actions]
        for sequence, observation in zip(longer, self.observe(longer), strict=True):
            self._apart[sequence] = np.maximum(self._apart[sequence[:-1]], distances(observation))

    def observe(self, sequences: Sequence[Actions]) -> list[dict[str, np.ndarray]]:
        """What is seen at the end of each sequence: arrays with a leading axis of the 16 patterns."""
        found: dict[Actions, dict[str, np.ndarray]] = {}
        for length in {len(sequence) for sequence in sequences}:
            alike = [sequence for sequence in sequences if len(sequence) == length]
            for start in range(0, len(alike), _SEQUENCES):
                found.update(self._play(alike[start : start + _SEQUENCES]))
        return [found[sequence] for sequence in sequences]

    def _play(self, sequences: list[Actions]):
        """Plays sequences of one length side by side, each in 16 environments."""
        rows = np.arange(NUM_PATTERNS * len(sequences))
        self._batch.reset(rows, hidden=rows % NUM_PATTERNS)
        for actions in np.array(sequences).T:
            timestep = self._batch.step(np.repeat(actions, NUM_PATTERNS), rows)
            self.steps += len(rows)
        if self._batch.num_divergences:
            raise RuntimeError("the simulation of a tower diverged; nothing can be said about what can be told apart")
        for number, sequence in enumerate(sequences):
            its = slice(NUM_PATTERNS * number, NUM_PATTERNS * (number + 1))
            yield sequence, {name: value[its].copy() for name, value in timestep.observation.items()}


def distances(observation: Mapping[str, np.ndarray]) -> np.ndarray:
    """How far apart observations are, pairwise: [N, N] for arrays with a leading axis N.

    Features: the largest distance between positions of the same thing, m. Images: how many pixels differ.
    """
    if "pixels" in observation:
        images = observation["pixels"]
        return np.array([(image != images).any(axis=-1).sum(axis=(1, 2)) for image in images], float)
    positions = np.concatenate([value.reshape(len(value), -1, 3) for value in observation.values()], axis=1)
    return np.linalg.norm(positions[:, None].astype(float) - positions, axis=-1).max(axis=-1)
