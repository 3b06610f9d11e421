"""Calibration: the readings of things with known hidden values, and their inverse."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy import interpolate

from physexp import suite

_NODES = 513

Read = Callable[[Mapping[str, np.ndarray], int], float]
"""Returns the hidden value of a thing, in (0, 1), from the observation after an interaction with it."""


class Responses:
    """Readings of a thing for each of G hidden values, after it was touched at some steps; simulated when needed.

    Interaction k acts on thing k, and component k of the feature shows it; all things have the same physics.
    """

    def __init__(
        self, domain_name: str, task_name: str, feature: str, task_kwargs: Mapping[str, Any], values: np.ndarray
    ):
        """Builds the simulations of a task, as for `suite.load`, for hidden values in [0, 1], float64 [G]."""
        self.task = suite.load_task(domain_name, task_name, {**task_kwargs, "random": 0})
        self.feature, self.values = feature, values
        self._hidden = np.repeat(values[:, None], self.task.num_interactions, axis=1)
        self._batch = suite.BatchEnvironment(self.task, len(values))
        self._found: dict[tuple[bool, ...], np.ndarray] = {}

    def after(self, touched: tuple[bool, ...]) -> np.ndarray:
        """Returns the readings, float64 [G]; `touched` has, for each step since the first touch, whether it was one."""
        if touched not in self._found:
            self._batch.reset(hidden=self._hidden)
            for step, is_touch in enumerate(touched, start=1):
                actions = np.full(len(self.values), 0 if is_touch else 1)
                read = self._batch.step(actions).observation[self.feature]
                self._found[touched[:step]] = read[:, 0].astype(float)
        return self._found[touched]


def calibrate(domain_name: str, task_name: str, feature: str, task_kwargs: Mapping[str, Any]) -> Read:
    """Returns a function that reads values; raises ValueError if different ones give the same reading."""
    responses = Responses(domain_name, task_name, feature, task_kwargs, np.linspace(0, 1, _NODES))
    readings = responses.after((True,))
    steps = np.diff(readings)
    if not (steps < 0).all() and not (steps > 0).all():
        raise ValueError(
            f"control_timestep is {responses.task.options.control_timestep} s, after which things with different "
            "hidden values look the same; give a shorter one"
        )
    order = np.argsort(readings)
    inverse = interpolate.PchipInterpolator(readings[order], responses.values[order], extrapolate=True)
    return lambda observation, action: float(np.clip(inverse(observation[feature][action]), 1e-9, 1 - 1e-9))
