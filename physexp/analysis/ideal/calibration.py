"""Calibration: the readings of things with known hidden values, and their inverse."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy import interpolate

from physexp import suite

_NODES = 513


class Responses:
    """Readings of a thing for each of G hidden values, after it was touched at some steps; simulated when needed.

    Interaction k acts on thing k, and component k of the feature shows it; all things have the same physics.
    """

    def __init__(
        self, domain_name: str, task_name: str, feature: str, task_kwargs: Mapping[str, Any], values: np.ndarray
    ):
        """Builds the simulations.

        Args:
          domain_name, task_name, task_kwargs: as for `suite.load`; the hidden property is K values in [0, 1].
          feature: name of the observation.
          values: in [0, 1], float64 [G].
        """
        self.task = suite.load_task(domain_name, task_name, {**task_kwargs, "random": 0})
        self.feature, self.values = feature, values
        self._hidden = np.repeat(values[:, None], self.task.num_interactions, axis=1)
        self._batch = suite.BatchEnvironment(self.task, len(values))
        self._found: dict[tuple[bool, ...], np.ndarray] = {}

    def after(self, touched: tuple[bool, ...]) -> np.ndarray:
        """Returns the reading for each of `values`, float64 [G].

        Args:
          touched: for each step since the first touch, whether the thing was touched.
        """
        if touched not in self._found:
            self._batch.reset(hidden=self._hidden)
            for step, is_touch in enumerate(touched, start=1):
                actions = np.full(len(self.values), 0 if is_touch else 1)
                read = self._batch.step(actions).observation[self.feature]
                self._found[touched[:step]] = read[:, 0].astype(float)
        return self._found[touched]


def calibrate(
    domain_name: str, task_name: str, feature: str, task_kwargs: Mapping[str, Any] | None = None
) -> Callable[[Mapping[str, np.ndarray], int], float]:
    """Returns a function that reads a thing's hidden value, in (0, 1), from the observation after one interaction.

    It takes the observation and the interaction; for the other arguments see `Responses`.

    Raises:
      ValueError: if different values give the same reading.
    """
    values = np.linspace(0, 1, _NODES)
    responses = Responses(domain_name, task_name, feature, task_kwargs or {}, values)
    readings = responses.after((True,))
    order = np.argsort(readings)
    if not (np.diff(readings) < 0).all() and not (np.diff(readings) > 0).all():
        raise ValueError(
            f"control_timestep is {responses.task.options.control_timestep} s, after which things with different "
            "hidden values look the same; give a shorter one"
        )
    inverse = interpolate.PchipInterpolator(readings[order], values[order], extrapolate=True)
    return lambda observation, action: float(np.clip(inverse(observation[feature][action]), 1e-9, 1 - 1e-9))
