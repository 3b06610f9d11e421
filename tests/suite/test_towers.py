"""Towers: glue, pushes and the fist do what they say, and two pokes can tell the answer."""

import functools
import itertools

from chance import P_VALUE
from episodes import EVERY_PATTERN, SEED, batch_of, drawn
import numpy as np
import pytest
from scipy import stats

from physexp import suite
from physexp.suite.parts import tower

EDGE = 0.1  # m, of a cube
FIST_RADIUS = 0.1  # m
DIRECTIONS = np.array([(1, 0), (-1, 0), (0, 1), (0, -1)])  # +x, -x, +y, -y

# Bodies in a tower of each pattern, in the order of `tower.PATTERNS`: five, less one for each of the glued joints.
COUNTS = np.array([5 - sum(pattern) for pattern in itertools.product((0, 1), repeat=4)])
SEPARATE, WHOLE = 0, 15

pytestmark = pytest.mark.usefixtures("seed")


def _distances(positions, lower: int, upper: int):
    """Distances between two blocks' centres, float64 [...] from [..., 5, 3]."""
    return np.linalg.norm(positions[..., upper, :].astype(float) - positions[..., lower, :], axis=-1)


def _glued(pattern: int, lower: int, upper: int) -> bool:
    return all(tower.PATTERNS[pattern][lower:upper])


def test_the_count_is_uniform_and_so_is_the_pattern_given_the_count(seed):
    patterns = drawn("towers", np.full(20_000, seed), np.arange(20_000))
    assert stats.chisquare(np.bincount(COUNTS[patterns], minlength=6)[1:]).pvalue > P_VALUE
    for count, number in zip(range(1, 6), (1, 4, 6, 4, 1), strict=True):  # Binomial coefficients of 4.
        seen = np.bincount(patterns, minlength=16)[count == COUNTS]
        assert len(seen) == number
        assert number == 1 or stats.chisquare(seen).pvalue > P_VALUE


@pytest.mark.parametrize("task_name", ["direct_features", "fist_features"])
def test_the_answer_is_the_number_of_bodies_less_one(seed, task_name):
    env = suite.load("towers", task_name, {"random": seed})
    for pattern in EVERY_PATTERN:
        env.reset(hidden=pattern)
        assert env.task.correct_answer == COUNTS[pattern] - 1
        assert env.step(env.task.num_interactions + COUNTS[pattern] - 1).reward == 1


@pytest.mark.parametrize(
    "options",
    [
        {"cube_size": 0.08},
        {"cube_size": 0.12},
        {"sliding_friction": 1.0},
        {"cube_size": 0.095, "sliding_friction": 0.45},
    ],
)
def test_towers_of_other_cubes_look_alike_until_hit_and_keep_their_glue(options):
    edge = options.get("cube_size", EDGE)
    batch = suite.load_batch("towers", "fist_features", 16, {"random": 0, **options})
    first = batch.reset(hidden=EVERY_PATTERN).observation["positions"]
    np.testing.assert_allclose(first, [[(0, 0, edge / 2 + k * edge) for k in range(5)]] * 16, atol=1e-5)
    for _ in range(20):
        now = batch.step(np.ones(16, int)).observation["positions"]  # To -x, away from the tower.
    assert first.tobytes() == now.tobytes()
    assert len({column.tobytes() for column in first}) == 1
    batch.reset(hidden=EVERY_PATTERN)
    for _ in range(10):
        fallen = batch.step(np.zeros(16, int)).observation["positions"]
    for pattern, lower in itertools.product(EVERY_PATTERN, range(4)):
        if _glued(pattern, lower, lower + 1):
            assert _distances(fallen[pattern], lower, lower + 1) == pytest.approx(edge, abs=1e-6)
    batch.close()


@pytest.mark.parametrize("variation", [0.0, 1.0])
@pytest.mark.parametrize("task_name", ["direct_features", "fist_features"])
def test_everything_that_slides_has_the_friction_that_was_chosen(task_name, variation):
    kwargs = {"random": 0, "sliding_friction": 0.45, "variation": variation}
    environment = suite.load("towers", task_name, kwargs)
    environment.reset()
    model = environment.physics.model
    sliding = {model.id2name(i, "geom") for i in np.flatnonzero(model.geom_friction[:, 0] == 0.45)}
    fists = {name for name in sliding if "fist" in name}
    assert len(sliding) == 5 + 1 + (task_name == "fist_features") and len(fists) == (task_name == "fist_features")
    assert not (model.geom_friction[:, 0] == 0.3).any()
    environment.close()


@functools.cache
def _random_episodes(task_name):
    """A whole episode of two towers of each pattern: patterns [32] and positions [T, 32, 5, 3]."""
    rng = np.random.default_rng(SEED)
    patterns, positions = np.tile(EVERY_PATTERN, 2), []
    batch, _ = batch_of(task_name, patterns)
    for t in range(26):
        actions = rng.integers(batch.task.num_interactions, size=32)
        if task_name == "fist_features" and t < 4:
            actions[:] = 0  # Into the tower.
        positions.append(batch.step(actions).observation["positions"])
    return patterns, np.stack(positions)


@pytest.mark.parametrize("task_name", ["direct_features", "fist_features"])
def test_glued_blocks_keep_their_distance(task_name):
    patterns, positions = _random_episodes(task_name)
    for i, pattern in enumerate(patterns):
        for lower, upper in itertools.combinations(range(5), 2):
            if _glued(pattern, lower, upper):
                distances = _distances(positions[:, i], lower, upper)
                np.testing.assert_allclose(distances, EDGE * (upper - lower), rtol=0, atol=1e-6)


def test_neighbours_that_are_not_glued_come_apart_when_pushed():
    patterns, positions = _random_episodes("direct_features")
    for pattern in EVERY_PATTERN:
        for lower in range(4):
            if not _glued(pattern, lower, lower + 1):
                apart = _distances(positions[:, patterns == pattern], lower, lower + 1) - EDGE
                assert apart.max() > 0.02, f"joint {lower} of {tower.PATTERNS[pattern]}"


def test_a_tower_of_several_bodies_comes_apart_when_the_fist_hits_it():
    patterns, positions = _random_episodes("fist_features")
    for pattern in np.flatnonzero(COUNTS > 1):
        apart = [_distances(positions[:, patterns == pattern], k, k + 1).max() - EDGE for k in range(4)]
        assert max(apart) > 0.02, tower.PATTERNS[pattern]


@pytest.mark.parametrize("task_name", ["direct_features", "fist_features"])
def test_nothing_leaves_the_room_or_sinks_into_its_floor(task_name):
    # The walls are 0.56 m from the tower's middle, and a cube's centre is at least half an edge, 0.05 m, from what the
    # cube touches. A cube that hits it at speed v goes v * 5 ms further before the next physics step feels it, and then
    # as far as a critically damped contact of time constant 10 ms gives, v * 10 ms / e. A cube of 1 kg that 50 N have
    # pushed from wall to wall, 1.02 m, comes at sqrt(2 * 50 * 1.02) = 10.1 m/s; one that fell from the ceiling, 0.6 m,
    # at 3.4 m/s.
    give = 0.005 + 0.01 / np.e  # s
    _, positions = _random_episodes(task_name)
    assert np.abs(positions[..., :2]).max() < 0.56 - 0.05 + 10.1 * give < 0.6  # Which is the bound in the spec.
    assert positions[..., 2].min() > 0.05 - 3.4 * give


@pytest.mark.parametrize("first, second", [(0, 2), (1, 3), (2, 1), (3, 0)])
def test_two_pokes_tell_the_number_of_bodies(first, second):
    """Block 1 in one direction, then block 3 across: patterns of different counts end up more than 2 cm apart."""
    batch, _ = batch_of("direct_features", EVERY_PATTERN)
    batch.step(np.full(16, 4 * 1 + first))
    positions = batch.step(np.full(16, 4 * 3 + second)).observation["positions"]
    for one, other in itertools.combinations(EVERY_PATTERN, 2):
        if COUNTS[one] != COUNTS[other]:
            largest = np.linalg.norm(positions[one] - positions[other], axis=-1).max()
            assert largest > 0.02, (tower.PATTERNS[one], tower.PATTERNS[other])


def test_a_push_moves_its_own_block_in_its_own_direction():
    batch, first = batch_of("direct_features", np.full(20, SEPARATE))
    moved = (batch.step(np.arange(20)).observation["positions"] - first["positions"])[..., :2]
    for action in range(20):
        block, direction = action // 4, DIRECTIONS[action % 4]
        along, across = moved[action] @ direction, moved[action] @ direction[::-1]
        assert along.argmax() == block
        assert along[block] > 0.05
        assert abs(across[block]) < 0.2 * along[block]


@pytest.mark.parametrize("cube_size, distance", [(EDGE, 0.16), (0.12, 0.17), (0.08, 0.2)])
def test_a_fist_that_starts_nearer_touches_in_the_first_step(cube_size, distance):
    options = {"random": 0, "cube_size": cube_size, "fist_distance": distance}
    batch = suite.load_batch("towers", "fist_features", 16, options)
    first = batch.reset(hidden=EVERY_PATTERN).observation
    assert first["fist_position"][:, 0] == pytest.approx(-distance)
    away = batch.step(np.ones(16, int)).observation["positions"]
    assert away.tobytes() == first["positions"].tobytes()
    batch.reset(hidden=EVERY_PATTERN)
    hit = batch.step(np.zeros(16, int)).observation["positions"]
    assert (np.abs(hit - first["positions"]).max(axis=(1, 2)) > 0.01).all()


@pytest.mark.parametrize(
    "options, message",
    [
        ({"fist_distance": 0.15}, "fist_distance, .*, is 0.15; give a number from 0.16 to 0.32 m"),
        ({"fist_distance": 0.4}, "fist_distance, .*, is 0.4; give a number from 0.16 to 0.32 m"),
        (
            {"fist_distance": 0.16, "variation": 0.5},
            "fist_distance, with cube_size 0.1 and variation 0.5, is 0.16; give a number from 0.18 to 0.32 m",
        ),
    ],
)
def test_a_fist_too_near_or_where_there_is_none_is_refused(options, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        suite.load("towers", "fist_features", options)
    with pytest.raises(ValueError, match="give 0.32 where there is no fist"):
        suite.load("towers", "direct_features", {"fist_distance": 0.2})


def test_the_fist_hits_the_middle_block_first():
    env = suite.load("towers", "fist_features", {"random": 0, "control_timestep": 0.01})
    for pattern in EVERY_PATTERN:
        env.reset(hidden=pattern)
        hit = set()
        while not hit:
            assert env.step(0).mid(), "the fist missed the tower"
            model, contacts = env.physics.model, env.physics.data.contact
            pairs = [{model.id2name(int(geom), "geom") for geom in pair} for pair in contacts.geom]
            hit = {name for pair in pairs if "fist/geom" in pair for name in pair - {"fist/geom"}}
        assert hit == {"tower/block_2/geom"}


@pytest.mark.parametrize("action", range(4))
def test_the_fist_keeps_its_speed_in_the_open(action):
    """1 m/s in the held direction, once 400 N have sped up 20 kg; behind it, the end of its room is 0.08 m away."""
    env = suite.load("towers", "fist_features", {"random": 0, "control_timestep": 0.01})
    track = [env.reset().observation["fist_position"].astype(float)]
    track += [env.step(action).observation["fist_position"].astype(float) for _ in range(10)]
    velocities = np.diff(track, axis=0) / 0.01
    np.testing.assert_allclose(velocities[8:], [[*DIRECTIONS[action], 0]] * 2, atol=0.01)


def test_what_somebody_changes_is_simulated_there_and_nowhere_else():
    """Towers are composed once in a process, for all tasks with the same scene."""

    def model_of(task, structure=5):
        return task.build_apparatus(structure).model

    usual = model_of(suite.load_task("towers", "direct_features"))
    scene, block = (suite.load_task("towers", "direct_features") for _ in range(2))
    scene.root_entity.mjcf_model.option.gravity = [0, 0, -1.6]
    block.arrange(5)
    block.tower.blocks[0].geom.mass = 9
    block.arrange(0)
    assert model_of(scene).opt.gravity[2] == -1.6 and usual.opt.gravity[2] != -1.6
    assert model_of(block).body_mass.max() == 9 > usual.body_mass.max()
    again = model_of(suite.load_task("towers", "direct_features"))
    np.testing.assert_array_equal(again.opt.gravity, usual.opt.gravity)
    np.testing.assert_array_equal(again.body_mass, usual.body_mass)
