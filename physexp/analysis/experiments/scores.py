"""How well agents play while they learn, in shares of what can be reached."""

from collections.abc import Sequence

import numpy as np

from physexp.analysis.experiments import base, conditions, ideal_towers, learning
from physexp.analysis.training import config as config_lib

TASKS = (*conditions.HEAVIER, *conditions.TOWERS)
LEVEL = 0.95  # Of the ideal's return, for features; of right answers, for pixels.
FLOOR = -0.5  # Of figures; what is less is of no interest.
_FINE = 0.001  # m, the least that the observer distinguishes whom agents from features are compared with.


def load(results: base.Results, wanted: Sequence[config_lib.TrainConfig]):
    """Learning curves: rows of metrics of all agents of these conditions, with their `score`.

    It is the share of the ideal's return from features, and of right answers from pixels: that of the greedy episodes
    where a learner plays some of its episodes greedily, and of all, with drawn actions, elsewhere.
    """
    frame = results.curves(wanted)
    returns, right = (
        frame.get(greedy, default=frame[drawn] * np.nan).fillna(frame[drawn])
        for greedy, drawn in (("greedy_return", "episode_return"), ("greedy_success_rate", "success_rate"))
    )
    units = {task.label: _unit(task, results) for task in TASKS if (frame.condition == task.label).any()}
    return frame.assign(score=returns.where(~frame.condition.map(sees_pixels), right) / frame.condition.map(units))


def _unit(task, results: base.Results) -> float:
    """Returns what a score of one is: the ideal's return, or all answers right."""
    if sees_pixels(task.label):
        return 1.0
    if task in conditions.TOWERS:
        return ideal_towers.best(ideal_towers.read(results)[task.task], resolution=_FINE)["value"]
    return conditions.ideal(task).value


def sees_pixels(label: str) -> bool:
    """Returns whether agents observe pixels in a condition of this name."""
    return label in {task.label for task in TASKS if conditions.observations(task) == "pixels"}


def level(label: str) -> str:
    """Returns, in words, what agents of a condition are to reach."""
    return f"{LEVEL:.0%} right answers" if sees_pixels(label) else f"{LEVEL:.0%} of the ideal's return"


def runs(frame, label: str, learner: str) -> list:
    """Returns the rows of each agent of a task that a learner, named by its title, has trained."""
    chosen = frame[(frame.condition == label) & (frame.algorithm == learner)]
    return [run for _, run in chosen.groupby("training_seed")]


def reached(runs: Sequence, along: str) -> np.ndarray:
    """Returns where on a column runs first reach `LEVEL`; infinity where they do not."""
    return np.array([learning.first_reached(run, LEVEL, along, "score") for run in runs])


def frames_needed(runs: Sequence) -> np.ndarray:
    """Returns the environment steps until runs reach `LEVEL`; all that they had where they do not."""
    return np.minimum(reached(runs, "frames"), [run.frames.max() for run in runs])
