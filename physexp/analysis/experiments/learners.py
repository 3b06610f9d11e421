"""Two learners on the same network: A3C, the paper's, and PPO. Ours: the paper has one."""

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, learning

_NAMES = {"ppo": "PPO", "a3c": "A3C"}
_LEARNED = 0.9  # The success whose first moment is compared.
_CLAIMS = {
    "frames": ("PPO learns from fewer environment steps than A3C", "environment steps"),
    "seconds": ("PPO learns in less time than A3C", "seconds"),
}
_REASON = (
    "A3C takes one gradient from an episode, PPO sixteen or eight; where simulation is cheap, as in Which is "
    "Heavier, A3C makes up in time for what it needs in frames."
)


_TASKS = {label: conditions.BY_LABEL[label] for label in ("5-F", "F-F")}
CONDITIONS = tuple(config for task in _TASKS.values() for config in (task, conditions.with_ppo(task)))


def load(results: base.Results):
    """Learning curves of both, `condition` being the task's, as `5-F`, and the learner's name."""
    frame = results.curves(CONDITIONS)
    return frame.assign(condition=frame.condition + " " + frame.algorithm.map(_NAMES))


def _curve_names(task: str) -> list[str]:
    """What `load` calls the curves of a task, in the order of `_NAMES`."""
    return [f"{task} {name}" for name in _NAMES.values()]


def find_claims(frame) -> list[claims.Claim]:
    """PPO learns from less, and takes no longer."""
    found = []
    for along, (text, unit) in _CLAIMS.items():
        for task in _TASKS:
            ppo, a3c = learning.compare_first_reached(frame, _curve_names(task), _LEARNED, along)
            if len(ppo) and len(a3c):
                found.append(
                    claims.Claim(
                        text=text,
                        condition=task,
                        statistic=f"{unit} to {_LEARNED:.0%} right answers, PPO over A3C, ratio of geometric means",
                        estimate=estimates.ratio_of_means(ppo, a3c),
                        below=1,
                        reason=_REASON,
                    )
                )
    return found


def draw(frame):
    """A row for each task, against frames and against minutes."""
    tasks = [task for task in _TASKS if frame.condition.str.startswith(task).any()]
    curves = {along: learning.smoothed(frame, along) for along in learning.AXES}
    figure, panels = plots.new(rows=len(tasks), columns=2, height=2.2, sharey=True, squeeze=False)
    for row, task in zip(panels, tasks, strict=True):
        chance = conditions.chance(_TASKS[task].domain, _TASKS[task].task)
        for axes, along in zip(row, learning.AXES, strict=True):
            learning.draw_panel(axes, curves[along], _curve_names(task), list(_NAMES.values()), chance, along)
        row[0].set(title=conditions.spelled_out(task), ylabel="share of right answers")
        row[0].legend(loc="lower right", bbox_to_anchor=(1, 0.3))
    return figure


EXPERIMENT = base.Experiment(
    name="learners",
    title="A3C and PPO",
    section=claims.OURS,
    caption="Share of right answers in training of the paper's learner and of PPO, on the same network and the same "
    "environments, against environment steps and against time (on several machines, not all equally fast, with "
    "other agents beside). Light lines: the better half of the agents; dark: their median.",
    conditions=CONDITIONS,
    load=load,
    claims=find_claims,
    draw=draw,
)
