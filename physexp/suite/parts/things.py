"""Things of one geom: cubes, pucks that slide where a question lets them, and boards that show readings."""

from collections.abc import Sequence
from typing import Any

from dm_control import composer, mjcf

from physexp.suite.engine import declarations
from physexp.suite.parts import material

HALF_SIZE = 0.05  # m, half the edge of a cube
PUCK_RADIUS, PUCK_HALF_HEIGHT = 0.03, 0.01  # m
_FLAG_HALF_SIZE = (0.035, 0.01, 0.035)  # m
# One colour a position, never a property: apart in hue and, for grey prints, in lightness.
COLORS = (
    (0.85, 0.25, 0.20, 1.0),
    (0.95, 0.75, 0.20, 1.0),
    (0.25, 0.60, 0.35, 1.0),
    (0.25, 0.50, 0.85, 1.0),
    (0.50, 0.30, 0.60, 1.0),
    (0.45, 0.28, 0.15, 1.0),
)


class Thing(composer.Entity):
    """A body of one geom, `geom`."""

    def _build(self, name: str, **geom: Any) -> None:
        """Builds a thing from the attributes of its geom."""
        self._root = mjcf.RootElement(model=name)
        self.geom = self._root.worldbody.add("geom", name="geom", **geom)

    @property
    def mjcf_model(self) -> mjcf.RootElement:
        return self._root


class Block(Thing):
    """A cube with a site at its centre of mass, `center`."""

    def _build(  # type: ignore[override]  # It takes what the constructor is given.
        self,
        rgba: Sequence[float],
        mass: float,
        half_size: float = HALF_SIZE,
        friction: float = material.FRICTION,
        name: str = "block",
    ) -> None:
        """Builds a cube of the given colour, mass (kg), half an edge (m) and coefficient of friction."""
        super()._build(name, type="box", size=[half_size] * 3, mass=mass, rgba=rgba, **material.solid(friction))
        self.center = self._root.worldbody.add("site", name="center", size=[0.001], group=5)


def puck(rgba: Sequence[float], mass: float, name: str = "puck") -> Thing:
    """Returns a flat cylinder without contacts, of the given colour and mass (kg)."""
    size = [PUCK_RADIUS, PUCK_HALF_HEIGHT]
    return Thing(name, type="cylinder", size=size, mass=mass, rgba=rgba, contype=0, conaffinity=0)


def stand_flag(
    room: composer.Arena,
    name: str,
    rgba: Sequence[float],
    place: tuple[float, float],
    reading: str,
    travel: tuple[float, float, float],
    component: int = 0,
) -> declarations.Indicator:
    """Stands a board without contacts at a place on the floor, m, that shows a reading as an `Indicator` does."""
    board = Thing(name, type="box", size=_FLAG_HALF_SIZE, rgba=rgba, contype=0, conaffinity=0)
    room.attach(board).pos = [*place, _FLAG_HALF_SIZE[2]]
    return declarations.Indicator(board.geom, reading, component, travel)
