"""Finitely many hypotheses about what is hidden, simulated side by side."""

from collections.abc import Mapping, Sequence
import dataclasses
import functools
from typing import Any

import numpy as np

from physexp import suite
from physexp.suite.engine import contract, declarations, snapshots

_NUM_THREADS = 2  # That simulate.


class Hypotheses:
    """H hypotheses about what is hidden, each with a simulation of its own for each interaction.

    Physics is deterministic: a hypothesis and a sequence of actions make one trajectory.

    Attributes:
      task: the task that is played.
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
        *,
        read_as: str | None = None,
    ):
        """Prepares the simulations.

        Args:
          domain_name, task_name, task_kwargs: as for `suite.load`.
          hidden, prior: as above.
          nuisances: what the episode differs in beside, [number of nuisances], where the task has variation.
          read_as: a task of the domain with the same physics, whose readings tell apart what this task's images do: it
            is simulated in its place, without drawing.

        Raises:
          ValueError: for an unknown name or a bad keyword argument.
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
        """Where the hypotheses stand before the first action."""
        return self._moment(range(len(self.hidden)))

    def step(
        self, moment: snapshots.Snapshot, members: Sequence[int], actions: Sequence[int]
    ) -> list[tuple[np.ndarray, snapshots.Snapshot]]:
        """Tries interactions, each from the same moment.

        Args:
          moment: where some hypotheses stand, as `start` or this method returned it.
          members: those that act, indices in increasing order, n of them.
          actions: the interactions.

        Returns:
          For each action, how far apart they look after it, float64 [n, n], as `distances` has it, and where they
          stand.
        """
        seen, size = self._step(self._reading, moment, members, actions), len(members)
        found = []
        for number in range(len(actions)):
            rows = slice(number * size, (number + 1) * size)
            these = {name: values[rows] for name, values in seen.items()}
            apart = distances(these, these, self._read.readings)
            found.append((apart, self._moment(members, number)))
        return found

    def _moment(self, members: Sequence[int], copy: int = 0) -> snapshots.Snapshot:
        """Returns where hypotheses stand in one of their simulations."""
        saved = snapshots.take(self._reading, copy * len(self.hidden) + np.asarray(members))
        return dataclasses.replace(saved, environments=np.asarray(members))

    def observe(self, moment: snapshots.Snapshot, members: Sequence[int], action: int) -> Mapping[str, np.ndarray]:
        """Returns what is observed after an interaction, arrays with a leading axis [n]; arguments as for `step`."""
        return self._step(self._observing, dataclasses.replace(moment, observed={}), members, [action])

    def _step(self, environments: suite.BatchEnvironment, moment, members, actions) -> Mapping[str, np.ndarray]:
        """Returns what is observed after each of the actions, arrays with a leading axis [number of them * n]."""
        size = len(self.hidden)
        # However long an episode was, its time does not run out here.
        snapshots.restore(environments, moment.with_step_count(0).repeated(len(actions), size))
        acting = (size * np.arange(len(actions))[:, None] + np.asarray(members)).ravel()
        timestep = environments.step(np.repeat(actions, len(members)), acting)
        self.steps += len(acting)
        if environments.num_divergences:
            raise RuntimeError("the simulation diverged; nothing can be said about what can be told apart")
        return timestep.observation

    def nearest(self, observation: Mapping[str, np.ndarray], seen: Mapping[str, np.ndarray]) -> int:
        """Returns which of what was seen, arrays [n, ...], is nearest to an observation."""
        one = {name: values[None] for name, values in observation.items()}
        return int(distances(one, seen, self.task.readings)[0].argmin())

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
    seen: Mapping[str, np.ndarray], others: Mapping[str, np.ndarray], readings: Mapping[str, declarations.Reading]
) -> np.ndarray:
    """Returns how far each of what was seen is from each of others, [N, M].

    Features: the largest distance between what was read of the same thing, in the reading's unit. Images: how many
    pixels differ.

    Args:
      seen, others: arrays by name, [N, ...] and [M, ...].
      readings: the task's; what is not among them is an image.
    """
    found = []
    for name, values in seen.items():
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
