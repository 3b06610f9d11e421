"""The simulations of a batch: one MuJoCo batch for each compiled model, and the ledger of the episodes."""

from collections.abc import Mapping
import functools
import logging
from typing import Any

import mujoco
from mujoco.batch import Batch
import numpy as np

from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, episodes

_LOG = logging.getLogger(__name__)

Rows = np.ndarray | slice
"""Positions among some environments."""


class Simulations:
    """The simulations of N environments that play a task, by compiled model.

    Attributes:
      task: the task.
      ledger: the bookkeeping of the episodes.
      observations: the last observations, arrays [N, ...] by name.
      num_divergences: episodes that ended because the simulation diverged.
    """

    def __init__(self, task: contract.Task, size: int, num_threads: int):
        self.task, self._size, self._num_threads = task, size, num_threads
        self.ledger = episodes.Ledger(task, size)
        self.observations = task.observer.blank(size)
        self.num_divergences = 0
        self._groups: dict[int, Group] = {}

    def by_structure(self, chosen: np.ndarray) -> "list[tuple[Group, Rows]]":
        """Splits environments by structure: pairs of a group and the positions in `chosen` that belong to it."""
        if self.task.scene.num_structures == 1:
            return [(self._grouped([0])[0], slice(None))] if len(chosen) else []
        structures = self.ledger.structures[chosen]
        needed = np.unique(structures).tolist()
        positions = [np.flatnonzero(structures == structure) for structure in needed]
        return list(zip(self._grouped(needed), positions, strict=True))

    def _grouped(self, structures: list[int]) -> "list[Group]":
        """Returns the groups of structures; new ones are compiled."""
        new = [structure for structure in structures if structure not in self._groups]
        if new:
            for structure, apparatus in zip(new, self.task.build_apparatuses(new), strict=True):
                self._groups[structure] = Group(self.task, apparatus, self._size, self._num_threads)
        return [self._groups[structure] for structure in structures]

    def close(self) -> None:
        self._groups = {}

    def reset(self, chosen: np.ndarray, hidden: Any = None, nuisances: Any = None, episode: int | None = None) -> None:
        """Starts episodes of some environments, int [K]; arguments as for `Ledger.begin`."""
        if not len(chosen):
            return
        self.ledger.begin(chosen, hidden, nuisances, episode)
        for group, members in self.by_structure(chosen):
            rows = chosen[members]
            group.reset(rows, self.ledger.hidden[rows], self.ledger.nuisances[rows])
            group.look_first(rows, self.observations)
        self.task.observer.add_noise(self.ledger, chosen, self.observations)
        self.task.observer.reveal(self.ledger, chosen, self.observations)

    def interact(self, chosen: np.ndarray, actions: np.ndarray) -> np.ndarray:
        """Simulates one control step; returns the environments that diverged, int [K]."""
        diverged = [np.zeros(0, np.int64)]
        for group, members in self.by_structure(chosen):
            rows = chosen[members]
            lost = group.step(rows, actions[members], self.ledger.substeps[rows])
            if len(lost):  # Their last observation stays the one before, as in composer.
                diverged.append(lost)
                rows = np.setdiff1d(rows, lost)
            self.ledger.touched[rows] |= group.moved(rows)
            group.look(self.ledger.touched[rows], rows, self.observations)
            self.task.observer.add_noise(self.ledger, rows, self.observations)
        lost = np.concatenate(diverged)
        if len(lost):
            self.num_divergences += len(lost)
            _LOG.warning("the simulation diverged in environments %s; their episodes end without reward", lost)
        return lost


class Group:
    """The simulations of one structure: row `i` serves environment `i` whenever it has this structure."""

    def __init__(self, task: contract.Task, apparatus: apparatus_lib.Apparatus, size: int, num_threads: int):
        self._task, self.apparatus = task, apparatus
        self._batch = Batch(apparatus.model, size, num_threads)
        self._batch.reset(stage=mujoco.mjtStage.mjSTAGE_NONE)
        self._rest = self._batch.state[0].copy()
        # If all episodes start alike, one initial state and one first observation are enough.
        self._are_alike = not task.options.variation
        nowhere = np.zeros(size, np.intp)
        self._starts = apparatus.start.repeated(size) if self._are_alike else apparatus.start.of(nowhere)
        self._qpos, self._control = (self._batch.bind(name) for name in ("qpos", "ctrl"))
        self._looked_at = {field: self._batch.bind(field) for field in task.sense.fields}
        self._measured = np.zeros((size, apparatus.model.nsensordata))  # The sensors' values at the last observation.

    @functools.cached_property
    def _first_observation(self) -> dict[str, np.ndarray]:
        """The observation at the start of every episode."""
        first = self._task.observer.blank(1)
        self._look_at_start(np.zeros(1, np.intp), first)
        return {name: value[0] for name, value in first.items()}

    def look_first(self, rows: np.ndarray, observations: Mapping[str, np.ndarray]) -> None:
        """Writes what is observed at the start of episodes; as `look`."""
        self._measured[rows] = self._starts.shown["sensordata"][rows]
        if self._are_alike:
            for name, value in self._first_observation.items():
                observations[name][rows] = value
        else:
            self._look_at_start(rows, observations)

    def _look_at_start(self, rows: np.ndarray, observations: Mapping[str, np.ndarray]) -> None:
        state = {field: self._starts.shown[field][rows] for field in self._task.sense.fields}
        untouched = np.zeros((len(rows), len(self.apparatus.held)), bool)
        self._task.observer.look(self.apparatus, state, untouched, self._starts, rows, observations)

    def look(self, touched: np.ndarray, rows: np.ndarray, observations: Mapping[str, np.ndarray]) -> None:
        """Writes the current observations of rows, some of whose held entities, bool [K, ...], have been touched."""
        state = {field: values[rows] for field, values in self._looked_at.items()}
        self._measured[rows] = state["sensordata"]
        self._task.observer.look(self.apparatus, state, touched, self._starts, rows, observations)

    def reset(self, rows: np.ndarray, hidden: np.ndarray, nuisances: np.ndarray) -> None:
        """Puts rows into the initial states of episodes."""
        self._batch.state[rows] = self._rest
        self._control[rows] = 0
        fields, starts = self._task.begin(self.apparatus, hidden, nuisances)
        for field, addresses, values in fields:
            self._batch.expand(field)[rows[:, None], addresses] = values
        if not self._are_alike:
            self._qpos[rows] = starts.qpos
            self._starts.put(rows, starts)

    def save(self, rows: np.ndarray) -> np.ndarray:
        """Returns the states of rows and what was measured there, float64 [number of rows, ...]."""
        return np.concatenate([self._batch.state[rows], self._measured[rows]], axis=1)

    def coordinates(self, rows: np.ndarray) -> np.ndarray:
        """Returns positions and velocities, float64 [number of rows, nq + nv]."""
        return np.concatenate([self._qpos[rows], self._batch.bind("qvel")[rows]], axis=1)

    def restore(self, rows: np.ndarray, states: np.ndarray) -> None:
        """Takes up what `save` returned."""
        self._batch.state[rows], self._measured[rows] = np.split(states, [len(self._rest)], axis=1)

    def step(self, rows: np.ndarray, actions: np.ndarray, substeps: np.ndarray) -> np.ndarray:
        """Simulates a control step, which has so many physics steps in each row; returns the rows that diverged."""
        controls = self._task.drive(actions, self._qpos[rows], self._control[rows])
        self._control[rows] = controls * self._starts.strength[rows]
        self._batch.warning[rows] = 0  # A row that diverges is reset by MuJoCo, its counters too.
        for count in np.unique(substeps):
            self._batch.step(ids=rows[substeps == count], nstep=int(count), stage=mujoco.mjtStage.mjSTAGE_POS)
        return rows[(self._batch.warning[rows] != 0).reshape(len(rows), -1).any(axis=1)]

    def moved(self, rows: np.ndarray) -> np.ndarray:
        """Returns which held entities have moved, bool [number of rows, number of held entities]."""
        return self.apparatus.moved(self._qpos[rows], self._starts.qpos[rows])

    def poses(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns positions, m, and rotations of the geoms, [number of rows, ngeom, 3 and 9].

        They are computed anew, since a reset changes only coordinates. Sensors are not: indicators show last readings.
        """
        fields = [self._batch.bind(field) for field in ("geom_xpos", "geom_xmat")]  # Written to by what is called next.
        self._batch.forward(ids=rows, stage=mujoco.mjtStage.mjSTAGE_POS)
        positions, rotations = (values[rows].reshape(len(rows), self.apparatus.model.ngeom, -1) for values in fields)
        self.apparatus.indicate(positions, self._measured[rows])
        return positions, rotations

    def view(self, field: str) -> np.ndarray:
        """Returns a field of `MjData` of all rows, float64 [size, ...], not a copy."""
        return self._batch.bind(field)
