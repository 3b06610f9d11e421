"""Sealed Box: a box on a rail that is closed, and the question what is in it."""

import dataclasses
import itertools

import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, priors, rendering, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import arena, material, measures, things

PHYSICS_TIMESTEP = 0.004  # s
OLD_TIMESTEP = 0.02  # s, of the task's first version, whose walls were as soft as MuJoCo's defaults.
VERSIONS: tuple[dict[str, float], ...] = ({"physics_timestep": OLD_TIMESTEP}, {})
"""The options that make each version of the tasks, v0 and v1."""

# A box slides on a rail, against a spring and a damper. In it is a weight on a rail of its own. The hand that pushes
# the box hides it: only who waits sees where it is, to a mark. With the box in view all the time any shaking would
# tell.
PUSHES = {"hard to the left": -4.0, "to the left": -1.0, "to the right": 1.0, "hard to the right": 4.0}  # N
_STIFFNESS, _DAMPING = 60.0, 2.0  # N/m, N s/m, of the box's rail
MARKS = {1: 0.010, 2: 0.005, 3: 0.003}  # m, between the marks beside the box, by difficulty

CONTENTS = ("a solid weight", "a loose weight", "a weight on a spring", "a weight in goo")
MASSES = (0.8, 1.0, 1.2)  # kg, of box and weight together
SHARES = (0.3, 0.5)  # of that, the weight's
_ROOM_INSIDE = 0.06  # m, to either side of the weight, but for the loose one's
_RUB = 0.02  # N s/m, of every weight that moves


@dataclasses.dataclass(frozen=True)
class Content:
    """The content of a box.

    Attributes:
      kind: index in `CONTENTS`.
      mass: mass of box and weight together, kg.
      share: the weight's share of it.
      gap: how far the weight may move to either side, m.
      stiffness: stiffness of the weight's spring, N/m.
      damping: damping of the weight's motion, N s/m.
    """

    kind: int
    mass: float
    share: float
    gap: float = _ROOM_INSIDE
    stiffness: float = 0.0
    damping: float = _RUB


def _contents() -> tuple[Content, ...]:
    """Returns all possible contents, kind by kind."""
    kinds = (
        ({"damping": 1e6},),
        ({"gap": 0.010}, {"gap": 0.025}),
        ({"stiffness": 20.0}, {"stiffness": 80.0}),
        ({"damping": _RUB + 1.0}, {"damping": _RUB + 4.0}),
    )
    return tuple(
        Content(kind, mass, share, **settings)
        for kind, variants in enumerate(kinds)
        for mass, share, settings in itertools.product(MASSES, SHARES, variants)
    )


ALL_CONTENTS = _contents()
KINDS = np.array([content.kind for content in ALL_CONTENTS])
PRIOR = 1 / len(CONTENTS) / np.bincount(KINDS)[KINDS]
"""The probability of each of `ALL_CONTENTS`, where kinds are equally likely, and so are those of one kind."""


BOX_HALF_SIZE = 0.13  # m: holds the weight, wherever it moves
_REACH = 0.4  # m: no box gets farther from home; pushed along its velocity all the time, one gets to 0.363

_ROOM = dict(mat_size=[0.5, 0.34], camera_pos=[0, -2.9, 1.1], camera_target=[0, 0, 0.08], fovy=20.0)
_BOX_RGBA, _CURTAIN_RGBA, _POINTER_RGBA = things.COLORS[5], (0.50, 0.50, 0.55, 1.0), (0.15, 0.15, 0.18, 1.0)
_CURTAIN_HALF_SIZE = (0.50, 0.005, 0.20)  # m
_CURTAIN_Y, _CURTAIN_RISE = -0.2, 0.6  # m; at rest it is under the floor
_POINTER_Y, _POINTER_TRAVEL = -0.3, 0.4  # m


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options_lib.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep: float = checked(  # type: ignore[misc]  # Other domains have one for all their tasks.
        PHYSICS_TIMESTEP,
        checks.among(0.0005, 0.001, 0.002, PHYSICS_TIMESTEP, OLD_TIMESTEP),
        help=f"step of the simulation, s; {OLD_TIMESTEP:g} is the coarse one of the tasks' first version",
    )
    time_limit: float = 2.0  # the longer, the less it costs never to answer
    difficulty: float = checked(
        2.0,
        checks.among(*MARKS),
        help="1, 2 or 3: how finely the place of the box is read, to 10, 5 or 3 mm; the larger, the easier",
    )


def _share(forces: np.ndarray) -> np.ndarray:
    """Returns the share of the greatest force that was pushed with, positive to the right, from the force, N [N, 1]."""
    return forces / max(PUSHES.values())


class SealedBox(contract.Task):
    """A closed box on a sprung rail, which a hand hides while it pushes."""

    options: Options
    question = "What is in the box?"

    def build(self) -> contract.Scene:
        self._mark = MARKS[int(self.options.difficulty)]
        room = arena.Laboratory(**_ROOM, contact=False, gravity=False)
        box = things.Block(_BOX_RGBA, mass=1.0, half_size=BOX_HALF_SIZE, name="box")
        rail = room.put_on_rail(box, [0, 0, BOX_HALF_SIZE], [1, 0, 0], stiffness=_STIFFNESS, damping=_DAMPING)
        weight = things.puck(_POINTER_RGBA, mass=1.0, name="weight")
        weight.geom.group = rendering.UNDRAWN_GROUP
        walls = {} if self.options.physics_timestep == OLD_TIMESTEP else material.stop(PHYSICS_TIMESTEP)
        slide = dict(type="slide", axis=[1, 0, 0], limited=True, range=[-1, 1], **walls)
        inner = box.attach(weight).add("joint", name="inner", **slide)
        self._joints = (rail.full_identifier, inner.full_identifier)
        position = room.mjcf_model.sensor.add("jointpos", name="position", joint=rail)
        force = room.add_actuator("push", rail)
        place = [0, _CURTAIN_Y, _CURTAIN_HALF_SIZE[2] - _CURTAIN_RISE]
        curtain = room.add_scenery("curtain", _CURTAIN_HALF_SIZE, place, _CURTAIN_RGBA)
        pointer = things.stand_flag(room, "pointer", _POINTER_RGBA, (0, _POINTER_Y), "push", (_POINTER_TRAVEL, 0, 0))
        farthest = np.ceil(_REACH / self._mark)
        push_meaning = "the last push, as a share of a hard one, positive to the right; 0 for none"
        covered_meaning = "1 if the box is hidden, as it is by a push, otherwise 0"
        place_meaning = "how many marks the box is from home, positive to the right; 0 if it is hidden"
        return contract.Scene(
            arena=room,
            interactions=[
                *(
                    declarations.Interaction(f"push {where}", np.array([newtons]), "box", (newtons, 0.0, 0.0))
                    for where, newtons in PUSHES.items()
                ),
                declarations.Interaction("wait", np.zeros(1), "box", (0.0, 0.0, 0.0)),
            ],
            label_names=list(CONTENTS),
            readings={
                "push": measures.coarse([force], push_meaning, _share, (-1, 1)),
                "covered": measures.coarse([force], covered_meaning, measures.is_on),
                "place": measures.coarse([position, force], place_meaning, self._place, (-farthest, farthest)),
            },
            indicators=[
                pointer,
                declarations.Indicator(curtain, "covered", 0, (0, 0, _CURTAIN_RISE)),
                declarations.Indicator(box.geom, "place", 0, (self._mark, 0, 0)),
            ],
        )

    @property
    def description(self) -> str:
        soft, hard = PUSHES["to the right"], PUSHES["hard to the right"]
        return (
            "A closed box on a rail, brought home by a spring and a damper, holds a weight. A push lasts one step, "
            f"with {soft:g} N or, if it is hard, {hard:g} N, and the hand hides the box meanwhile. To wait takes the "
            "hand away for one step: then the place of the box can be read, to a mark of "
            f"{1000 * self._mark:g} mm. The box goes on moving from one step to the next. A solid weight moves with "
            "the box; a loose one slides a little and bumps into the walls; one on a spring swings; one in goo lags "
            f"behind. Box and weight have {MASSES[0]:g} to {MASSES[-1]:g} kg together, of which the weight has "
            f"{SHARES[0]:.0%} or {SHARES[-1]:.0%}. All answers are equally likely."
        )

    def _place(self, values: np.ndarray) -> np.ndarray:
        """Returns the marks from home to the box, and 0 while it is pushed, from its position and the force, [N, 2]."""
        positions, forces = values.T
        # Adding 0 makes 0 of -0, which would tell the side.
        return np.where(forces == 0, np.round(positions / self._mark) + 0.0, 0.0)[:, None]

    largest_hidden = len(ALL_CONTENTS) - 1

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the contents of the boxes of some episodes: indices of `ALL_CONTENTS`, int64 [N]."""
        return priors.choose(PRIOR, seeding.uniforms(seeds, episodes, 1)[:, 0])

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        return KINDS[hidden]

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        """Returns the model fields of the box and its rail, and of the weight and its own, as `mj_setConst` does."""
        dofs, bodies = apparatus.dofs(self._joints)
        inner = np.array([apparatus.model.joint(self._joints[1]).id])
        _, total, share, gap, stiffness, damping = np.array([dataclasses.astuple(ALL_CONTENTS[k]) for k in hidden]).T
        weight, box = share * total, (1 - share) * total
        return {
            "body_mass": (bodies, np.stack([box, weight], axis=1)),
            "body_subtreemass": (bodies, np.stack([total, weight], axis=1)),
            "dof_M0": (dofs, np.stack([total, weight], axis=1)),
            "dof_invweight0": (dofs, np.stack([1 / box, total / (box * weight)], axis=1)),
            "dof_damping": (dofs[1:], damping[:, None]),
            "jnt_stiffness": (inner, stiffness[:, None]),
            "jnt_range": (inner, np.stack([-gap, gap], axis=1)[:, None]),
        }

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        content = ALL_CONTENTS[int(hidden)]
        weight = content.share * content.mass
        return declarations.Revealed(marks={"box": f"{CONTENTS[content.kind]}, {weight:.2f} of {content.mass:.1f} kg"})


SUITE = contract.features_and_pixels(SealedBox)
