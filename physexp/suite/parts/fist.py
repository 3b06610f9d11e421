"""The fist: a large sphere that moves in a horizontal plane (paper, Section 6.2)."""

from collections.abc import Sequence

from dm_control import composer, mjcf

from physexp.suite.parts import material

RADIUS = 0.1  # m
MASS = 20.0  # kg, so heavy that a block hardly slows it
SPEED_GAIN = 2000.0  # N s/m: reaches its speed within two physics steps of 5 ms
MAX_FORCE = 400.0  # N, so that a block caught between fist and wall is not crushed
RGBA = (0.15, 0.15, 0.18, 1.0)


class Fist(composer.Entity):
    """A sphere on two sliding joints, driven by velocity actuators."""

    def _build(
        self,
        x_range: Sequence[float],
        y_range: Sequence[float],
        friction: float = material.FRICTION,
        name: str = "fist",
    ) -> None:
        """Builds a fist with limits of its displacement from where it is attached, m (2,)."""
        self._root = mjcf.RootElement(model=name)
        body = self._root.worldbody.add("body", name="body")
        self.joints = []
        for axis, direction, limits in (("x", [1, 0, 0], x_range), ("y", [0, 1, 0], y_range)):
            joint = body.add("joint", name=axis, type="slide", axis=direction, limited=True, range=limits)
            self.joints.append(joint)
            self._root.actuator.add(
                "velocity", name=axis, joint=joint, kv=SPEED_GAIN, forcelimited=True, forcerange=[-MAX_FORCE, MAX_FORCE]
            )
        self.geom = body.add(
            "geom", name="geom", type="sphere", size=[RADIUS], mass=MASS, rgba=RGBA, **material.solid(friction)
        )
        center = body.add("site", name="center", size=[0.001], group=5)
        self.position_sensor = self._root.sensor.add("framepos", name="position", objtype="site", objname=center)

    @property
    def mjcf_model(self) -> mjcf.RootElement:
        return self._root
