"""Threshold: a block that friction holds, and the question which force makes it slide."""

import dataclasses

import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, priors, rendering, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import arena, material, measures, things

PHYSICS_TIMESTEP = 0.01  # s

# A block on a rail between two stops. A push goes away from the stop that the block leans on, and a force above its
# friction takes it to the other one within a control step. All that can be read of the block is whether it has slid:
# how far would tell the friction after a single push.
NUM_LEVELS = 8
LEVEL_SPACING = 4.0  # N: level k pushes with (k + 1) times this force
MASS = 0.05  # kg: so light that the smallest surplus of force takes the block across in time
TRAVEL = 0.02  # m, between the stops
# Share of an interval between two levels that friction keeps away from either. Nearer to a level, the surplus of force
# would be too small to take the block across.
MARGIN = 0.2

_FRICTION = material.dry_friction(PHYSICS_TIMESTEP)
_STOP = material.stop(PHYSICS_TIMESTEP, damping_ratio=0.6)

# s: the smallest surplus of force, MARGIN * LEVEL_SPACING, takes 0.05 s from one stop to the other.
_SHORTEST_STEP = 0.06
_LONGEST_EPISODE = 10.0  # s

_ROOM = dict(mat_size=[0.36, 0.12], camera_pos=[0, -2.6, 0.9], camera_target=[0, 0, 0.1], fovy=14.5)
_COVER_HALF_SIZE = (0.13, 0.08, 0.07)  # m
_FLAG_X, _POINTER_X = 0.24, -0.24  # m
_RISE = (0, 0, 0.3)  # m, of the flag when the block has slid, and of the pointer with the greatest force


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options_lib.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 1.5  # the longer, the less it costs never to answer
    difficulty: float = checked(  # By default, no answer is so rare that to ignore it costs little.
        1.0,
        checks.at_least(1, "the skew of the prior over levels"),
        help="how much more likely low levels are than high ones, >= 1; at 1 all are equally likely; the larger, the "
        "easier",
    )
    flag_noise: float = checked(
        0.0, checks.within(0, 0.5, without=0.5), help="probability that the flag is wrong after a push, less than 0.5"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        self.check_step(_SHORTEST_STEP, "a block gets from one stop to the other")
        meanwhile = "a block that is held creeps too little to be read"
        if self.time_limit > _LONGEST_EPISODE:
            raise ValueError(
                f"time_limit is {self.time_limit} s; give at most {_LONGEST_EPISODE:g} s, in which {meanwhile}"
            )
        if self.longest_play > _LONGEST_EPISODE:
            raise ValueError(
                f"time_limit is {self.time_limit} s, in which pushes may last {self.longest_play:g} s where control "
                f"steps are long; give less: at most {_LONGEST_EPISODE:g} s of pushes, in which {meanwhile}"
            )


def prior(difficulty: float) -> np.ndarray:
    """Returns the probabilities of the labels, float64 [NUM_LEVELS]: those of Beta(1, difficulty) in equal parts."""
    above = 1 - np.arange(NUM_LEVELS + 1) / NUM_LEVELS
    return -np.diff(above**difficulty)


def frictions(hidden: np.ndarray) -> np.ndarray:
    """Returns the frictions, N, float64 [N], of hidden properties, as `Threshold.draw` returns them."""
    return hidden.reshape(len(hidden), -1)[:, 0]


def _is_right(positions: np.ndarray) -> np.ndarray:
    """Returns whether a block leans on the right-hand stop, from its position on the rail, m."""
    return positions > TRAVEL / 2


def _are_wrong(places: np.ndarray, flag_noise: float) -> np.ndarray:
    """Returns whether flags are wrong, bool [N], from their places: numbers of pushes, and draws in (0, 1), added."""
    integers = (2.0**32 * places).astype(np.int64)
    return seeding.uniforms(integers, np.zeros_like(integers), 1)[:, 0] < flag_noise


class Threshold(contract.Task):
    """A covered block on a rail with dry friction, which is hidden, and a flag that tells whether it has slid."""

    options: Options
    question = "Which is the smallest of the forces that makes the block slide?"

    def build(self) -> contract.Scene:
        room = arena.Laboratory(**_ROOM, contact=False, gravity=False)
        room.add_cover(_COVER_HALF_SIZE)
        cube = things.Block(rgba=things.COLORS[0], mass=MASS, name="block")
        cube.geom.group = rendering.UNDRAWN_GROUP
        limits = dict(limited=True, range=[0, TRAVEL], **_FRICTION, **_STOP)
        rail = room.put_on_rail(cube, [-TRAVEL / 2, 0, things.HALF_SIZE], [1, 0, 0], **limits)
        self._rails = (rail.full_identifier,)
        position = room.mjcf_model.sensor.add("jointpos", name="position", joint=rail)
        force, places = room.add_actuator("push", rail), []
        slid_meaning = "1 if the last push made the block slide, otherwise 0"
        if noise := self.options.flag_noise:
            slid_meaning += f"; wrong with probability {noise:g}"
            # Readings are made of sensors alone: this one holds the place of the last flag, see `tell`.
            places = [room.mjcf_model.sensor.add("user", name="mistakes", dim=1, needstage="pos")]
        levels = [LEVEL_SPACING * (k + 1) for k in range(NUM_LEVELS)]
        return contract.Scene(
            arena=room,
            interactions=[
                declarations.Interaction(f"push with {newtons:g} N", np.array([newtons]), "block", (newtons, 0.0, 0.0))
                for newtons in levels
            ],
            label_names=[f"{newtons:g} N" for newtons in levels],
            readings={
                "strength": measures.strength(force, "push", NUM_LEVELS * LEVEL_SPACING),
                "slid": measures.coarse([position, force, *places], slid_meaning, self._flag),
            },
            indicators=[
                things.stand_flag(room, "flag", things.COLORS[1], (_FLAG_X, 0), "slid", _RISE),
                things.stand_flag(room, "pointer", things.COLORS[2], (_POINTER_X, 0), "strength", _RISE),
            ],
        )

    @property
    def description(self) -> str:
        likely = "All forces are equally likely." if self.options.difficulty == 1 else "Low forces are likelier."
        return (
            "A covered block leans on one of two stops. A push lasts one step and goes away from that stop. If its "
            "force is greater than the block's friction, which stays the same, the block slides to the other stop; "
            f"otherwise it does not move. The greatest force always makes it slide. {likely}"
        )

    def _flag(self, values: np.ndarray) -> np.ndarray:
        """Returns 1 where the last push took the block to the other stop, or where the flag is wrong, and 0 elsewhere.

        A push goes away from the stop that the block leans on: if it leans on the stop ahead of the push, it has slid.
        The values, [N, 2 or 3], are the block's position, m, the force, N, and the place of the flag, as above.
        """
        positions, forces, *places = values.T
        is_up = np.where(_is_right(positions), forces > 0, forces < 0)
        for each in places:
            is_up ^= _are_wrong(each, self.options.flag_noise) & (forces != 0)
        return is_up.astype(float)[:, None]

    def flags(self, hidden: np.ndarray, pushes: np.ndarray) -> np.ndarray:
        """Returns the flag after each of the first pushes of an episode, int64 [T]; hidden property as in `draw`."""
        friction, *places = np.ravel(hidden)
        is_up = LEVEL_SPACING * (pushes + 1) > friction
        for each in places:
            is_up ^= _are_wrong(1 + np.arange(len(pushes)) + each, self.options.flag_noise)
        return is_up.astype(np.int64)

    largest_hidden = LEVEL_SPACING * (NUM_LEVELS - MARGIN)

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the frictions of some episodes, N, float64 [N].

        The label follows `prior`; friction is uniform between the forces of two neighbouring levels, away from both.
        With `flag_noise` it returns [N, 2]: a friction, and a number in (0, 1) from which the mistakes of the flag
        follow.
        """
        draws = seeding.uniforms(seeds, episodes, 3)
        labels = priors.choose(prior(self.options.difficulty), draws[:, 0])
        newtons = LEVEL_SPACING * (labels + MARGIN + (1 - 2 * MARGIN) * draws[:, 1])
        return np.column_stack([newtons, draws[:, 2]]) if self.options.flag_noise else newtons

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        return (frictions(hidden) // LEVEL_SPACING).astype(np.int64)

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        return apparatus_lib.frictions(apparatus, self._rails, frictions(hidden)[:, None])

    def drive(self, actions: np.ndarray, qpos: np.ndarray, ctrl: np.ndarray) -> np.ndarray:
        """Returns the force of a push, which goes away from the stop that the block leans on, N [N, 1]."""
        return self.controls[actions] * np.where(_is_right(qpos), -1, 1)

    def tell(self, hidden: np.ndarray, asked: np.ndarray, steps: np.ndarray) -> np.ndarray:
        """Returns the place of the last flag, [N, 1], with `flag_noise`; see `_are_wrong`."""
        return steps[:, None] + hidden.reshape(len(hidden), -1)[:, 1:]

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        return declarations.Revealed(marks={"block": f"friction {np.ravel(hidden)[0]:.1f} N"})

    def hardness(self, hidden: np.ndarray) -> np.ndarray:
        """Returns how rare the right answer is: the rarer, the more pushes it takes to find."""
        return -prior(self.options.difficulty)[self.answers(hidden)]


SUITE = contract.features_and_pixels(Threshold)
