"""Many environments of one task that step together in C++ threads."""

import dataclasses
import functools
import logging

import dm_env
import mujoco
from mujoco.batch import Batch
import numpy as np

from physexp import checks
from physexp.suite.engine import episodes, guard, rendering, seeding
from physexp.suite.engine import task as task_lib

_LOG = logging.getLogger(__name__)
MOST_ENVIRONMENTS = 65_536

_FIRST, _MID, _LAST = (int(kind) for kind in dm_env.StepType)


@dataclasses.dataclass(frozen=True)
class Moment:
    """Where the episodes of N environments stand, as `BatchEnvironment.save` returns it.

    Attributes:
      environments: which they are, int64 [N].
      episodes: indices of the episodes, int64 [N].
      hidden: their hidden properties, [N, ...].
      nuisances: what they differ in beside, float64 [N, number of nuisances].
      substeps: physics steps in a control step, int64 [N].
      steps: control steps taken, int64 [N].
      touched: whether each held entity has moved, bool [N, number of held entities].
      observed: what was observed last, arrays [N, ...].
      states: of the simulations and their sensors, those of each structure together, float64 [number of its
        environments, ...].
      coordinates: of those, the positions and velocities (`qpos` and `qvel`) alone.
    """

    environments: np.ndarray
    episodes: np.ndarray
    hidden: np.ndarray
    nuisances: np.ndarray
    substeps: np.ndarray
    steps: np.ndarray
    touched: np.ndarray
    observed: dict[str, np.ndarray]
    states: tuple[np.ndarray, ...]
    coordinates: tuple[np.ndarray, ...]

    def at_step(self, step: int) -> "Moment":
        """Returns the same, as if this many control steps had been taken."""
        return dataclasses.replace(self, steps=np.full_like(self.steps, step))

    def repeated(self, times: int, stride: int) -> "Moment":
        """Returns the same of so many copies of the environments, whose indices are `stride` apart."""

        def tiled(values: np.ndarray) -> np.ndarray:
            return np.tile(values, (times, *[1] * (values.ndim - 1)))

        shifts = np.repeat(stride * np.arange(times), len(self.environments))
        return Moment(
            environments=tiled(self.environments) + shifts,
            episodes=tiled(self.episodes),
            hidden=tiled(self.hidden),
            nuisances=tiled(self.nuisances),
            substeps=tiled(self.substeps),
            steps=tiled(self.steps),
            touched=tiled(self.touched),
            observed={name: tiled(values) for name, values in self.observed.items()},
            states=tuple(map(tiled, self.states)),
            coordinates=tuple(map(tiled, self.coordinates)),
        )


class BatchEnvironment:
    """Environments that share a task but no randomness: each has its own seed and episodes.

    Environment `i` behaves, bit for bit, as `Environment` does with the seed `environment_seed(seed, i)`, whatever
    the number of environments and threads.

    Attributes:
      num_environments: how many there are.
      num_divergences: episodes that ended because the simulation diverged.
    """

    def __init__(self, task: task_lib.QuestionTask, num_environments: int, num_threads: int = 1):
        """Builds the environments of a task.

        Args:
          task: what they play; its seed is the batch's.
          num_environments: how many, from 1 to 65,536.
          num_threads: threads that simulate, from 1 to 1,024.

        Raises:
          ValueError: if one of the numbers is not such an integer.
        """
        self.num_environments = checks.integer("num_environments", num_environments, 1, MOST_ENVIRONMENTS)
        self._num_threads = checks.integer("num_threads", num_threads, 1, 1_024)
        self._guard = guard.Guard("batch", self._num_threads)
        self.num_divergences = 0
        self._closed = False
        self._task = task
        self._everyone = np.arange(self.num_environments)
        self._ledger = episodes.Ledger(task, self.num_environments)
        self.reseed(task.options.random)
        self._groups: dict[int, _Group] = {}
        self._observations = task.blank_observations(self.num_environments)
        self._renderer: rendering.Renderer | None = None  # Of images for people.

    def reseed(self, random) -> None:
        """Takes another seed: every environment starts its first episode next; `random` as in `task_kwargs`."""
        with self._guard:
            self._task.reseed(random)
            self._ledger.reseed(seeding.environment_seeds(self._task.options.random, self._everyone))

    # Specs are those of the single environment.

    def action_spec(self) -> dm_env.specs.DiscreteArray:
        return self._task.action_spec()

    def observation_spec(self) -> dict[str, dm_env.specs.Array]:
        return self._task.observation_spec()

    def reward_spec(self) -> dm_env.specs.Array:
        return dm_env.specs.Array((), float, "reward")

    def discount_spec(self) -> dm_env.specs.BoundedArray:
        return dm_env.specs.BoundedArray((), float, 0.0, 1.0, "discount")

    @property
    def task(self) -> task_lib.QuestionTask:
        """The task that all environments play, with its rules and options."""
        return self._task

    @property
    def num_interactions(self) -> int:
        """How many actions are interactions; they come first, labels after them."""
        return self._task.num_interactions

    @property
    def correct_answers(self) -> np.ndarray:
        """Indices of the right labels in the current episodes, int64 [B]; never observable."""
        return self._task.answers(self.hidden)

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
          environments: which environments, sorted indices int [N]; all of them by default.
          episode: index of the episode to start, the same in each; by default the one after the current.
          hidden: their hidden properties, [N, ...], for analysis; by default they are drawn.
          nuisances: what they differ in beside, [N, number of nuisances] in [-1, 1], for analysis of tasks with
            variation; by default they are drawn.

        Returns:
          As `step`.

        Raises:
          ValueError: for indices out of range, or if `hidden` or `nuisances` do not have the shape and the kind of what
            would be drawn, or are out of their range; all episodes stay as they were.
          RuntimeError: if the batch is closed, or another thread is using it.
        """
        with self._guard:
            chosen = self._choose(environments)
            if episode is not None:
                episode = checks.integer("episode", episode, 0, seeding.LAST_EPISODE)
            self._reset(chosen, hidden, nuisances, episode)
            return self._time_step(chosen, np.full(len(chosen), _FIRST), np.zeros(len(chosen)), np.ones(len(chosen)))

    def step(self, actions: np.ndarray, environments: np.ndarray | None = None) -> dm_env.TimeStep:
        """Takes one action in each environment; one whose episode is over starts a new one instead.

        Args:
          actions: one action for each of the chosen environments, int [N].
          environments: which environments to step, sorted indices int [N]; all of them by default.

        Returns:
          A TimeStep whose fields are arrays with a leading axis [N]. Where an episode starts, the reward is 0 and the
          discount 1.

        Raises:
          ValueError: if an action is not one of the action spec's; nothing has moved then.
          RuntimeError: if the batch is closed, or another thread is using it.
        """
        with self._guard:
            return self._step(actions, environments)

    def _step(self, actions, environments) -> dm_env.TimeStep:
        chosen = self._choose(environments)
        actions = self._task.rules.check_type(actions, (len(chosen),))
        starting = self._ledger.over[chosen]
        playing, taken = chosen[~starting], actions[~starting]
        self._task.rules.check_range(taken)
        self._reset(chosen[starting])
        self._ledger.steps[playing] += 1
        interacting = taken < self._task.num_interactions
        diverged = self._interact(playing[interacting], taken[interacting])
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

    def save(self, environments: np.ndarray | None = None) -> Moment:
        """Returns where the episodes of some environments stand, so that they can go on from there in several ways.

        Args:
          environments: which environments, sorted indices int [N]; all of them by default.

        Raises:
          ValueError: for indices out of range.
          RuntimeError: if an episode is over or none has begun, the batch is closed, or another thread is using it.
        """
        with self._guard:
            chosen = self._choose(environments)
            if self._ledger.over[chosen].any():
                raise RuntimeError("an episode is over; save where episodes are under way")
            by_structure = [(group, chosen[members]) for group, members in self._by_structure(chosen)]
            return Moment(
                environments=chosen.copy(),
                episodes=self.episodes[chosen],
                hidden=self._ledger.hidden[chosen],
                nuisances=self._ledger.nuisances[chosen],
                substeps=self._ledger.substeps[chosen],
                steps=self._ledger.steps[chosen],
                touched=self._ledger.touched[chosen],
                observed={name: values[chosen] for name, values in self._observations.items()},
                states=tuple(group.save(rows) for group, rows in by_structure),
                coordinates=tuple(group.coordinates(rows) for group, rows in by_structure),
            )

    def restore(self, moment: Moment) -> None:
        """Takes episodes back to where they stood; the next step goes on from there.

        Raises:
          ValueError: if one of the environments has begun another episode since.
          RuntimeError: if the batch is closed, or another thread is using it.
        """
        with self._guard:
            chosen = self._choose(moment.environments)
            ledger = self._ledger
            now = self.episodes, ledger.hidden, ledger.nuisances, ledger.substeps
            saved = moment.episodes, moment.hidden, moment.nuisances, moment.substeps
            if not all(np.array_equal(values[chosen], then) for values, then in zip(now, saved, strict=True)):
                raise ValueError("environments have begun other episodes since this was saved; restore before that")
            ledger.steps[chosen], ledger.touched[chosen], ledger.over[chosen] = moment.steps, moment.touched, False
            for name, values in moment.observed.items():
                self._observations[name][chosen] = values
            for (group, members), states in zip(self._by_structure(chosen), moment.states, strict=True):
                group.restore(chosen[members], states)

    def view(self, field: str, environment: int) -> np.ndarray:
        """Returns a field of `MjData` in one environment, as it is after a step; it may be written to.

        It is for analysis: an episode that was written to cannot be rebuilt from its seed and actions.

        Raises:
          ValueError: for an index out of range.
          RuntimeError: if the batch is closed, or another thread is using it.
        """
        with self._guard:
            last = self.num_environments - 1
            (chosen,) = self._choose([checks.integer("environment", environment, 0, last)])
            structure = int(self._ledger.structures[chosen])
            return self._grouped([structure])[0].view(field)[chosen]

    def render(self, size: int = rendering.SIZE_FOR_PEOPLE) -> np.ndarray:
        """Returns images for people of all environments, uint8 [B, size, size, 3].

        Raises:
          ValueError: if `size` is no positive number of pixels that can be drawn.
          RuntimeError: if there is no episode to show, the batch is closed, another thread is using it, or no GL
            backend works.
        """
        checks.integer("size", size, 1, rendering.LARGEST)
        with self._guard:
            chosen = self._choose(None)
            if not self._ledger.has_begun:
                raise RuntimeError("no episode has been started; call reset() first")
            images = np.zeros((len(chosen), size, size, 3), np.uint8)
            for group, members in self._by_structure(chosen):
                rows = chosen[members]
                if self._renderer is None or self._renderer.size != size:
                    self._close_renderer()
                    self._renderer = rendering.Renderer(group.apparatus.model, group.apparatus.moving_geoms, size=size)
                positions, rotations = group.poses(rows)
                self._renderer.render(positions, rotations, rows, images)
            return images

    def close(self) -> None:
        """Frees the simulations. Closing twice does nothing.

        Raises:
          RuntimeError: if another thread is using the batch.
        """
        with self._guard:
            self._groups = {}
            self._close_renderer()
            self._task.close()
            self._closed = True

    def __reduce__(self):  # Of copies and of pickles.
        return self._guard.__reduce__()

    def _close_renderer(self) -> None:
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

    def _choose(self, environments) -> np.ndarray:
        if self._closed:
            raise RuntimeError("the batch is closed; load another")
        if environments is None:
            return self._everyone
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

    def _by_structure(self, chosen: np.ndarray):
        """Splits environments by structure: pairs of a group and the positions in `chosen` that belong to it."""
        if self._task.num_structures == 1:
            return [(self._grouped([0])[0], slice(None))] if len(chosen) else []
        structures = self._ledger.structures[chosen]
        needed = np.unique(structures).tolist()
        positions = [np.flatnonzero(structures == structure) for structure in needed]
        return list(zip(self._grouped(needed), positions, strict=True))

    def _grouped(self, structures: list[int]) -> "list[_Group]":
        """Returns the groups of structures; new ones are compiled."""
        new = [structure for structure in structures if structure not in self._groups]
        if new:
            for structure, apparatus in zip(new, self._task.build_apparatuses(new), strict=True):
                self._groups[structure] = _Group(self._task, apparatus, self.num_environments, self._num_threads)
        return [self._groups[structure] for structure in structures]

    def _reset(
        self,
        chosen: np.ndarray,
        hidden: np.ndarray | None = None,
        nuisances: np.ndarray | None = None,
        episode: int | None = None,
    ) -> None:
        if not len(chosen):
            return
        self._ledger.begin(chosen, hidden, nuisances, episode)
        for group, members in self._by_structure(chosen):
            rows = chosen[members]
            group.reset(rows, self._ledger.hidden[rows], self._ledger.nuisances[rows])
            group.look_first(rows, self._observations)
        self._task.add_noise(self._ledger, chosen, self._observations)
        self._task.reveal_answers(self._ledger, chosen, self._observations)

    def _interact(self, chosen: np.ndarray, actions: np.ndarray) -> np.ndarray:
        """Simulates one control step; returns the environments that diverged."""
        diverged = []
        for group, members in self._by_structure(chosen):
            rows = chosen[members]
            lost = group.step(rows, actions[members], self._ledger.substeps[rows])
            if len(lost):  # Their last observation stays the one before, as in composer.
                diverged.append(lost)
                rows = np.setdiff1d(rows, lost)
            self._ledger.touched[rows] |= group.moved(rows)
            group.look(self._ledger.touched[rows], rows, self._observations)
            self._task.add_noise(self._ledger, rows, self._observations)
        if not diverged:
            return np.zeros(0, np.int64)
        lost = np.concatenate(diverged)
        self.num_divergences += len(lost)
        _LOG.warning("the simulation diverged in environments %s; their episodes end without reward", lost)
        return lost

    def _time_step(self, chosen, step_types, rewards, discounts) -> dm_env.TimeStep:
        observation = {name: value[chosen] for name, value in self._observations.items()}
        return dm_env.TimeStep(step_types, rewards, discounts, observation)


class _Group:
    """The simulations of one structure: row `i` serves environment `i` whenever it has this structure."""

    def __init__(self, task, apparatus, size, num_threads):
        self._task, self.apparatus = task, apparatus
        self._batch = Batch(apparatus.model, size, num_threads)
        self._batch.reset(stage=mujoco.mjtStage.mjSTAGE_NONE)
        self._rest = self._batch.state[0].copy()
        # Where all episodes start alike, one start is enough, and so is one look at it.
        self._are_alike = not task.options.variation
        nowhere = np.zeros(size, np.intp)
        self._starts = apparatus.start.repeated(size) if self._are_alike else apparatus.start.of(nowhere)
        self._qpos, self._control = (self._batch.bind(name) for name in ("qpos", "ctrl"))
        self._looked_at = {field: self._batch.bind(field) for field in task.sense.fields}
        self._measured = np.zeros((size, apparatus.model.nsensordata))  # The sensors' values at the last observation.

    @functools.cached_property
    def _first_observation(self) -> dict[str, np.ndarray]:
        """The observation at the start of every episode."""
        first = self._task.blank_observations(1)
        self._look_at_start(np.zeros(1, np.intp), first)
        return {name: value[0] for name, value in first.items()}

    def look_first(self, rows, observations) -> None:
        """Writes what is observed at the start of episodes; as `look`."""
        self._measured[rows] = self._starts.shown["sensordata"][rows]
        if self._are_alike:
            for name, value in self._first_observation.items():
                observations[name][rows] = value
        else:
            self._look_at_start(rows, observations)

    def _look_at_start(self, rows, observations) -> None:
        state = {field: self._starts.shown[field][rows] for field in self._task.sense.fields}
        untouched = np.zeros((len(rows), len(self.apparatus.held)), bool)
        self._task.look(self.apparatus, state, untouched, self._starts, rows, observations)

    def look(self, touched, rows, observations) -> None:
        """Writes what is observed now.

        Args:
          touched: whether each held entity has been touched, bool [number of rows, number of held entities].
          rows: which environments, int.
          observations: arrays with a leading axis that `rows` index; written to.
        """
        state = {field: values[rows] for field, values in self._looked_at.items()}
        self._measured[rows] = state["sensordata"]
        self._task.look(self.apparatus, state, touched, self._starts, rows, observations)

    def reset(self, rows, hidden, nuisances) -> None:
        self._batch.state[rows] = self._rest
        self._control[rows] = 0
        fields, starts = self._task.begin(self.apparatus, hidden, nuisances)
        for field, addresses, values in fields:
            self._batch.expand(field)[rows[:, None], addresses] = values
        if not self._are_alike:
            self._qpos[rows] = starts.qpos
            self._starts.put(rows, starts)

    def save(self, rows) -> np.ndarray:
        """Returns the states of rows and what was measured there, float64 [number of rows, ...]."""
        return np.concatenate([self._batch.state[rows], self._measured[rows]], axis=1)

    def coordinates(self, rows) -> np.ndarray:
        """Returns positions and velocities, float64 [number of rows, nq + nv]."""
        return np.concatenate([self._qpos[rows], self._batch.bind("qvel")[rows]], axis=1)

    def restore(self, rows, states) -> None:
        """Takes up what `save` returned."""
        self._batch.state[rows], self._measured[rows] = np.split(states, [len(self._rest)], axis=1)

    def step(self, rows, actions, substeps) -> np.ndarray:
        """Simulates a control step, which has so many physics steps in each row; returns the rows that diverged."""
        controls = self._task.drive(actions, self._qpos[rows], self._control[rows])
        self._control[rows] = controls * self._starts.strength[rows]
        self._batch.warning[rows] = 0  # A row that diverges is reset by MuJoCo, its counters too.
        for count in np.unique(substeps):
            self._batch.step(ids=rows[substeps == count], nstep=int(count), stage=mujoco.mjtStage.mjSTAGE_POS)
        return rows[(self._batch.warning[rows] != 0).reshape(len(rows), -1).any(axis=1)]

    def moved(self, rows) -> np.ndarray:
        """Returns which held entities have moved, bool [number of rows, number of held entities]."""
        return self.apparatus.moved(self._qpos[rows], self._starts.qpos[rows])

    def poses(self, rows) -> tuple[np.ndarray, np.ndarray]:
        """Returns positions, m, and rotations of the geoms, [number of rows, ngeom, 3 and 9].

        They are computed anew, since a reset or a restored state does not change them by itself. Sensors are not: this
        stage measures some of them alone, so the indicators show the last readings.
        """
        fields = [self._batch.bind(field) for field in ("geom_xpos", "geom_xmat")]  # Written to by what is called next.
        self._batch.forward(ids=rows, stage=mujoco.mjtStage.mjSTAGE_POS)
        positions, rotations = (values[rows].reshape(len(rows), self.apparatus.model.ngeom, -1) for values in fields)
        self.apparatus.indicate(positions, self._measured[rows])
        return positions, rotations

    def view(self, field) -> np.ndarray:
        """Returns a field of `MjData` of all rows, float64 [size, ...], not a copy."""
        return self._batch.bind(field)
