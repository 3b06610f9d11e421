"""Crush: cans of one kind that a press crushes for good, and the question which force does so."""

import dataclasses

import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import arena, material, measures, things

PHYSICS_TIMESTEP = 0.01  # s

# The lid of each can is on a rail of its own, with dry friction, which is the strength of the can. A force above it
# takes the lid down to a stop within a control step, and no force takes it up again. All that can be read is which cans
# are crushed: how far a lid sinks would tell the strength after a single press. The cans are equally strong, so a
# choice of the can would only multiply the actions: a press acts on the first one that is whole.
NUM_FORCES = 16
FORCE_SPACING = 2.0  # N: press k has (k + 1) times this force
PRIOR = np.full(NUM_FORCES, 1 / NUM_FORCES)
"""The probabilities of the labels."""
MASS = 0.007  # kg, of a lid: so light that the smallest surplus of force crushes a can in time
TRAVEL = 0.14  # m, of a lid
# Share of an interval between two forces that the strength keeps away from either. Nearer to a force, the surplus would
# be too small to crush a can in time.
MARGIN = 0.2

_STRENGTH = material.dry_friction(PHYSICS_TIMESTEP)
_STOP = material.stop(PHYSICS_TIMESTEP, damping_ratio=0.6)

# s: the smallest surplus of force, MARGIN * FORCE_SPACING, takes 0.07 s from the top to the stop.
_SHORTEST_STEP = 0.08
_LONGEST_PLAY = 10.0  # s

_ROOM = dict(mat_size=[0.4, 0.12], camera_pos=[0, -2.6, 0.9], camera_target=[0, 0, 0.12], fovy=16.0)
_X, _SPACING = 0.08, 0.2  # m, the middle of the row of cans, and the distance between them
_RADIUS, _HEIGHT = 0.065, 0.24  # m, of a can
# In images a crushed can sinks into the floor, as far as its lid, and a bulge comes out of it, m.
_BULGE_HALF_SIZE = (0.09, 0.09, 0.05)
_BULGE_Z, _BULGE_RISE = -0.1, (0.0, 0.0, 0.135)
_GAUGE_X, _RISE = -0.32, (0.0, 0.0, 0.3)  # m, of the board that shows the force of the last press


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options_lib.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 1.6  # the longer, the less it costs never to answer
    num_cans: int = checked(2, checks.whole(1, 3), help="1, 2 or 3: the number of cans; the larger, the easier")

    def __post_init__(self) -> None:
        super().__post_init__()
        self.check_step(_SHORTEST_STEP, "a can is crushed")
        if self.longest_play > _LONGEST_PLAY:
            raise ValueError(
                f"time_limit is {self.time_limit} s, in which presses may last {self.longest_play:g} s; give less: at "
                f"most {_LONGEST_PLAY:g} s of presses, in which a can that holds sinks too little to be read"
            )


def _is_crushed(positions: np.ndarray) -> np.ndarray:
    """Returns 1 for each can that is crushed and 0 for the others, from how far the lids have sunk, m [N, cans]."""
    return (positions > TRAVEL / 2).astype(float)


def _strength(forces: np.ndarray) -> np.ndarray:
    """Returns the force of the last press as a share of the greatest, [N, 1], from the forces on cans, N [N, cans]."""
    return forces.max(axis=1, keepdims=True) / (NUM_FORCES * FORCE_SPACING)


class Crush(contract.Task):
    """Cans of one hidden strength in a row, and a press that stands over the first one that is whole."""

    options: Options
    question = "Which is the smallest of the forces that crushes a can of this kind?"

    def build(self) -> contract.Scene:
        room = arena.Laboratory(**_ROOM, contact=False, gravity=False)
        num_cans = self.options.num_cans
        indicators = [things.stand_flag(room, "press", things.COLORS[3], (_GAUGE_X, 0), "strength", _RISE)]
        rails = []
        for k in range(num_cans):
            x = _X + (k - (num_cans - 1) / 2) * _SPACING
            look = dict(rgba=things.COLORS[k], contype=0, conaffinity=0)
            can = things.Thing(f"can_{k}", type="cylinder", size=[_RADIUS, _HEIGHT / 2], mass=MASS, **look)
            bulge = things.Thing(f"bulge_{k}", type="ellipsoid", size=_BULGE_HALF_SIZE, **look)
            limits = dict(limited=True, range=[0, TRAVEL], **_STRENGTH, **_STOP)
            rails.append(room.put_on_rail(can, [x, 0, _HEIGHT / 2], [0, 0, -1], **limits))
            room.attach(bulge).pos = [x, 0, _BULGE_Z]
            indicators.append(declarations.Indicator(can.geom, "crushed", k, (0, 0, -TRAVEL)))
            indicators.append(declarations.Indicator(bulge.geom, "crushed", k, _BULGE_RISE))
        self._rails = tuple(rail.full_identifier for rail in rails)
        forces = [room.add_actuator(f"press_{k}", rail) for k, rail in enumerate(rails)]
        sensors = room.mjcf_model.sensor
        positions = [sensors.add("jointpos", name=f"position_{k}", joint=rail) for k, rail in enumerate(rails)]
        levels = [FORCE_SPACING * (k + 1) for k in range(NUM_FORCES)]
        strength_meaning = f"the force of the last press, as a share of {levels[-1]:g} N; 0 before the first"
        crushed_meaning = "1 for each can that is crushed, 0 for the others"
        return contract.Scene(
            arena=room,
            interactions=[
                declarations.Interaction(
                    f"press the first whole can with {newtons:g} N", np.full(num_cans, newtons), "press", (0, 0, -1)
                )
                for newtons in levels
            ],
            label_names=[f"{newtons:g} N" for newtons in levels],
            readings={
                "strength": measures.coarse(forces, strength_meaning, _strength),
                "crushed": measures.coarse(positions, crushed_meaning, _is_crushed, size=num_cans),
            },
            indicators=indicators,
        )

    @property
    def description(self) -> str:
        count = self.options.num_cans
        are = f"{count} equally strong cans stand" if count > 1 else "One can stands"
        return (
            f"{are} under a press. A press with a force above a can's strength crushes it for good; a lesser one "
            "changes nothing. Each press takes the first can that is whole; when none is left, a press shows nothing. "
            "The greatest force always crushes a can. All forces are equally likely."
        )

    largest_hidden = FORCE_SPACING * (NUM_FORCES - MARGIN)

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the strengths of the cans of some episodes, N, float64 [N].

        The labels are equally likely; the strength is uniform between two neighbouring forces, away from both.
        """
        draws = seeding.uniforms(seeds, episodes, 2)
        labels = np.floor(NUM_FORCES * draws[:, 0])
        return FORCE_SPACING * (labels + MARGIN + (1 - 2 * MARGIN) * draws[:, 1])

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        return (hidden // FORCE_SPACING).astype(np.int64)

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        return apparatus_lib.frictions(apparatus, self._rails, np.repeat(hidden[:, None], len(self._rails), axis=1))

    def drive(self, actions: np.ndarray, qpos: np.ndarray, ctrl: np.ndarray) -> np.ndarray:
        """Returns the forces on the cans, N [N, cans]: on the first whole one; if none is whole, on the last one."""
        num_cans = qpos.shape[1]
        pressed = np.minimum(_is_crushed(qpos).sum(axis=1).astype(int), num_cans - 1)
        return self.controls[actions] * (pressed[:, None] == np.arange(num_cans))

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        return declarations.Revealed(marks={"can_0": f"strength {float(hidden):.1f} N"})


SUITE = contract.features_and_pixels(Crush)
