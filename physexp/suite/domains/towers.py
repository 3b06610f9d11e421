"""Towers: a column of five cubes, and the question how many rigid bodies it is made of (paper, Section 6)."""

import dataclasses
import math

from dm_control.utils import containers
import numpy as np

from physexp.suite.engine import seeding, senses, task
from physexp.suite.parts import arena, fist, tower

SUITE = containers.TaggedTasks()

PHYSICS_TIMESTEP = 0.005  # s
WALL_DISTANCE = 0.56  # m, from the tower: a tower that falls as one piece fits inside
CEILING = 0.7  # m, above the floor

# The lowest cube alone is held by friction of 0.3 * (4 + 5) * 9.81 = 26.5 N: twice that moves it, and slides a cube
# from the middle out by a good part of its edge in one control step.
PUSH_FORCE = 50.0  # N

FIST_START = (-0.32, 0.0, 0.25)  # m: at the height of the middle cube, 0.17 m clear of the tower
FIST_SPEED = 1.0  # m/s
_FIST_REACH = 0.4  # m: leaves half a block's room at the wall, and its force is limited
_DIRECTIONS = np.array([(1, 0), (-1, 0), (0, 1), (0, -1)], float)
_DIRECTION_NAMES = ("+x", "-x", "+y", "-y")

_ROOM = dict(mat_size=[0.6, 0.6], camera_pos=[0.35, -3.4, 2.0], camera_target=[-0.03, 0, 0.17], fovy=21.5)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(task.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 2.6  # the paper's 26 steps at its control step of 0.1 s


class Towers(task.QuestionTask):
    """A tower whose glue is hidden."""

    question = "How many rigid bodies is the tower made of?"
    num_structures = len(tower.PATTERNS)

    def __init__(self, options: Options, actuator, sense: senses.Sense):
        """Builds the scene around an actuator, a `DirectActuator` or a `FistActuator`."""
        room = arena.Laboratory(**_ROOM)
        room.add_walls(WALL_DISTANCE, CEILING)
        self._actuator = actuator
        self._tower: tower.Tower | None = None
        self._towers: dict[int, tower.Tower] = {}  # Built when first needed, one for each pattern.
        actuator.attach_to(room)
        self._arena = room
        self.arrange(0)
        super().__init__(room, options, sense, len(actuator.controls), tower.NUM_BLOCKS)

    @property
    def tower(self) -> tower.Tower:
        """The tower of the current structure."""
        assert self._tower is not None  # `arrange` is called when the task is made.
        return self._tower

    @property
    def controls(self):
        return self._actuator.controls

    @property
    def effects(self):
        return self._actuator.effects

    @property
    def interaction_names(self):
        return self._actuator.interaction_names

    @property
    def label_names(self):
        return ["1 body", *(f"{count} bodies" for count in range(2, tower.NUM_BLOCKS + 1))]

    @property
    def sensors(self):
        return {"positions": (self.tower.position_sensors, (tower.NUM_BLOCKS, 3)), **self._actuator.sensors}

    @property
    def bounds(self):
        """Returns the room; a centre is no nearer to its walls than the part of an edge that contacts give way."""
        corner = np.array([WALL_DISTANCE, WALL_DISTANCE, CEILING])
        return {name: (corner * [-1, -1, 0], corner) for name in self.sensors}

    @property
    def held_joints(self):
        return self.tower.joints

    @property
    def held_sensors(self):
        return self.tower.position_sensors

    @property
    def held_geoms(self):
        return [cube.geom for cube in self.tower.blocks]

    def draw(self, seeds, episodes):
        """Indices of glue patterns in `tower.PATTERNS`, int64 [N]."""
        return draw_patterns(seeds, episodes)

    def answers(self, hidden):
        return _NUM_BODIES[hidden] - 1

    def structures(self, hidden):
        return hidden

    def arrange(self, structure):
        if structure not in self._towers:
            self._towers[structure] = built = tower.Tower(tower.PATTERNS[structure])
            self._actuator.equip(built)
        if self._tower is not self._towers[structure]:
            if self._tower is not None:
                self._tower.detach()
            self._tower = self._towers[structure]
            self._arena.attach(self._tower)


_NUM_BODIES = np.array([tower.num_bodies(pattern) for pattern in tower.PATTERNS])


def draw_patterns(seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
    """Glue patterns of some episodes: the count uniform over 1..5, the pattern uniform given the count.

    Args:
      seeds, episodes: environment seeds and episode indices, int64 [N].

    Returns:
      Indices in `tower.PATTERNS`, int64 [N].
    """
    draws = seeding.uniforms(seeds, episodes, 2)
    counts = 1 + (draws[:, 0] * tower.NUM_BLOCKS).astype(np.int64)
    by_count = np.argsort(_NUM_BODIES, kind="stable")
    sizes = np.array([math.comb(tower.NUM_BLOCKS - 1, n - 1) for n in range(1, tower.NUM_BLOCKS + 1)])
    starts = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    return by_count[starts[counts - 1] + (draws[:, 1] * sizes[counts - 1]).astype(np.int64)]


class DirectActuator:
    """Pushes one block with a horizontal force (paper, Section 6.2)."""

    sensors: dict[str, tuple] = {}

    def attach_to(self, room) -> None:
        """Adds the site whose axes give the directions of the forces."""
        self._axes = room.mjcf_model.worldbody.add("site", name="axes", size=[0.001], group=5)

    def equip(self, built: tower.Tower) -> None:
        """Gives a tower what it needs to be pushed."""
        built.add_pushers(self._axes)

    @property
    def controls(self) -> np.ndarray:
        """Action 4 * block + direction pushes the block in that direction, N [20, 10]."""
        return PUSH_FORCE * np.kron(np.eye(tower.NUM_BLOCKS), _DIRECTIONS)

    @property
    def effects(self):
        """The force on a block of each action, N."""
        return [
            (f"block_{k}", (PUSH_FORCE * x, PUSH_FORCE * y, 0.0))
            for k in range(tower.NUM_BLOCKS)
            for x, y in _DIRECTIONS
        ]

    @property
    def interaction_names(self):
        return [f"push block {k} {name}" for k in range(tower.NUM_BLOCKS) for name in _DIRECTION_NAMES]


class FistActuator:
    """Sets the velocity of the fist (paper, Section 6.2)."""

    def __init__(self):
        x, y, _ = FIST_START
        reach = _FIST_REACH
        self.fist = fist.Fist(x_range=[-reach - x, reach - x], y_range=[-reach - y, reach - y])
        self.sensors = {"fist_position": ([self.fist.position_sensor], (3,))}

    def attach_to(self, room) -> None:
        """Places the fist in the room."""
        frame = room.attach(self.fist)
        frame.pos = FIST_START
        self.fist.create_root_joints(frame)

    def equip(self, built: tower.Tower) -> None:
        """Does nothing: the fist needs nothing of the tower."""

    @property
    def controls(self) -> np.ndarray:
        """Action `direction` holds the velocity in that direction, m/s [4, 2]."""
        return FIST_SPEED * _DIRECTIONS

    @property
    def effects(self):
        """The velocity of the fist of each action, m/s."""
        return [("fist", (FIST_SPEED * x, FIST_SPEED * y, 0.0)) for x, y in _DIRECTIONS]

    @property
    def interaction_names(self):
        return [f"move the fist {name}" for name in _DIRECTION_NAMES]


@SUITE.add("features", "direct")
def direct_features(options):
    """Observes `positions`, float32 (5, 3): the blocks' centres, m."""
    return Towers(options, DirectActuator(), senses.Features())


@SUITE.add("features", "fist")
def fist_features(options):
    """Observes `positions`, float32 (5, 3), and `fist_position`, float32 (3,), m."""
    return Towers(options, FistActuator(), senses.Features())


@SUITE.add("pixels", "direct")
def direct_pixels(options):
    """Observes `pixels`, uint8 (84, 84, 3): the room from above its front wall."""
    return Towers(options, DirectActuator(), senses.Pixels())


@SUITE.add("pixels", "fist")
def fist_pixels(options):
    """Observes `pixels`, uint8 (84, 84, 3): the room from above its front wall."""
    return Towers(options, FistActuator(), senses.Pixels())
