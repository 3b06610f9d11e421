"""Strings: three pucks under a cover, some of them joined by rubber bands, and the question which."""

from collections.abc import Sequence
import dataclasses
import itertools

from dm_control import mjcf
import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, rendering, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import arena, measures, things

PHYSICS_TIMESTEP = 0.01  # s

# Pucks on parallel rails, each brought home by a spring. A band pulls along what it is tied to once its slack is used
# up, so that a pull moves all pucks that are joined to the pulled one, directly or through others. All that can be read
# is whether a puck is away from home: how far, and when, would tell all bands after two pulls. Only a clamp, which
# holds a puck still and so cuts the ways through it, tells apart what is joined in a row from what is joined in a ring.
NUM_PUCKS = 3
PAIRS = tuple(itertools.combinations(range(NUM_PUCKS), 2))
"""The pairs of pucks that a band may join; label bits and hidden properties are in this order."""
NUM_GRAPHS = 2 ** len(PAIRS)
SLACKS = (0.004, 0.010)  # m, the least and the greatest slack of a band

MASS = 0.0142  # kg: a puck is home again, to a reader, 0.1 s after it was pulled
_SPRING = 60.0  # N/m, and of a band
_DAMPING = 2 * np.sqrt(_SPRING * MASS)  # N s/m: critical
_PULL = 8.0  # N: takes a puck 0.09 to 0.13 m from home, and the last one of three in a row 0.012 m or more
_AWAY = 0.005  # m, the distance from home that is read
# A clamp is a brake: it is as if the puck stood in honey that lets it creep by a nanometre in an episode.
_BRAKE = 1e9  # N s/m

_SHORTEST_STEP = 0.1  # s: pucks come home within it

_SPACING = 0.2  # m, between pucks
_ROOM = dict(mat_size=[0.36, 0.42], camera_pos=[0, -2.6, 1.6], camera_target=[0, 0.06, 0], fovy=16.5)
_COVER_HALF_SIZE = (0.3, 0.17, 0.05)  # m
_CLAMP_RGBA = (0.15, 0.15, 0.18, 1.0)
# Boards that show readings, m: where they stand, and how far they move. A clamp is in the cover when it is off.
_HANDLE_Y, _HANDLE_TRAVEL = -0.22, (0.0, -0.14, 0.0)
_CLAMP_Y, _CLAMP_TRAVEL = -0.03, (0.0, 0.0, 0.1)
_FLAG_Y, _FLAG_TRAVEL = 0.2, (0.0, 0.0, 0.2)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options_lib.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 2.0  # the longer, the less it costs never to answer
    difficulty: float = checked(  # By default, all graphs are equally likely.
        1.0,
        checks.at_least(1, "the odds that two are not joined"),
        help="odds that two pucks are not joined, >= 1; the larger, the easier",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        self.check_step(_SHORTEST_STEP, "pucks come home")


def prior(difficulty: float) -> np.ndarray:
    """Returns the probabilities of the labels, float64 [NUM_GRAPHS]."""
    chances = np.array([difficulty, 1.0]) / (1 + difficulty)
    return chances[is_joined(np.arange(NUM_GRAPHS)).astype(int)].prod(axis=1)


def is_joined(graphs: np.ndarray) -> np.ndarray:
    """Returns which pairs are joined in graphs, bool [N, number of pairs] from the numbers of their labels, int [N]."""
    return np.asarray(graphs)[:, None] >> np.arange(len(PAIRS)) & 1 == 1


def _is_away(positions: np.ndarray) -> np.ndarray:
    """Returns 1 for each puck that is away from home and 0 for the others, from positions on rails, m [N, pucks]."""
    return (np.abs(positions) > _AWAY).astype(float)


class Strings(contract.Task):
    """Three covered pucks, some of them joined by bands, a clamp, and flags that tell which of them are away."""

    options: Options
    question = "Which pucks are joined by bands?"

    def build(self) -> contract.Scene:
        room = arena.Laboratory(**_ROOM, contact=False)
        root = room.mjcf_model
        root.option.integrator = "implicitfast"  # With the brake, the others diverge.
        room.add_cover(_COVER_HALF_SIZE)
        rails = [_add_puck(room, k) for k in range(NUM_PUCKS)]
        self._bands = tuple(_add_band(root, rails, pair).full_identifier for pair in PAIRS)
        positions = [root.sensor.add("jointpos", name=f"position_{k}", joint=rail) for k, rail in enumerate(rails)]
        # In the order of `drive`. The force that presses a clamp on a puck does not push it along its rail.
        pulls = [room.add_actuator(f"handle_{k}", rail) for k, rail in enumerate(rails)]
        presses = [room.add_actuator(f"clamp_{k}", rail, gear=[0.0]) for k, rail in enumerate(rails)]
        for k, rail in enumerate(rails):
            room.add_actuator(f"brake_{k}", rail, "damper", kv=_BRAKE, ctrlrange=[0, 1])
        indicators = [
            things.stand_flag(room, f"{kind}_{k}", rgba or things.COLORS[k], (_x(k), y), reading, travel, k)
            for kind, rgba, y, reading, travel in (
                ("handle", None, _HANDLE_Y, "pulled", _HANDLE_TRAVEL),
                ("clamp", _CLAMP_RGBA, _CLAMP_Y, "clamped", _CLAMP_TRAVEL),
                ("flag", None, _FLAG_Y, "away", _FLAG_TRAVEL),
            )
            for k in range(NUM_PUCKS)
        ]
        readings = {
            name: measures.coarse(sensors, f"1 for {meaning}, 0 for the others", measure, size=NUM_PUCKS)
            for name, sensors, measure, meaning in (
                ("pulled", pulls, measures.is_on, "the puck that the last action pulled"),
                ("clamped", presses, measures.is_on, "the puck that is clamped"),
                ("away", positions, _is_away, "each puck that is away from home"),
            )
        }
        controls = np.eye(3 * NUM_PUCKS)
        return contract.Scene(
            arena=room,
            interactions=[
                declarations.Interaction(f"{verb} puck {k}", control * controls[start + k], f"puck_{k}", vector)
                for verb, start, control, vector in (
                    ("pull", 0, _PULL, (0.0, -_PULL, 0.0)),
                    ("clamp or free", NUM_PUCKS, 1.0, (0.0, 0.0, -1.0)),
                )
                for k in range(NUM_PUCKS)
            ],
            label_names=[_name(graph) for graph in range(NUM_GRAPHS)],
            readings=readings,
            indicators=indicators,
        )

    largest_hidden = SLACKS[1]

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the slacks of the bands of some episodes, m, 0 for no band, float64 [N, number of pairs].

        The pairs that are joined follow the prior; slacks are uniform within `SLACKS`.
        """
        draws = seeding.uniforms(seeds, episodes, 2 * len(PAIRS))
        joined, slack = np.split(draws, 2, axis=1)
        least, greatest = SLACKS
        return np.where(joined * (1 + self.options.difficulty) < 1, least + (greatest - least) * slack, 0.0)

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        return (hidden > 0) @ 2 ** np.arange(len(PAIRS))

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        bands = np.array([apparatus.model.tendon(band).id for band in self._bands])
        return {
            "tendon_stiffness": (bands, np.where(hidden > 0, _SPRING, 0.0)),
            "tendon_lengthspring": (bands, np.stack([-hidden, hidden], axis=-1)),  # A band pulls once it is longer.
        }

    def drive(self, actions: np.ndarray, qpos: np.ndarray, ctrl: np.ndarray) -> np.ndarray:
        """Returns the pulls, N, where the clamp is pressed, and where it holds, float64 [N, 3 * NUM_PUCKS].

        The clamp takes hold with the step after the one that puts it on, in which the puck comes home.
        """
        pulls, wanted, _ = np.split(self.controls[actions], 3, axis=1)
        _, before, _ = np.split(ctrl, 3, axis=1)
        pressed = np.where(wanted.any(axis=1, keepdims=True), wanted * (1 - before), before)
        return np.concatenate([pulls, pressed, pressed * before], axis=1)

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        tied = [(f"puck_{i}", f"puck_{j}") for (i, j), slack in zip(PAIRS, hidden, strict=True) if slack > 0]
        return declarations.Revealed(marks={} if tied else {"puck_1": "no bands"}, tied=tied)


def _x(puck: int) -> float:
    """Returns the position of a puck's rail along x, m."""
    return (puck - (NUM_PUCKS - 1) / 2) * _SPACING


def _add_puck(room: arena.Laboratory, number: int) -> mjcf.Element:
    """Adds a puck and returns its rail."""
    added = things.puck(things.COLORS[number], MASS, name=f"puck_{number}")
    added.geom.group = rendering.UNDRAWN_GROUP
    place = [_x(number), 0, things.PUCK_HALF_HEIGHT]
    return room.put_on_rail(added, place, [0, -1, 0], stiffness=_SPRING, damping=_DAMPING)


def _add_band(root: mjcf.RootElement, rails: Sequence[mjcf.Element], pair: tuple[int, int]) -> mjcf.Element:
    """Adds a band between two pucks and returns it."""
    i, j = pair
    band = root.tendon.add("fixed", name=f"band_{i}_{j}", springlength=[0, 0])
    band.add("joint", joint=rails[i], coef=1)
    band.add("joint", joint=rails[j], coef=-1)
    return band


def _name(graph: int) -> str:
    """Returns a graph in words."""
    joined = [f"{i}-{j}" for (i, j), is_band in zip(PAIRS, is_joined(np.array([graph]))[0], strict=True) if is_band]
    return ", ".join(joined) or "none"


SUITE = contract.features_and_pixels(Strings)
