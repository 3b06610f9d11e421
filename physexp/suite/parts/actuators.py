"""The two ways to act on a tower: forces on its blocks, and a fist (paper, Section 6.2)."""

from collections.abc import Sequence

from dm_control import mjcf
import numpy as np

from physexp.suite.engine import declarations
from physexp.suite.parts import arena, fist, material, tower

# The lowest cube alone is held by friction of 0.3 * (4 + 5) * 9.81 = 26.5 N: twice that moves it, and slides a cube
# from the middle out by a good part of its edge in one control step.
PUSH_FORCE = 50.0  # N

FIST_DISTANCE = 0.32  # m, from the tower's axis to the fist's centre at the start: 0.17 m clear of the tower
_FIST_HEIGHT = 0.25  # m: that of the middle cube
FIST_SPEED = 1.0  # m/s
_FIST_REACH = 0.4  # m: leaves half a block's room at the wall, and its force is limited

FIST_VARIATION = (0.02, 0.03)  # m, of where the fist starts, along x and y
STRENGTH_VARIATION = 0.1  # Share of forces and of speeds.

_DIRECTIONS = {"+x": (1, 0), "-x": (-1, 0), "+y": (0, 1), "-y": (0, -1)}


class DirectActuator:
    """Pushes one block with a horizontal force."""

    joints: Sequence[mjcf.Element] = ()
    readings: dict[str, declarations.Reading] = {}

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
            for name, (x, y) in _DIRECTIONS.items():
                control = np.zeros((tower.NUM_BLOCKS, 2))
                control[block] = PUSH_FORCE * x, PUSH_FORCE * y
                vector = (PUSH_FORCE * x, PUSH_FORCE * y, 0.0)
                found.append(
                    declarations.Interaction(f"push block {block} {name}", control.ravel(), f"block_{block}", vector)
                )
        return found


class FistActuator:
    """Sets the velocity of the fist.

    Attributes:
      fist: the fist.
      joints: its joints, along x and y, which `FIST_VARIATION` displaces.
    """

    def __init__(self, friction: float = material.FRICTION, distance: float = FIST_DISTANCE):
        """Builds a fist at a distance from the tower's axis, m."""
        self._distance, reach = distance, _FIST_REACH
        self.fist = fist.Fist([distance - reach, distance + reach], [-reach, reach], friction)
        self.joints = self.fist.joints

    @property
    def readings(self) -> dict[str, declarations.Reading]:
        """The position of the fist's centre, m (3,)."""
        meaning, components = "the fist's centre (x, y, z)", ("x", "y", "z")
        return {
            "fist_position": declarations.Reading(
                [self.fist.position_sensor], (3,), meaning, unit="m", components=components, noisy=True
            )
        }

    def attach_to(self, room: arena.Laboratory) -> None:
        """Places the fist in the room."""
        room.attach(self.fist).pos = -self._distance, 0.0, _FIST_HEIGHT

    def equip(self, built: tower.Tower) -> None:
        """Does nothing: the fist has its own actuators."""

    @property
    def interactions(self) -> list[declarations.Interaction]:
        """4 actions, each of which drives the fist in its direction with `FIST_SPEED`."""
        return [
            declarations.Interaction(
                f"move the fist {name}",
                FIST_SPEED * np.array([x, y], float),
                "fist",
                (FIST_SPEED * x, FIST_SPEED * y, 0.0),
            )
            for name, (x, y) in _DIRECTIONS.items()
        ]


Actuator = DirectActuator | FistActuator
