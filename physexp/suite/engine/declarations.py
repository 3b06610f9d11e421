"""Declarations of a task: its interactions, its readings, and the marks of replays."""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
from typing import Any

import numpy as np

Fields = Mapping[str, tuple[np.ndarray, np.ndarray]]
"""For each model field, the addresses, int [K], at which environments differ, and the values there, [N, K]."""

Measure = Callable[[np.ndarray], np.ndarray]
"""Turns sensor values, float64 [N, number of values], into a reading, [N, ...], row by row."""


@dataclasses.dataclass(frozen=True)
class Interaction:
    """An interaction action.

    Attributes:
      name: its meaning, in words, as in `poke block 2`.
      control: its control signals, float64 [nu].
      thing: name of the entity that it acts on.
      vector: the force (N) or velocity (m/s) to draw there, (3,).
    """

    name: str
    control: np.ndarray
    thing: str
    vector: tuple[float, float, float]


@dataclasses.dataclass(frozen=True)
class Reading:
    """A feature: the values of some sensors, or a measure of them.

    Attributes:
      sensors: the MJCF sensors that make it up.
      shape: shape of the feature.
      meaning: the meaning of its values, in words, without their unit.
      unit: unit of its values.
      components: names of the values of one sensor, as `x`, `y`, `z`; none where each sensor has one value.
      bounds: the least and the greatest values that it ever has, where they are known.
      measure: computes the reading where it is less than the sensors' values; observations hold only what it returns.
      noisy: whether the option `noise` adds noise to it.
    """

    sensors: Sequence[Any]
    shape: tuple[int, ...]
    meaning: str
    unit: str = ""
    components: tuple[str, ...] = ()
    bounds: tuple[Any, Any] | None = None
    measure: Measure | None = None
    noisy: bool = False

    @property
    def title(self) -> str:
        """The meaning of its values, in words, with their unit."""
        return f"{self.meaning}, {self.unit}" if self.unit else self.meaning


@dataclasses.dataclass(frozen=True)
class Indicator:
    """A geom that shows a reading in images: it is drawn at its place plus `travel` times the reading.

    Its size may show the reading, too.

    Attributes:
      geom: the MJCF geom.
      reading: name of the reading.
      component: index in the reading, flattened.
      travel: m, (3,).
      size: returns its size as MuJoCo draws it, m [N, 3], for values of the reading, [N]; None if it keeps its own.
    """

    geom: Any
    reading: str
    component: int
    travel: tuple[float, float, float]
    size: Callable[[np.ndarray], np.ndarray] | None = None


@dataclasses.dataclass(frozen=True)
class Staged:
    """A geom that people see, also if images do not show it, and that moves as readings tell; images keep its place.

    Attributes:
      geom: the MJCF geom.
      rise: returns by how much it is raised, m [N, 1], from readings, each [N, ...], by name; None if it stays.
      lean: returns by how much it is turned about the y axis, rad [N, 1], likewise.
      text: is written beside it.
    """

    geom: Any
    rise: Callable[[Mapping[str, np.ndarray]], np.ndarray] | None = None
    lean: Callable[[Mapping[str, np.ndarray]], np.ndarray] | None = None
    text: str = ""


@dataclasses.dataclass(frozen=True)
class Circumstances:
    """The random variation of N episodes.

    Attributes:
      fields: model fields.
      qpos: initial coordinates: addresses, int [K], and values, [N, K]; None for those of the model.
      strength: factors on the control signals, [N, 1] or [N, nu].
      camera: displacements of the camera, m [N, 3].
    """

    fields: Fields = dataclasses.field(default_factory=dict)
    qpos: tuple[np.ndarray, np.ndarray] | None = None
    strength: np.ndarray | None = None
    camera: np.ndarray | None = None


@dataclasses.dataclass(frozen=True)
class Revealed:
    """The marks that a replay shows of a hidden property.

    Attributes:
      marks: texts beside things, by the thing's name.
      joined: pairs of things that are one rigid body, by their names.
      tied: pairs of things that a band ties to each other, by their names.
    """

    marks: Mapping[str, str] = dataclasses.field(default_factory=dict)
    joined: Sequence[tuple[str, str]] = ()
    tied: Sequence[tuple[str, str]] = ()
