"""A column of five blocks, some of them glued into larger rigid bodies (paper, Section 6.1)."""

from collections.abc import Sequence
import itertools

from dm_control import composer, mjcf
import numpy as np

from physexp.suite.parts import material, things

NUM_BLOCKS = 5
BLOCK_MASS = 1.0  # kg

# Every way to glue a tower: entry j of a pattern tells whether block j is glued to block j + 1.
PATTERNS = tuple(itertools.product((False, True), repeat=NUM_BLOCKS - 1))


def num_bodies(pattern: Sequence[bool]) -> int:
    """How many rigid bodies a tower with this glue pattern is made of: each glued joint saves one."""
    return NUM_BLOCKS - sum(pattern)


def _rigid_bodies(pattern: Sequence[bool]) -> list[list[int]]:
    """The blocks of each rigid body, from the floor up."""
    bodies = [[0]]
    for upper, glued in enumerate(pattern, start=1):
        if glued:
            bodies[-1].append(upper)
        else:
            bodies.append([upper])
    return bodies


class Tower(composer.Entity):
    """Five cubes, one above the other; glued cubes are one body with several geoms, hence exactly rigid.

    A body's six degrees of freedom are three slides and a ball joint, since MuJoCo allows a free joint only
    directly below the world. All coordinates are zero (and the quaternion the identity) in the initial column.
    """

    def _build(
        self,
        pattern: Sequence[bool],
        half_size: float = things.HALF_SIZE,
        friction: float = material.FRICTION,
        name: str = "tower",
    ) -> None:
        """Builds a tower that is glued at some of its four joints, from the lowest up."""
        self._root = mjcf.RootElement(model=name)
        heights = [(2 * k + 1) * half_size for k in range(NUM_BLOCKS)]  # Of the cubes' centres.
        self.blocks = []
        for number, members in enumerate(_rigid_bodies(pattern)):
            center = np.mean([heights[k] for k in members])
            body = self._root.worldbody.add("body", name=f"body_{number}", pos=[0, 0, center])
            for axis, direction in zip("xyz", np.eye(3), strict=True):
                body.add("joint", name=f"{axis}_{number}", type="slide", axis=direction)
            body.add("joint", name=f"ball_{number}", type="ball")
            for k in members:
                cube = things.Block(things.COLORS[k], BLOCK_MASS, half_size, friction, name=f"block_{k}")
                mount = body.add("site", name=f"mount_{k}", pos=[0, 0, heights[k] - center], group=5)
                self.attach(cube, mount)
                self.blocks.append(cube)
        self.position_sensors = [
            self._root.sensor.add("framepos", name=f"position_{k}", objtype="site", objname=cube.center)
            for k, cube in enumerate(self.blocks)
        ]

    @property
    def mjcf_model(self) -> mjcf.RootElement:
        return self._root

    def add_pushers(self, world_site: mjcf.Element) -> None:
        """Adds two force actuators a block (N), along the axes of a site that is fixed in the world.

        They act at the block's centre and follow it, so a glued block passes on the force and its torque.
        """
        for k, cube in enumerate(self.blocks):
            for axis, gear in (("x", [1, 0, 0, 0, 0, 0]), ("y", [0, 1, 0, 0, 0, 0])):
                self._root.actuator.add(
                    "general", name=f"push_{axis}_{k}", site=cube.center, refsite=world_site, gear=gear
                )
