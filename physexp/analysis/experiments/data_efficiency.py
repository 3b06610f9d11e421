"""Data efficiency: from how many environment steps, and in how many minutes, learners come near the optimum. Ours."""

from typing import Any

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, ideal_towers, learning, scores

LEARNERS = {
    "a3c": "A3C",
    "ppo": "PPO",
    "belief": "belief",
    "belief_revealed": "belief, answers revealed",
    "a3c_paper": "the paper's own",
}
"""The learners by their titles, in words."""

CONDITIONS = (
    *conditions.with_each_learner(scores.TASKS),
    conditions.with_papers_learner(conditions.BY_LABEL["10-F"]),  # Where answers are learned the soonest.
)

MOST_FRAMES = {
    "belief": {
        "3-F": 80_000,
        "5-F": 30_000,
        "10-F": 15_000,
        "3-P": 200_000,
        "5-P": 60_000,
        "10-P": 20_000,
        "D-F": 60_000,
        "F-F": 30_000,
        "D-P": 40_000,
        "F-P": 50_000,
    },
    "belief_revealed": {
        "3-F": 60_000,
        "5-F": 25_000,
        "10-F": 12_000,
        "3-P": 100_000,
        "5-P": 40_000,
        "10-P": 12_000,
        "D-F": 40_000,
        "F-F": 25_000,
        "D-P": 25_000,
        "F-P": 30_000,
    },
}
"""Environment steps that an agent is to need at most to reach `scores.LEVEL`; written down before any was trained."""

MOST_SECONDS = 300.0  # The same for the time of agents from features, with one core each.
LEAST_SHARE = {
    **{"3-F": 0.985, "5-F": 0.985, "10-F": 0.985, "D-F": 0.98, "F-F": 0.98},
    **{"3-P": 0.95, "5-P": 0.97, "10-P": 0.97, "D-P": 0.97, "F-P": 0.97},
}
"""Shares of the ideal's return that agents are to earn at the end of training, at least; from before, too."""
LEAST_OF_THE_WORST = 0.95  # Of agents from features.
MOST_CALIBRATION_ERROR = 0.03  # The same.
_CLAIMS = {
    "belief": "The belief learner learns from few environment steps, from the reward alone",
    "belief_revealed": "The belief learner learns from few environment steps, with answers revealed",
}


def load(results: base.Results):
    """Learning curves of all learners, see `scores.load`; the attribute `final` has what `scores.final` returns."""
    frame = scores.load(results, CONDITIONS)
    frame.attrs["final"] = scores.final(results, CONDITIONS)
    return frame


def find_claims(frame) -> list[claims.Claim]:
    """The belief learner needs few frames, few minutes, and fewer frames than A3C; and it ends near the optimum."""
    found = []
    for label in frame.condition.unique():
        for learner in _CLAIMS:
            if runs := scores.runs(frame, label, learner):
                found += _while_learning(runs, label, learner)
            final = frame.attrs["final"]
            agents = final[(final.condition == label) & (final.algorithm == learner)]
            if len(agents):
                found += _at_the_end(agents, label, learner)
        found += _compared(frame, label)
    for kind in conditions.OBSERVATIONS:
        labels = [conditions.label("towers", f"{actuator}_{kind}") for actuator in ("fist", "direct")]
        found += scores.fewer_frames(
            *(scores.runs(frame, label, "belief") for label in labels),
            text="The fist leads to faster learning than direct actuation where agents are told nothing",
            condition=kind,
            statistic=f"environment steps to {scores.level(labels[0])}, belief learner, fist over direct, "
            "ratio of geometric means",
            reason="The fist must first find the tower and travel to it, and every push touches it: reaching tests "
            "whether that is why.",
        )
    return found


# The claims below are of medians where ten agents are trained, and of means where five are: no interval of the order of
# five values has a level that is left after the correction.


def _while_learning(runs, label: str, learner: str) -> list[claims.Claim]:
    level = scores.level(label)
    from_pixels = scores.sees_pixels(label)
    found = [
        claims.Claim(
            text=_CLAIMS[learner],
            condition=label,
            statistic=f"environment steps to {level}, {'geometric mean' if from_pixels else 'median'}",
            estimate=(estimates.geometric_mean if from_pixels else estimates.median)(scores.reached(runs, "frames")),
            below=MOST_FRAMES[learner][label] + 1,
        )
    ]
    if from_pixels:
        return found
    errors = [run.sort_values("frames").calibration_error.iloc[-1] for run in runs]
    return [
        *found,
        claims.Claim(
            text="The belief learner learns in minutes on one core",
            condition=label,
            statistic=f"seconds to {level}, {LEARNERS[learner]}, median",
            estimate=estimates.median(scores.reached(runs, "seconds")),
            below=MOST_SECONDS,
        ),
        claims.Claim(
            text="The belief learner is as often right as it believes",
            condition=label,
            statistic=f"expected calibration error of the last 1024 greedy answers, {LEARNERS[learner]}, median",
            estimate=estimates.median(errors),
            below=MOST_CALIBRATION_ERROR,
        ),
    ]


def _at_the_end(agents, label: str, learner: str) -> list[claims.Claim]:
    word, middle = scores.middle(label)
    found = [
        claims.Claim(
            text="The belief learner comes near the optimum",
            condition=label,
            statistic=f"share of the ideal's return, {LEARNERS[learner]}, {word}",
            estimate=middle(agents.share),
            above=LEAST_SHARE[label],
        )
    ]
    if not scores.sees_pixels(label):
        worst = agents.loc[agents.share.idxmin()]
        found.append(
            claims.Claim(
                text="No agent of the belief learner is far from the optimum",
                condition=label,
                statistic=f"share of the ideal's return, {LEARNERS[learner]}, the worst; interval: of its episodes",
                estimate=estimates.normal(worst.share, worst.error),
                above=LEAST_OF_THE_WORST,
            )
        )
    return found


def _compared(frame, label: str) -> list[claims.Claim]:
    """Compares learners that are told the reward alone."""
    found = []
    for quick, slow, text in (
        ("belief", "a3c", "The belief learner learns from fewer environment steps than A3C"),
        ("a3c", "a3c_paper", "Many episodes an update and scaled observations save A3C environment steps"),
    ):
        found += scores.fewer_frames(
            *(scores.runs(frame, label, learner) for learner in (quick, slow)),
            text=text,
            condition=label,
            statistic=f"environment steps to {scores.level(label)}, {LEARNERS[quick]} over {LEARNERS[slow]}, "
            "ratio of geometric means",
        )
    return found


def draw(frame):
    """A row for each task, features at the left and pixels at the right, each against frames and against minutes."""
    shown = [task for task in scores.TASKS if (frame.condition == task.label).any()]
    kinds = [kind for kind in conditions.OBSERVATIONS if kind in map(conditions.observations, shown)]
    rows = list(dict.fromkeys(map(_without_kind, shown)))
    figure, panels = plots.new(
        rows=len(rows), columns=2 * len(kinds), width=2.0, height=1.5, sharex="col", sharey=True, squeeze=False
    )
    for axes in panels.flat:
        axes.set_axis_off()
    handles: dict[str, Any] = {}
    lowest: dict[int, Any] = {}  # Of each column.
    for task in shown:
        row, column = rows.index(_without_kind(task)), 2 * kinds.index(conditions.observations(task))
        for place, along in enumerate(learning.AXES, column):
            axes = lowest[place] = panels[row, place]
            axes.set_axis_on()
            for number, (learner, words) in enumerate(LEARNERS.items()):
                if runs := scores.runs(frame, task.label, learner):
                    learning.draw_range(axes, runs, number, words, along, "score")
            plots.reference(axes, scores.LEVEL, "")
            axes.set(xscale="log", ylim=(scores.FLOOR, 1.05))
            handles |= dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
        score = "right answers" if scores.sees_pixels(task.label) else "share of the ideal"
        panels[row, column].set(title=conditions.spelled_out(task.label), ylabel=score)
    for place, axes in lowest.items():
        axes.set(xlabel=list(learning.AXES.values())[place % 2][1])
        axes.tick_params(labelbottom=True)
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=len(handles))
    return figure


def _without_kind(task) -> str:
    return task.label.split("-")[0]


EXPERIMENT = base.Experiment(
    name="data_efficiency",
    title="Learning from few frames",
    section=claims.OURS,
    caption="How well agents play while they learn, against environment steps and against time (on several "
    "machines, not all equally fast, with other agents beside), averaged over the last 2000 episodes. Belief: the "
    "quarter of the episodes that are played greedily; A3C and PPO: all, with drawn actions. Light: from the worst "
    "agent to the best; dark: their median. With answers revealed the learner is told more than the others, who know "
    "the reward alone. The paper's own: A3C with one episode an update, raw observations and no hint.",
    conditions=CONDITIONS,
    trials=(base.EVALUATION,),
    prepare=ideal_towers.prepare,
    load=load,
    claims=find_claims,
    draw=draw,
)
