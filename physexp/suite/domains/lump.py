"""Lump: a lump that a stamp presses and hides meanwhile, and the question what it is made of."""

import dataclasses
import itertools

import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, priors, rendering, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import arena, material, measures, things

PHYSICS_TIMESTEP = 0.01  # s

# A plate lies on a spring, and the spring on a core, which a damper, dry friction or a spring holds. The stamp that
# presses the plate hides the lump, and its height is read only after a wait, to a mark.
PRESSES = (2.0, 6.0)  # N
MARKS = {1: 0.010, 2: 0.008, 3: 0.005}  # m, between the marks beside the lump, by difficulty
DEEPEST = 0.12  # m: there the core meets a stop

MATERIALS = ("rubber", "clay", "putty", "foam")
SPRINGS = (200.0, 280.0, 400.0)  # N/m, between plate and core
_LOCKED = 1e6  # N s/m, of rubber's core
_MASS = 0.05  # kg, of the plate and of the core
_PLATE_DAMPING, _SPRING_DAMPING = 5.2, 3.0  # N s/m: nothing swings


@dataclasses.dataclass(frozen=True)
class Lump:
    """A lump.

    Attributes:
      kind: index in `MATERIALS`.
      spring: stiffness of the spring between plate and core, N/m.
      stiffness: stiffness of the core's spring, N/m.
      damping: damping of the core's motion, N s/m.
      friction: dry friction of the core, N.
    """

    kind: int
    spring: float
    stiffness: float = 0.0
    damping: float = 0.0
    friction: float = 0.0


def _lumps() -> tuple[Lump, ...]:
    """Returns all possible lumps, kind by kind."""
    kinds = (
        [{"damping": _LOCKED}],
        # Hardening clay keeps its dent while a press has at most twice the friction. Without damping: a damper and dry
        # friction on one joint creep.
        [{"friction": newtons, "stiffness": k} for newtons, k in itertools.product((3.2, 4.4), (120.0, 300.0))],
        [{"damping": damping} for damping in (20.0, 40.0, 80.0)],
        [{"stiffness": k, "damping": k * seconds} for k, seconds in itertools.product((150.0, 300.0), (0.15, 0.4))],
    )
    return tuple(
        Lump(kind, spring, **settings)
        for kind, variants in enumerate(kinds)
        for spring, settings in itertools.product(SPRINGS, variants)
    )


ALL_LUMPS = _lumps()
KINDS = np.array([lump.kind for lump in ALL_LUMPS])
PRIOR = 1 / len(MATERIALS) / np.bincount(KINDS)[KINDS]
"""The probability of each of `ALL_LUMPS`, where kinds are equally likely, and so are those of one kind."""

_FRICTION, _STOP = material.dry_friction(PHYSICS_TIMESTEP), material.stop(PHYSICS_TIMESTEP)

_ROOM = dict(mat_size=[0.35, 0.25], camera_pos=[0, -2.9, 1.1], camera_target=[-0.045, 0, 0.19], fovy=12.0)
_HEIGHT, _RADIUS = 0.24, 0.12  # m, of the lump before it is pressed
_PLATE_SIZE = (_RADIUS, 0.005)  # m
# The stamp is a box that comes down over the lump, and hides it at its widest: 0.17 m from the middle.
_STAMP_HALF_SIZE = (0.185, 0.185, 0.14)  # m
_STAMP_RISE = 0.36  # m
_GAUGE, _GAUGE_TRAVEL = (-0.27, -0.1), (0.0, 0.0, 0.26)  # m, of the board that shows the force of the press


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options_lib.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 1.2  # the longer, the less it costs never to answer
    difficulty: float = checked(
        2.0,
        checks.among(*MARKS),
        help="1, 2 or 3: how finely the height of the lump is read, to 10, 8 or 5 mm; the larger, the easier",
    )


def _share(forces: np.ndarray) -> np.ndarray:
    """Returns the share of the greatest force that was pressed with, from the force, N [N, 1]."""
    return forces / max(PRESSES)


class LumpTask(contract.Task):
    """A lump on the floor, and a stamp that hides it while it presses."""

    options: Options
    question = "Is it rubber, clay, putty or foam?"

    def build(self) -> contract.Scene:
        self._mark = MARKS[int(self.options.difficulty)]
        room = arena.Laboratory(**_ROOM, contact=False, gravity=False)
        root = room.mjcf_model
        root.option.integrator = "implicitfast"  # With the damping of rubber, the others diverge.
        moving = dict(type="cylinder", size=_PLATE_SIZE, mass=_MASS, rgba=things.COLORS[2], contype=0, conaffinity=0)
        plate, core = (things.Thing(name, group=rendering.UNDRAWN_GROUP, **moving) for name in ("plate", "core"))
        down = [0, 0, -1]
        top = room.put_on_rail(plate, [0, 0, _HEIGHT], down, damping=_PLATE_DAMPING)
        held = dict(limited=True, range=[-1, DEEPEST], **_FRICTION, **_STOP)
        middle = room.put_on_rail(core, [0, 0, _HEIGHT / 2], down, **held)
        spring = root.tendon.add("fixed", name="spring", stiffness=SPRINGS[0], damping=_SPRING_DAMPING)
        spring.add("joint", joint=top, coef=1)
        spring.add("joint", joint=middle, coef=-1)
        self._core, self._spring = (middle.full_identifier,), spring.full_identifier
        position = root.sensor.add("jointpos", name="position", joint=top)
        force = room.add_actuator("press", top)
        look = dict(rgba=things.COLORS[1], contype=0, conaffinity=0)
        lump = things.Thing("lump", type="ellipsoid", size=_half_size(np.zeros(1))[0], **look)
        room.attach(lump).pos = [0, 0, _HEIGHT / 2]
        stamp = room.add_scenery("stamp", _STAMP_HALF_SIZE, [0, 0, _STAMP_HALF_SIZE[2] + _STAMP_RISE], arena.COVER_RGBA)
        press_meaning = f"the last press, as a share of {max(PRESSES):g} N; 0 for none"
        covered_meaning = "1 if the stamp hides the lump, as it does by a press, otherwise 0"
        dent_meaning = "how many marks the lump is lower than at first; 0 if it is hidden"
        return contract.Scene(
            arena=room,
            interactions=[
                *(
                    declarations.Interaction(f"press with {newtons:g} N", np.array([newtons]), "lump", (0, 0, -newtons))
                    for newtons in PRESSES
                ),
                declarations.Interaction("wait", np.zeros(1), "lump", (0.0, 0.0, 0.0)),
            ],
            label_names=list(MATERIALS),
            readings={
                "press": measures.coarse([force], press_meaning, _share),
                "covered": measures.coarse([force], covered_meaning, measures.is_on),
                "dent": measures.coarse([position, force], dent_meaning, self._dent, (0, DEEPEST / self._mark)),
            },
            indicators=[
                things.stand_flag(room, "gauge", things.COLORS[3], _GAUGE, "press", _GAUGE_TRAVEL),
                declarations.Indicator(stamp, "covered", 0, (0, 0, -_STAMP_RISE)),
                declarations.Indicator(
                    lump.geom, "dent", 0, (0, 0, -self._mark / 2), lambda marks: _half_size(self._mark * marks)
                ),
            ],
        )

    @property
    def description(self) -> str:
        return (
            f"A stamp presses a lump with {PRESSES[0]:g} or {PRESSES[-1]:g} N for one step and hides it meanwhile. To "
            "wait lifts the stamp for one step: then the height of the lump can be read, to a mark of "
            f"{1000 * self._mark:g} mm. Rubber comes up at once. Clay keeps a dent of a hard press, and none of a soft "
            "one. Putty keeps a dent of every press, which the next adds to. Foam comes up slowly, within some steps. "
            "How soft the lump is varies, too. All answers are equally likely."
        )

    def _dent(self, values: np.ndarray) -> np.ndarray:
        """Returns the marks that the lump has sunk, and 0 while it is pressed, from plate and force, [N, 2]."""
        positions, forces = values.T
        marks = np.clip(np.round(positions / self._mark), 0, np.round(DEEPEST / self._mark))
        # Adding 0 makes 0 of -0, which would tell that the plate is above its place.
        return np.where(forces == 0, marks + 0.0, 0.0)[:, None]

    largest_hidden = len(ALL_LUMPS) - 1

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the lumps of some episodes: indices of `ALL_LUMPS`, int64 [N]."""
        return priors.choose(PRIOR, seeding.uniforms(seeds, episodes, 1)[:, 0])

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        return KINDS[hidden]

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        dofs, _ = apparatus.dofs(self._core)
        core = np.array([apparatus.model.joint(self._core[0]).id])
        spring = np.array([apparatus.model.tendon(self._spring).id])
        _, springs, stiffness, damping, friction = _TABLE[hidden].T[:, :, None]
        return {
            "tendon_stiffness": (spring, springs),
            "jnt_stiffness": (core, stiffness),
            "dof_damping": (dofs, damping),
            "dof_frictionloss": (dofs, friction),
        }

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        return declarations.Revealed(marks={"lump": MATERIALS[KINDS[hidden]]})


_TABLE = np.array([dataclasses.astuple(lump) for lump in ALL_LUMPS])


def _half_size(dents: np.ndarray) -> np.ndarray:
    """Returns half the axes of an ellipsoid of constant volume, m [N, 3], from the depth that it is lower, m [N]."""
    heights = _HEIGHT - dents
    radii = _RADIUS * np.sqrt(_HEIGHT / heights)
    return np.stack([radii, radii, heights / 2], axis=1)


SUITE = contract.features_and_pixels(LumpTask)
