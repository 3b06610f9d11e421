"""Success in training: Which is Heavier (paper, Section 5.3; Figure 2), Towers (6.3; Figure 6), and A3C with others."""

from collections.abc import Callable, Iterable
import functools
from typing import Any

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves

_END = 0.05  # The share of training that is its end.
_LEARNED = 0.9  # The success at which the speed of learning is compared.

_TASKS = tuple(conditions.BY_LABEL[label] for label in ("5-F", "F-F"))
LEARNERS = tuple(condition for task in _TASKS for condition in (task, conditions.with_ppo(task)))
_NAMES = {"ppo": "PPO", "a3c": "A3C"}

_NUMBERS = {"a3c": "two workers", "a3c_one_worker": "one worker"}
_OWN = ", the paper's own"  # A remark to the label of a condition.
WORKERS = tuple(
    each
    for task in (*conditions.BY_LABEL.values(), conditions.PAPERS_OWN)
    for each in (task, conditions.with_one_worker(task).changed(player=f"{task.player}_one_worker"))
)


def load_heavier(results: base.Results):
    """Returns learning curves; the attribute `ideal` has the accuracy of the ideal experimenter at each difficulty."""
    frame = results.curves(conditions.HEAVIER)
    frame.attrs["ideal"] = [each.ideal().figures()["accuracy"] for each in conditions.FEATURES]
    return frame


def with_own_apart(frame):
    """Returns learning curves in which the paper's own learner is A3C, in conditions of its own."""
    is_own = frame.player.str.startswith("a3c_paper")
    return frame.assign(
        condition=frame.condition.where(~is_own, frame.condition + _OWN),
        player=frame.player.str.replace("_paper", ""),
    )


def final_success(rows):
    """Returns the share of right answers at the end of training, of each agent of a condition."""
    ends = rows.groupby("training_seed").frames.transform("max")
    return rows[rows.frames >= (1 - _END) * ends].groupby("training_seed").success_rate.mean()


_mean_success = claims.of_rows(lambda rows: estimates.mean_share(final_success(rows)))


def _ratio_of_ends(*groups: Any) -> estimates.Estimate:
    return estimates.ratio_of_means(*map(final_success, groups))


def _ratio_of_success(frame, condition: str) -> estimates.Estimate:
    return _ratio_of_ends(*(claims.rows(frame, condition=name) for name in condition.split(" against ")))


def ratio_of_steps(quick, slow, along: str = "frames") -> estimates.Estimate:
    """Returns the ratio of the training until `_LEARNED` of two groups, within the shortest training of all agents.

    An agent that never reaches it counts as one that reaches it at the end of that training.
    """
    shortest = min(rows.groupby("training_seed")[along].max().min() for rows in (quick, slow))
    return estimates.ratio_of_means(
        *(curves.reached(rows, _LEARNED, along).clip(max=shortest) for rows in (quick, slow))
    )


def _fist_over_direct(frame, kind: str) -> estimates.Estimate:
    return ratio_of_steps(*(claims.rows(frame, condition=name) for name in conditions.by_actuator(kind)))


def _between(players: Iterable[str], ratio: Callable[[Any, Any], estimates.Estimate]) -> claims.Statistic:
    """Returns the statistic of a ratio of two learners' curves in a task."""

    def statistic(frame, task: str) -> estimates.Estimate:
        return ratio(*(claims.rows(frame, condition=task, player=name) for name in players))

    return statistic


def _draw_heavier(frame):
    """Draws a panel for each kind of observation."""
    accuracies = frame.attrs["ideal"]
    kinds = [kind for kind in conditions.OBSERVATIONS if (frame.task == kind).any()]
    figure, panels = plots.new(columns=len(kinds), sharey=True, squeeze=False)
    for axes, kind in zip(panels[0], kinds, strict=True):
        by_name = frame[frame.task == kind].groupby("condition", sort=False)
        lines = {f"β = {name.partition('-')[0]}": curves.better_half(rows) for name, rows in by_name}
        curves.draw_panel(axes, lines, conditions.HEAVIER[0].chance)
        plots.reference(axes, max(accuracies), f"ideal: {min(accuracies):.3f} to {max(accuracies):.3f}")
        axes.set(ylim=(0, 1.08), yticks=[0, 0.2, 0.4, 0.6, 0.8, 1], title=f"from {kind}")
        axes.legend(loc="lower right", bbox_to_anchor=(1, 0.3))
    panels[0, 0].set_ylabel("share of right answers")
    return figure


def _draw_towers(frame):
    """Draws a panel for each condition."""
    by_task = dict(list(frame.groupby("task", sort=False)))
    figure, panels = plots.new(columns=len(by_task), width=2.0, height=2.2, sharey=True, squeeze=False)
    for axes, (task, rows) in zip(panels[0], by_task.items(), strict=True):
        curves.draw_panel(axes, {"median": curves.better_half(rows)}, conditions.TOWERS[0].chance)
        axes.set_title(task.replace("_", ", "))
    panels[0, 0].set_ylabel("share of right answers")
    return figure


def _draw_workers(frame):
    """Draws a panel for each condition, in two rows."""
    by_task = dict(list(frame.groupby("condition", sort=False)))
    figure, panels = plots.grid(len(by_task), columns=-(-len(by_task) // 2), width=2.0, height=2.2, sharey=True)
    for axes, (name, rows) in zip(panels.flat, by_task.items(), strict=False):
        players = dict(list(rows.groupby("player")))
        lines = {words: curves.better_half(players[each]) for each, words in _NUMBERS.items() if each in players}
        curves.draw_panel(axes, lines, conditions.BY_LABEL[claims.named(name)].chance)
        axes.set_title(conditions.tick(name).replace(_OWN, "\nthe paper's own learner"))
    for axes in panels[:, 0]:
        axes.set_ylabel("share of right answers")
    panels[0, 0].legend(loc="lower right", bbox_to_anchor=(1, 0.3))
    return figure


def _draw_learners(frame):
    """Draws a row for each task, against frames and against minutes."""
    tasks = [task for task in _TASKS if (frame.condition == task.label).any()]
    figure, panels = plots.new(rows=len(tasks), columns=2, height=2.2, sharey=True, squeeze=False)
    for row, task in zip(panels, tasks, strict=True):
        players = dict(list(frame[frame.condition == task.label].groupby("player")))
        for axes, along in zip(row, curves.AXES, strict=True):
            lines = {_NAMES[name]: curves.better_half(players[name], along) for name in _NAMES if name in players}
            curves.draw_panel(axes, lines, task.chance, along)
        row[0].set(title=conditions.spelled_out(task.label), ylabel="share of right answers")
        row[0].legend(loc="lower right", bbox_to_anchor=(1, 0.3))
    return figure


EXPERIMENTS = {
    "learning_heavier": base.Experiment(
        **claims.described("learning_heavier"),
        conditions=conditions.HEAVIER,
        load=load_heavier,
        statistics={"trained": _mean_success, "not_perfect": _mean_success, "harder_is_lower": _ratio_of_success},
        draw=_draw_heavier,
    ),
    "learning_towers": base.Experiment(
        **claims.described("learning_towers"),
        conditions=conditions.TOWERS,
        load=lambda results: results.curves(conditions.TOWERS),
        statistics={"solved": _mean_success, "fist_is_faster": _fist_over_direct},
        draw=_draw_towers,
    ),
    "learners": base.Experiment(
        **claims.described("learners"),
        conditions=LEARNERS,
        load=lambda results: results.curves(LEARNERS),
        statistics={
            "fewer_steps": _between(_NAMES, ratio_of_steps),
            "less_time": _between(_NAMES, functools.partial(ratio_of_steps, along="seconds")),
        },
        draw=_draw_learners,
    ),
    "workers": base.Experiment(
        **claims.described("workers"),
        conditions=WORKERS,
        load=lambda results: with_own_apart(results.curves(WORKERS)),
        statistics={
            "as_many_steps": _between(_NUMBERS, ratio_of_steps),
            "as_right": _between(_NUMBERS, _ratio_of_ends),
        },
        draw=_draw_workers,
    ),
}
