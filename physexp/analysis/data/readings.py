"""Readings as curves for people: names, things, units and bounds."""

from collections.abc import Mapping, Sequence
import dataclasses
from typing import Any

import numpy as np

from physexp.suite.engine import declarations

POSITION = (("x", "y", "z"), "m")
"""Components and unit of a reading of positions."""


@dataclasses.dataclass(frozen=True)
class Shown:
    """A reading as S curves for each of C components.

    Attributes:
      name: name of the reading.
      components: names of the components; one empty name for a reading without components.
      names: names of the curves.
      things: names of the things that are measured.
      unit: unit of the values, or empty.
      limits: minimum and maximum of each component, [C, 2], or None.
    """

    name: str
    components: tuple[str, ...]
    names: tuple[str, ...]
    things: tuple[str, ...]
    unit: str
    limits: np.ndarray | None

    @property
    def is_position(self) -> bool:
        """Whether its values are positions, in metres."""
        return (self.components, self.unit) == POSITION

    def values(self, observed: np.ndarray) -> np.ndarray:
        """Returns values [T, S, C] of observations [T, *shape], or of one observation [*shape]."""
        return observed.reshape(-1, len(self.names), len(self.components))


def shown(readings: Mapping[str, declarations.Reading]) -> list[Shown]:
    """Returns all of a task's readings as curves."""
    return [_shown(name, reading) for name, reading in readings.items()]


def spoken(name: str) -> str:
    """Returns the name of a thing or a reading with spaces."""
    return name.replace("_", " ")


def owner(identifier: str) -> str:
    """Returns the innermost model of an identifier: `block_0` of `tower/block_0/center` and of the frame `block_0/`."""
    *models, last = identifier.rstrip("/").split("/")
    return next((part for part in reversed(models) if part), last)


def _shown(name: str, reading: declarations.Reading) -> Shown:
    components = reading.components or ("",)
    count = int(np.prod(reading.shape)) // len(components)
    things = [_thing(sensor) for sensor in reading.sensors]
    names = [spoken(thing) for thing in things]
    if count == 1 and not reading.components:
        names, things = [spoken(name)], things if len(things) == 1 else [""]
    elif count != len(things):  # Values without names.
        names = [str(number) for number in range(count)]
        things = (things if len(set(things)) == 1 else [""])[:1] * count
    elif len(set(things)) < len(things):  # Several sensors of one thing.
        names = [spoken(sensor.name or str(number)) for number, sensor in enumerate(reading.sensors)]
    return Shown(name, components, tuple(names), tuple(things), reading.unit, _limits(reading, len(components)))


def _limits(reading: declarations.Reading, num_components: int) -> np.ndarray | None:
    """Returns the bounds of each component, [C, 2], over all things."""
    if reading.bounds is None:
        return None
    low, high = (np.broadcast_to(bound, reading.shape).reshape(-1, num_components) for bound in reading.bounds)
    return np.stack([low.min(axis=0), high.max(axis=0)], axis=1)


def _thing(sensor: Any) -> str:
    """Returns the thing of an MJCF sensor: the model of its joint, site or body."""
    for value in sensor.get_attributes().values():
        identifier = getattr(value, "full_identifier", None)
        if identifier is not None:
            return owner(identifier)
    return sensor.name


def joined_limits(group: Sequence[np.ndarray | None]) -> tuple[float, float] | None:
    """Returns the common minimum and maximum of several limits; None if one of them is unknown."""
    known = [limits for limits in group if limits is not None]
    if not known or len(known) < len(group):
        return None
    return float(min(limits[0] for limits in known)), float(max(limits[1] for limits in known))
