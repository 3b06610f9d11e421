"""Measures that several questions share: of the forces of actuators."""

import functools
from typing import Any

import numpy as np

from physexp.suite.engine import declarations


def is_on(forces: np.ndarray) -> np.ndarray:
    """Returns 1 for each actuator that acts and 0 for the others, from their forces, N [N, K]."""
    return (forces != 0).astype(float)


def strength(sensor: Any, action: str, greatest: float) -> declarations.Reading:
    """Returns the reading of how strong the last action was, as a share of the greatest force, N, from its sensor."""
    return declarations.Reading(
        [sensor],
        (1,),
        f"the force of the last {action}, as a share of {greatest:g} N; 0 before the first",
        bounds=(0, 1),
        measure=functools.partial(_share, greatest=greatest),
    )


def _share(forces: np.ndarray, greatest: float) -> np.ndarray:
    return np.abs(forces) / greatest
