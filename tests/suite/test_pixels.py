"""Pixel tasks: an image is the state, all of it that may be seen and nothing more, alone and in a batch."""

from concurrent import futures
import functools
import gc
import itertools
import os
import re

import dm_env
from episodes import AWAY, EVERY_PATTERN, SEED, episode_with, plans_that_miss, random_actions
import memory
import numpy as np
import pytest
from scipy import spatial

from physexp import suite
from physexp.suite.engine import rendering
from physexp.suite.parts import block, tower

import mujoco  # isort: skip  # The suite chooses the GL backend, which mujoco looks at once.

HEAVIER, DIRECT, FIST = ("which_is_heavier", "pixels"), ("towers", "direct_pixels"), ("towers", "fist_pixels")
PIXEL_TASKS = [HEAVIER, DIRECT, FIST]
every_pixel_task = pytest.mark.parametrize("domain_name, task_name", PIXEL_TASKS)
# What draws is not what is tested here.
pytestmark = [
    pytest.mark.usefixtures("seed"),
    pytest.mark.filterwarnings("ignore:PIXELS ARE DRAWN BY THE PROCESSOR"),
]

EDGE = 84  # pixels, of an image
SHAPE = (EDGE, EDGE, 3)
CORNERS = np.array(list(itertools.product((-0.05, 0.05), repeat=3)))  # m, of a cube, from its centre
SEPARATE, WHOLE = 0, 15


@functools.cache
def _shared(domain_name, task_name, random, size=None, control_timestep=0.1):
    """An environment, or a batch, that tests use in turn: building sixteen towers takes a second."""
    task_kwargs = {"random": random, "control_timestep": control_timestep}
    if size is None:
        _opened.append(suite.load(domain_name, task_name, task_kwargs))
    else:
        _opened.append(suite.load_batch(domain_name, task_name, size, task_kwargs))
    return _opened[-1]


_opened: list = []


@pytest.fixture(scope="module", autouse=True)
def close_what_is_shared():
    yield
    for environment in _opened:
        environment.close()


@pytest.fixture
def load():
    """Loads an environment, or a batch of `size`, and closes it when the test is over."""
    opened = []

    def load(domain_name, task_name, random, size=None, num_threads=1, **task_kwargs):
        task_kwargs["random"] = random
        if size is None:
            opened.append(suite.load(domain_name, task_name, task_kwargs))
        else:
            opened.append(suite.load_batch(domain_name, task_name, size, task_kwargs, num_threads))
        return opened[-1]

    yield load
    for environment in opened:
        environment.close()


@pytest.fixture
def poses_drawn(monkeypatch):
    """For each call of a renderer, which draws as ever, positions [N, G, 3] and rotation matrices [N, G, 9], float32.

    That is what MuJoCo draws with. In float64 the blocks' heights differ by rounding from one structure to another.
    """
    poses = []
    render = rendering.Renderer.render

    def recording(self, geom_xpos, geom_xmat, *args, **kwargs):
        poses.append((geom_xpos.astype(np.float32), geom_xmat.astype(np.float32)))
        return render(self, geom_xpos, geom_xmat, *args, **kwargs)

    monkeypatch.setattr(rendering.Renderer, "render", recording)
    return poses


@pytest.fixture
def drawn(monkeypatch):
    """The number of images of each call of a renderer; it draws as ever."""
    counts = []
    render = rendering.Renderer.render

    def counting(self, geom_xpos, *args, **kwargs):
        counts.append(len(geom_xpos))
        return render(self, geom_xpos, *args, **kwargs)

    monkeypatch.setattr(rendering.Renderer, "render", counting)
    return counts


def _single(domain_name, task_name, number=0):
    """The environment that is one of the batch's, about to start its first episode."""
    single = _shared(domain_name, task_name, suite.environment_seed(SEED, number))
    single.task.next_episode = 0
    return single


def _start_both(domain_name, task_name, size):
    """A batch and its single environments, in their first episodes."""
    batch = _shared(domain_name, task_name, SEED, size)
    singles = [_single(domain_name, task_name, i) for i in range(size)]
    _assert_same(batch.reset(episode=0), [single.reset() for single in singles])
    return batch, singles


def _assert_same(steps: dm_env.TimeStep, singles: list[dm_env.TimeStep]) -> None:
    for i, single in enumerate(singles):
        assert steps.step_type[i] == single.step_type
        image, expected = steps.observation["pixels"][i], single.observation["pixels"]
        assert (image.dtype, image.shape) == (expected.dtype, expected.shape)
        different = (image != expected).any(axis=-1)
        assert not different.any(), f"environment {i}: {different.sum()} pixels differ"


def _play(environment, actions) -> np.ndarray:
    """The images of the first episode, [T + 1, 84, 84, 3]."""
    environment.task.next_episode = 0
    steps = [environment.reset(), *(environment.step(action) for action in actions)]
    return np.stack([step.observation["pixels"] for step in steps])


def _image(step) -> np.ndarray:
    return step.observation["pixels"]


# Patterns of glue.


def _batch_of(task_name, patterns, control_timestep=0.1):
    """A batch whose first environments start with `patterns`, their indices, and their first images."""
    batch, first = _shared("towers", task_name, SEED, 80, control_timestep), []
    chosen = np.arange(len(patterns))
    for i, pattern in zip(chosen, patterns, strict=True):
        episode = episode_with(pattern, suite.environment_seed(SEED, i))
        first.append(_image(batch.reset(np.array([i]), episode)))
    np.testing.assert_array_equal(batch.hidden[chosen], patterns)
    return batch, chosen, np.concatenate(first)


# Where things are, and where that is in an image.


def _model(domain_name, task_name):
    """The compiled model of a task: of the separate cubes, for towers."""
    return suite.load_task(domain_name, task_name).build_apparatus(0).model


def _block_geoms(model) -> list[int]:
    """Geoms of the blocks, in order."""
    found = [(re.search(r"block_(\d)", model.geom(i).name), i) for i in range(model.ngeom)]
    return [i for _, i in sorted((match[1], i) for match, i in found if match)]


def _at_rest(model):
    """Positions [1, G, 3] and rotation matrices [1, G, 3, 3] of all geoms in the initial state."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data.geom_xpos[None].copy(), data.geom_xmat.reshape(1, -1, 3, 3).copy()


def _poses(batch, chosen):
    """Positions [N, G, 3] and rotation matrices [N, G, 3, 3] of all geoms of some environments after a step."""
    poses = {"geom_xpos": [], "geom_xmat": []}
    for i in chosen:
        structure = batch._structures[i]
        for field, values in poses.items():
            values.append(batch._groups[int(structure)]._batch.bind(field)[i].copy())
    positions = np.stack(poses["geom_xpos"])
    return positions, np.stack(poses["geom_xmat"]).reshape(*positions.shape[:2], 3, 3)


def _corners(model, positions, rotations) -> np.ndarray:
    """Corners of the blocks, [B, number of blocks, 8, 3], m, from the poses of all geoms."""
    geoms = _block_geoms(model)
    return positions[:, geoms, None] + np.einsum("bkij,cj->bkci", rotations[:, geoms], CORNERS)


def _project(model, points) -> np.ndarray:
    """Column and row [..., 2] at which the camera sees points [..., 3]: 0, 0 is the image's upper left corner."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    camera = model.camera("observer").id
    # In the camera's frame x is to the right and y up, and it looks along -z.
    seen = (np.asarray(points) - data.cam_xpos[camera]) @ data.cam_xmat[camera].reshape(3, 3)
    half_height = -seen[..., 2:] * np.tan(np.radians(model.cam_fovy[camera]) / 2)
    return EDGE / 2 * (1 + seen[..., :2] / half_height * [1, -1])


def _mask(image, number: int) -> np.ndarray:
    """Pixels of a block, bool [84, 84]: light that is white changes how bright a colour is, not the colour."""
    colors = np.array([*(color[:3] for color in block.COLORS), (1, 1, 1)])  # White is all that is grey.
    directions = colors / np.linalg.norm(colors, axis=1, keepdims=True)
    return (image.astype(float) @ directions.T).argmax(axis=-1) == number


def _box(mask) -> np.ndarray:
    """The first column and row, and those after the last, of a mask."""
    assert mask.any(), "not to be seen"
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return np.array([columns[0], rows[0], columns[-1] + 1, rows[-1] + 1])


# What is observed.


@every_pixel_task
def test_a_pixel_task_observes_one_image_and_nothing_else(domain_name, task_name):
    single, batch = _single(domain_name, task_name), _shared(domain_name, task_name, SEED, 3)
    for spec in (single.observation_spec(), batch.observation_spec()):
        assert {name: (array.shape, array.dtype) for name, array in spec.items()} == {"pixels": (SHAPE, np.uint8)}
    for step in (single.reset(), single.step(0), single.step(single.task.num_interactions)):
        assert {name: (v.shape, v.dtype) for name, v in step.observation.items()} == {"pixels": (SHAPE, np.uint8)}
    for step in (batch.reset(), batch.step([0, 1, batch.task.num_interactions])):
        assert {name: (v.shape, v.dtype) for name, v in step.observation.items()} == {"pixels": ((3, *SHAPE), np.uint8)}


def test_every_task_of_features_has_one_of_pixels():
    other = {"features": "pixels", "direct_features": "direct_pixels", "fist_features": "fist_pixels"}
    features = {(domain, task) for domain, task in suite.ALL_TASKS if task.endswith("features")}
    assert {(domain, other[task]) for domain, task in features} == set(suite.ALL_TASKS) - features == set(PIXEL_TASKS)


@pytest.mark.parametrize("task_name, patterns", [("direct_pixels", [SEPARATE, 6, WHOLE]), ("fist_pixels", range(16))])
def test_an_image_of_a_touched_tower_is_what_mujoco_draws_of_the_state(task_name, patterns):
    """Pattern by pattern, though one renderer draws them all, with a renderer of mujoco's own for the pattern."""
    env = _shared("towers", task_name, SEED)
    for pattern in patterns:
        env.task.next_episode = episode_with(pattern, SEED)
        first = _image(env.reset())
        for _ in range(7):  # The fist has hit the tower, 0.17 m away, after two; the lowest block is pushed.
            image = _image(env.step(0))
        assert (image != first).any()
        renderer = mujoco.Renderer(env.physics.model.ptr, EDGE, EDGE)
        renderer.update_scene(env.physics.data.ptr, camera="observer")
        for effect in ("SHADOW", "REFLECTION", "SKYBOX", "HAZE"):
            renderer.scene.flags[getattr(mujoco.mjtRndFlag, f"mjRND_{effect}")] = False
        expected = renderer.render()
        renderer.close()
        np.testing.assert_array_equal(image, expected, err_msg=str(tower.PATTERNS[pattern]))


def test_blocks_are_drawn_where_they_are(load, seed):
    """From the camera's pose and field of view alone; nothing hides a block on its rail."""
    rng = np.random.default_rng(seed)
    model = _model(*HEAVIER)
    batch = load(*HEAVIER, seed, 8)
    images, poses = _image(batch.reset()), [np.repeat(value, 8, axis=0) for value in _at_rest(model)]
    for t in range(12):
        projected = _project(model, _corners(model, *poses))
        for i, number in itertools.product(range(8), range(4)):
            expected = np.concatenate([projected[i, number].min(axis=0), projected[i, number].max(axis=0)])
            # A pixel is drawn where its centre is covered, which is half a pixel from its edges.
            np.testing.assert_allclose(_box(_mask(images[i], number)), expected, rtol=0, atol=0.6, err_msg=f"step {t}")
        images, poses = _image(batch.step(rng.integers(4, size=8))), _poses(batch, range(8))


@every_pixel_task
def test_the_front_of_every_block_is_seen_at_first(domain_name, task_name):
    model = _model(domain_name, task_name)
    image = _image(_single(domain_name, task_name).reset())
    front = CORNERS[:, 1] < 0
    for number, corners in enumerate(_corners(model, *_at_rest(model))[0]):
        area = spatial.ConvexHull(_project(model, corners[front])).volume  # In the plane that is the area.
        assert area > 20, "a block of fewer pixels can hardly be told from its neighbour"
        mask = _mask(image, number)
        # The outline's pixels may go either way: one in ten of the whole for the largest front, more for smaller ones.
        assert mask.sum() > area - 2 * np.sqrt(area)
        columns, rows = np.moveaxis(_project(model, corners), -1, 0)
        left, top, right, bottom = _box(mask)
        assert left > columns.min() - 0.6 and right < columns.max() + 0.6
        assert top > rows.min() - 0.6 and bottom < rows.max() + 0.6


def test_a_poke_lifts_the_lightest_and_the_heaviest_block_by_clearly_different_numbers_of_rows(load, seed):
    # At difficulty 1e300 one block has a mass of 1 kg and the others of 0.2 kg. Spring, damper and poke lift them by
    # 0.0989 m and 0.2580 m in a control step (derived in the tests of the task).
    model = _model(*HEAVIER)
    env = load(*HEAVIER, seed, difficulty=1e300)
    images = _play(env, [])
    heaviest = env.task.correct_answer
    lightest = (heaviest + 1) % 4
    lifts = {}
    for number, height in ((heaviest, 0.0989), (lightest, 0.2580)):
        images = _play(env, [number])
        tops = [_box(_mask(image, number))[1] for image in images]
        lifts[number] = tops[0] - tops[1]
        top = np.array([(number - 1.5) * 0.16, 0.05, 0.1])  # m: the upper edge at the back is the highest in the image.
        expected = _project(model, top)[1] - _project(model, top + [0, 0, height])[1]
        assert lifts[number] == pytest.approx(expected, abs=1.01)  # Either row is found up to half a pixel.
    assert lifts[lightest] >= 2 * lifts[heaviest] >= 10


# A batch is its single environments.


@every_pixel_task
def test_a_batch_is_its_single_environments(seed, domain_name, task_name):
    """Over episodes that end with labels or when time runs out, and resets in the middle of one."""
    rng = np.random.default_rng(seed)
    size = 3
    batch, singles = _start_both(domain_name, task_name, size)
    endings = set()
    for t in range(2 * batch.task.rules.step_limit + 20):
        actions = random_actions(rng, batch.task, size)
        if t < batch.task.rules.step_limit:
            actions[0] %= batch.task.num_interactions  # The first environment's first episode runs out of time.
        steps = batch.step(actions)
        _assert_same(steps, [single.step(a) for single, a in zip(singles, actions, strict=True)])
        endings |= set((actions >= batch.task.num_interactions)[steps.step_type == dm_env.StepType.LAST].tolist())
        if rng.random() < 0.05 and t > batch.task.rules.step_limit:
            chosen = np.flatnonzero(rng.random(size) < 0.5)
            _assert_same(batch.reset(chosen), [singles[i].reset() for i in chosen])
    assert False in endings, "no episode ran out of time"
    assert not {single.task.episode for single in singles} & {-1, 0}, "an environment played only one episode"


@every_pixel_task
def test_chosen_environments_step_without_the_others(seed, domain_name, task_name):
    rng = np.random.default_rng(seed)
    batch, singles = _start_both(domain_name, task_name, 3)
    for _ in range(25):
        chosen = np.flatnonzero(rng.random(3) < 0.6)
        actions = random_actions(rng, batch.task, len(chosen))
        expected = [singles[i].step(a) for i, a in zip(chosen, actions, strict=True)]
        _assert_same(batch.step(actions, chosen), expected)


@every_pixel_task
def test_an_image_does_not_depend_on_how_many_environments_or_threads_there_are(load, seed, domain_name, task_name):
    rng = np.random.default_rng(seed)
    batches = [load(domain_name, task_name, seed, 1), _shared(domain_name, task_name, seed, 3)]
    batches.append(load(domain_name, task_name, seed, 5, num_threads=2))
    first = [_image(batch.reset(episode=0)) for batch in batches]
    for t in range(20):
        actions = random_actions(rng, batches[0].task, 5)
        images = [_image(batch.step(actions[: batch.num_environments])) for batch in batches]
        for image in images:
            assert image.tobytes() == images[-1][: len(image)].tobytes(), f"step {t}"
    assert (images[-1] != first[-1]).any()


@every_pixel_task
def test_the_image_of_an_environment_that_is_not_stepped_stays(domain_name, task_name):
    """A label shows the image that its environment saw last: the others' steps have not written there."""
    batch = _shared(domain_name, task_name, SEED, 3)
    batch.reset(episode=0)
    before = _image(batch.step([0, 0, 0]))
    for action in (0, 1, 2, 3):
        others = _image(batch.step([action, action], np.array([0, 2])))
    assert (others != before[[0, 2]]).any(axis=(1, 2, 3)).all()
    np.testing.assert_array_equal(_image(batch.step([batch.task.num_interactions], np.array([1]))), before[[1]])


@every_pixel_task
def test_images_that_were_returned_are_the_callers_own(domain_name, task_name):
    """Later steps do not write into them, and writing into them changes nothing that is seen later."""
    batch, (single, *_) = _start_both(domain_name, task_name, 3)
    label = batch.task.num_interactions
    plays = [
        (lambda: _single(domain_name, task_name).reset(), single.step, [0, 1, label, 2, 3]),
        (lambda: batch.reset(episode=0), batch.step, [[0, 0, 1], [1, label, 0], [label, 0, 2]]),
    ]
    for start, step, actions in plays:
        steps, kept = [start()], []
        for action in actions:
            kept.append(_image(steps[-1]).copy())
            steps.append(step(action))
        again = start()
        for action, earlier, copy in zip(actions, steps, kept, strict=False):
            np.testing.assert_array_equal(_image(earlier), copy)
            np.testing.assert_array_equal(_image(again), copy)
            _image(again)[:] = 77
            again = step(action)


# How often is drawn.


@every_pixel_task
def test_an_environment_draws_once_at_a_reset_and_in_each_step_and_never_for_a_label(
    load, drawn, domain_name, task_name
):
    env = load(domain_name, task_name, 0)
    assert drawn == []
    expected = 0
    for _ in range(2):
        env.reset()
        expected += 1
        assert drawn == [1] * expected
        for t in range(3):
            env.step(t)
            expected += 1
            assert drawn == [1] * expected
        assert env.step(env.task.num_interactions).last()
        assert drawn == [1] * expected
        assert env.step(0).first()  # Whatever the action.
        expected += 1
        assert drawn == [1] * expected


@every_pixel_task
def test_a_batch_draws_one_image_for_each_environment_that_interacts_and_one_first_image_for_each_structure(
    load, drawn, domain_name, task_name
):
    size = 6
    batch = load(domain_name, task_name, 3, size)
    batch.reset(episode=0)
    num_structures = len(np.unique(batch.task.structures(batch.hidden)))
    assert drawn == [1] * num_structures
    drawn.clear()
    label = batch.task.num_interactions
    for labeling in ([], [1], [0, 2, 3, 4, 5]):
        actions = np.zeros(size, int)
        actions[labeling] = label
        steps = batch.step(actions)
        assert sum(drawn) == size - len(labeling) - (steps.step_type == dm_env.StepType.FIRST).sum()
        assert len(drawn) <= num_structures
        drawn.clear()
        batch.reset(np.array(labeling, int), episode=0)
        assert drawn == []  # Their first images have been drawn.
    batch.step(np.full(size, label))
    batch.reset(episode=0)
    nobody = np.array([], int)
    batch.step(nobody, nobody)
    assert drawn == []


@every_pixel_task
def test_the_image_of_a_label_is_the_one_before(domain_name, task_name):
    batch, (env, *_) = _start_both(domain_name, task_name, 3)
    for label in range(env.task.num_labels):
        first = _image(env.reset())
        for t in range(3):
            before = _image(env.step(t))
        assert (before != first).any()
        answer = env.step(env.task.num_interactions + label)
        assert answer.last()
        np.testing.assert_array_equal(_image(answer), before)
        batch.reset(episode=0)
        for t in range(2):
            before = _image(batch.step([t, 0, 1]))
        answer = batch.step([batch.task.num_interactions + label, 0, 1])
        np.testing.assert_array_equal(
            answer.step_type, [dm_env.StepType.LAST, dm_env.StepType.MID, dm_env.StepType.MID]
        )
        np.testing.assert_array_equal(_image(answer)[0], before[0])
        assert (_image(answer)[1:] != before[1:]).any(axis=(1, 2, 3)).all()


@every_pixel_task
@pytest.mark.parametrize("field", ["qvel", "qpos"])
def test_the_image_of_an_episode_that_diverges_is_the_one_before(domain_name, task_name, field):
    batch, singles = _start_both(domain_name, task_name, 3)
    for _ in range(5):
        before = batch.step([0, 0, 0])
        _assert_same(before, [single.step(0) for single in singles])
    _overwrite(batch, 1, field)
    getattr(singles[1].physics.data, field)[0] = np.nan
    last = batch.step([1, 1, 1])
    assert last.step_type.tolist() == [1, 2, 1]
    _assert_same(last, [single.step(1) for single in singles])
    changed = (_image(last) != _image(before)).any(axis=(1, 2, 3))
    np.testing.assert_array_equal(changed, [True, False, True])
    _assert_same(batch.step([0, 0, 0]), [single.step(0) for single in singles])


@every_pixel_task
def test_when_all_environments_of_a_batch_diverge_their_images_are_the_ones_before(domain_name, task_name):
    batch = _shared(domain_name, task_name, SEED, 3)
    batch.reset(episode=0)
    first = _image(batch.step([0, 0, 0]))
    before = _image(batch.step([1, 1, 1]))
    assert (before != first).any()
    for i in range(3):
        _overwrite(batch, i, "qvel")
    last = batch.step([0, 0, 0])
    assert last.step_type.tolist() == [2, 2, 2]
    np.testing.assert_array_equal(_image(last), before)
    assert batch.step([0, 0, 0]).step_type.tolist() == [0, 0, 0]


def _overwrite(batch, environment: int, field: str) -> None:
    """With something that MuJoCo cannot go on from."""
    batch._groups[int(batch._structures[environment])]._batch.bind(field)[environment, 0] = np.nan


# Nothing leaks.


@pytest.mark.parametrize("task_name", ["direct_pixels", "fist_pixels"])
def test_every_tower_looks_the_same_at_first(task_name):
    _, _, first = _batch_of(task_name, EVERY_PATTERN)
    env = _shared("towers", task_name, SEED)
    for pattern in EVERY_PATTERN:
        env.task.next_episode = episode_with(pattern, SEED)
        image = _image(env.reset())
        assert env.task.hidden == pattern
        assert image.tobytes() == first[pattern].tobytes() == first[0].tobytes(), tower.PATTERNS[pattern]


def test_all_masses_look_the_same_at_first(load, seed):
    images = _image(load(*HEAVIER, seed, 64, difficulty=1).reset())
    env = load(*HEAVIER, seed, difficulty=1)
    for image in (*images, *(_image(env.reset()) for _ in range(20))):
        assert image.tobytes() == images[0].tobytes()


@pytest.mark.parametrize(
    "control_timestep, step_limit, patterns, num_random",
    [(0.1, 26, EVERY_PATTERN, 2), (0.01, 260, np.array([0, 6, 15]), 0)],
    ids=["0.1 s", "0.01 s"],
)
def test_the_images_of_an_episode_that_leaves_the_tower_alone_are_the_same_whatever_the_glue(
    seed, control_timestep, step_limit, patterns, num_random
):
    plans = plans_that_miss(np.random.default_rng(seed), step_limit, control_timestep, num_random)
    size = len(patterns)
    batch, chosen, first = _batch_of("fist_pixels", np.tile(patterns, len(plans)), control_timestep)
    model = _model(*FIST)
    fist = model.geom("fist/geom").id
    columns = _project(model, _corners(model, *_at_rest(model))[0])[..., 0]
    tower_columns = slice(int(columns.min()), int(columns.max()) + 1)
    leaks = []
    for t in range(step_limit):
        steps = batch.step(np.repeat(plans[:, t], size), chosen)
        assert _poses(batch, chosen)[0][:, fist, 0].max() < -0.3, "the fist must keep away from the tower"
        images = _image(steps).reshape(len(plans), size, *SHAPE)
        if images.tobytes() != np.repeat(images[:, :1], size, axis=1).tobytes():
            leaks.append((t, "glue"))
        if (images[..., tower_columns, :] != first[0, :, tower_columns]).any():
            leaks.append((t, "moved"))
    assert (steps.step_type == dm_env.StepType.LAST).all(), "the episodes were not played to their end"
    assert len({image.tobytes() for image in images[:3, 0]} | {first[0].tobytes()}) == 4, "the fist is not to be seen"
    assert not leaks, f"{len(leaks)} leaks (control step, what), the first: {leaks[:4]}"


@pytest.mark.parametrize("control_timestep", [0.1, 0.005])
def test_an_untouched_tower_is_drawn_to_the_last_bit_as_it_stood_at_first(poses_drawn, control_timestep):
    """It settles by less than a micrometre, which pixels show only where an edge happens to be next to one's centre."""
    model = _model(*FIST)
    rest, blocks = _at_rest(model)[0][0].astype(np.float32), _block_geoms(model)
    batch, chosen, _ = _batch_of("fist_pixels", EVERY_PATTERN, control_timestep)
    single = _shared(*FIST, SEED, control_timestep=control_timestep)
    for _ in range(5):
        batch.step(np.full(16, AWAY), chosen)
    for pattern in (SEPARATE, 6, WHOLE):
        single.task.next_episode = episode_with(pattern, SEED)
        single.reset()
        for _ in range(5):
            single.step(AWAY)
    positions, rotations = (np.concatenate(values) for values in zip(*poses_drawn, strict=True))
    assert len(positions) >= 16 * 5 + 3 * (1 + 5)
    assert (positions[:, model.geom("fist/geom").id] != rest[model.geom("fist/geom").id]).any(), "nothing moved"
    for shown, expected in ((positions, rest), (rotations, np.tile(np.eye(3).ravel(), (model.ngeom, 1)))):
        assert (shown[:, blocks] == expected[blocks]).all()


def test_a_poked_block_tells_nothing_of_the_others_which_stay_as_they_were():
    """Masses are given to the blocks in turn: 0.5 kg or 1 kg to the poked one, 0.2 kg or 1 kg to the others."""
    model = _model(*HEAVIER)
    env = _single(*HEAVIER)
    first = _image(env.reset())
    columns = _project(model, _corners(model, *_at_rest(model))[0])[..., 0]

    def play(poked, mass, others):
        env.task.next_episode = 0
        env.reset()
        kit = env.task.apparatus
        kilograms = np.full((1, 4), others)
        kilograms[0, poked] = mass
        for field, (addresses, values) in kit.mass_fields(kilograms).items():
            getattr(env.physics.model, field)[addresses] = values[0]
        return np.stack([_image(env.step(poked)) for _ in range(10)])

    for poked in range(4):
        light, heavy = play(poked, 0.5, 0.2), play(poked, 0.5, 1.0)
        assert light.tobytes() == heavy.tobytes()
        assert (light[0] != first).any() and (light[0] != play(poked, 1.0, 0.2)[0]).any()
        for other in {0, 1, 2, 3} - {poked}:
            seen = slice(int(columns[other].min()), int(columns[other].max()) + 1)
            assert (light[:, :, seen] == first[:, seen]).all()


# Everything that can happen stays in view.


def _assert_in_view(model, points, message="", margin=0.0):
    seen = _project(model, points).reshape(-1, 2)
    in_view = (seen.min() >= -margin) & (seen.max() <= EDGE + margin)
    assert in_view, (message, seen.min(axis=0), seen.max(axis=0))


@pytest.mark.parametrize("difficulty", [1, 1e300])
def test_blocks_on_their_rails_stay_in_view(load, seed, difficulty):
    """However long a poke is held: all the lightest blocks, too, up to the ends of their rails."""
    rng = np.random.default_rng(seed)
    model = _model(*HEAVIER)
    batch = load(*HEAVIER, seed, 24, difficulty=difficulty)
    batch.reset()
    actions, holds = np.zeros(24, int), np.repeat([1, 3, 8, 60], 6)
    highest = 0.0
    for t in range(60):
        actions = np.where(t % holds == 0, rng.integers(4, size=24), actions)
        batch.step(actions)
        corners = _corners(model, *_poses(batch, range(24)))
        highest = max(highest, corners[..., 2].max())
        _assert_in_view(model, corners, f"step {t}")
    assert highest > 0.1 + 0.4, "no block reached the end of its rail"


def _pushes_of_towers(rng) -> np.ndarray:
    """Whole episodes of pushes [N, 26]: each push held, each block into each corner of the room, and random ones."""
    held = np.repeat(np.arange(20)[:, None], 26, axis=1)
    corners = [[4 * k + (x, y)[t % 2] for t in range(26)] for k in range(5) for x in (0, 1) for y in (2, 3)]
    return np.concatenate([held, corners, rng.integers(20, size=(24, 26))])


def _blows_of_the_fist(rng) -> np.ndarray:
    """Whole episodes of the fist [N, 26]: each direction held, and random ones held for one to four steps."""
    held = np.repeat(np.arange(4)[:, None], 26, axis=1)
    return np.concatenate([held, *(np.repeat(rng.integers(4, size=(14, 26)), n, axis=1)[:, :26] for n in (1, 2, 3, 4))])


@pytest.mark.parametrize("task_name, plan", [("direct_pixels", _pushes_of_towers), ("fist_pixels", _blows_of_the_fist)])
def test_the_blocks_of_a_tower_and_the_fist_stay_in_view(seed, task_name, plan):
    model = _model("towers", task_name)
    plans = plan(np.random.default_rng(seed))
    patterns = np.resize([SEPARATE, WHOLE, 6], len(plans))
    batch, chosen, _ = _batch_of(task_name, patterns)
    farthest = 0.0
    for t, actions in enumerate(plans.T):
        batch.step(actions, chosen)
        poses = _poses(batch, chosen)
        corners = _corners(model, *poses)
        farthest = max(farthest, np.abs(corners[..., :2]).max())
        _assert_in_view(model, corners, f"step {t}", margin=1)  # A wall gives way a little to what hits it.
        if task_name == "fist_pixels":  # The corners of the cube around it are farther out than the fist.
            fist = poses[0][:, model.geom("fist/geom").id]
            _assert_in_view(model, fist[:, None] + 2 * CORNERS, f"fist in step {t}")
    assert farthest > 0.55, "nothing came near a wall"


@pytest.mark.parametrize("task_name", ["direct_pixels", "fist_pixels"])
def test_a_tower_that_stands_in_a_corner_of_the_room_is_in_view(task_name):
    """In one piece it can be pushed there, in a dozen steps."""
    model = _model("towers", task_name)
    walls = [model.geom(f"wall_{i}") for i in range(4)]
    reach = [np.abs(wall.pos[:2]).max() - wall.size[np.abs(wall.pos[:2]).argmax()] for wall in walls]
    assert min(reach) > 0.5, "a fallen tower does not fit in"
    corners = [(x * max(reach), y * max(reach), z) for x in (-1, 1) for y in (-1, 1) for z in (0, 0.5)]
    _assert_in_view(model, corners)


# Several environments, and others that draw.


@every_pixel_task
def test_environments_that_take_turns_each_see_their_own_state(load, domain_name, task_name):
    actions = [0, 1, 2, 3, 0, 1]
    others = actions[::-1]
    one, other = _single(domain_name, task_name), load(domain_name, task_name, suite.environment_seed(SEED, 0))
    expected, expected_others = _play(one, actions), _play(one, others)
    for env in (one, other):
        env.task.next_episode = 0
        env.reset()
    for t in range(6):
        np.testing.assert_array_equal(_image(one.step(actions[t])), expected[t + 1])
        np.testing.assert_array_equal(_image(other.step(others[t])), expected_others[t + 1])
    assert len({image.tobytes() for image in expected}) > 1, "the images never changed"
    assert (expected[-1] != expected_others[-1]).any()


def test_environments_of_different_tasks_take_turns():
    actions = [0, 2, 1, 3, 0, 0]
    envs = [_single(*task) for task in PIXEL_TASKS]
    expected = [_play(env, actions) for env in envs]
    for env in envs:
        env.task.next_episode = 0
        env.reset()
    for t, action in enumerate(actions):
        for env, images in zip(envs, expected, strict=True):
            np.testing.assert_array_equal(_image(env.step(action)), images[t + 1])


@pytest.mark.parametrize("end", ["closed", "dropped"])
@pytest.mark.parametrize("which", ["drawn first", "drawn last"])
def test_when_one_environment_is_gone_the_others_and_new_ones_see_as_before(load, end, which):
    actions = [0, 1, 2]
    staying, random = _single(*FIST), suite.environment_seed(SEED, 0)
    expected = _play(staying, actions)
    gone = suite.load(*FIST, {"random": random})
    for env in (gone, staying) if which == "drawn first" else (staying, gone):
        _play(env, actions)
    if end == "closed":
        gone.close()
    del gone, env
    gc.collect()
    for env in (staying, load(*FIST, random)):
        np.testing.assert_array_equal(_play(env, actions), expected)


def test_a_renderer_of_mujoco_that_comes_and_goes_in_between_changes_nothing(load):
    """It frees its buffers in whatever context is current, which must not be the environment's."""
    actions = [0, 1, 2, 3]
    expected = _play(_single(*FIST), actions)
    env = load(*FIST, suite.environment_seed(SEED, 0))
    env.reset()
    for t, action in enumerate(actions):
        with mujoco.Renderer(env.physics.model.ptr, 30, 40) as other:
            other.update_scene(env.physics.data.ptr)
            other.render()
            np.testing.assert_array_equal(_image(env.step(action)), expected[t + 1], err_msg=f"step {t}")


def test_an_environment_and_dm_controls_own_rendering_take_turns(load):
    """As when a film is made of an episode: `physics.render` draws in a context of its own."""
    actions = [0] * 5

    def film(env):
        env.reset()
        return [(env.step(action), env.physics.render(60, 100, camera_id="observer"))[1] for action in actions]

    random = suite.environment_seed(SEED, 0)
    expected = film(load("towers", "fist_features", random))
    images = _play(_single(*FIST), actions)
    env, frames = load(*FIST, random), []
    env.reset()
    for t, action in enumerate(actions):
        np.testing.assert_array_equal(_image(env.step(action)), images[t + 1])
        frames.append(env.physics.render(60, 100, camera_id="observer"))
    assert [(frame == other).all() for frame, other in zip(frames, expected, strict=True)] == [True] * len(frames)


# Threads and the end.


def _in_another_thread(function):
    with futures.ThreadPoolExecutor(1) as pool:
        return pool.submit(function).result()


@pytest.mark.parametrize("size", [None, 2])
def test_any_thread_may_draw(load, size):
    env = load(*HEAVIER, 0, size)
    action = 0 if size is None else [0] * size

    def play():
        if size is None:
            return _play(env, [action])
        return np.stack([_image(env.reset(episode=0)), _image(env.step(action))])

    expected = play()
    np.testing.assert_array_equal(_in_another_thread(play), expected)
    np.testing.assert_array_equal(play(), expected)


@every_pixel_task
def test_an_environment_that_was_made_in_one_thread_is_played_by_another(domain_name, task_name):
    expected = _play(_single(domain_name, task_name), [0, 1])
    env = suite.load(domain_name, task_name, {"random": suite.environment_seed(SEED, 0)})

    def play_and_close():
        images = _play(env, [0, 1])
        env.close()
        return images

    np.testing.assert_array_equal(_in_another_thread(play_and_close), expected)


@pytest.mark.parametrize("size", [None, 2])
def test_an_environment_may_be_closed_by_another_thread_than_the_one_that_drew(load, size):
    neighbour = _single(*HEAVIER)
    expected = _play(neighbour, [0, 1])
    env = load(*HEAVIER, 0, size)
    action = 0 if size is None else [0] * size
    _in_another_thread(lambda: (env.reset(), env.step(action)))
    env.close()
    with pytest.raises(RuntimeError, match="closed"):
        env.step(action)
    env = None
    gc.collect()
    np.testing.assert_array_equal(_play(neighbour, [0, 1]), expected)


@every_pixel_task
@pytest.mark.parametrize("drawn_before", [True, False])
def test_a_closed_environment_says_so_and_may_be_closed_again(load, domain_name, task_name, drawn_before):
    for env, action in ((load(domain_name, task_name, 0), 0), (load(domain_name, task_name, 0, 2), [0, 0])):
        if drawn_before:
            env.reset()
        env.close()
        env.close()
        for use in (env.reset, lambda env=env, action=action: env.step(action)):
            with pytest.raises(RuntimeError, match="closed; load another"):
                use()


# Memory.


def test_ten_thousand_resets_leave_memory_as_it_is(seed, drawn):
    """Of one environment, where each of them draws, and of a batch, where each is followed by a step that does."""
    env, batch = _shared(*HEAVIER, seed), _shared(*HEAVIER, seed, 16)

    def play():
        for _ in range(4):
            env.reset()
        env.step(0)
        batch.reset()
        batch.step(np.zeros(16, int))

    grown = memory.growth(play, 500, num_warm_up=20)
    assert sum(drawn) >= 520 * (4 + 1 + 16)
    assert grown < 2_000_000, f"{grown} bytes; an image has {EDGE * EDGE * 3}"


@pytest.mark.parametrize("end", ["closed", "dropped"])
def test_environments_that_are_gone_give_their_memory_back(end):
    """A context and its buffers take 7 MB, and not one of those of six environments may be lost."""

    def play():
        for env in (suite.load(*HEAVIER), suite.load_batch(*HEAVIER, 1)):
            env.reset()
            if end == "closed":
                env.close()

    grown = memory.growth(play, 3, num_warm_up=3)
    assert grown < 7_000_000, f"{grown} bytes"


@pytest.mark.long
@pytest.mark.parametrize("size", [None, 2], ids=["environment", "batch"])
def test_two_thousand_environments_opened_and_closed_leave_nothing(size):
    """Neither memory nor open files; 2 kB of each would be 4 MB in all."""

    def play():
        environment = suite.load(*HEAVIER) if size is None else suite.load_batch(*HEAVIER, size)
        environment.reset()
        environment.step(0 if size is None else np.zeros(size, int))
        environment.close()

    play()
    files = len(os.listdir("/proc/self/fd"))
    grown = memory.growth(play, 2000, num_warm_up=20)
    assert grown < 4_000_000, f"{grown} bytes"
    assert len(os.listdir("/proc/self/fd")) == files


def test_a_dozen_environments_draw_in_turn_while_all_are_open_and_leave_no_file(load):
    """Each has a context of its own."""
    files = len(os.listdir("/proc/self/fd"))
    environments = [load(*HEAVIER, number) for number in range(12)]
    first = [_image(environment.reset()) for environment in environments]
    poked = [_image(environment.step(0)) for environment in environments]
    for number in (0, 6, 11):
        np.testing.assert_array_equal(first[number], first[0])
        assert (poked[number] != first[number]).any()
    for environment in environments:
        environment.close()
    assert len(os.listdir("/proc/self/fd")) <= files + 1
