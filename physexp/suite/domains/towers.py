"""Towers: a column of five cubes, and the question how many rigid bodies it is made of (paper, Section 6)."""

import dataclasses
import functools
import math
from typing import Any

import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import actuators, arena, material, things, tower

PHYSICS_TIMESTEP = 0.005  # s
WALL_DISTANCE = 0.56  # m, from the tower: a tower that falls as one piece fits inside
CEILING = 0.7  # m, above the floor
_GIVE = 0.04  # m: a wall is soft, and the fastest block's centre passes it by less

POSITION_VARIATION = 0.01  # m, of the tower, along x and y
YAW_VARIATION = np.deg2rad(10)
FRICTIONS = (0.25, 0.4)  # Range with full variation; the default is between the two.
MASS_VARIATION = 0.2  # Share of the cubes' mass, the same for all of them.

# How much nearer fist and tower may start with full variation: by the places of both, and by the tower's yaw, which
# takes the corners of cubes of 0.12 m towards the fist by less than 1 cm.
_APPROACH = POSITION_VARIATION + actuators.FIST_VARIATION[0] + 0.01  # m
_FIST_CLEARANCE = 0.01  # m

_ROOM = dict(mat_size=[0.6, 0.6], camera_pos=[0.35, -3.4, 2.0], camera_target=[-0.03, 0, 0.17], fovy=21.5)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options_lib.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 2.6  # the paper's 26 steps at its control step of 0.1 s
    cube_size: float = checked(
        2 * things.HALF_SIZE, checks.within(0.08, 0.12, "m"), help="edge of the cubes, 0.08 to 0.12 m"
    )
    sliding_friction: float | None = checked(
        None,
        checks.optional(checks.within(0.1, 1.0)),
        help="coefficient of friction of cubes, floor and fist, 0.1 to 1; by default 0.3, which `variation` varies",
    )
    fist_distance: float = checked(
        actuators.FIST_DISTANCE,
        help="initial distance from the tower's axis to the centre of the fist, m, at most 0.32, the default. It must "
        "leave 1 cm between them: at least 0.16 for the default cubes, and 0.2 with full variation",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        nearest = actuators.FIST_RADIUS + self.cube_size / 2 + _FIST_CLEARANCE + self.variation * _APPROACH
        name = f"fist_distance, with cube_size {self.cube_size:g} and variation {self.variation:g},"
        distance = checks.within(round(nearest, 4), actuators.FIST_DISTANCE, "m")(name, self.fist_distance)
        object.__setattr__(self, "fist_distance", distance)

    @property
    def friction(self) -> float:
        """The coefficient of friction of cubes, floor and fist; with variation it differs between episodes."""
        return material.FRICTION if self.sliding_friction is None else self.sliding_friction


NUM_BODIES = np.array([tower.num_bodies(pattern) for pattern in tower.PATTERNS])
"""How many rigid bodies a tower is made of, for each glue pattern, int64 [16]."""

_PATTERNS_OF_COUNT = np.array([math.comb(tower.NUM_BLOCKS - 1, count - 1) for count in range(1, tower.NUM_BLOCKS + 1)])

PRIOR = 1 / tower.NUM_BLOCKS / _PATTERNS_OF_COUNT[NUM_BODIES - 1]
"""Probability of each glue pattern, [16], where the count is uniform and the pattern is uniform given the count."""


@functools.lru_cache(maxsize=32)
def _texts(scene: str) -> dict[int, str]:
    """Returns the MJCF by structure, as far as this process has composed it in a scene, and can be added to."""
    return {}


class Towers(contract.Task):
    """A tower whose glue is hidden."""

    options: Options
    question = "How many rigid bodies is the tower made of?"
    discount = 0.98
    largest_hidden = len(NUM_BODIES) - 1

    def __init__(self, options: Options, actuator: actuators.Actuator, pixels: bool):
        self._actuator = actuator
        super().__init__(options, pixels)

    def build(self) -> contract.Scene:
        friction = self.options.friction
        self._room = arena.Laboratory(**_ROOM, friction=friction)
        self._room.add_walls(WALL_DISTANCE, CEILING)
        self._build_tower = functools.partial(tower.Tower, half_size=self.options.cube_size / 2, friction=friction)
        self._towers: dict[int, tower.Tower] = {}  # Built when first needed, one for each pattern.
        self._actuator.attach_to(self._room)
        self.tower = self._tower_of(0)
        self._room.attach(self.tower)
        return self._scene()

    def _tower_of(self, structure: int) -> tower.Tower:
        if structure not in self._towers:
            self._towers[structure] = built = self._build_tower(tower.PATTERNS[structure])
            self._actuator.equip(built)
        return self._towers[structure]

    def _scene(self) -> contract.Scene:
        """Returns the scene with the tower that is attached; walls, which give way a little, bound the positions."""
        sensors, shape = self.tower.position_sensors, (tower.NUM_BLOCKS, 3)
        meaning = "the blocks' centres (x, y, z), from the lowest block up"
        positions = declarations.Reading(sensors, shape, meaning, "m", ("x", "y", "z"), noisy=True)
        corner = np.array([WALL_DISTANCE + _GIVE, WALL_DISTANCE + _GIVE, CEILING])
        bounds = (corner * [-1, -1, 0], corner)
        found = {"positions": positions, **self._actuator.readings}
        return contract.Scene(
            arena=self._room,
            interactions=self._actuator.interactions,
            label_names=["1 body", *(f"{count} bodies" for count in range(2, tower.NUM_BLOCKS + 1))],
            readings={name: dataclasses.replace(reading, bounds=bounds) for name, reading in found.items()},
            held=(self.tower,),
            num_nuisances=11,
            num_structures=len(tower.PATTERNS),
        )

    @property
    def description(self) -> str:
        return (
            f"Five cubes with edges of {self.options.cube_size:g} m stand one above the other, from block 0 on the "
            "floor up to block 4. Some neighbours are glued, and move as one rigid body. x and y are horizontal, z is "
            "the height above the floor, and the tower stands at x = y = 0, more or less, with its sides along x and "
            f"y. {self._actuator.description} Cubes that have begun to move go on moving during the next steps. The "
            "numbers of bodies from 1 to 5 are equally likely."
        )

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the glue patterns of some episodes, drawn from `PRIOR`: indices in `tower.PATTERNS`, int64 [N]."""
        draws = seeding.uniforms(seeds, episodes, 2)
        counts = 1 + (draws[:, 0] * tower.NUM_BLOCKS).astype(np.int64)
        by_count = np.argsort(NUM_BODIES, kind="stable")
        starts = np.concatenate([[0], np.cumsum(_PATTERNS_OF_COUNT)[:-1]])
        return by_count[starts[counts - 1] + (draws[:, 1] * _PATTERNS_OF_COUNT[counts - 1]).astype(np.int64)]

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        return NUM_BODIES[hidden] - 1

    def structures(self, hidden: np.ndarray) -> np.ndarray:
        return hidden

    def arrange(self, structure: int) -> None:
        chosen = self._tower_of(structure)
        if chosen is not self.tower:
            self.tower.detach()
            self.tower = chosen
            self._room.attach(chosen)
            self.scene = self._scene()

    @functools.cached_property
    def _composed(self) -> dict[int, str]:
        return _texts(self.root_entity.mjcf_model.to_xml_string())

    def compose(self, structure: int) -> str:
        """Composes a tower unless this process has composed it in the same scene: that takes most of a reset."""
        if structure in self._towers:  # It may have been changed since it was built.
            return super().compose(structure)
        if structure not in self._composed:
            self._composed[structure] = super().compose(structure)
        return self._composed[structure]

    def circumstances(self, apparatus: apparatus_lib.Apparatus, nuisances: np.ndarray) -> declarations.Circumstances:
        """Varies where tower, fist and camera are, how strong pushes or how fast the fist is, friction, and mass."""
        place, (yaw,), fist, (strength, friction, mass), camera = np.split(nuisances.T, [2, 3, 5, 8])
        (standing,) = apparatus.held
        turned = np.zeros((len(nuisances), 7))  # The coordinates of a rigid body: a position and a quaternion.
        turned[:, :2] = POSITION_VARIATION * place.T
        turned[:, 3], turned[:, 6] = np.cos(YAW_VARIATION * yaw / 2), np.sin(YAW_VARIATION * yaw / 2)
        joints = [apparatus.model.joint(joint.full_identifier) for joint in self._actuator.joints]
        addresses = np.array([joint.qposadr[0] for joint in joints], np.intp)
        displaced = (fist.T * actuators.FIST_VARIATION)[:, : len(joints)]
        return declarations.Circumstances(
            fields={
                **apparatus_lib.scaled_masses(apparatus, standing.bodies, 1 + MASS_VARIATION * mass),
                **({} if self.options.sliding_friction else _frictions(apparatus.model, friction)),
            },
            qpos=(
                np.concatenate([standing.qpos, addresses]),
                np.concatenate([np.tile(turned, len(standing.qpos) // 7), displaced], axis=1),
            ),
            strength=1 + actuators.STRENGTH_VARIATION * strength[:, None],
            camera=contract.CAMERA_VARIATION * camera.T,
        )

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        """Returns the pairs of blocks that are glued together."""
        pattern = tower.PATTERNS[int(hidden)]
        glued = [(f"block_{k}", f"block_{k + 1}") for k, is_glued in enumerate(pattern) if is_glued]
        return declarations.Revealed(joined=glued)


def _frictions(model: Any, nuisances: np.ndarray) -> declarations.Fields:
    """Returns the friction of everything that slides as cubes do, of nuisances in [-1, 1], [N]."""
    geoms = np.flatnonzero(model.geom_friction[:, 0] == material.FRICTION)
    low, high = np.subtract(FRICTIONS, material.FRICTION)
    values = np.repeat(model.geom_friction[None, geoms], len(nuisances), axis=0)
    values[:, :, 0] += np.where(nuisances < 0, -low, high)[:, None] * nuisances[:, None]
    return {"geom_friction": (geoms, values)}


def _direct(options: Options, pixels: bool) -> Towers:
    if options.fist_distance != actuators.FIST_DISTANCE:
        raise ValueError(
            f"fist_distance is {options.fist_distance:g}; give {actuators.FIST_DISTANCE:g} where there is no fist"
        )
    return Towers(options, actuators.Pushes(), pixels)


def _fist(options: Options, pixels: bool) -> Towers:
    return Towers(options, actuators.Fist(options.friction, options.fist_distance), pixels)


SUITE = contract.features_and_pixels(direct=_direct, fist=_fist)
