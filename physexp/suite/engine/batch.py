"""Many environments of one task that step together in C++ threads."""

from collections.abc import Iterator
import contextlib
import logging
from typing import Any, NoReturn

import dm_env
import numpy as np

from physexp import checks
from physexp.suite.engine import contract, episodes, guard, rendering, seeding, simulations

_LOG = logging.getLogger(__name__)

MOST_ENVIRONMENTS = 65_536

Rows = np.ndarray | slice
"""Positions among some environments."""

_FIRST, _MID, _LAST = (int(kind) for kind in dm_env.StepType)


class BatchEnvironment:
    """Environments that share a task but no randomness: each has its own seed and episodes.

    Environment `i` behaves, bit for bit, as `Environment` does with the seed `environment_seed(seed, i)`, whatever the
    number of environments and threads.

    Attributes:
      num_environments: number of environments.
      task: the task that all environments play, with its rules and options.
      num_divergences: episodes that ended because the simulation diverged.
      ledger: the bookkeeping of the episodes, for the engine's own use.
      observations: the last observations, arrays [B, ...] by name, for the engine's own use.
    """

    def __init__(self, task: contract.Task, num_environments: int, num_threads: int = 1):
        """Builds the environments of a task, whose seed is the batch's; numbers as for `suite.load_batch`."""
        self.num_environments = checks.integer("num_environments", num_environments, 1, MOST_ENVIRONMENTS)
        self._num_threads = checks.integer("num_threads", num_threads, 1, 1_024)
        self._guard = guard.Guard("batch", num_threads)
        self.task = task
        self.num_divergences = 0
        self.ledger = episodes.Ledger(task, self.num_environments)
        self.observations = task.observer.blank(self.num_environments)
        self._groups: dict[int, simulations.Group] = {}  # By structure.
        self._closed = False
        self._all = np.arange(self.num_environments)
        self.reseed(task.options.random)

    def reseed(self, random: Any) -> None:
        """Takes another seed: every environment starts its first episode next; `random` as in `task_kwargs`."""
        with self._guard:
            self.task.reseed(random)
            self.ledger.reseed(seeding.environment_seeds(self.task.options.random, self._all))

    # Specs are those of the single environment.

    def action_spec(self) -> dm_env.specs.DiscreteArray:
        return self.task.action_spec()

    def observation_spec(self) -> dict[str, dm_env.specs.Array]:
        return self.task.observation_spec()

    def reward_spec(self) -> dm_env.specs.Array:
        return dm_env.specs.Array((), float, "reward")

    def discount_spec(self) -> dm_env.specs.BoundedArray:
        return dm_env.specs.BoundedArray((), float, 0.0, 1.0, "discount")

    @property
    def num_interactions(self) -> int:
        return self.task.num_interactions

    @property
    def is_told(self) -> bool:
        return self.task.is_told

    @property
    def step_limit(self) -> int:
        return self.task.step_limit

    @property
    def num_questions(self) -> int:
        return self.task.rules.num_questions

    @property
    def correct_answers(self) -> np.ndarray:
        """Indices of the right labels of the current questions, int64 [B]; never observable."""
        return self.ledger.correct_answers

    @property
    def hidden(self) -> np.ndarray:
        """Returns the hidden properties of the current episodes, [B, ...], which are never part of an observation."""
        return self.ledger.hidden.copy()

    @property
    def seeds(self) -> np.ndarray:
        """Returns the seeds of the environments, int64 [B]; `load` with one of them makes that environment alone."""
        return self.ledger.seeds.copy()

    @property
    def episodes(self) -> np.ndarray:
        """Indices of the current episodes, int64 [B]; -1 before the first."""
        return self.ledger.next_episodes - 1

    @property
    def steps(self) -> np.ndarray:
        """Control steps taken in the current episodes, int64 [B]."""
        return self.ledger.steps.copy()

    def reset(
        self,
        environments: np.ndarray | None = None,
        episode: int | None = None,
        hidden: np.ndarray | None = None,
        nuisances: np.ndarray | None = None,
    ) -> dm_env.TimeStep:
        """Starts new episodes.

        Args:
          environments: sorted indices of environments, int [N]; all by default.
          episode: index of the episode to start, the same in each; by default the one after the current.
          hidden: their hidden properties, [N, ...], for analysis; drawn by default.
          nuisances: their random variation, [N, number of nuisances] in [-1, 1], for analysis; drawn by default.

        Raises:
          ValueError: for a value that no episode could have; all episodes stay as they were.
        """
        with self.in_use(environments) as chosen:
            if episode is not None:
                episode = checks.integer("episode", episode, 0, seeding.LAST_EPISODE)
            self._start(chosen, hidden, nuisances, episode)
            return self._time_step(chosen, np.full(len(chosen), _FIRST), np.zeros(len(chosen)), np.ones(len(chosen)))

    def step(self, actions: np.ndarray, environments: np.ndarray | None = None) -> dm_env.TimeStep:
        """Takes one action in each environment; one whose episode is over starts a new one instead.

        Args:
          actions: one action for each of the chosen environments, int [N].
          environments: sorted indices of environments, int [N]; all by default.

        Returns:
          A TimeStep of arrays with a leading axis [N]; a first step has reward 0 and discount 1.

        Raises:
          ValueError: if an action is not one of the action spec's; nothing has moved then.
        """
        with self.in_use(environments) as chosen:
            return self._step(chosen, actions)

    def _step(self, chosen: np.ndarray, actions: Any) -> dm_env.TimeStep:
        actions = self.task.rules.check_type(actions, (len(chosen),))
        starting = self.ledger.over[chosen]
        playing, taken = chosen[~starting], actions[~starting]
        self.task.rules.check_range(taken)
        self._start(chosen[starting])
        self.ledger.steps[playing] += 1
        interacting = taken < self.task.num_interactions
        diverged = self._interact(playing[interacting], taken[interacting])
        rewards, last = self.ledger.judge(playing, taken, np.isin(playing, diverged) if len(diverged) else False)
        self._ask(playing[~interacting & ~last])
        step_types = np.full(len(chosen), _FIRST)
        step_types[~starting] = np.where(last, _LAST, _MID)
        all_rewards = np.zeros(len(chosen))
        all_rewards[~starting] = rewards
        return self._time_step(chosen, step_types, all_rewards, np.where(step_types == _LAST, 0.0, 1.0))

    def _start(self, chosen: np.ndarray, hidden: Any = None, nuisances: Any = None, episode: int | None = None) -> None:
        """Starts episodes of some environments, int [K]; arguments as for `Ledger.begin`."""
        if not len(chosen):
            return
        self.ledger.begin(chosen, hidden, nuisances, episode)
        for group, members in self.by_structure(chosen):
            rows = chosen[members]
            group.reset(rows, self.ledger.hidden[rows], self.ledger.nuisances[rows])
            group.look_first(rows, self.observations)
        self.task.observer.complete(self.ledger, chosen, self.observations)

    def _interact(self, chosen: np.ndarray, actions: np.ndarray) -> np.ndarray:
        """Simulates one control step; returns the environments that diverged, int [K]."""
        diverged = [np.zeros(0, np.int64)]
        for group, members in self.by_structure(chosen):
            rows = chosen[members]
            lost = group.step(rows, actions[members], self.ledger.substeps[rows])
            if len(lost):  # Their last observation stays the one before, as in composer.
                diverged.append(lost)
                rows = np.setdiff1d(rows, lost)
            self.ledger.touched[rows] |= group.moved(rows)
            group.look(self.ledger, rows, self.observations)
            self.task.observer.complete(self.ledger, rows, self.observations)
        lost = np.concatenate(diverged)
        if len(lost):
            self.num_divergences += len(lost)
            _LOG.warning("the simulation diverged in environments %s; their episodes end without reward", lost)
        return lost

    def _ask(self, chosen: np.ndarray) -> None:
        """Shows the next questions of some environments, int [K]."""
        for group, members in self.by_structure(chosen):
            group.look_again(self.ledger, chosen[members], self.observations)
        if len(chosen):
            self.task.observer.complete(self.ledger, chosen, self.observations)

    def by_structure(self, chosen: np.ndarray) -> list[tuple[simulations.Group, Rows]]:
        """Splits environments by structure: pairs of a group and the positions in `chosen` that belong to it."""
        if self.task.scene.num_structures == 1:
            return [(self._group(0), slice(None))] if len(chosen) else []
        structures = self.ledger.structures[chosen]
        return [(self._group(each), np.flatnonzero(structures == each)) for each in np.unique(structures).tolist()]

    def _group(self, structure: int) -> simulations.Group:
        """Returns the simulations of a structure, which is compiled when it is first needed."""
        if structure not in self._groups:
            apparatus = self.task.build_apparatus(structure)
            self._groups[structure] = simulations.Group(self.task, apparatus, self.num_environments, self._num_threads)
        return self._groups[structure]

    def render(self, size: int = rendering.SIZE_FOR_PEOPLE) -> np.ndarray:
        """Returns images for people of all environments, uint8 [B, size, size, 3]; RuntimeError if no GL works."""
        checks.integer("size", size, 1, rendering.LARGEST)
        with self.in_use() as chosen:
            _ = self.ledger.hidden  # Before the first episode it raises the error.
            images = np.zeros((len(chosen), size, size, 3), np.uint8)
            for group, members in self.by_structure(chosen):
                rows = chosen[members]
                positions, rotations, sizes = group.poses(rows)
                renderer = self.task.observer.renderer(group.apparatus, size)
                renderer.render(positions, rotations, rows, images, sizes=sizes)
            return images

    def close(self) -> None:
        """Frees the simulations. Closing twice does nothing."""
        with self._guard:
            self._groups = {}
            self.task.close()
            self._closed = True

    def __reduce__(self) -> NoReturn:  # Of copies and of pickles.
        self._guard.__reduce__()

    @contextlib.contextmanager
    def in_use(self, environments: Any = None) -> Iterator[np.ndarray]:
        """Keeps other threads out; yields the indices of some environments, int64 [N], by default of all."""
        with self._guard:
            yield self._choose(environments)

    def _choose(self, environments: Any) -> np.ndarray:
        if self._closed:
            raise RuntimeError("the batch is closed; load another")
        if environments is None:
            return self._all
        try:
            chosen = np.asarray(environments)
        except ValueError:  # Lists of different lengths.
            chosen = np.zeros(())
        if chosen.ndim == 1 and chosen.dtype.kind in "iu":
            inside = not chosen.size or (chosen.min() >= 0 and chosen.max() < self.num_environments)
            if inside and (np.diff(chosen.astype(np.int64)) > 0).all():
                return chosen.astype(np.int64)
        last = self.num_environments - 1
        raise ValueError(f"environments is {checks.shown(environments)}; give increasing indices from 0 to {last}")

    def _time_step(
        self, chosen: np.ndarray, step_types: np.ndarray, rewards: np.ndarray, discounts: np.ndarray
    ) -> dm_env.TimeStep:
        observation = {name: value[chosen] for name, value in self.observations.items()}
        return dm_env.TimeStep(step_types, rewards, discounts, observation)
