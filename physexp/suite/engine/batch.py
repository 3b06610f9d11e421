"""Many environments of one task that step together in C++ threads."""

from collections.abc import Iterator
import contextlib
from typing import Any, NoReturn

import dm_env
import numpy as np

from physexp import checks
from physexp.suite.engine import contract, episodes, guard, rendering, seeding
from physexp.suite.engine import simulations as simulations_lib

MOST_ENVIRONMENTS = 65_536

_FIRST, _MID, _LAST = (int(kind) for kind in dm_env.StepType)


class BatchEnvironment:
    """Environments that share a task but no randomness: each has its own seed and episodes.

    Environment `i` behaves, bit for bit, as `Environment` does with the seed `environment_seed(seed, i)`, whatever the
    number of environments and threads.

    Attributes:
      num_environments: number of environments.
      task: the task that all environments play, with its rules and options.
      simulations: the simulations, for the engine's own use.
    """

    def __init__(self, task: contract.Task, num_environments: int, num_threads: int = 1):
        """Builds the environments of a task, whose seed is the batch's; numbers as for `suite.load_batch`."""
        self.num_environments = checks.integer("num_environments", num_environments, 1, MOST_ENVIRONMENTS)
        num_threads = checks.integer("num_threads", num_threads, 1, 1_024)
        self._guard = guard.Guard("batch", num_threads)
        self.task = task
        self.simulations = simulations_lib.Simulations(task, self.num_environments, num_threads)
        self._closed = False
        self._all = np.arange(self.num_environments)
        self.reseed(task.options.random)
        self._renderer: rendering.Renderer | None = None  # Of images for people.

    def reseed(self, random: Any) -> None:
        """Takes another seed: every environment starts its first episode next; `random` as in `task_kwargs`."""
        with self._guard:
            self.task.reseed(random)
            self._ledger.reseed(seeding.environment_seeds(self.task.options.random, self._all))

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
    def _ledger(self) -> episodes.Ledger:
        return self.simulations.ledger

    @property
    def num_divergences(self) -> int:
        """Episodes that ended because the simulation diverged."""
        return self.simulations.num_divergences

    @property
    def num_interactions(self) -> int:
        return self.task.num_interactions

    @property
    def correct_answers(self) -> np.ndarray:
        """Indices of the right labels in the current episodes, int64 [B]; never observable."""
        return self.task.answers(self.hidden)

    @property
    def hidden(self) -> np.ndarray:
        """Returns the hidden properties of the current episodes, [B, ...], which are never part of an observation."""
        return self._ledger.hidden.copy()

    @property
    def seeds(self) -> np.ndarray:
        """Returns the seeds of the environments, int64 [B]; `load` with one of them makes that environment alone."""
        return self._ledger.seeds.copy()

    @property
    def episodes(self) -> np.ndarray:
        """Indices of the current episodes, int64 [B]; -1 before the first."""
        return self._ledger.next_episodes - 1

    @property
    def steps(self) -> np.ndarray:
        """Control steps taken in the current episodes, int64 [B]."""
        return self._ledger.steps.copy()

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
          ValueError: for indices out of range, or for values without the shape, the type and the range of drawn ones;
            all episodes stay as they were.
        """
        with self.in_use(environments) as chosen:
            if episode is not None:
                episode = checks.integer("episode", episode, 0, seeding.LAST_EPISODE)
            self.simulations.reset(chosen, hidden, nuisances, episode)
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
        starting = self._ledger.over[chosen]
        playing, taken = chosen[~starting], actions[~starting]
        self.task.rules.check_range(taken)
        self.simulations.reset(chosen[starting])
        self._ledger.steps[playing] += 1
        interacting = taken < self.task.num_interactions
        diverged = self.simulations.interact(playing[interacting], taken[interacting])
        rewards, last = self._ledger.judge(playing, taken)
        if len(diverged):
            lost = np.isin(playing, diverged)
            rewards, last = np.where(lost, 0.0, rewards), last | lost
            self._ledger.over[diverged] = True
        step_types = np.full(len(chosen), _FIRST)
        step_types[~starting] = np.where(last, _LAST, _MID)
        all_rewards = np.zeros(len(chosen))
        all_rewards[~starting] = rewards
        return self._time_step(chosen, step_types, all_rewards, np.where(step_types == _LAST, 0.0, 1.0))

    def render(self, size: int = rendering.SIZE_FOR_PEOPLE) -> np.ndarray:
        """Returns images for people of all environments, uint8 [B, size, size, 3]; RuntimeError if no GL works."""
        checks.integer("size", size, 1, rendering.LARGEST)
        with self.in_use() as chosen:
            if not self._ledger.has_begun:
                raise RuntimeError("no episode has been started; call reset() first")
            images = np.zeros((len(chosen), size, size, 3), np.uint8)
            for group, members in self.simulations.by_structure(chosen):
                rows = chosen[members]
                if self._renderer is None or self._renderer.size != size:
                    self._close_renderer()
                    self._renderer = rendering.Renderer(group.apparatus.model, group.apparatus.moving_geoms, size=size)
                positions, rotations = group.poses(rows)
                self._renderer.render(positions, rotations, rows, images)
            return images

    def close(self) -> None:
        """Frees the simulations. Closing twice does nothing."""
        with self._guard:
            self.simulations.close()
            self._close_renderer()
            self.task.close()
            self._closed = True

    def __reduce__(self) -> NoReturn:  # Of copies and of pickles.
        self._guard.__reduce__()

    @contextlib.contextmanager
    def in_use(self, environments: Any = None) -> Iterator[np.ndarray]:
        """Keeps other threads out; yields the indices of some environments, int64 [N], by default of all."""
        with self._guard:
            yield self._choose(environments)

    def _close_renderer(self) -> None:
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

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
        observation = {name: value[chosen] for name, value in self.simulations.observations.items()}
        return dm_env.TimeStep(step_types, rewards, discounts, observation)
