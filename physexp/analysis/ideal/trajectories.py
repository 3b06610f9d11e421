"""The observations of finitely many hypotheses after sequences of actions, simulated when needed and kept."""

from collections.abc import Collection, Iterator, Mapping, Sequence
import functools
import itertools
from typing import Any

import numpy as np

from physexp import suite
from physexp.suite.engine import declarations

_SEQUENCES = 32  # Simulated side by side.

Actions = tuple[int, ...]  # A sequence of interaction actions.
Play = tuple[Actions, Sequence[int]]  # A sequence, and the hypotheses that it is played with.


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
        self._simulated: dict[Actions, set[int]] = {}

    def is_expanded(self, sequence: Actions, members: Collection[int]) -> bool:
        """Returns whether what follows a sequence has been simulated for some hypotheses."""
        return self._simulated.get(sequence, set()).issuperset(members)

    def apart(self, sequence: Actions) -> np.ndarray:
        """Returns the largest distances between observations along a sequence, [H, H], of what was simulated."""
        return self._apart[sequence]

    def expand(self, sequences: Mapping[Actions, Collection[int]]) -> None:
        """Simulates every action after each of some sequences, for the hypotheses that are given with it."""
        plays = [(sequence, sorted(members)) for sequence, members in sequences.items()]
        for together in _side_by_side(plays, self._batch_size):
            for action, observation in self._branch(together):
                ends = np.cumsum([0, *(len(members) for _, members in together)])
                for (sequence, members), (start, end) in zip(together, itertools.pairwise(ends), strict=True):
                    seen = {name: value[start:end] for name, value in observation.items()}
                    before, block = self._apart[sequence], np.ix_(members, members)
                    apart = self._apart.setdefault((*sequence, action), before.copy())
                    apart[block] = np.maximum(before[block], self.distances(seen))
        for sequence, members in plays:
            self._simulated.setdefault(sequence, set()).update(members)

    def observe(self, sequence: Actions) -> dict[str, np.ndarray]:
        """Returns the observations at the end of a sequence of at least one action: arrays with a leading axis [H]."""
        *_, last = self._play([(sequence, range(len(self.hidden)))])
        return {name: value.copy() for name, value in last.items()}

    def follow(self, sequence: Actions) -> Iterator[np.ndarray]:
        """Returns the largest distances so far after each action of a sequence, [H, H] each."""
        apart = self._apart[()]
        for observation in self._play([(sequence, range(len(self.hidden)))]) if sequence else ():
            apart = np.maximum(apart, self.distances(observation))
            yield apart

    def distances(self, observation: Mapping[str, np.ndarray]) -> np.ndarray:
        """Returns how far apart observations of the task are, as `distances`."""
        return distances(observation, self.task.readings)

    @property
    def _batch_size(self) -> int:
        return len(self.hidden) * _SEQUENCES

    @functools.cached_property
    def _batch(self) -> suite.BatchEnvironment:
        return suite.BatchEnvironment(self.task, self._batch_size, self._num_threads)

    def _play(self, plays: Sequence[Play]) -> Iterator[Mapping[str, np.ndarray]]:
        """Plays sequences of one length side by side; returns what is seen after each step, play by play."""
        members = np.concatenate([members for _, members in plays])
        rows = np.arange(len(members))
        nuisances = None if self._nuisances is None else np.repeat(self._nuisances[None], len(rows), axis=0)
        self._batch.reset(rows, hidden=self.hidden[members], nuisances=nuisances)
        counts = [len(members) for _, members in plays]
        for actions in np.array([sequence for sequence, _ in plays], np.int64).T:
            yield self._step(np.repeat(actions, counts))

    def _branch(self, plays: Sequence[Play]) -> Iterator[tuple[int, Mapping[str, np.ndarray]]]:
        """Plays sequences as `_play` does, and then every action from there; returns what is seen after each."""
        for _ in self._play(plays):
            pass
        count = sum(len(members) for _, members in plays)
        moment = self._batch.save(np.arange(count))
        for action in range(self.task.num_interactions):
            self._batch.restore(moment)
            yield action, self._step(np.full(count, action))

    def _step(self, actions: np.ndarray) -> Mapping[str, np.ndarray]:
        """Takes an action in each of the first environments; returns what is seen."""
        timestep = self._batch.step(actions, np.arange(len(actions)))
        self.steps += len(actions)
        if self._batch.num_divergences:
            raise RuntimeError("the simulation diverged; nothing can be said about what can be told apart")
        return timestep.observation


def _side_by_side(plays: Sequence[Play], size: int) -> Iterator[list[Play]]:
    """Returns plays in their order, in parts of equal length that have as many members as a batch's size at most."""
    together: list[Play] = []
    for sequence, members in plays:
        count = sum(len(others) for _, others in together) + len(members)
        if together and (count > size or len(together[0][0]) != len(sequence)):
            yield together
            together = []
        together.append((sequence, members))
    if together:
        yield together


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
