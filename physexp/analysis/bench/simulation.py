"""Speed of resets and of batches, against a loop, composer, and MuJoCo's own batches."""

from collections.abc import Callable, Iterator
import statistics
import time

import numpy as np

from physexp import suite  # Before mujoco and dm_control, for which it chooses the GL backend.
from physexp.analysis.bench import measuring
from physexp.analysis.bench.measuring import BATCH, FEATURES, THREADS, Task

from dm_control import composer  # isort: skip
from mujoco import batch as mujoco_batch  # isort: skip

_RESET = {"heavier": 1.5}
_RESET_OF_OTHERS = 6.0  # Upper limit, ms.
_FURTHER = 5.0  # Lower limit of the ratio of the first batch's loading time to that of a further batch.
_BATCH = {"heavier": (60, 200, 0.7)}
_BATCH_OF_OTHERS = (6, 15, 0.85)  # Lower limits: a loop, composer that recompiles, MuJoCo's own batch.


def resets() -> Iterator[dict]:
    """Measures the duration of a reset, and of loading the first and further batches of many models."""
    for name, task in FEATURES.items():
        if suite.load_task(*task).scene.num_structures > 1:
            first, *more = (_begin_batch(task) for _ in range(1 + measuring.REPETITIONS))
            further = statistics.median(more)
            figure = f"first / further batch of {BATCH}: {name}"
            yield measuring.ratio(figure, _FURTHER, first=first, further=further)
        environment = suite.load(*task, task_kwargs={"random": 0})
        for _ in range(100):  # Compiles every structure.
            environment.reset()

        def reset(environment=environment) -> int:
            environment.reset()
            return 1

        milliseconds = 1e3 / measuring.rates(reset)[0]
        target = _RESET.get(name, _RESET_OF_OTHERS)
        yield measuring.row(f"reset of suite.load: {name}", milliseconds, "ms", target, at_most=True)


def _begin_batch(task: Task) -> float:
    """Returns the seconds that loading and resetting a batch takes."""
    start = time.perf_counter()
    batch = suite.load_batch(*task, BATCH, {"random": 0})
    batch.reset()
    taken = time.perf_counter() - start
    batch.close()
    return taken


def batches() -> Iterator[dict]:
    """Measures control steps per second of a batch, against three references."""
    for name, task in FEATURES.items():
        loop_target, recompile_target, bare_target = _BATCH.get(name, _BATCH_OF_OTHERS)
        batch, loop, recompiling = measuring.rates(
            measuring.random_batch(task),
            measuring.random_loop(suite.load(*task, task_kwargs={"random": 0})),
            measuring.random_loop(_RecompilingEnvironment(suite.load_task(*task, {"random": 0}))),
        )
        yield measuring.ratio(f"batch of {BATCH} / loop over suite.load: {name}", loop_target, batch=batch, loop=loop)
        figure = f"batch of {BATCH} / composer that recompiles: {name}"
        yield measuring.ratio(figure, recompile_target, batch=batch, recompiling=recompiling)
        ours = measuring.random_batch(task, only_interactions=True)
        batch, bare = measuring.rates(ours, bare_batch(task), seconds=3.0)
        yield measuring.ratio(f"batch / bare mujoco Batch.step: {name}", bare_target, batch=batch, bare=bare)


class _RecompilingEnvironment(composer.Environment):
    """Composer's default: the MJCF is compiled again for every episode."""

    def __init__(self, task):
        self._apparatuses = {}
        super().__init__(task, random_state=0, strip_singleton_obs_buffer_dim=True)

    def _recompile_physics(self):
        super()._recompile_physics()
        structure = self._task.structure
        if structure not in self._apparatuses:
            self._apparatuses[structure] = self._task.build_apparatus(structure)
        self._task.apparatus = self._apparatuses[structure]


def bare_batch(task_name: Task) -> Callable[[], int]:
    """Returns a function that plays random interactions in MuJoCo's own batches of the same models."""
    task = suite.load_task(*task_name, {"random": 0})
    seeds = np.array([suite.environment_seed(0, i) for i in range(BATCH)])
    structures, counts = np.unique(task.structures(task.draw(seeds, np.zeros_like(seeds))), return_counts=True)
    models = [apparatus.model for apparatus in map(task.build_apparatus, structures.tolist())]
    batches = [mujoco_batch.Batch(model, int(count), THREADS) for model, count in zip(models, counts, strict=True)]
    controls = [batch.bind("ctrl") for batch in batches]
    generator, steps = np.random.default_rng(0), 0

    def play() -> int:
        nonlocal steps
        if steps % task.rules.step_limit == 0:
            for batch in batches:
                batch.reset()
        steps += 1
        for batch, control in zip(batches, controls, strict=True):
            control[:] = task.controls[generator.integers(task.num_interactions, size=batch.nsim)]
            batch.step(nstep=task.options.substeps)
        return BATCH

    return play
