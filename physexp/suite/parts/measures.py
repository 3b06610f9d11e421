"""Readings that are coarser than their sensors, and measures of the forces of actuators."""

from collections.abc import Sequence
import functools
from typing import Any

import numpy as np

from physexp.suite.engine import declarations


def coarse(
    sensors: Sequence[Any],
    meaning: str,
    measure: declarations.Measure,
    bounds: tuple[float, float] = (0, 1),
    size: int = 1,
) -> declarations.Reading:
    """Returns a reading without a unit that a measure makes of the values of some sensors."""
    return declarations.Reading(sensors, (size,), meaning, bounds=bounds, measure=measure)


def strength(sensor: Any, action: str, greatest: float) -> declarations.Reading:
    """Returns the reading of how strong the last action was, as a share of the greatest force, N, from its sensor."""
    meaning = f"the force of the last {action}, as a share of {greatest:g} N; 0 before the first"
    return coarse([sensor], meaning, functools.partial(_share, greatest=greatest))


def is_on(forces: np.ndarray) -> np.ndarray:
    """Returns 1 for each actuator that acts and 0 for the others, from their forces, N [N, K]."""
    return (forces != 0).astype(float)


def _share(forces: np.ndarray, greatest: float) -> np.ndarray:
    return np.abs(forces) / greatest
