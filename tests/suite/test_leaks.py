"""Nothing tells of the hidden property before it is touched, and what hides it leaves the physics as it is."""

import functools

from episodes import EVERY_PATTERN, INTO_THE_TOWER, batch_of, plans_that_miss
import mujoco
import numpy as np
import pytest

from physexp import suite
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.parts import tower

pytestmark = pytest.mark.usefixtures("seed")


def _differences(observation, size: int) -> dict[str, float]:
    """How far each array differs between the patterns of a plan: rows are [plan, pattern]."""
    far = {}
    for name, value in observation.items():
        value = value.reshape(-1, size, *value.shape[1:])
        if value.tobytes() != np.repeat(value[:, :1], size, axis=1).tobytes():
            far[name] = float(np.abs(value - value[:, :1]).max())
    return far


@pytest.mark.parametrize(
    "control_timestep, step_limit, patterns, num_random",
    [(0.1, 26, EVERY_PATTERN, 8), (0.01, 260, np.array([0, 6, 8, 15]), 1), (2.6, 1, EVERY_PATTERN, 0)],
    ids=["0.1 s", "0.01 s", "2.6 s"],
)
def test_an_untouched_tower_and_the_fist_look_the_same_whatever_the_glue(
    seed, control_timestep, step_limit, patterns, num_random
):
    plans = plans_that_miss(np.random.default_rng(seed), step_limit, control_timestep, num_random)
    size = len(patterns)
    batch, first = batch_of("fist_features", np.tile(patterns, len(plans)), control_timestep)
    leaks = []
    for t in range(step_limit):
        step = batch.step(np.repeat(plans[:, t], size))
        assert step.observation["fist_position"][:, 0].max() < -0.3, "the fist must keep away from the tower"
        leaks += [(t, name, far) for name, far in _differences(step.observation, size).items()]
        if step.observation["positions"].tobytes() != first["positions"].tobytes():
            leaks.append((t, "moved", float(np.abs(step.observation["positions"] - first["positions"]).max())))
    assert (step.step_type == 2).all(), "the episodes were not played to their end"
    assert not leaks, f"{len(leaks)} leaks (control step, what, m), the first: {leaks[:4]}"


def test_blocks_that_are_not_poked_stay_where_they_are_whatever_is_poked(seed):
    """Each of 64 environments pokes its own choice of blocks, at random, up to the ceiling."""
    rng = np.random.default_rng(seed)
    pokable = rng.random((64, 4)) < 0.5
    pokable[np.arange(64), rng.integers(4, size=64)] = True
    weights = pokable / pokable.sum(axis=1, keepdims=True)
    batch = suite.load_batch("which_is_heavier", "features", 64, {"random": seed, "difficulty": 1})
    rest = batch.reset().observation["heights"]
    assert rest.tobytes() == np.zeros((64, 4), np.float32).tobytes()
    for t in range(100):
        if t % 3 == 0:
            pokes = (weights.cumsum(axis=1) > rng.random((64, 1))).argmax(axis=1)
        heights = batch.step(pokes).observation["heights"]
        assert heights[~pokable].tobytes() == rest[~pokable].tobytes()
    assert (heights[pokable] > 0.001).mean() > 0.8, "the pokes moved nothing"


def test_a_poked_block_moves_the_same_whatever_the_others_weigh(seed):
    """The blocks' masses are given in turn to two environments that agree in one mass only."""
    env = suite.load("which_is_heavier", "features", {"random": seed, "difficulty": 1})
    for _ in range(5):
        tracks = []
        for others in (0.0, 1.0):
            env.reset(hidden=[0.5, others, others, others])
            tracks.append([env.step(0).observation["heights"].tobytes() for _ in range(20)])
        assert tracks[0] == tracks[1]


# The plain physics: the same compiled model, awake from the start, stepped by `mj_step` and never held.


@functools.cache
def _kits(task_name):
    return list(map(suite.load_task("towers", task_name).build_apparatus, EVERY_PATTERN.tolist()))


def _plain(task_name):
    """The model of each pattern, and a state at rest."""
    return [(kit, mujoco.MjData(kit.model)) for kit in _kits(task_name)]


def _positions(kit, data) -> np.ndarray:
    mujoco.mj_kinematics(kit.model, data)
    mujoco.mj_sensorPos(kit.model, data)
    return data.sensordata[kit.readings["positions"]].astype(np.float32)


@pytest.mark.parametrize("control_timestep", [0.1, 0.01])
def test_a_tower_hit_by_the_fist_moves_as_a_plain_awake_one(control_timestep):
    """Until the touch it looks at rest, exactly; from then on it is where the plain one is, through the whole fall."""
    batch, first = batch_of("fist_features", EVERY_PATTERN, control_timestep)
    plain, touched, since_touch = _plain("fist_features"), np.zeros(16, bool), 0
    while since_touch < 1.0 / control_timestep:
        positions = batch.step(np.full(16, INTO_THE_TOWER)).observation["positions"]
        touched |= (positions != first["positions"]).any(axis=(1, 2))
        since_touch += touched.all()
        for pattern, (kit, data) in enumerate(plain):
            data.ctrl[:] = batch.task.controls[INTO_THE_TOWER]
            mujoco.mj_step(kit.model, data, batch.task.options.substeps)
            # A block whose coordinates have moved by up to the tolerance is out of place by up to twice as much.
            tolerance = 1e-6 if touched[pattern] else 2 * apparatus_lib.TOUCH_TOLERANCE
            difference = np.abs(_positions(kit, data) - positions[pattern]).max()
            assert difference <= tolerance, (tower.PATTERNS[pattern], touched[pattern], since_touch)
    assert np.abs(positions - first["positions"]).max(axis=(1, 2)).min() > 0.1, "a tower did not fall"


def test_a_pushed_tower_moves_as_a_plain_awake_one(seed):
    """The first push finds both towers in the same state, so they stay together, up to a micrometre, for two."""
    rng = np.random.default_rng(seed)
    batch, _ = batch_of("direct_features", EVERY_PATTERN)
    plain = _plain("direct_features")
    for actions in rng.integers(20, size=(2, 16)):
        positions = batch.step(actions).observation["positions"]
        for pattern, (kit, data) in enumerate(plain):
            data.ctrl[:] = batch.task.controls[actions[pattern]]
            mujoco.mj_step(kit.model, data, batch.task.options.substeps)
            np.testing.assert_allclose(_positions(kit, data), positions[pattern], rtol=0, atol=1e-6)


def test_a_tower_at_rest_feels_every_contact_from_the_start():
    """Each joint that is not glued, and the floor, has its four contact points: nothing falls before it is carried."""
    missing = {}
    for pattern, (kit, data) in enumerate(_plain("direct_features")):
        mujoco.mj_forward(kit.model, data)
        expected = 4 * tower.num_bodies(tower.PATTERNS[pattern])
        if data.ncon < expected:
            missing[pattern] = (data.ncon, expected)
    assert not missing, f"contact points, found and expected: {missing}"
