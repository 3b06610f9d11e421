"""A study: the page in the order of an experiment with people, from consent to debriefing."""

from collections.abc import Sequence
import json
from pathlib import Path
import shutil

from physexp import checks
from physexp.analysis.play import exporting, page

PRACTICE = 3
"""Instances of each task that are played for practice, before those of the study."""

_TEMPLATE = page.SITE / "study"

Order = list[tuple[str, int]]
"""Files of tasks and indices of their instances."""


def orders(files: Sequence[str], num_instances: int, count: int) -> list[Order]:
    """Returns orders of all trials, each of which has a block of every task.

    The orders begin at places that are evenly apart: with as many orders as instances, each instance comes at every
    place of its block once.

    Raises ValueError for a count that is no integer from 1 to the number of instances.
    """
    checks.integer("orders", count, 1, num_instances)

    def block(file: str, order: int) -> Order:
        first = order * num_instances // count
        return [(file, PRACTICE + (first + place) % num_instances) for place in range(num_instances)]

    return [
        [trial for place in range(len(files)) for trial in block(files[(order + place) % len(files)], order)]
        for order in range(count)
    ]


def write(folder: Path, tasks: dict[str, exporting.Data], num_orders: int) -> Path:
    """Writes a study into a folder, which it makes; returns the path to open. It needs a server.

    The first instances of each task are for practice. Texts that are already there stay as they are.

    Raises ValueError as `orders`.
    """
    num_instances = min(len(task["instances"]) for task in tasks.values()) - PRACTICE
    found = {
        "orders": orders(list(tasks), num_instances, num_orders),
        "practice": [(file, episode) for file in tasks for episode in range(PRACTICE)],
    }
    page.write(folder, tasks)
    settings = folder / "study.json"
    for path in _TEMPLATE.iterdir():
        if path.name != settings.name or not settings.exists():
            shutil.copyfile(path, folder / path.name)
    settings.write_text(json.dumps({**json.loads(settings.read_text()), **found}, indent=2))
    return folder / "index.html"
