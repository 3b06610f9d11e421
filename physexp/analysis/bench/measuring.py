"""Rows of figures, rates measured in turns, and the players that several sections use."""

from collections.abc import Callable
import statistics
import subprocess
import sys
import time

import numpy as np

from physexp import suite
from physexp.agents.a3c import config as a3c
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import trainer

Task = tuple[str, str]
"""Names of a domain and of one of its tasks."""

BATCH = 256
THREADS = 2
REPETITIONS = 5


def tasks(observations: str) -> dict[str, Task]:
    """Returns the tasks with one kind of observations, `features` or `pixels`, by short names.

    A short name is the task's other tags, or the last word of its domain's name.
    """
    found = {}
    for domain, task in suite.tagged(observations):
        kind = "_".join(sorted(suite.tags(domain, task) - {observations}))
        found[kind or domain.rpartition("_")[2]] = (domain, task)
    return found


FEATURES = tasks("features")
REFERENCE = next(iter(FEATURES.values()))
"""The task of figures that are measured for a single task."""


def row(figure: str, value: float, unit: str, target: float, at_most: bool = False, **absolute: float) -> dict:
    """Returns a figure as a row: its value, unit and target, and the absolute values behind it."""
    known = {"figure": figure, "value": value, "unit": unit, "target": target, "at_most": at_most}
    return known | {"reached": value <= target if at_most else value >= target} | absolute


def ratio(figure: str, target: float, at_most: bool = False, **sides: float) -> dict:
    """Returns the ratio of two values, which are named, as a row."""
    first, second = sides.values()
    return row(figure, first / second, "" if at_most else "x", target, at_most, **sides)


def line(figure: dict) -> str:
    """Returns a figure as a line of text."""
    known = {"figure", "value", "unit", "target", "at_most", "reached"}
    absolute = ", ".join(f"{name} {value:,.4g}" for name, value in figure.items() if name not in known)
    sign = "<=" if figure["at_most"] else ">="
    verdict = "ok  " if figure["reached"] else "MISS"
    value = f"{figure['value']:.4g} {figure['unit']}"
    return f"{verdict} {figure['figure']:58} {value:>12}  ({sign} {figure['target']:g})  {absolute}"


def rates(*sides: Callable[[], int], seconds: float = 1.0) -> list[float]:
    """Returns the median steps per second of each side: a function that takes some steps and returns their number.

    Sides take turns of some seconds.
    """
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
    """Returns the shortest of three durations of a `physexp` command, s, as a row."""
    command = [sys.executable, "-c", "from physexp.cli import main; main()", *arguments]
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        seconds.append(time.perf_counter() - start)
    return row(figure, min(seconds), "s", limit, at_most=True)


def random_loop(environment) -> Callable[[], int]:
    """Returns a function that plays uniformly random actions in one environment."""
    generator = np.random.default_rng(0)
    num_actions = environment.action_spec().num_values

    def play() -> int:
        for action in generator.integers(num_actions, size=20):
            environment.step(action)
        return 20

    return play


def random_batch(task: Task, size: int = BATCH, only_interactions: bool = False) -> Callable[[], int]:
    """Returns a function that plays uniformly random actions in a batch."""
    environment = suite.load_batch(*task, size, {"random": 0}, THREADS)
    generator = np.random.default_rng(0)
    rules = environment.task.rules
    num_actions = rules.num_interactions if only_interactions else rules.num_actions
    environment.reset()

    def play() -> int:
        environment.step(generator.integers(num_actions, size=size))
        return size

    return play


def training_rate(task: Task, seconds: float) -> float:
    """Returns frames per second of A3C from scratch, measured once all workers have sent an update."""
    preset = config_lib.preset(*task, algorithm="a3c")
    assert isinstance(preset, a3c.A3CConfig)
    agent = trainer.make_agent(config_lib.TrainConfig(domain=task[0], task=task[1], agent=preset))
    heard: set[int] = set()
    start, frames, at_start = None, 0, 0
    for update in agent.updates():
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
