"""The observations of finitely many hypotheses after sequences of actions, simulated when needed and kept."""

from collections.abc import Iterator, Mapping, Sequence
import functools
from typing import Any

import numpy as np

from physexp import suite
from physexp.suite.engine import declarations

_SEQUENCES = 32  # Simulated side by side.

Actions = tuple[int, ...]  # A sequence of interaction actions.


class Trajectories:
    """Distances between the observations of H hypotheses about what is hidden, under sequences of actions.

    Physics is deterministic: a hypothesis and a sequence of actions make one trajectory.

    Attributes:
      task: what is played, a `QuestionTask`.
      hidden: the hypotheses: all values that the hidden property can have, [H, ...].
      prior: their probabilities, float64 [H].
      answers: the right label of each, int64 [H].
      steps: control steps simulated so far.
    """

    def __init__(
        self,
        domain_name: str,
        task_name: str,
        hidden: np.ndarray,
        prior: np.ndarray,
        task_kwargs: Mapping[str, Any] | None = None,
        nuisances: np.ndarray | None = None,
        num_threads: int = 2,
    ):
        """Prepares the simulations.

        Args:
          domain_name, task_name, task_kwargs: as for `suite.load`.
          hidden, prior: as above.
          nuisances: what the episode differs in beside, [number of nuisances], where the task has variation.
          num_threads: threads that simulate.

        Raises:
          ValueError: for an unknown name or a bad keyword argument.
        """
        self.task = suite.load_task(domain_name, task_name, {**(task_kwargs or {}), "random": 0})
        self.hidden, self.prior = np.asarray(hidden), np.asarray(prior, float)
        self.answers = self.task.answers(self.hidden)
        self.steps = 0
        self._nuisances, self._num_threads = nuisances, num_threads
        self._apart: dict[Actions, np.ndarray] = {(): np.zeros((len(self.hidden), len(self.hidden)))}

    def is_expanded(self, sequence: Actions) -> bool:
        """Returns whether what follows a sequence has been simulated."""
        return (*sequence, 0) in self._apart

    def apart(self, sequence: Actions) -> np.ndarray:
        """Returns the largest distances between the hypotheses' observations along a simulated sequence, [H, H]."""
        return self._apart[sequence]

    def expand(self, sequences: Sequence[Actions]) -> None:
        """Simulates every action after each of some sequences."""
        actions = range(self.task.num_interactions)
        longer = [(*sequence, action) for sequence in sequences for action in actions]
        for sequence, observation in zip(longer, self.observe(longer), strict=True):
            self._apart[sequence] = np.maximum(self._apart[sequence[:-1]], self.distances(observation))

    def observe(self, sequences: Sequence[Actions]) -> list[dict[str, np.ndarray]]:
        """Returns the observations at the end of each sequence: arrays with a leading axis [H]."""
        found: dict[Actions, dict[str, np.ndarray]] = {}
        for length in {len(sequence) for sequence in sequences}:
            alike = [sequence for sequence in sequences if len(sequence) == length]
            for start in range(0, len(alike), _SEQUENCES):
                chosen = alike[start : start + _SEQUENCES]
                *_, last = self._play(chosen)
                for number, sequence in enumerate(chosen):
                    its = slice(len(self.hidden) * number, len(self.hidden) * (number + 1))
                    found[sequence] = {name: value[its].copy() for name, value in last.items()}
        return [found[sequence] for sequence in sequences]

    def follow(self, sequence: Actions) -> Iterator[np.ndarray]:
        """Returns the largest distances so far after each action of a sequence, [H, H] each."""
        apart = self._apart[()]
        for observation in self._play([sequence]) if sequence else ():
            apart = np.maximum(apart, self.distances(observation))
            yield apart

    def distances(self, observation: Mapping[str, np.ndarray]) -> np.ndarray:
        """Returns how far apart observations of the task are, as `distances`."""
        return distances(observation, self.task.readings)

    @functools.cached_property
    def _batch(self) -> suite.BatchEnvironment:
        return suite.BatchEnvironment(self.task, len(self.hidden) * _SEQUENCES, self._num_threads)

    def _play(self, sequences: Sequence[Actions]) -> Iterator[Mapping[str, np.ndarray]]:
        """Plays sequences of one length side by side, each for all hypotheses; returns what is seen after each step."""
        size = len(self.hidden)
        rows = np.arange(size * len(sequences))
        nuisances = None if self._nuisances is None else np.repeat(self._nuisances[None], len(rows), axis=0)
        self._batch.reset(rows, hidden=self.hidden[rows % size], nuisances=nuisances)
        for actions in np.array(sequences).T:
            timestep = self._batch.step(np.repeat(actions, size), rows)
            self.steps += len(rows)
            if self._batch.num_divergences:
                raise RuntimeError("the simulation diverged; nothing can be said about what can be told apart")
            yield timestep.observation


def distances(observation: Mapping[str, np.ndarray], readings: Mapping[str, declarations.Reading]) -> np.ndarray:
    """Returns how far apart observations are, pairwise: [N, N] for arrays with a leading axis N.

    Features: the largest distance between what was read of the same thing, in the reading's unit. Images: how many
    pixels differ.

    Args:
      observation: arrays by name, [N, ...].
      readings: the task's; what is not among them is an image.
    """
    found = []
    for name, values in observation.items():
        if name in readings:
            points = values.reshape(len(values), -1, max(1, len(readings[name].components))).astype(float)
            found.append(np.linalg.norm(points[:, None] - points, axis=-1).max(axis=-1))
        else:
            found.append(np.array([(image != values).any(axis=-1).sum(axis=(1, 2)) for image in values], float))
    return np.max(found, axis=0)
