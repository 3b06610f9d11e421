"""The senses: how a task shows its state, as features or as pixels; one environment and a batch share one."""

from collections.abc import Mapping

import numpy as np

from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import rendering

Shapes = Mapping[str, tuple[int, ...]]
"""Shapes of features, by name."""


class Features:
    """Sensor values as float32 arrays."""

    fields: tuple[str, ...] = ("sensordata",)
    """The fields of `MjData` that are looked at."""

    needs_gl = False
    """Whether images are drawn."""

    def blank(self, shapes: Shapes, size: int) -> dict[str, np.ndarray]:
        """Returns arrays for the observations of `size` environments."""
        return {name: np.zeros((size, *shape), np.float32) for name, shape in shapes.items()}

    def look(
        self,
        apparatus: apparatus_lib.Apparatus,
        state: Mapping[str, np.ndarray],
        camera: np.ndarray,
        rows: np.ndarray,
        observations: Mapping[str, np.ndarray],
    ) -> None:
        """Writes the rows, int [N], of the observations that show a state, float64 [N, ...], which it may change.

        The camera is displaced by `camera`, m [N, 3].
        """
        for name in apparatus.readings:
            observations[name][rows] = apparatus.read(name, state["sensordata"])

    def close(self) -> None:
        """Does nothing: features hold no resources."""


class Pixels:
    """One image, `pixels`, from the task's camera, with the methods of `Features`.

    The GL context is made when the first image is drawn.
    """

    fields: tuple[str, ...] = apparatus_lib.LOOKED_AT
    needs_gl = True

    def __init__(self) -> None:
        self._renderer: rendering.Renderer | None = None

    def blank(self, shapes: Shapes, size: int) -> dict[str, np.ndarray]:
        return {"pixels": np.zeros((size, rendering.SIZE, rendering.SIZE, 3), np.uint8)}

    def look(
        self,
        apparatus: apparatus_lib.Apparatus,
        state: Mapping[str, np.ndarray],
        camera: np.ndarray,
        rows: np.ndarray,
        observations: Mapping[str, np.ndarray],
    ) -> None:
        if self._renderer is None:  # All structures of a task have the same geoms: one renderer draws them all.
            self._renderer = rendering.Renderer(apparatus.model, apparatus.moving_geoms)
        apparatus.indicate(state["geom_xpos"], state["sensordata"])
        self._renderer.render(state["geom_xpos"], state["geom_xmat"], rows, observations["pixels"], camera)

    def close(self) -> None:
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None


Sense = Features | Pixels
