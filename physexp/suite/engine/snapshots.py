"""Snapshots of episodes: episodes of a batch that go on from one state in several ways. For analysis."""

import dataclasses
from typing import Any

import numpy as np

from physexp import checks
from physexp.suite.engine import batch as batch_lib

_COUNTED = ("steps", "num_answered", "num_right", "returns", "touched")


@dataclasses.dataclass(frozen=True)
class Snapshot:
    """The state of the episodes of N environments.

    Attributes:
      environments: their indices, int64 [N].
      identity: arrays [N, ...] that tell the episodes from others of the same environments.
      counted: the attributes of `episodes.Ledger` that change in an episode, arrays [N, ...] by name.
      observed: the last observations, arrays [N, ...] by name.
      states: states of the simulations and their sensors, one array for each structure, float64 [number of its
        environments, ...].
      coordinates: positions and velocities (`qpos` and `qvel`) alone, as `states`.
    """

    environments: np.ndarray
    identity: tuple[np.ndarray, ...]
    counted: dict[str, np.ndarray]
    observed: dict[str, np.ndarray]
    states: tuple[np.ndarray, ...]
    coordinates: tuple[np.ndarray, ...]

    def with_step_count(self, steps: int) -> "Snapshot":
        """Returns the same snapshot with another number of control steps taken."""
        counted = {**self.counted, "steps": np.full_like(self.counted["steps"], steps)}
        return dataclasses.replace(self, counted=counted)

    def repeated(self, times: int, stride: int) -> "Snapshot":
        """Returns the snapshot of several copies of the environments, whose indices are `stride` apart."""

        def tiled(values: Any) -> Any:
            if isinstance(values, dict):
                return {name: tiled(value) for name, value in values.items()}
            if isinstance(values, tuple):
                return tuple(map(tiled, values))
            return np.tile(values, (times, *[1] * (values.ndim - 1)))

        copies = Snapshot(*(tiled(getattr(self, field.name)) for field in dataclasses.fields(self)))
        copies.environments[:] += np.repeat(stride * np.arange(times), len(self.environments))
        return copies


def take(batch: batch_lib.BatchEnvironment, environments: np.ndarray | None = None) -> Snapshot:
    """Returns a snapshot of episodes that are under way, of some environments, sorted indices int [N], or of all."""
    with batch.in_use(environments) as chosen:
        ledger = batch.ledger
        if ledger.over[chosen].any():
            raise RuntimeError("an episode is over; take a snapshot where episodes are under way")
        by_structure = [(group, chosen[members]) for group, members in batch.by_structure(chosen)]
        return Snapshot(
            environments=chosen.copy(),
            identity=_identity(batch, chosen),
            counted={name: getattr(ledger, name)[chosen] for name in _COUNTED},
            observed={name: values[chosen] for name, values in batch.observations.items()},
            states=tuple(group.save(rows) for group, rows in by_structure),
            coordinates=tuple(group.coordinates(rows) for group, rows in by_structure),
        )


def restore(batch: batch_lib.BatchEnvironment, snapshot: Snapshot) -> None:
    """Takes episodes back to a snapshot; the next step goes on from there."""
    with batch.in_use(snapshot.environments) as chosen:
        ledger = batch.ledger
        if not all(map(np.array_equal, _identity(batch, chosen), snapshot.identity)):
            raise ValueError("environments have begun other episodes since the snapshot; restore it before that")
        ledger.over[chosen] = False
        for name, values in snapshot.counted.items():
            getattr(ledger, name)[chosen] = values
        for name, values in snapshot.observed.items():
            batch.observations[name][chosen] = values
        for (group, members), states in zip(batch.by_structure(chosen), snapshot.states, strict=True):
            group.restore(chosen[members], states)


def _identity(batch: batch_lib.BatchEnvironment, chosen: np.ndarray) -> tuple[np.ndarray, ...]:
    ledger = batch.ledger
    return tuple(each[chosen] for each in (batch.episodes, ledger.hidden, ledger.nuisances, ledger.substeps))


def view(batch: batch_lib.BatchEnvironment, field: str, environment: int) -> np.ndarray:
    """Returns a field of `MjData` in one environment, as it is after a step; it may be written to.

    An episode that was written to cannot be rebuilt from its seed and actions.
    """
    index = checks.integer("environment", environment, 0, batch.num_environments - 1)
    with batch.in_use(np.array([index])) as chosen:
        ((group, _),) = batch.by_structure(chosen)
        return group.view(field)[index]
