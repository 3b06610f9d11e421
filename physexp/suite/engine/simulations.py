"""The simulations of a batch that have one compiled model."""

from collections.abc import Mapping
import functools

import mujoco
from mujoco.batch import Batch
import numpy as np

from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, episodes


class Group:
    """The simulations of one structure: row `i` serves environment `i` whenever it has this structure."""

    def __init__(self, task: contract.Task, apparatus: apparatus_lib.Apparatus, size: int, num_threads: int):
        self._task, self.apparatus = task, apparatus
        self._batch = Batch(apparatus.model, size, num_threads)
        self.view = self._batch.bind  # A field of `MjData` of all rows, not a copy.
        self._batch.reset(stage=mujoco.mjtStage.mjSTAGE_NONE)
        self._rest = self._batch.state[0].copy()
        # If all episodes start alike, one initial state and one first observation are enough.
        self._are_alike = not task.options.variation and not len(apparatus.told)
        nowhere = np.zeros(size, np.intp)
        self._starts = apparatus.start.repeated(size) if self._are_alike else apparatus.start.of(nowhere)
        self._qpos, self._control = (self._batch.bind(name) for name in ("qpos", "ctrl"))
        self._looked_at = {field: self._batch.bind(field) for field in task.observer.fields}
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
        state = {field: self._starts.shown[field][rows] for field in self._task.observer.fields}
        untouched = np.zeros((len(rows), len(self.apparatus.held)), bool)
        self._task.observer.look(self.apparatus, state, untouched, self._starts, rows, observations)

    def look(self, ledger: episodes.Ledger, rows: np.ndarray, observations: Mapping[str, np.ndarray]) -> None:
        """Writes the current observations of rows."""
        self._look(ledger, rows, {field: values[rows] for field, values in self._looked_at.items()}, observations)

    def look_again(self, ledger: episodes.Ledger, rows: np.ndarray, observations: Mapping[str, np.ndarray]) -> None:
        """Writes the last observations of rows with the current questions; the values of other sensors stay."""
        self._batch.forward(ids=rows, stage=mujoco.mjtStage.mjSTAGE_POS)  # A reset changes only coordinates.
        state = {field: values[rows] for field, values in self._looked_at.items()}
        self._look(ledger, rows, {**state, "sensordata": self._measured[rows]}, observations)

    def _look(
        self,
        ledger: episodes.Ledger,
        rows: np.ndarray,
        state: dict[str, np.ndarray],
        observations: Mapping[str, np.ndarray],
    ) -> None:
        if len(self.apparatus.told):
            state["sensordata"][:, self.apparatus.told] = ledger.told(rows)
        self._measured[rows] = state["sensordata"]
        self._task.observer.look(self.apparatus, state, ledger.touched[rows], self._starts, rows, observations)

    def reset(self, rows: np.ndarray, hidden: np.ndarray, nuisances: np.ndarray) -> None:
        """Puts rows into the initial states of episodes."""
        self._batch.state[rows] = self._rest
        self._control[rows] = 0
        fields, starts = self._task.begin(self.apparatus, hidden, nuisances)
        for field, (addresses, values) in fields:
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

    def poses(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray, apparatus_lib.Sizes]:
        """Returns positions, m, and rotations of the geoms, [number of rows, ngeom, 3 and 9], and sizes of some.

        They are computed anew, since a reset changes only coordinates. Sensors are not: indicators show last readings.
        """
        fields = [self._batch.bind(field) for field in ("geom_xpos", "geom_xmat")]  # Written to by what is called next.
        self._batch.forward(ids=rows, stage=mujoco.mjtStage.mjSTAGE_POS)
        positions, rotations = (values[rows].reshape(len(rows), self.apparatus.model.ngeom, -1) for values in fields)
        self.apparatus.indicate(positions, self._measured[rows])
        return positions, rotations, self.apparatus.sizes(self._measured[rows])
