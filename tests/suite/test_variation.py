"""Variation: episodes differ in what is not asked, in the same way whatever is hidden."""

import copy
import itertools

from chance import P_VALUE
from every_task import VARYING, load_batch
import mujoco
import numpy as np
import pytest
from scipy import stats

from physexp import suite
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.parts import tower

every_varying_task = pytest.mark.parametrize("name", VARYING)
TOWERS = ["direct_features", "fist_features"]


@every_varying_task
def test_before_an_interaction_episodes_differ_but_not_by_what_is_hidden(seed, name):
    size = 8
    batch = load_batch(name, size, random=seed, variation=1.0)
    drawn = batch.task.draw(np.full(size, seed), np.arange(size))
    firsts = [batch.reset(episode=0, hidden=hidden).observation for hidden in (drawn, drawn[::-1])]
    for key, value in firsts[0].items():
        np.testing.assert_array_equal(value, firsts[1][key])
    looks = {tuple(value[i].tobytes() for value in firsts[0].values()) for i in range(size)}
    if name == "which_is_heavier/features":
        assert len(looks) == 1  # Heights are zero at rest, whatever the force of a poke.
    elif name.endswith("pixels"):
        # Of two episodes in ten thousand, at most, the cameras are so near to each other that they see the same. Of
        # the 28 pairs here three do with a probability below (28 * 1e-4)^3 / 6, which is 4e-9.
        assert len(looks) >= size - 2
    else:
        assert len(looks) == size
    batch.close()


def test_towers_vary_by_as_much_as_is_said(seed):
    share = 0.5
    size = 400
    batch = suite.load_batch("towers", "fist_features", size, {"random": seed, "variation": share})
    plain = suite.load_batch("towers", "fist_features", 1, {"random": seed}).reset().observation
    seen = batch.reset().observation
    moved = seen["positions"] - plain["positions"]
    np.testing.assert_allclose(moved, np.repeat(moved[:, :1], tower.NUM_BLOCKS, axis=1), atol=1e-6)  # All alike.
    start = seen["fist_position"] - plain["fist_position"]
    for found, most in ((moved[:, 0, 0], 0.01), (moved[:, 0, 1], 0.01), (start[:, 0], 0.02), (start[:, 1], 0.03)):
        assert stats.kstest(found / (share * most), "uniform", args=(-1, 2)).pvalue > P_VALUE
    assert np.abs(moved[:, 0, 2]).max() < 1e-6 and np.abs(start[:, 2]).max() < 1e-6
    batch.close()


def _varied(task_name, nuisances, structure=0):
    """Returns the apparatus of a tower, a model with the fields of some nuisances, and their circumstances."""
    task = suite.load_task("towers", task_name)
    kit = task.build_apparatus(structure)
    found = task.circumstances(kit, np.array([nuisances], float))
    model = copy.copy(kit.model)
    for field, (addresses, values) in found.fields.items():
        getattr(model, field)[addresses] = values[0]
    return kit, model, found


@pytest.mark.parametrize("task_name, mass", [(TOWERS[0], -1.0), (TOWERS[1], 0.5)])
def test_the_masses_are_what_mujoco_would_compute(task_name, mass):
    kit, model, _ = _varied(task_name, [0, 0, 0, 0, 0, 0, 0, mass, 0, 0, 0])
    expected = copy.copy(kit.model)
    bodies = kit.held[0].bodies
    expected.body_mass[bodies] *= 1 + 0.2 * mass
    expected.body_inertia[bodies] *= 1 + 0.2 * mass
    mujoco.mj_setConst(expected, mujoco.MjData(expected))
    cubes = model.body_mass[bodies][model.body_mass[bodies] > 0]
    np.testing.assert_allclose(cubes, 1 + 0.2 * mass)
    for field in ("body_mass", "body_inertia", "dof_M0", "dof_invweight0", "body_invweight0"):
        np.testing.assert_allclose(getattr(model, field), getattr(expected, field), rtol=1e-6, err_msg=field)
    below = model.body_subtreemass[1:], expected.body_subtreemass[1:]  # Nothing asks for the mass of the world.
    np.testing.assert_allclose(*below, rtol=1e-6)


@pytest.mark.parametrize("value, friction", [(-1.0, 0.25), (-0.5, 0.275), (0.0, 0.3), (1.0, 0.4)])
def test_friction_is_between_what_is_said(value, friction):
    task_name = TOWERS[1]
    kit, model, _ = _varied(task_name, [0, 0, 0, 0, 0, 0, value, 0, 0, 0, 0])
    changed = kit.model.geom_friction[:, 0] == 0.3
    assert changed.sum() >= tower.NUM_BLOCKS + 1  # The cubes and the ground.
    np.testing.assert_allclose(model.geom_friction[changed, 0], friction)
    np.testing.assert_array_equal(model.geom_friction[~changed], kit.model.geom_friction[~changed])
    np.testing.assert_array_equal(model.geom_friction[:, 1:], kit.model.geom_friction[:, 1:])


@pytest.mark.parametrize("task_name", TOWERS)
@pytest.mark.parametrize("strength, share", [(0, 0.1), (1, 0.5)])
def test_a_tower_settles_by_a_share_of_the_touch_tolerance(seed, task_name, strength, share):
    """The contacts of a turned tower differ from those of a plain one."""
    task = suite.load_task("towers", task_name)
    nuisances = strength * np.random.default_rng(seed).choice([-1.0, 1.0], size=(16, task.num_nuisances))
    for structure in range(task.scene.num_structures):
        kit, model, found = _varied(task_name, nuisances[structure], structure)
        data = mujoco.MjData(model)
        addresses, values = found.qpos
        data.qpos[addresses] = values[0]
        start = data.qpos.copy()
        settled = 0.0
        for _ in range(26):
            mujoco.mj_step(model, data, 20)  # 2.6 s in all.
            settled = max(settled, np.abs(data.qpos - start)[kit.held[0].qpos].max())
        assert settled < share * apparatus_lib.TOUCH_TOLERANCE, (structure, settled)


def test_a_tower_is_turned_as_a_whole():
    task = suite.load_task("towers", "direct_features")
    for structure in range(task.scene.num_structures):
        kit = task.build_apparatus(structure)
        starts = kit.starts(task.circumstances(kit, np.array([[1, -1, 1, 0, 0, 0, 0, 0, 0, 0, 0]], float)), 1)
        cubes = kit.held[0].shows["geom_xmat"]
        turned = starts.shown["geom_xmat"][0, cubes].reshape(-1, 3, 3)
        assert len(turned) == tower.NUM_BLOCKS
        angle = np.deg2rad(10)
        expected = [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
        np.testing.assert_allclose(turned, np.repeat([expected], tower.NUM_BLOCKS, axis=0), atol=1e-9)
        centers = starts.shown["sensordata"][0, kit.readings["positions"]]
        np.testing.assert_allclose(centers[:, :2], np.tile([0.01, -0.01], (tower.NUM_BLOCKS, 1)), atol=1e-12)


def test_the_fist_is_as_fast_and_pokes_are_as_strong_as_is_said(seed):
    batch = suite.load_batch("towers", "fist_features", 300, {"random": seed, "variation": 1.0})
    batch.reset()
    # To +y, where nothing is. In the first control step of 0.1 s it reaches its speed of 1 m/s.
    before, after = (batch.step(np.full(300, 2)).observation["fist_position"][:, 1] for _ in range(2))
    assert stats.kstest(((after - before) / 0.1 - 1) / 0.1, "uniform", args=(-1, 2)).pvalue > P_VALUE
    batch.close()
    batch = suite.load_batch("which_is_heavier", "features", 300, {"random": seed, "variation": 1.0})
    batch.reset(hidden=np.tile([0.5, 0.1, 0.1, 0.1], (300, 1)))
    heights = batch.step(np.zeros(300, int)).observation["heights"][:, 0]
    alone = suite.load("which_is_heavier", "features", {"random": seed})
    alone.reset(hidden=[0.5, 0.1, 0.1, 0.1])
    # The scene is linear below the rail's end: a tenth more force lifts a tenth higher.
    factors = heights / alone.step(0).observation["heights"][0]
    assert stats.kstest((factors - 1) / 0.1, "uniform", args=(-1, 2)).pvalue > P_VALUE
    batch.close()
    alone.close()


@pytest.mark.parametrize(
    "domain, task", [("which_is_heavier", "pixels"), ("towers", "fist_pixels"), ("strings", "pixels")]
)
def test_images_are_those_of_a_displaced_camera(seed, domain, task):
    batch = suite.load_batch(domain, task, 8, {"random": seed, "variation": 1.0})
    corners = np.array(list(itertools.product([-1.0, 1.0], repeat=3)))  # Of where cameras are.
    nuisances = np.tile(corners, batch.task.num_nuisances)[:, : batch.task.num_nuisances]
    images = batch.reset(episode=0, nuisances=nuisances).observation["pixels"].copy()
    assert len({image.tobytes() for image in images}) == 8
    batch.reset(episode=1)
    again = batch.reset(np.array([4]), episode=0, nuisances=nuisances[4:5]).observation["pixels"]
    np.testing.assert_array_equal(again[0], images[4])
    plain = suite.load_batch(domain, task, 1, {"random": seed}).reset().observation["pixels"][0]
    # Two centimetres are a pixel or two of a view that is a metre wide.
    differences = np.abs(images.astype(int) - plain).mean(axis=(1, 2, 3))
    assert differences.min() > 0 and differences.max() < 25
    batch.close()
