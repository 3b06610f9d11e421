"""Success in training: Which is Heavier (paper, Section 5.3; Figure 2), Towers (6.3; Figure 6), and A3C against PPO."""

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves

_END = 0.05  # The share of training that is its end.
_LEARNED = 0.9  # The success at which the speed of learning is compared.

LEARNERS_TASKS = {label: conditions.BY_LABEL[label] for label in ("5-F", "F-F")}
LEARNERS = tuple(config for task in LEARNERS_TASKS.values() for config in (task, conditions.with_ppo(task)))
_NAMES = {"ppo": "PPO", "a3c": "A3C"}


def load_learners(results: base.Results):
    """Returns learning curves of both learners; a condition is named by task and learner, as `5-F PPO`."""
    frame = results.curves(LEARNERS)
    return frame.assign(condition=frame.condition + " " + frame.algorithm.map(_NAMES))


def final_success(frame, condition: str):
    """Returns the share of right answers at the end of training, of each agent of a condition."""
    rows = frame[frame.condition == condition]
    ends = rows.groupby("training_seed").frames.transform("max")
    return rows[rows.frames >= (1 - _END) * ends].groupby("training_seed").success_rate.mean()


def _mean_success(frame, condition: str) -> estimates.Estimate | None:
    success = final_success(frame, condition)
    return estimates.mean_share(success) if len(success) else None


def _ratio_of_success(frame, condition: str) -> estimates.Estimate | None:
    easier, harder = (final_success(frame, name) for name in condition.split(" against "))
    return estimates.ratio_of_means(easier, harder) if len(easier) and len(harder) else None


def ratio_of_steps(frame, quick: str, slow: str, along: str = "frames") -> estimates.Estimate | None:
    """Returns the ratio of the training until `_LEARNED` of two conditions, within the shortest training of all agents.

    An agent that never reaches it counts as one that reaches it at the end of that training.
    """
    groups = [curves.runs(frame[frame.condition == name]) for name in (quick, slow)]
    if not all(groups):
        return None
    shortest = min(run[along].max() for group in groups for run in group)
    return estimates.ratio_of_means(
        *([min(curves.first_reached(run, _LEARNED, along), shortest) for run in group] for group in groups)
    )


def _fist_over_direct(frame, kind: str) -> estimates.Estimate | None:
    return ratio_of_steps(frame, *(conditions.label("towers", f"{actuator}_{kind}") for actuator in ("fist", "direct")))


def _ppo_over_a3c(along: str) -> claims.Statistic:
    return lambda frame, task: ratio_of_steps(frame, f"{task} PPO", f"{task} A3C", along)


def _draw_heavier(frame):
    """Draws a panel for each kind of observation."""
    lines = curves.better_half(frame)
    accuracies = [conditions.heavier_ideal(beta).figures()["accuracy"] for beta in conditions.DIFFICULTIES]
    kinds = [kind for kind in conditions.OBSERVATIONS if (frame.task == kind).any()]
    figure, panels = plots.new(columns=len(kinds), sharey=True, squeeze=False)
    for axes, kind in zip(panels[0], kinds, strict=True):
        labels = {each.label: f"β = {each.task_kwargs['difficulty']:g}" for each in conditions.HEAVIER}
        labels = {name: label for name, label in labels.items() if name.endswith(kind[0].upper())}
        curves.draw_panel(axes, lines, labels, conditions.chance("which_is_heavier", kind))
        plots.reference(axes, max(accuracies), f"ideal: {min(accuracies):.3f} to {max(accuracies):.3f}")
        axes.set(ylim=(0, 1.08), yticks=[0, 0.2, 0.4, 0.6, 0.8, 1], title=f"from {kind}")
        axes.legend(loc="lower right", bbox_to_anchor=(1, 0.3))
    panels[0, 0].set_ylabel("share of right answers")
    return figure


def _draw_towers(frame):
    """Draws a panel for each condition."""
    lines = curves.better_half(frame)
    tasks = [each for each in conditions.TOWERS if each.label in lines]
    figure, panels = plots.new(columns=len(tasks), width=2.0, height=2.2, sharey=True, squeeze=False)
    for axes, each in zip(panels[0], tasks, strict=True):
        curves.draw_panel(axes, lines, {each.label: "median"}, conditions.chance("towers", each.task))
        axes.set_title(each.task.replace("_", ", "))
    panels[0, 0].set_ylabel("share of right answers")
    return figure


def _draw_learners(frame):
    """Draws a row for each task, against frames and against minutes."""
    tasks = [label for label in LEARNERS_TASKS if frame.condition.str.startswith(label).any()]
    figure, panels = plots.new(rows=len(tasks), columns=2, height=2.2, sharey=True, squeeze=False)
    for column, along in enumerate(curves.AXES):
        lines = curves.better_half(frame, along)
        for axes, label in zip(panels[:, column], tasks, strict=True):
            chance = conditions.chance(LEARNERS_TASKS[label].domain, LEARNERS_TASKS[label].task)
            labels = {f"{label} {name}": name for name in _NAMES.values()}
            curves.draw_panel(axes, lines, labels, chance, along)
    for axes, label in zip(panels[:, 0], tasks, strict=True):
        axes.set(title=conditions.spelled_out(label), ylabel="share of right answers")
        axes.legend(loc="lower right", bbox_to_anchor=(1, 0.3))
    return figure


EXPERIMENTS = {
    "learning_heavier": base.Experiment(
        **claims.described("learning_heavier"),
        conditions=conditions.HEAVIER,
        load=lambda results: results.curves(conditions.HEAVIER),
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
        load=load_learners,
        statistics={"fewer_steps": _ppo_over_a3c("frames"), "less_time": _ppo_over_a3c("seconds")},
        draw=_draw_learners,
    ),
}
