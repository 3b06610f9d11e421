"""The fist: a large sphere that moves in a horizontal plane (paper, Section 6.2)."""

from dm_control import mjcf
from dm_control.locomotion.walkers import base

from physexp.suite.parts import material

RADIUS = 0.1  # m
MASS = 20.0  # kg, so heavy that a block hardly slows it
SPEED_GAIN = 2000.0  # N s/m: reaches its speed within two physics steps of 5 ms
MAX_FORCE = 400.0  # N, so that a block caught between fist and wall is not crushed
RGBA = (0.15, 0.15, 0.18, 1.0)


class Fist(base.Walker):
    """A sphere on two sliding joints, driven by velocity actuators."""

    def _build(self, x_range, y_range, friction=material.FRICTION, name="fist"):
        """Builds the fist.

        Args:
          x_range, y_range: limits of its displacement from where it is attached, m (2,).
          friction: coefficient of friction.
          name: name of the MJCF model.
        """
        self._root = mjcf.RootElement(model=name)
        self._ranges = {"x": x_range, "y": y_range}
        self._body = self._root.worldbody.add("body", name="body")
        for axis, direction in (("x", [1, 0, 0]), ("y", [0, 1, 0])):
            joint = self._body.add(
                "joint", name=axis, type="slide", axis=direction, limited=True, range=self._ranges[axis]
            )
            self._root.actuator.add(
                "velocity", name=axis, joint=joint, kv=SPEED_GAIN, forcelimited=True, forcerange=[-MAX_FORCE, MAX_FORCE]
            )
        self.geom = self._body.add(
            "geom", name="geom", type="sphere", size=[RADIUS], mass=MASS, rgba=RGBA, **material.solid(friction)
        )
        center = self._body.add("site", name="center", size=[0.001], group=5)
        self.position_sensor = self._root.sensor.add("framepos", name="position", objtype="site", objname=center)

    def create_root_joints(self, attachment_frame) -> None:
        """Adds nothing: the fist brings its own joints, which keep it in its plane."""

    def initialize_episode(self, physics, random_state):
        """Does nothing: the task places everything."""

    @property
    def mjcf_model(self):
        return self._root

    @property
    def root_body(self):
        return self._body

    @property
    def actuators(self):
        return self._root.find_all("actuator")

    @property
    def observable_joints(self):
        return tuple(self._root.find_all("joint"))
