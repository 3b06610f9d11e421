"""The block: a cube."""

from collections.abc import Sequence

from dm_control import composer, mjcf

from physexp.suite.parts import material

HALF_SIZE = 0.05  # m, half the edge of a cube
# One colour a position, never a property: apart in hue and, for grey prints, in lightness.
COLORS = (
    (0.85, 0.25, 0.20, 1.0),
    (0.95, 0.75, 0.20, 1.0),
    (0.25, 0.60, 0.35, 1.0),
    (0.25, 0.50, 0.85, 1.0),
    (0.50, 0.30, 0.60, 1.0),
    (0.45, 0.28, 0.15, 1.0),
)


class Block(composer.Entity):
    """A cube with a site at its centre of mass."""

    def _build(
        self,
        rgba: Sequence[float],
        mass: float,
        half_size: float = HALF_SIZE,
        friction: float = material.FRICTION,
        name: str = "block",
    ) -> None:
        """Builds a cube of the given colour, mass (kg), half an edge (m) and coefficient of friction."""
        self._root = mjcf.RootElement(model=name)
        world = self._root.worldbody
        self.geom = world.add(
            "geom", name="geom", type="box", size=[half_size] * 3, mass=mass, rgba=rgba, **material.solid(friction)
        )
        self.center = world.add("site", name="center", size=[0.001], group=5)

    @property
    def mjcf_model(self) -> mjcf.RootElement:
        return self._root
