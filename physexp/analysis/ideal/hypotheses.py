"""Finitely many hypotheses about the hidden property, simulated side by side."""

from collections.abc import Mapping, Sequence
import dataclasses
import functools
from typing import Any

import numpy as np

from physexp import suite
from physexp.suite.engine import contract, declarations, snapshots

_NUM_THREADS = 2  # For simulations.


class Hypotheses:
    """H hypotheses about the hidden property, each with a simulation for each interaction.

    Physics is deterministic: a hypothesis and a sequence of interactions determine one trajectory.

    Attributes:
      task: the task that is played.
      hidden: the hypotheses: all values of the hidden property, [H, ...].
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
        *,
        read_as: str | None = None,
    ):
        """Prepares the simulations of a task, as for `suite.load`; for `hidden` and `prior` see the class.

        Args:
          nuisances: the values of the random variation, [number of nuisances], for tasks with variation.
          read_as: a task of the domain with the same physics, whose readings distinguish the same hypotheses as this
            task's images. It is simulated instead, without drawing.
        """
        options = {**(task_kwargs or {}), "random": 0}
        self.task = suite.load_task(domain_name, task_name, options)
        self._read = self.task if read_as in (None, task_name) else suite.load_task(domain_name, read_as, options)
        self.hidden, self.prior = np.asarray(hidden), np.asarray(prior, float)
        self.answers = self.task.answers(self.hidden)
        self.steps = 0
        self._nuisances = nuisances

    @functools.cached_property
    def start(self) -> snapshots.Snapshot:
        """The states of all hypotheses before the first interaction."""
        return self._snapshot(range(len(self.hidden)))

    def step(
        self, snapshot: snapshots.Snapshot, members: Sequence[int], actions: Sequence[int]
    ) -> list[tuple[np.ndarray, snapshots.Snapshot]]:
        """Tries interactions, each from the same states, with n hypotheses in increasing order.

        Returns the `distances` between the observations after each of them, float64 [n, n], and the states after it.
        """
        observed, size = self._step(self._reading, snapshot, members, actions), len(members)
        outcomes = []
        for number in range(len(actions)):
            rows = slice(number * size, (number + 1) * size)
            these = {name: values[rows] for name, values in observed.items()}
            outcomes.append((distances(these, these, self._read.readings), self._snapshot(members, number)))
        return outcomes

    def observe(self, snapshot: snapshots.Snapshot, members: Sequence[int], action: int) -> Mapping[str, np.ndarray]:
        """Returns the observations after an interaction, arrays [n, ...]; arguments as for `step`."""
        return self._step(self._observing, dataclasses.replace(snapshot, observed={}), members, [action])

    def nearest(self, observation: Mapping[str, np.ndarray], expected: Mapping[str, np.ndarray]) -> int:
        """Returns the index of the expected observation, of arrays [n, ...], that is nearest to an observation."""
        one = {name: values[None] for name, values in observation.items()}
        return int(distances(one, expected, self.task.readings)[0].argmin())

    def _snapshot(self, members: Sequence[int], copy: int = 0) -> snapshots.Snapshot:
        """Returns the states of hypotheses in one of their simulations."""
        found = snapshots.take(self._reading, copy * len(self.hidden) + np.asarray(members))
        return dataclasses.replace(found, environments=np.asarray(members))

    def _step(self, environments: suite.BatchEnvironment, snapshot, members, actions) -> Mapping[str, np.ndarray]:
        """Returns the observations after each of the actions, arrays [number of actions * n, ...]."""
        size = len(self.hidden)
        # With a step count of 0 the time limit never ends an episode here.
        snapshots.restore(environments, snapshot.with_step_count(0).repeated(len(actions), size))
        acting = (size * np.arange(len(actions))[:, None] + np.asarray(members)).ravel()
        timestep = environments.step(np.repeat(actions, len(members)), acting)
        self.steps += len(acting)
        if environments.num_divergences:
            raise RuntimeError(
                "the simulation diverged, so hypotheses cannot be compared; use a shorter control_timestep"
            )
        return timestep.observation

    @functools.cached_property
    def _reading(self) -> suite.BatchEnvironment:
        return self._begun(self._read)

    @functools.cached_property
    def _observing(self) -> suite.BatchEnvironment:
        return self._reading if self._read is self.task else self._begun(self.task)

    def _begun(self, task: contract.Task) -> suite.BatchEnvironment:
        """Returns environments in which each hypothesis is true once for each interaction."""
        hidden = np.concatenate([self.hidden] * task.num_interactions)
        environments = suite.BatchEnvironment(task, len(hidden), _NUM_THREADS)
        nuisances = None if self._nuisances is None else np.repeat(self._nuisances[None], len(hidden), axis=0)
        environments.reset(hidden=hidden, nuisances=nuisances)
        return environments


def distances(
    observed: Mapping[str, np.ndarray], others: Mapping[str, np.ndarray], readings: Mapping[str, declarations.Reading]
) -> np.ndarray:
    """Returns the distances between N and M observations, [N, M].

    Features, which are named in the task's readings: the largest distance between two readings of one thing, in the
    reading's unit. Images: the number of pixels that differ.
    """
    found = []
    for name, values in observed.items():
        theirs = others[name]
        if name in readings:
            points, their_points = (
                each.reshape(len(each), -1, max(1, len(readings[name].components))).astype(float)
                for each in (values, theirs)
            )
            found.append(np.linalg.norm(points[:, None] - their_points, axis=-1).max(axis=-1))
        else:
            found.append(np.array([(image != theirs).any(axis=-1).sum(axis=(1, 2)) for image in values], float))
    return np.max(found, axis=0)
