"""Balance: six blocks of which one has another weight, and the question which, and whether it is heavier or lighter."""

from collections.abc import Mapping, Sequence
import dataclasses
import functools

from dm_control import mjcf
import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, rendering, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import arena, material, measures, things
from physexp.suite.parts import questions as questions_lib

PHYSICS_TIMESTEP = 0.01  # s

# A beam on a hinge, with two pans. Blocks load it with their weight alone, so that laying one down is not felt, and
# only the side to which the beam tilts is read: how far it tilts would tell the difference after one weighing.
NUM_BLOCKS = 6
WEIGHT = 1.0  # kg
_KINDS = ("heavier", "lighter")
DIFFERENCES = (0.25, 0.4)  # Shares of the weight by which the odd block differs, the least and the greatest.
SIDES = {"left": -1, "right": 1}
PLACES = {"aside": 0, **{f"on the {side} pan": value for side, value in SIDES.items()}}
"""Where a block may be put, and the reading that says so; the actions are in this order."""
_BLOCK = "block"  # The question which block is odd.

_GRAVITY = 9.81  # m/s^2
ARM = 0.3  # m, from the hinge to a pan
STOP = 0.05  # rad, the tilt at which the beam leans on a stop
_READ = STOP / 2  # rad, the tilt that is read as one
_BEAM_MASS = 0.1  # kg
_INERTIA = _BEAM_MASS * (2 * ARM) ** 2 / 12  # kg m^2, of a thin beam about its middle
_LEAST_TORQUE = DIFFERENCES[0] * WEIGHT * _GRAVITY * ARM  # N m, of the smallest difference
# The hinge is above the beam's centre of mass, which brings it back: at the stop with half of the least torque. It is
# damped critically, and level again, to a reader, after 0.035 s.
_STIFFNESS = _LEAST_TORQUE / 2 / STOP  # N m/rad
_DAMPING = 2 * np.sqrt(_STIFFNESS * _INERTIA)  # N m s/rad
_STOPPING = material.stop(PHYSICS_TIMESTEP)

_SHORTEST_STEP = 0.08  # s: a beam is at rest, to a reader, within it
_SHORTEST_STEP_WITH_LATCH = 0.1  # s: the same, if the loads of all blocks come and go at once

_SPACING = 0.15  # m, between blocks
_REACH = 0.34  # m, from where a block lies aside to where it lies on a pan
_POINTER_Y, _POINTER_TRAVEL = -0.58, 0.34  # m
_LATCH, _LATCH_TRAVEL = (0.0, 0.55), (0.2, 0.0, 0.0)  # m
# To people the beam stands above the pans, and the lighter pan is raised with the blocks on it: farther than it is, by
# which they see it, and always as far.
_BEAM_HEIGHT, _LEAN = 0.2, 0.15  # m, rad
_POST_HALF_SIZE, _CORD_HALF_SIZE = (0.008, 0.008, _BEAM_HEIGHT / 2), (0.003, 0.003, _BEAM_HEIGHT / 2)  # m
_PAN_HALF_SIZE = (0.08, 0.47, 0.004)  # m
_PAN_RGBA, _POINTER_RGBA = (0.55, 0.55, 0.60, 1.0), (0.15, 0.15, 0.18, 1.0)
_LAMP_X, _LAMP_Z, _LAMP_TRAVEL = 0.15, -0.03, 0.06  # m: on a board, and under it when they are off.
_BOARD_HALF_SIZE = (0.05, 0.45, 0.002)  # m
_ROOM = dict(mat_size=[0.5, 0.68], camera_pos=[0, -1.9, 3.2], camera_target=[0, -0.07, 0], fovy=19.0)


@functools.cache
def question_sets() -> dict[str, np.ndarray]:
    """Returns the sets of questions that are told, by name: tables of the blocks that mean yes, bool [Q, NUM_BLOCKS].

    Three blocks mean yes. Held out are those whose numbers add up to 6 or to 9: if three do, so do the other three.
    """
    tables = questions_lib.balanced(NUM_BLOCKS)
    held_out = np.isin(tables @ np.arange(NUM_BLOCKS), (6, 9))
    named = {"_".join(["among", *map(str, np.flatnonzero(table))]): table[None] for table in tables}
    return {"all": tables, "train": tables[~held_out], "held_out": tables[held_out], **named}


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options_lib.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 4.0  # the longer, the less it costs never to answer
    difficulty: float = checked(  # By default, each block may be the odd one.
        1.0,
        checks.among(1, 2, 3),
        help="1, 2 or 3: 1 plus the number of blocks, drawn grey, that cannot be the odd one; the larger, the easier",
    )
    latch: bool = checked(
        False,
        checks.flag,
        help="whether a latch holds the beam level until one more action releases it, for a step; harder",
    )
    questions: str = checked(
        _BLOCK,
        checks.word(_BLOCK, *question_sets()),
        help="block: which block is odd, and is it heavier or lighter; or whether the odd block is among three: "
        + questions_lib.SETS,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        shortest = _SHORTEST_STEP_WITH_LATCH if self.latch else _SHORTEST_STEP
        self.check_step(shortest, "the beam comes to rest")


def num_suspects(difficulty: float) -> int:
    """Returns how many blocks may be the odd one: the first ones."""
    return NUM_BLOCKS + 1 - int(difficulty)


def _tilt(angles: np.ndarray) -> np.ndarray:
    """Returns to which side the beam tilts, -1, 0 or 1, from its angle, rad [N, 1]; right is positive."""
    return (angles > _READ).astype(float) - (angles < -_READ)


def _across(block: int) -> float:
    """Returns the place of a block along the beam's hinge, m."""
    return ((NUM_BLOCKS - 1) / 2 - block) * _SPACING


def _end_rise(side: int, readings: Mapping[str, np.ndarray]) -> np.ndarray:
    """Returns by how much people see an end of the beam raised, m [N, 1]."""
    return -side * ARM * _LEAN * readings["tilt"]


def _pan_rise(side: int, readings: Mapping[str, np.ndarray]) -> np.ndarray:
    """Returns by how much people see a pan raised, m [N, 1]."""
    return np.maximum(_end_rise(side, readings), 0)


def _block_rise(block: int, readings: Mapping[str, np.ndarray]) -> np.ndarray:
    """Returns by how much people see a block raised with the pan that it lies on, m [N, 1]."""
    left, right = SIDES.values()
    place = readings["places"][:, block : block + 1]
    on_left, on_right = np.maximum(left * place, 0), np.maximum(right * place, 0)
    return on_left * _pan_rise(left, readings) + on_right * _pan_rise(right, readings)


def _stage(room: arena.Laboratory, beam: mjcf.Element, blocks: Sequence[things.Block]) -> list[declarations.Staged]:
    """Adds the pans, and a post and cords that images do not show; returns all that people see of the balance."""
    post = room.add_scenery("post", _POST_HALF_SIZE, [0, 0, _POST_HALF_SIZE[2]], _POINTER_RGBA, is_drawn=False)
    found = [
        declarations.Staged(post),
        declarations.Staged(beam, lean=lambda readings: _LEAN * readings["tilt"]),
        *(declarations.Staged(block.geom, functools.partial(_block_rise, k)) for k, block in enumerate(blocks)),
    ]
    for name, side in SIDES.items():
        pan = room.add_scenery(f"{name}_pan", _PAN_HALF_SIZE, [side * _REACH, 0, _PAN_HALF_SIZE[2]], _PAN_RGBA)
        place = [side * ARM, 0, _CORD_HALF_SIZE[2]]
        cord = room.add_scenery(f"{name}_cord", _CORD_HALF_SIZE, place, _POINTER_RGBA, is_drawn=False)
        end = functools.partial(_end_rise, side)
        found += [declarations.Staged(pan, functools.partial(_pan_rise, side)), declarations.Staged(cord, end)]
    return found


def _add_beam(room: arena.Laboratory) -> mjcf.Element:
    """Adds the beam of the balance and returns its hinge."""
    beam = room.mjcf_model.worldbody.add("body", name="beam", pos=[0, 0, _BEAM_HEIGHT])
    beam.add("geom", name="beam", type="box", size=[ARM, 0.005, 0.005], mass=_BEAM_MASS, group=rendering.UNDRAWN_GROUP)
    spring = dict(stiffness=_STIFFNESS, damping=_DAMPING, limited=True, range=[-STOP, STOP], **_STOPPING)
    return beam.add("joint", name="hinge", type="hinge", axis=[0, 1, 0], **spring)


class Balance(contract.Task):
    """Six blocks beside a balance, which tells which of its pans is heavier."""

    options: Options
    question = "Which block has another weight than the others, and is it heavier or lighter?"

    def build(self) -> contract.Scene:
        room = arena.Laboratory(**_ROOM, contact=False)
        hinge = _add_beam(room)
        latch = self.options.latch
        blocks, torques = [], []
        for k in range(NUM_BLOCKS):
            is_suspect = k < num_suspects(self.options.difficulty)
            cube = things.Block(things.COLORS[k] if is_suspect else _PAN_RGBA, mass=WEIGHT, name=f"block_{k}")
            room.attach(cube).pos = [0, _across(k), things.HALF_SIZE]
            blocks.append(cube)
            torques.append(room.add_actuator(f"block_{k}", hinge, gear=[0.0 if latch else 1.0]))
        staged = _stage(room, hinge.parent.geom["beam"], blocks)
        # With a latch these keep the places alone, and others load the beam when it is released.
        loads = [room.add_actuator(f"load_{k}", hinge) for k in range(NUM_BLOCKS)] if latch else torques
        self._loads = tuple(load.actuator.full_identifier for load in loads)
        pointer = things.stand_flag(room, "pointer", _POINTER_RGBA, (0, _POINTER_Y), "tilt", (_POINTER_TRAVEL, 0, 0))
        angle = room.mjcf_model.sensor.add("jointpos", name="angle", joint=hinge)
        places_meaning = "where each block lies: -1 on the left pan, 1 on the right pan, 0 aside"
        tilt_meaning = "which pan is heavier: -1 the left one, 1 the right one, 0 neither"
        controls = np.eye(2 * NUM_BLOCKS + 1 if latch else NUM_BLOCKS)  # In the order of `drive`.
        interactions = [
            declarations.Interaction(
                f"put block {k} {place}", side * controls[k], f"block_{k}", (0.0, 0.0, -float(abs(side)))
            )
            for k in range(NUM_BLOCKS)
            for place, side in PLACES.items()
        ]
        readings = {
            "places": measures.coarse(torques, places_meaning, np.sign, (-1, 1), NUM_BLOCKS),
            "tilt": measures.coarse([angle], tilt_meaning, _tilt, (-1, 1)),
        }
        indicators = [
            *(declarations.Indicator(cube.geom, "places", k, (_REACH, 0, 0)) for k, cube in enumerate(blocks)),
            pointer,
        ]
        if latch:
            interactions.append(declarations.Interaction("release the beam", controls[-1], "latch", (0.0, 0.0, -1.0)))
            released = room.add_actuator("latch", hinge, gear=[0.0])
            meaning = "1 if the last action released the beam, 0 otherwise"
            readings["released"] = measures.coarse([released], meaning, measures.is_on)
            indicators.append(things.stand_flag(room, "latch", _POINTER_RGBA, _LATCH, "released", _LATCH_TRAVEL))
        label_names = [f"block {k} is {kind}" for k in range(NUM_BLOCKS) for kind in _KINDS]
        if self.options.questions != _BLOCK:
            readings |= self._tell_questions(room, indicators)
        return contract.Scene(
            arena=room,
            interactions=interactions,
            label_names=questions_lib.LABELS if self.told else label_names,
            readings=readings,
            indicators=indicators,
            staged=staged,
        )

    def _tell_questions(
        self, room: arena.Laboratory, indicators: list[declarations.Indicator]
    ) -> dict[str, declarations.Reading]:
        """Chooses the questions that are told; adds a lamp beside each block, and returns the reading."""
        tables = np.repeat(question_sets()[self.options.questions], len(_KINDS), axis=1)
        self.question = "Is the block with another weight one of those that mean yes?"
        self.told = told = questions_lib.Questions(tables, count=1, shown=slice(None, None, len(_KINDS)))
        self.largest_hidden = np.array([self.largest_hidden] * NUM_BLOCKS + [len(tables) - 1])
        room.add_scenery("board", _BOARD_HALF_SIZE, [_LAMP_X, 0, _BOARD_HALF_SIZE[2]], _POINTER_RGBA)
        places = [(_LAMP_X, _across(k), _LAMP_Z) for k in range(NUM_BLOCKS)]
        indicators += told.add_lamps(room, places, _LAMP_TRAVEL)
        return told.add_reading(room, [f"block {k}" for k in range(NUM_BLOCKS)])

    @property
    def description(self) -> str:
        least, greatest = DIFFERENCES
        suspects = num_suspects(self.options.difficulty)
        which = "any of them" if suspects == NUM_BLOCKS else f"one of blocks 0 to {suspects - 1}"
        held = (
            "The beam is held level except in the step of the action that releases it. " if self.options.latch else ""
        )
        told = (
            "The question is told by numbers, one for each block: 1 means that the answer is yes if it has another "
            "weight."
            if self.told
            else ""
        )
        text = (
            f"{NUM_BLOCKS} blocks lie beside a balance at first. An action moves one of them to a pan, or aside; the "
            "others stay where they are. A pan holds any number of blocks, and the beam tilts to the heavier pan. "
            f"{held}All blocks weigh the same but for one, which is {least:.0%} to {greatest:.0%} heavier or lighter. "
            f"It is {which} with equal probability, and as often heavier as lighter. {told}"
        )
        return text.rstrip()

    largest_hidden: float | np.ndarray = WEIGHT * (1 + DIFFERENCES[1])

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the weights of the blocks in some episodes, kg, float64 [N, NUM_BLOCKS].

        The odd block and the sign of its difference are drawn uniformly, the difference uniformly within `DIFFERENCES`.
        Questions that are told add a column with their numbers, which are uniform.
        """
        draws = seeding.uniforms(seeds, episodes, 3)
        labels = np.floor(draws[:, 0] * 2 * num_suspects(self.options.difficulty)).astype(np.int64)
        least, greatest = DIFFERENCES
        differences = WEIGHT * (least + (greatest - least) * draws[:, 1])
        weights = np.full((len(labels), NUM_BLOCKS), WEIGHT)
        weights[np.arange(len(labels)), labels // 2] += np.where(labels % 2, -differences, differences)
        return np.hstack([weights, self.told.draw(draws[:, 2:])]) if self.told else weights

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        labels = self.kinds(hidden)
        return self.told.answers(labels, self.told.drawn(hidden)) if self.told else labels

    def kinds(self, hidden: np.ndarray) -> np.ndarray:
        """Returns the number of the odd block, times 2, and 1 more if it is lighter, int64 [N]."""
        differences = hidden[:, :NUM_BLOCKS] - WEIGHT
        odd = np.abs(differences).argmax(axis=1)
        return 2 * odd + (differences[np.arange(len(hidden)), odd] < 0)

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        weights = hidden[:, :NUM_BLOCKS]
        gains = np.zeros((*weights.shape, apparatus.model.actuator_gainprm.shape[1]))
        gains[..., 0] = _GRAVITY * ARM * weights  # N m at a control of 1
        return {"actuator_gainprm": (np.array([apparatus.model.actuator(load).id for load in self._loads]), gains)}

    def drive(self, actions: np.ndarray, qpos: np.ndarray, ctrl: np.ndarray) -> np.ndarray:
        """Returns where the blocks are, -1 for the left pan, 1 for the right one, 0 for aside, [N, NUM_BLOCKS].

        With a latch, also the places that load the beam, and whether it is released, [N, 2 * NUM_BLOCKS + 1].
        """
        is_moved = actions[:, None] // len(PLACES) == np.arange(NUM_BLOCKS)
        wanted = self.controls[actions]
        places = np.where(is_moved, wanted[:, :NUM_BLOCKS], ctrl[:, :NUM_BLOCKS])
        if not self.options.latch:
            return places
        released = wanted[:, -1:]
        return np.concatenate([places, places * released, released], axis=1)

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        weights = enumerate(hidden[:NUM_BLOCKS])
        return declarations.Revealed(marks={f"block_{k}": f"{weight:.2f} kg" for k, weight in weights})


SUITE = contract.features_and_pixels(Balance)
