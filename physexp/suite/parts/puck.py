"""The puck: a flat cylinder that slides where a question lets it."""

from collections.abc import Sequence

from dm_control import composer, mjcf

RADIUS = 0.03  # m
HALF_HEIGHT = 0.01  # m


class Puck(composer.Entity):
    """A cylinder without contacts."""

    def _build(self, rgba: Sequence[float], mass: float, name: str = "puck") -> None:
        """Builds a puck of the given colour and mass (kg)."""
        self._root = mjcf.RootElement(model=name)
        self.geom = self._root.worldbody.add(
            "geom",
            name="geom",
            type="cylinder",
            size=[RADIUS, HALF_HEIGHT],
            mass=mass,
            rgba=rgba,
            contype=0,
            conaffinity=0,
        )

    @property
    def mjcf_model(self) -> mjcf.RootElement:
        return self._root
