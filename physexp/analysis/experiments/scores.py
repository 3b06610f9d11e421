"""How well agents play while they learn, in shares of what can be reached."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from physexp.analysis.data import estimates
from physexp.analysis.experiments import base, claims, conditions, ideal_towers, learning
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import records

TASKS = tuple(conditions.BY_LABEL.values())
LEVEL = 0.95  # Of the ideal's return, for features; of right answers, for pixels.
FLOOR = -0.5  # Of figures; what is less is of no interest.
_FROM_PIXELS = frozenset(task.label for task in TASKS if conditions.observations(task) == "pixels")


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
    shown = [task for task in TASKS if (frame.condition == task.label).any()]
    units = {task.label: 1.0 if sees_pixels(task.label) else ideal_return(task, results) for task in shown}
    return frame.assign(score=returns.where(~frame.condition.map(sees_pixels), right) / frame.condition.map(units))


def final(results: base.Results, wanted: Sequence[config_lib.TrainConfig], known: Mapping[str, float] | None = None):
    """What trained agents earn: a DataFrame with a row for each agent of these conditions that has been evaluated.

    `share` is that of the ideal's return, and `error` the standard error of it, from the agent's episodes.

    Args:
      results: the results.
      wanted: the conditions, whatever the seed in them.
      known: the ideal's return by condition; what is not there is looked up.
    """
    import pandas

    rows = []
    ideals = dict(known or {})
    for config in wanted:
        if not results.has_played(base.EVALUATION, config):
            continue  # What is said is about those that have been trained.
        frame = results.episodes([base.EVALUATION], [config], ["reward", "length"])
        if config.label not in ideals:
            ideals[config.label] = ideal_return(conditions.BY_LABEL[config.label], results)
        for seed, episodes in frame.groupby("training_seed"):
            shares = records.discounted_return(episodes) / ideals[config.label]
            rows.append(
                {
                    "condition": config.label,
                    "algorithm": config.agent.title,
                    "training_seed": seed,
                    "share": shares.mean(),
                    "error": shares.std(ddof=1) / np.sqrt(len(shares)),
                }
            )
    return pandas.DataFrame(rows, columns=["condition", "algorithm", "training_seed", "share", "error"])


def ideal_return(task: config_lib.TrainConfig, results: base.Results) -> float:
    """Returns the ideal experimenter's return in a task."""
    if task in conditions.TOWERS:
        return ideal_towers.best(ideal_towers.read(results)[task.task])["value"]
    return conditions.ideal(task).value


def sees_pixels(label: str) -> bool:
    """Returns whether agents observe pixels in a condition of this name."""
    return label in _FROM_PIXELS


def middle(label: str) -> tuple[str, Callable[..., estimates.Estimate]]:
    """Returns the name of what agents of a condition are summed up by, and how to estimate it.

    From pixels it is their mean: there are too few for an interval of the median.
    """
    return ("mean", estimates.mean) if sees_pixels(label) else ("median", estimates.median)


def level(label: str) -> str:
    """Returns, in words, what agents of a condition are to reach."""
    return f"{LEVEL:.0%} right answers" if sees_pixels(label) else f"{LEVEL:.0%} of the ideal's return"


def runs(frame, label: str, learner: str) -> list:
    """Returns the rows of each agent of a task that a learner, named by its title, has trained."""
    chosen = frame[(frame.condition == label) & (frame.algorithm == learner)]
    chosen.attrs = {}  # What is known of the whole frame pandas would copy deeply with every step from here on.
    return [run for _, run in chosen.groupby("training_seed")]


def reached(runs: Sequence, along: str) -> np.ndarray:
    """Returns where on a column runs first reach `LEVEL`; infinity where they do not."""
    return np.array([learning.first_reached(run, LEVEL, along, "score") for run in runs])


def ratio_of_frames(quick: Sequence, slow: Sequence) -> estimates.Estimate:
    """Returns the geometric mean of the environment steps to `LEVEL` of runs that are to be quick over that of others.

    Runs that never reach it gain nothing by that: of those that are to be quick none is known to be, and the others
    count with all the training that they had, which is less than they need: the ratio is then at most what is returned.
    """
    needed = reached(slow, "frames")
    ratio = estimates.ratio_of_means(reached(quick, "frames"), np.minimum(needed, [run.frames.max() for run in slow]))
    return ratio if np.isfinite(needed).all() else estimates.at_most(ratio)


def fewer_frames(quick: Sequence, slow: Sequence, **facts: Any) -> list[claims.Claim]:
    """Returns the claim that runs need fewer environment steps to `LEVEL` than others, if there are runs of both.

    Args:
      quick, slow: runs, see `ratio_of_frames`.
      facts: what else the claim says, see `claims.Claim`.
    """
    return [claims.Claim(**facts, estimate=ratio_of_frames(quick, slow), below=1)] if quick and slow else []
