"""Performance figures, each a ratio of two things measured in turn in the same run, with what each was on its own.

Machines are noisy: a figure is the median over repetitions in which both sides take their turn.
"""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
import statistics
import subprocess
import sys
import time

import numpy as np

from physexp import suite  # Before dm_control, for which it chooses the GL backend.

from dm_control import composer  # isort: skip

BATCH = 256
THREADS = 2
REPETITIONS = 5
TASKS = {
    "heavier": ("which_is_heavier", "features"),
    "direct": ("towers", "direct_features"),
    "fist": ("towers", "fist_features"),
}


def row(figure: str, value: float, unit: str, target: float, at_most: bool = False, **absolute: float) -> dict:
    """One figure: its value and unit, what it must reach, whether it does, and the absolute figures behind it."""
    reached = value <= target if at_most else value >= target
    return {
        "figure": figure,
        "value": value,
        "unit": unit,
        "target": target,
        "at_most": at_most,
        "reached": reached,
        **absolute,
    }


def line(figure: dict) -> str:
    """A figure as a line of text."""
    known = {"figure", "value", "unit", "target", "at_most", "reached"}
    absolute = ", ".join(f"{name} {value:,.4g}" for name, value in figure.items() if name not in known)
    sign = "<=" if figure["at_most"] else ">="
    verdict = "ok  " if figure["reached"] else "MISS"
    value = f"{figure['value']:.4g} {figure['unit']}"
    return f"{verdict} {figure['figure']:58} {value:>12}  ({sign} {figure['target']:g})  {absolute}"


def run(sections: Sequence[str], results_dir: Path) -> Iterator[dict]:
    """Measures sections of figures, in the order given."""
    for section in sections:
        if section == "learning":
            from physexp.analysis.bench import learning as bench_learning

            yield from bench_learning.run(results_dir)
        else:
            yield from _SECTIONS[section]()


def rates(*sides: Callable[[], int], seconds: float = 1.0) -> list[float]:
    """Median steps per second of each side: a call does some steps and returns how many; the sides take turns."""
    found: list[list[float]] = [[] for _ in sides]
    for repetition in range(REPETITIONS + 1):
        for measured, side in zip(found, sides, strict=True):
            steps, start = 0, time.perf_counter()
            while time.perf_counter() - start < (seconds if repetition else 0.2):
                steps += side()
            if repetition:  # The first one warms up.
                measured.append(steps / (time.perf_counter() - start))
    return [statistics.median(measured) for measured in found]


def timed(figure: str, arguments: list[str], limit: float) -> dict:
    """How long a command of ours takes from start to end, s: the best of three."""
    command = [sys.executable, "-c", "from physexp.cli import main; main()", *arguments]
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        seconds.append(time.perf_counter() - start)
    return row(figure, min(seconds), "s", limit, at_most=True)


def _reset() -> Iterator[dict]:
    for name, target in (("heavier", 1.5), ("direct", 6.0), ("fist", 6.0)):
        environment = suite.load(*TASKS[name], task_kwargs={"random": 0})
        for _ in range(100):  # Compiles every structure.
            environment.reset()

        def reset(environment=environment) -> int:
            environment.reset()
            return 1

        yield row(f"reset of suite.load: {name}", 1e3 / rates(reset)[0], "ms", target, at_most=True)


def _batch() -> Iterator[dict]:
    targets = {"heavier": (60, 200, 0.7), "direct": (6, 15, 0.85), "fist": (6, 15, 0.85)}
    for name, (loop_target, recompile_target, bare_target) in targets.items():
        batch, loop, recompiling = rates(
            random_batch(TASKS[name]), random_loop(_environment(name)), random_loop(_recompiling(name))
        )
        yield row(
            f"batch of {BATCH} / loop over suite.load: {name}", batch / loop, "x", loop_target, batch=batch, loop=loop
        )
        yield row(
            f"batch of {BATCH} / composer that recompiles: {name}",
            batch / recompiling,
            "x",
            recompile_target,
            batch=batch,
            recompiling=recompiling,
        )
        batch, bare = rates(random_batch(TASKS[name], only_interactions=True), bare_batch(name), seconds=3.0)
        yield row(f"batch / bare mujoco Batch.step: {name}", batch / bare, "x", bare_target, batch=batch, bare=bare)


def _environment(name: str):
    return suite.load(*TASKS[name], task_kwargs={"random": 0})


def _recompiling(name: str):
    return _RecompilingEnvironment(suite.load_task(*TASKS[name], {"random": 0}))


class _RecompilingEnvironment(composer.Environment):
    """What composer does by default: it compiles the MJCF anew at every episode."""

    def __init__(self, task):
        self._apparatuses = {}
        super().__init__(task, random_state=0, strip_singleton_obs_buffer_dim=True)

    def _recompile_physics(self):
        super()._recompile_physics()
        structure = self._task.structure
        if structure not in self._apparatuses:
            self._apparatuses[structure] = self._task.build_apparatus(structure)
        self._task.apparatus = self._apparatuses[structure]


def random_loop(environment) -> Callable[[], int]:
    """Uniformly random actions in one environment."""
    generator = np.random.default_rng(0)
    num_actions = environment.action_spec().num_values

    def play() -> int:
        for action in generator.integers(num_actions, size=20):
            environment.step(action)
        return 20

    return play


def random_batch(task: tuple[str, str], size: int = BATCH, only_interactions: bool = False) -> Callable[[], int]:
    """Uniformly random actions in a batch."""
    environment = suite.load_batch(*task, size, {"random": 0}, THREADS)
    generator = np.random.default_rng(0)
    rules = environment.task.rules
    num_actions = rules.num_interactions if only_interactions else rules.num_actions
    environment.reset()

    def play() -> int:
        environment.step(generator.integers(num_actions, size=size))
        return size

    return play


def bare_batch(name: str) -> Callable[[], int]:
    """Uniformly random interaction actions in MuJoCo's own batches of the same models, reset at the time limit."""
    from mujoco.batch import Batch

    task = suite.load_task(*TASKS[name], {"random": 0})
    seeds = np.array([suite.environment_seed(0, i) for i in range(BATCH)])
    structures, counts = np.unique(task.structures(task.draw(seeds, np.zeros_like(seeds))), return_counts=True)
    models = [task.build_apparatus(int(structure)).model for structure in structures]
    batches = [Batch(model, int(count), THREADS) for model, count in zip(models, counts, strict=True)]
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


def _training() -> Iterator[dict]:
    for name, target in (("heavier", 0.35), ("direct", 0.8), ("fist", 0.8)):
        trained, random = training_rate(TASKS[name], 20.0), rates(random_batch(TASKS[name]), seconds=2.0)[0]
        yield row(
            f"training / random policy in the batch: {name}",
            trained / random,
            "x",
            target,
            training=trained,
            random=random,
        )


def training_rate(task: tuple[str, str], seconds: float) -> float:
    """Frames per second of the default agent on two workers, from scratch, once all workers are under way."""
    from physexp.agents.a3c import config as a3c
    from physexp.analysis.training import config as config_lib
    from physexp.analysis.training import trainer

    preset = config_lib.preset(*task)
    assert isinstance(preset, a3c.A3CConfig)
    agent = trainer.make_agent(config_lib.TrainConfig(domain=task[0], task=task[1], agent=preset))
    heard: set[int] = set()
    start, frames, at_start = None, 0, 0
    for update in agent.updates(poll_seconds=0.1):
        if update is not None:
            heard.add(update.seed)
            frames = int(update.metrics["frames"])
        if start is None and len(heard) == preset.num_workers:
            start, at_start = time.perf_counter(), frames
        if start is not None and time.perf_counter() - start > seconds:
            rate = (frames - at_start) / (time.perf_counter() - start)
            break
    agent.stop()
    return rate


def _peers() -> Iterator[dict]:
    from physexp.analysis.bench import peers as bench_peers

    peer = bench_peers.recurrent_ppo_rate(*TASKS["heavier"], seconds=30.0)
    ours = training_rate(TASKS["heavier"], 20.0)
    yield row("training / sb3-contrib RecurrentPPO: heavier", ours / peer, "x", 50, training=ours, peer=peer)


def _pixels() -> Iterator[dict]:
    from physexp.analysis.bench import pixels as bench_pixels

    yield from bench_pixels.rendering_figures()
    yield from bench_pixels.training_figures()


def _pretrained() -> Iterator[dict]:
    from physexp.analysis.bench import pretrained as bench_pretrained

    yield from bench_pretrained.run()


def _replay() -> Iterator[dict]:
    from physexp.analysis.bench import replay as bench_replay

    yield from bench_replay.run()


def _distributed() -> Iterator[dict]:
    from physexp.analysis.bench import distributed as bench_distributed

    yield from bench_distributed.run()


_SECTIONS = {
    "reset": _reset,
    "batch": _batch,
    "training": _training,
    "peers": _peers,
    "pixels": _pixels,
    "pretrained": _pretrained,
    "replay": _replay,
    "distributed": _distributed,
}
