"""The two ways to act on a tower: forces on its blocks, and a fist (paper, Section 6.2)."""

from collections.abc import Sequence

from dm_control import composer, mjcf
import numpy as np

from physexp.suite.engine import declarations
from physexp.suite.parts import arena, material, tower

# The lowest cube alone is held by friction of 0.3 * (4 + 5) * 9.81 = 26.5 N: twice that moves it, and slides a cube
# from the middle out by a good part of its edge in one control step.
PUSH_FORCE = 50.0  # N

FIST_DISTANCE = 0.32  # m, from the tower's axis to the fist's centre at the start: 0.17 m clear of the tower
FIST_RADIUS = 0.1  # m
FIST_SPEED = 1.0  # m/s
_FIST_HEIGHT = 0.25  # m: that of the middle cube
_FIST_REACH = 0.4  # m: leaves half a block's room at the wall, and its force is limited
_FIST_MASS = 20.0  # kg, so heavy that a block hardly slows it
_FIST_RGBA = (0.15, 0.15, 0.18, 1.0)
_SPEED_GAIN = 2000.0  # N s/m: reaches its speed within two physics steps of 5 ms
_MAX_FORCE = 400.0  # N, so that a block caught between fist and wall is not crushed

FIST_VARIATION = (0.02, 0.03)  # m, of where the fist starts, along x and y
STRENGTH_VARIATION = 0.1  # Share of forces and of speeds.

_DIRECTIONS = {"+x": (1.0, 0.0, 0.0), "-x": (-1.0, 0.0, 0.0), "+y": (0.0, 1.0, 0.0), "-y": (0.0, -1.0, 0.0)}


class Pushes:
    """Pushes one block with a horizontal force."""

    joints: Sequence[mjcf.Element] = ()
    readings: dict[str, declarations.Reading] = {}

    description = (
        f"A push acts on the centre of one cube with {PUSH_FORCE:g} N for one step, along x or y; it moves every cube, "
        "even with the whole tower on top."
    )

    def attach_to(self, room: arena.Laboratory) -> None:
        """Adds the site whose axes give the directions of the forces."""
        self._axes = room.mjcf_model.worldbody.add("site", name="axes", size=[0.001], group=5)

    def equip(self, built: tower.Tower) -> None:
        """Adds the force actuators of a tower's blocks."""
        built.add_pushers(self._axes)

    @property
    def interactions(self) -> list[declarations.Interaction]:
        """20 actions, of which `4 * block + direction` pushes that block with `PUSH_FORCE` in that direction."""
        found = []
        for block in range(tower.NUM_BLOCKS):
            for name, (x, y, z) in _DIRECTIONS.items():
                control = np.zeros((tower.NUM_BLOCKS, 2))
                control[block] = PUSH_FORCE * x, PUSH_FORCE * y
                vector = (PUSH_FORCE * x, PUSH_FORCE * y, z)
                action = f"push block {block} {name}"
                found.append(declarations.Interaction(action, control.ravel(), f"block_{block}", vector))
        return found


class Fist(composer.Entity):
    """A large sphere on two sliding joints, `joints`, which move it in a horizontal plane with a given velocity."""

    def _build(self, friction: float = material.FRICTION, distance: float = FIST_DISTANCE) -> None:
        """Builds a fist with a coefficient of friction, at a distance from the tower's axis, m."""
        self._distance = distance
        self._root = mjcf.RootElement(model="fist")
        body = self._root.worldbody.add("body", name="body")
        self.joints = []
        for axis, direction, middle in (("x", [1, 0, 0], distance), ("y", [0, 1, 0], 0)):
            limits = [middle - _FIST_REACH, middle + _FIST_REACH]
            joint = body.add("joint", name=axis, type="slide", axis=direction, limited=True, range=limits)
            force = dict(kv=_SPEED_GAIN, forcelimited=True, forcerange=[-_MAX_FORCE, _MAX_FORCE])
            self._root.actuator.add("velocity", name=axis, joint=joint, **force)
            self.joints.append(joint)
        sphere = dict(type="sphere", size=[FIST_RADIUS], mass=_FIST_MASS, rgba=_FIST_RGBA, **material.solid(friction))
        body.add("geom", name="geom", **sphere)
        center = body.add("site", name="center", size=[0.001], group=5)
        self._position = self._root.sensor.add("framepos", name="position", objtype="site", objname=center)

    @property
    def mjcf_model(self) -> mjcf.RootElement:
        return self._root

    @property
    def readings(self) -> dict[str, declarations.Reading]:
        """The position of the fist's centre, m (3,)."""
        meaning, components = "the fist's centre (x, y, z)", ("x", "y", "z")
        return {"fist_position": declarations.Reading([self._position], (3,), meaning, "m", components, noisy=True)}

    @property
    def description(self) -> str:
        return (
            f"A fist, a sphere with a radius of {FIST_RADIUS:g} m, starts at x = {-self._distance:g} m, y = 0, more or "
            f"less, {_FIST_HEIGHT:g} m above the floor. A move drives it along x or y for one step, with "
            f"{FIST_SPEED:g} m/s; it gets {_FIST_REACH:g} m from its start at most."
        )

    def attach_to(self, room: arena.Laboratory) -> None:
        """Places the fist in the room."""
        room.attach(self).pos = -self._distance, 0.0, _FIST_HEIGHT

    def equip(self, built: tower.Tower) -> None:
        """Does nothing: the fist has its own actuators."""

    @property
    def interactions(self) -> list[declarations.Interaction]:
        """4 actions, each of which drives the fist in its direction with `FIST_SPEED`."""
        return [
            declarations.Interaction(f"move the fist {name}", FIST_SPEED * np.array(direction[:2]), "fist", direction)
            for name, direction in _DIRECTIONS.items()
        ]


Actuator = Pushes | Fist
