"""Speed of drawing and of learning from pixels, each beside its upper bound."""

from collections.abc import Callable, Iterator
import multiprocessing

import numpy as np
import torch

from physexp import suite  # Before mujoco and dm_control, for which it chooses the GL backend.
from physexp.agents import losses, networks, starting
from physexp.agents.a3c import config as a3c
from physexp.analysis.bench import measuring
from physexp.analysis.training import config as config_lib
from physexp.suite.engine import gl, rendering
from physexp.suite.parts import things, tower

from dm_control import composer, mjcf  # isort: skip
import mujoco  # isort: skip

BATCH = 64
TASKS = measuring.tasks("pixels")
_ROUND_STEPS = 6
_SECONDS = 20.0  # Of training, or of the bare network, for one rate.


def figures() -> Iterator[dict]:
    """Measures frames per second of drawing, against MuJoCo's own and a composer scene, and then of training."""
    for name in TASKS:
        drawn, bare = measuring.rates(_batch_drawing(name), bare_rendering(name))
        figure = f"batched drawing / bare mjr_render and mjr_readPixels: {name}"
        yield measuring.ratio(figure, 0.85, batched=drawn, bare=bare)
    ours, theirs = measuring.rates(bare_rendering("direct"), composer_rendering())
    figure = "a frame of our scene / of composer's default arena: direct"
    ours_us, theirs_us = 1e6 / ours, 1e6 / theirs
    value = theirs_us / ours_us
    yield measuring.row(figure, value, "x cheaper", 20, our_microseconds=ours_us, composer_microseconds=theirs_us)
    for name, task in TASKS.items():
        environment = suite.load(*task, task_kwargs={"random": 0})
        batch, loop = measuring.rates(measuring.random_batch(task, BATCH), measuring.random_loop(environment))
        environment.close()
        yield measuring.ratio(f"pixel batch of {BATCH} / loop over suite.load: {name}", 10, batch=batch, loop=loop)
    for name in ("fist", "heavier"):
        trained = measuring.training_rate(TASKS[name], _SECONDS)
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            bare = sum(pool.map(_bare_network_rate, [TASKS[name]] * 2, chunksize=1))
        figure = f"pixel training / bare network acting and training: {name}"
        yield measuring.ratio(figure, 0.7, training=trained, bare=bare)


def _batch_drawing(name: str) -> Callable[[], int]:
    """Returns a function that draws the states of a batch after some interactions, as a step does."""
    task = suite.load_task(*TASKS[name], {"random": 0})
    geom_xpos, geom_xmat = _played_poses(name)
    observations = {"pixels": np.zeros((BATCH, rendering.SIZE, rendering.SIZE, 3), np.uint8)}
    apparatus, rows = task.build_apparatus(0), np.arange(BATCH)
    starts = apparatus.start.repeated(BATCH)
    sensordata = starts.shown["sensordata"].copy()
    state = {"geom_xpos": geom_xpos, "geom_xmat": geom_xmat, "sensordata": sensordata}
    touched = np.ones((BATCH, len(apparatus.held)), bool)

    def draw() -> int:
        task.observer.look(apparatus, state, touched, starts, rows, observations)
        return BATCH

    return draw


def _played_poses(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Returns poses of the geoms after some random interactions in each of `BATCH` environments."""
    poses = []
    generator = np.random.default_rng(0)
    environment = suite.load(*measuring.FEATURES[name], task_kwargs={"random": 0})
    for _ in range(BATCH):
        environment.reset()
        for action in generator.integers(environment.task.num_interactions, size=5):
            environment.step(action)
        poses.append((environment.physics.data.geom_xpos.copy(), environment.physics.data.geom_xmat.copy()))
    environment.close()
    return np.stack([position for position, _ in poses]), np.stack([rotation for _, rotation in poses])


def bare_rendering(name: str) -> Callable[[], int]:
    """Returns a function that draws a still scene and reads it back with MuJoCo's own functions."""
    apparatus = suite.load_task(*TASKS[name], {"random": 0}).build_apparatus(0)
    renderer = rendering.Renderer(apparatus.model, apparatus.moving_geoms)
    size = rendering.SIZE
    context, scene, buffers = renderer.context, renderer.scene, renderer.buffers
    image, rectangle = np.zeros((size, size, 3), np.uint8), mujoco.MjrRect(0, 0, size, size)

    def draw(renderer=renderer) -> int:  # Keeps the renderer alive.
        with gl.current(context):
            for _ in range(BATCH):
                mujoco.mjr_render(rectangle, scene, buffers)
                mujoco.mjr_readPixels(image, None, rectangle, buffers)
        return BATCH

    return draw


def composer_rendering() -> Callable[[], int]:
    """Returns a function that draws a tower in composer's default arena with dm_control."""
    arena = composer.Arena()
    for k in range(tower.NUM_BLOCKS):
        cube = things.Block(rgba=things.COLORS[k], mass=1.0, name=f"block_{k}")
        arena.attach(cube).pos = [0, 0, (2 * k + 1) * things.HALF_SIZE]
    physics = mjcf.Physics.from_mjcf_model(arena.mjcf_model)

    def draw() -> int:
        physics.render(rendering.SIZE, rendering.SIZE)
        return 1

    return draw


def _bare_network_rate(task: measuring.Task) -> float:
    """Returns frames per second of a preset's network on random images: a pass to act, and both passes to learn."""
    torch.set_num_threads(1)
    config = config_lib.preset(*task, algorithm="a3c")
    assert isinstance(config, a3c.A3CConfig)
    environment = suite.load_batch(*task, 1)
    network = starting.make_network(networks.RecurrentActorCritic, environment, config)
    shape = (_ROUND_STEPS, config.envs_per_worker, rendering.SIZE, rendering.SIZE, 3)
    images = torch.randint(256, shape, dtype=torch.uint8, generator=torch.Generator().manual_seed(0))
    batch_sizes = torch.full((_ROUND_STEPS,), config.envs_per_worker)
    num_frames = int(batch_sizes.sum())
    actions, returns = torch.zeros(num_frames, dtype=torch.int64), torch.ones(num_frames)

    def act_and_learn() -> int:
        with torch.no_grad():
            state: networks.State = network.initial_state(config.envs_per_worker)
            for seen in images:
                _, state = network.step(network.encode({"pixels": seen}), state)
        network.zero_grad()
        logits, values = network.unroll(network.encode({"pixels": images.flatten(0, 1)}), batch_sizes)
        torch.stack(losses.actor_critic_losses(logits, values, actions, returns, returns)).sum().backward()
        return num_frames

    return measuring.rates(act_and_learn, seconds=_SECONDS / measuring.REPETITIONS)[0]
