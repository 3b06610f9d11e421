"""Strings: pucks under a cover, some of them joined by rubber bands, and the question which."""

from collections.abc import Sequence
import dataclasses
import functools
import itertools

from dm_control import mjcf
import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, rendering, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import arena, measures, things
from physexp.suite.parts import questions as questions_lib

PHYSICS_TIMESTEP = 0.01  # s

# Pucks on parallel rails, each brought home by a spring. A band pulls along what it is tied to once its slack is used
# up, so that a pull moves all pucks that are joined to the pulled one, directly or through others. All that can be read
# is whether a puck is away from home: how far, and when, would tell all bands after two pulls. Only a clamp, which
# holds a puck still and so cuts the ways through it, tells apart what is joined in a row from what is joined in a ring.
NUM_PUCKS = 3  # By default.
_GRAPH = "graph"  # The question which pucks are joined.
_MOST_QUESTIONS = 4  # With more, answers at once tell nearly as much as interactions: a reward tells the right one.

MASS = 0.0142  # kg: a puck is home again, to a reader, 0.1 s after it was pulled
_SPRING = 60.0  # N/m
_DAMPING = 2 * np.sqrt(_SPRING * MASS)  # N s/m: critical
# By the number of pucks: they let a pull take the last one of all pucks in a row away from home, and no other.
SLACKS = {3: (0.004, 0.010), 4: (0.003, 0.006)}  # m, the least and the greatest slack of a band
_BAND = {3: 60.0, 4: 120.0}  # N/m
_PULL = {3: 8.0, 4: 14.0}  # N
_AWAY = 0.005  # m, the distance from home that is read
# A clamp is a brake: it is as if the puck stood in honey that lets it creep by less than a micrometre in an episode. It
# catches pucks at up to 0.2 m/s, and MuJoCo takes an acceleration of more than 1e10 m/s^2 for divergence.
_BRAKE = 1e8  # N s/m

_SHORTEST_STEP = 0.1  # s: pucks come home within it

_WIDTH = 0.4  # m, between the first and the last puck
_ROOM = dict(mat_size=[0.36, 0.42], camera_pos=[0, -2.6, 1.6], camera_target=[0, 0.06, 0], fovy=16.5)
_COVER_HALF_SIZE = (0.3, 0.17, 0.05)  # m
_CLAMP_RGBA = (0.15, 0.15, 0.18, 1.0)
# Boards that show readings, m: where they stand, and how far they move. A clamp is in the cover when it is off.
_HANDLE_Y, _HANDLE_TRAVEL = -0.22, (0.0, -0.14, 0.0)
_CLAMP_Y, _CLAMP_TRAVEL = -0.03, (0.0, 0.0, 0.1)
_FLAG_Y, _FLAG_TRAVEL = 0.2, (0.0, 0.0, 0.2)
# A row of lamps on the cover; they are in it when they are off.
_LAMP_SPACING, _LAMP_PLACE, _LAMP_TRAVEL = 0.07, (0.135, 0.07), 0.045


def pairs(num_pucks: int = NUM_PUCKS) -> list[tuple[int, int]]:
    """Returns the pairs of pucks that a band may join; label bits and hidden properties are in this order."""
    return list(itertools.combinations(range(num_pucks), 2))


def graphs(num_pucks: int = NUM_PUCKS) -> np.ndarray:
    """Returns which pairs are joined in the graph of each label, bool [number of graphs, number of pairs]."""
    number = len(pairs(num_pucks))
    return np.arange(2**number)[:, None] >> np.arange(number) & 1 == 1


@functools.cache
def question_sets() -> dict[str, np.ndarray]:
    """Returns the sets of questions that are told, by name: tables of the graphs that mean yes, bool [Q, graphs].

    Four graphs mean yes. The question whether one pull moves all pucks, and its negation, are left out: one pull
    answers them. Two whole classes are held out: those of `one_at_0` and of `odd`.
    """
    joined, number = graphs(), len(pairs())
    bands = joined.sum(axis=1)
    named = {f"tied_{i}_{j}": joined[:, pair] for pair, (i, j) in enumerate(pairs())}
    for k in range(NUM_PUCKS):
        named[f"one_at_{k}"] = joined[:, [k in pair for pair in pairs()]].sum(axis=1) == 1
    named["odd"] = bands % 2 == 1
    # Three pairs are renamed in every way as three pucks are.
    renamings = [joined[:, order] @ 2 ** np.arange(number) for order in itertools.permutations(range(number))]
    tables = questions_lib.balanced(len(joined))
    tables = tables[[not np.array_equal(table == table[-1], bands > 1) for table in tables]]
    kinds = questions_lib.classes(tables, renamings)
    whole = [int(kinds[(tables == named[name]).all(axis=1)][0]) for name in ("one_at_0", "odd")]
    held_out = questions_lib.are_held_out(tables, kinds, whole)
    sets = {"all": tables, "train": tables[~held_out], "held_out": tables[held_out]}
    return {**sets, **{name: table[None] for name, table in named.items()}}


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
    num_pucks: int = checked(NUM_PUCKS, checks.whole(3, 4), help="3 or 4: the number of pucks; the larger, the harder")
    num_clamps: int = checked(1, checks.whole(1, 2), help="1 or 2: the number of pucks that may be clamped at once")
    questions: str = checked(
        _GRAPH,
        checks.word(_GRAPH, *question_sets()),
        help=f"graph: which pucks are joined; or {questions_lib.SETS}",
    )
    num_questions: int = checked(
        1,
        checks.whole(1, _MOST_QUESTIONS),
        help=f"questions in an episode, at most {_MOST_QUESTIONS}; the next is told when one is answered",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.questions == _GRAPH and self.num_questions > 1:
            raise ValueError(f"num_questions is {self.num_questions} of questions {_GRAPH}; give 1, or other questions")
        if self.questions != _GRAPH and self.num_pucks != NUM_PUCKS:
            raise ValueError(f"questions is {self.questions} of {self.num_pucks} pucks; give {_GRAPH}, or {NUM_PUCKS}")
        self.check_step(_SHORTEST_STEP, "pucks come home")


def prior(difficulty: float, num_pucks: int = NUM_PUCKS) -> np.ndarray:
    """Returns the probabilities of the labels, float64 [number of graphs]."""
    chances = np.array([difficulty, 1.0]) / (1 + difficulty)
    return chances[graphs(num_pucks).astype(int)].prod(axis=1)


def _is_away(positions: np.ndarray) -> np.ndarray:
    """Returns 1 for each puck that is away from home and 0 for the others, from positions on rails, m [N, pucks]."""
    return (np.abs(positions) > _AWAY).astype(float)


class Strings(contract.Task):
    """Covered pucks, some of them joined by bands, clamps, and flags that tell which of the pucks are away."""

    options: Options
    question = "Which pucks are joined by bands?"

    def build(self) -> contract.Scene:
        room = arena.Laboratory(**_ROOM, contact=False)
        root = room.mjcf_model
        root.option.integrator = "implicitfast"  # With the brake, the others diverge.
        room.add_cover(_COVER_HALF_SIZE)
        num_pucks = self.options.num_pucks
        places = np.linspace(-_WIDTH / 2, _WIDTH / 2, num_pucks)  # Of the rails, along x, m.
        rails = [_add_puck(room, k, x) for k, x in enumerate(places)]
        self._pairs = pairs(num_pucks)
        _, self.largest_hidden = SLACKS[num_pucks]
        label_names = [self._name(joined) for joined in graphs(num_pucks)]
        self._bands = tuple(_add_band(root, rails, pair).full_identifier for pair in self._pairs)
        positions = [root.sensor.add("jointpos", name=f"position_{k}", joint=rail) for k, rail in enumerate(rails)]
        # In the order of `drive`. The force that presses a clamp on a puck does not push it along its rail.
        pulls = [room.add_actuator(f"handle_{k}", rail) for k, rail in enumerate(rails)]
        presses = [room.add_actuator(f"clamp_{k}", rail, gear=[0.0]) for k, rail in enumerate(rails)]
        for k, rail in enumerate(rails):
            room.add_actuator(f"brake_{k}", rail, "damper", kv=_BRAKE, ctrlrange=[0, 1])
        indicators = [
            things.stand_flag(room, f"{kind}_{k}", rgba or things.COLORS[k], (x, y), reading, travel, k)
            for kind, rgba, y, reading, travel in (
                ("handle", None, _HANDLE_Y, "pulled", _HANDLE_TRAVEL),
                ("clamp", _CLAMP_RGBA, _CLAMP_Y, "clamped", _CLAMP_TRAVEL),
                ("flag", None, _FLAG_Y, "away", _FLAG_TRAVEL),
            )
            for k, x in enumerate(places)
        ]
        readings = {
            name: measures.coarse(sensors, f"1 for {meaning}, 0 for the others", measure, size=num_pucks)
            for name, sensors, measure, meaning in (
                ("pulled", pulls, measures.is_on, "the puck that the last action pulled"),
                ("clamped", presses, measures.is_on, "each puck that is clamped"),
                ("away", positions, _is_away, "each puck that is away from home"),
            )
        }
        if self.options.questions != _GRAPH:
            readings |= self._tell_questions(room, label_names, indicators)
        controls = np.eye(3 * num_pucks)
        pull = _PULL[num_pucks]
        return contract.Scene(
            arena=room,
            interactions=[
                declarations.Interaction(f"{verb} puck {k}", control * controls[start + k], f"puck_{k}", vector)
                for verb, start, control, vector in (
                    ("pull", 0, pull, (0.0, -pull, 0.0)),
                    ("clamp or free", num_pucks, 1.0, (0.0, 0.0, -1.0)),
                )
                for k in range(num_pucks)
            ],
            label_names=questions_lib.LABELS if self.told else label_names,
            readings=readings,
            indicators=indicators,
        )

    def _tell_questions(
        self, room: arena.Laboratory, names: Sequence[str], indicators: list[declarations.Indicator]
    ) -> dict[str, declarations.Reading]:
        """Chooses the questions that are told about graphs with these names; adds lamps, and returns the reading."""
        tables = question_sets()[self.options.questions]
        self.question = "Is the graph of bands one of those that mean yes?"
        self.told = told = questions_lib.Questions(tables, self.options.num_questions)
        self.largest_hidden = np.array([self.largest_hidden] * len(self._pairs) + [len(tables) - 1] * told.count)
        places = [(_LAMP_SPACING * (k - (len(names) - 1) / 2), *_LAMP_PLACE) for k in range(len(names))]
        indicators += told.add_lamps(room, places, _LAMP_TRAVEL)
        return told.add_reading(room, names)

    @property
    def description(self) -> str:
        options = self.options
        clamps = (
            "There is one clamp: when it is put on another puck, the first one is free."
            if options.num_clamps == 1
            else f"There are {options.num_clamps} clamps: when all are in use, another one cannot be put on."
        )
        told = (
            "Each question is told by numbers, one for each possible set of pairs that are joined: 1 means that the "
            "answer is yes if these are the pairs. "
            if self.told
            else ""
        )
        return (
            f"{options.num_pucks} pucks are under a cover, and some pairs of them are joined by rubber bands. To pull "
            "a puck takes it away from home for one step, and with it all pucks that are joined to it, directly or "
            "through others; a spring brings them home again before the next step. A clamped puck stays at home and "
            f"passes no pull on. {clamps} To clamp or to free a puck moves none. {told}Each pair is joined with "
            f"probability {1 / (1 + options.difficulty):.3g}, whatever the others are."
        )

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the slacks of the bands of some episodes, m, 0 for no band, float64 [N, number of pairs].

        The pairs that are joined follow the prior; slacks are uniform within `SLACKS`. Questions that are told add a
        column each, with their numbers, which are uniform.
        """
        count, number = self.told.count if self.told else 0, len(self._pairs)
        draws = seeding.uniforms(seeds, episodes, 2 * number + count)
        joined, slack, asked = np.split(draws, [number, 2 * number], axis=1)
        least, greatest = SLACKS[self.options.num_pucks]
        slacks = np.where(joined * (1 + self.options.difficulty) < 1, least + (greatest - least) * slack, 0.0)
        return np.hstack([slacks, self.told.draw(asked)]) if self.told else slacks

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        numbers = self.kinds(hidden)
        return self.told.answers(numbers, self.told.drawn(hidden)) if self.told else numbers

    def kinds(self, hidden: np.ndarray) -> np.ndarray:
        """Returns the numbers of the graphs, int64 [N]."""
        return (self._slacks(hidden) > 0) @ 2 ** np.arange(len(self._pairs))

    def _slacks(self, hidden: np.ndarray) -> np.ndarray:
        return hidden[..., : len(self._pairs)]

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        bands, slacks = np.array([apparatus.model.tendon(band).id for band in self._bands]), self._slacks(hidden)
        return {
            "tendon_stiffness": (bands, np.where(slacks > 0, _BAND[self.options.num_pucks], 0.0)),
            "tendon_lengthspring": (bands, np.stack([-slacks, slacks], axis=-1)),  # A band pulls once it is longer.
        }

    def drive(self, actions: np.ndarray, qpos: np.ndarray, ctrl: np.ndarray) -> np.ndarray:
        """Returns the pulls, N, where clamps are pressed, and where they hold, float64 [N, 3 * pucks].

        A clamp takes hold with the step after the one that puts it on, in which the puck comes home.
        """
        pulls, moved, _ = np.split(self.controls[actions], 3, axis=1)
        _, before, _ = np.split(ctrl, 3, axis=1)
        pressed = np.abs(before - moved)
        is_too_many = pressed.sum(axis=1, keepdims=True) > self.options.num_clamps
        pressed = np.where(is_too_many, moved if self.options.num_clamps == 1 else before, pressed)
        return np.concatenate([pulls, pressed, pressed * before], axis=1)

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        tied = [
            (f"puck_{i}", f"puck_{j}") for (i, j), slack in zip(self._pairs, self._slacks(hidden), strict=True) if slack
        ]
        return declarations.Revealed(marks={} if tied else {"puck_1": "no bands"}, tied=tied)

    def _name(self, joined: np.ndarray) -> str:
        """Returns a graph in words."""
        return ", ".join(f"{i}-{j}" for i, j in itertools.compress(self._pairs, joined)) or "none"


def _add_puck(room: arena.Laboratory, number: int, x: float) -> mjcf.Element:
    """Adds a puck and returns its rail."""
    added = things.puck(things.COLORS[number], MASS, name=f"puck_{number}")
    added.geom.group = rendering.UNDRAWN_GROUP
    place = [x, 0, things.PUCK_HALF_HEIGHT]
    return room.put_on_rail(added, place, [0, -1, 0], stiffness=_SPRING, damping=_DAMPING)


def _add_band(root: mjcf.RootElement, rails: Sequence[mjcf.Element], pair: tuple[int, int]) -> mjcf.Element:
    """Adds a band between two pucks and returns it."""
    i, j = pair
    band = root.tendon.add("fixed", name=f"band_{i}_{j}", springlength=[0, 0])
    band.add("joint", joint=rails[i], coef=1)
    band.add("joint", joint=rails[j], coef=-1)
    return band


SUITE = contract.features_and_pixels(Strings)
