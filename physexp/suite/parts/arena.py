"""The room in which questions are asked: a lit floor and one fixed camera."""

from collections.abc import Sequence
from typing import Any

from dm_control import composer, mjcf
import numpy as np

from physexp.suite.engine import rendering
from physexp.suite.parts import material

FLOOR_HALF_SIZE = 8.0  # m: the floor fills the view
FLOOR_RGBA = (0.72, 0.72, 0.70, 1.0)
MAT_RGBA = (0.86, 0.86, 0.84, 1.0)
COVER_RGBA = (0.50, 0.50, 0.55, 1.0)


class Laboratory(composer.Arena):
    """A floor at height zero, two lights and the camera `observer`.

    The visible floor is a box, much cheaper to draw than a plane; a plane that is not drawn carries the contacts.
    """

    def _build(
        self,
        mat_size: Sequence[float],
        camera_pos: Sequence[float],
        camera_target: Sequence[float],
        fovy: float,
        friction: float = material.FRICTION,
        contact: bool = True,
        gravity: bool = True,
    ) -> None:
        """Builds the room.

        Args:
          mat_size: half the sizes in x and y of a mat, a brighter part of the floor, where everything happens, m (2,).
          camera_pos: position of the camera, m (3,).
          camera_target: the point that it looks at, m (3,).
          fovy: vertical field of view, degrees.
          friction: coefficient of friction of the ground.
          contact: whether things touch one another.
          gravity: whether things have weight.
        """
        super()._build(name="laboratory")
        root = self.mjcf_model
        if not contact:
            root.option.flag.contact = "disable"
        if not gravity:
            root.option.gravity = [0, 0, 0]
        # MuJoCo's own defaults instead of composer's: no slip correction and pyramidal friction cones, at half the
        # cost, and no extra mass on the massless bodies that carry attached entities.
        root.option.set_attributes(cone="pyramidal", noslip_iterations=0)
        root.compiler.set_attributes(boundmass=0, boundinertia=0)
        root.visual.headlight.set_attributes(ambient=[0.4] * 3, diffuse=[0.3] * 3, specular=[0.0] * 3)
        root.visual.map.set_attributes(znear=0.01, zfar=50)
        root.visual.quality.set_attributes(shadowsize=0, offsamples=0, numslices=8, numstacks=8, numquads=1)
        world = root.worldbody
        lamp = dict(directional=True, castshadow=False, diffuse=[0.5] * 3, specular=[0.0] * 3)
        world.add("light", name="lamp", pos=[0, 0, 3], dir=[-0.3, 0.5, -0.8], **lamp)
        self.floor = self.add_scenery("floor", [FLOOR_HALF_SIZE, FLOOR_HALF_SIZE, 0.01], [0, 0, -0.015], FLOOR_RGBA)
        self.mat = self.add_scenery("mat", [*mat_size, 0.001], [0, 0, 0], MAT_RGBA)
        solid = dict(group=rendering.UNDRAWN_GROUP, **material.solid(friction))
        self.ground = world.add("geom", name="ground", type="plane", size=[1, 1, 0.1], **solid)
        view = _looking_at(camera_pos, camera_target)
        self.camera = world.add("camera", name="observer", pos=camera_pos, fovy=fovy, xyaxes=view)

    def put_on_rail(
        self, thing: composer.Entity, pos: Sequence[float], axis: Sequence[float], **joint: Any
    ) -> mjcf.Element:
        """Attaches a thing at a place, m (3,); returns the slide joint that it moves on, with attributes as in MJCF."""
        frame = self.attach(thing)
        frame.pos = pos
        return frame.add("joint", name="rail", type="slide", axis=axis, **joint)

    def add_actuator(self, name: str, joint: mjcf.Element, kind: str = "motor", **settings: Any) -> mjcf.Element:
        """Adds an actuator of a joint, with settings as in MJCF; returns the sensor of its force, of the same name."""
        actuator = self.mjcf_model.actuator.add(kind, name=name, joint=joint, **settings)
        return self.mjcf_model.sensor.add("actuatorfrc", name=name, actuator=actuator)

    def add_scenery(
        self,
        name: str,
        half_size: Sequence[float],
        pos: Sequence[float],
        rgba: Sequence[float],
        is_drawn: bool = True,
    ) -> mjcf.Element:
        """Adds a box, by half its edges and its centre, m (3,), that touches nothing; returns its geom.

        Images show it if it is drawn.
        """
        look = dict(rgba=rgba, group=None if is_drawn else rendering.UNDRAWN_GROUP)
        return self.mjcf_model.worldbody.add(
            "geom", name=name, type="box", size=half_size, pos=pos, contype=0, conaffinity=0, **look
        )

    def add_cover(self, half_size: Sequence[float], x: float = 0.0) -> None:
        """Adds a box, m (3,), whose middle is at `x` of the floor, and which hides what is in it."""
        self.add_scenery("cover", half_size, [x, 0, half_size[2]], COVER_RGBA)

    def add_walls(self, distance: float, height: float) -> None:
        """Adds four walls and a ceiling, at a distance and a height, m, that are not drawn and keep all things in view.

        They are boxes, not planes: the broad phase skips a box that is far away, which a plane never is.
        """
        half, side = 0.25, distance + 0.5
        boxes = [
            ([half if x else side, half if y else side, height], [x * (distance + half), y * (distance + half), height])
            for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))
        ]
        boxes.append(([side, side, half], [0, 0, height + half]))
        for number, (size, pos) in enumerate(boxes):
            solid = dict(group=rendering.UNDRAWN_GROUP, **material.solid(material.WALL_FRICTION))
            self.mjcf_model.worldbody.add("geom", name=f"wall_{number}", type="box", size=size, pos=pos, **solid)


def _looking_at(pos: Sequence[float], target: Sequence[float]) -> np.ndarray:
    """The right and up directions (6,) of an upright camera at `pos` that looks at `target`."""
    forward = np.subtract(target, pos) / np.linalg.norm(np.subtract(target, pos))
    right = np.cross(forward, [0, 0, 1])
    return np.concatenate([right, np.cross(right, forward)])
