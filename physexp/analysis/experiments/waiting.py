"""Waiting for information (paper, Section 6.3; right of Figure 5): the same agent in slower and slower time."""

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions

CONTROL_TIMESTEPS = tuple(round(0.01 * number, 2) for number in range(1, 11))  # s; the last is that of training
CONDITIONS = tuple(conditions.towers("fist", kind) for kind in conditions.OBSERVATIONS)
TRIALS = tuple(
    base.Trial(name=f"timestep{timestep:g}", num_steps=10_000, task_kwargs={"control_timestep": timestep})
    for timestep in CONTROL_TIMESTEPS
)
_FINEST, _TRAINED = CONTROL_TIMESTEPS[0], CONTROL_TIMESTEPS[-1]


def per_agent(frame):
    """For each condition, agent and control step: accuracy, median time to the answer (s) and median interactions."""
    keys = ["condition", "training_seed", "control_timestep"]
    frame = frame.assign(control_timestep=frame.control_timestep.round(3), right=frame.reward > 0)
    grouped = frame.groupby(keys, sort=False)
    return grouped.agg(
        accuracy=("right", "mean"), time=("time", "median"), interactions=("interactions", "median")
    ).reset_index()


def find_claims(frame) -> list[claims.Claim]:
    """In finer time, the answer comes after as many seconds and many more steps, and is nearly as good."""
    agents = per_agent(frame)
    found = []
    for condition in agents.condition.unique():
        fine, trained = (
            agents[(agents.condition == condition) & (agents.control_timestep == step)].set_index("training_seed")
            for step in (_FINEST, _TRAINED)
        )
        common = dict(section="6.3", condition=condition)
        found.append(
            claims.Claim(
                **common,
                text="With smaller control steps the time to answer stays about the same",
                statistic=f"median time to the answer, control steps of {_FINEST:g} s over {_TRAINED:g} s, mean ratio",
                estimate=estimates.ratio_of_pairs(*fine.time.align(trained.time, join="inner")),
                above=0.67,
                below=1.5,
                words="approximate the same amount of real time",
                reason="Agents with control steps of a tenth answer after more steps, but not after ten times as many. "
                "timing tests agents who know control steps of many lengths.",
            )
        )
        found.append(
            claims.Claim(
                **common,
                text="Agents wait for information, not for a number of steps",
                statistic=f"median steps to the answer, control steps of {_FINEST:g} s over {_TRAINED:g} s, mean "
                "ratio; 1 for a number of steps, 10 for a time",
                estimate=estimates.ratio_of_pairs(*fine.interactions.align(trained.interactions, join="inner")),
                above=5,
                words="waiting a fixed amount of steps",
            )
        )
        worst = agents[agents.condition == condition].groupby("training_seed").accuracy.min()
        silent = (frame[frame.condition == condition].label < 0).groupby(frame.training_seed).mean()
        found.append(
            claims.Claim(
                **common,
                text="Accuracy drops little with the control step",
                statistic=f"share of right answers at the worst control step over that at {_TRAINED:g} s, mean ratio",
                estimate=estimates.ratio_of_pairs(*worst.align(trained.accuracy, join="inner")),
                above=0.9,
                words="a small drop",
                reason="Agents have learned how towers move in the control steps of training: from pixels they are "
                "right more often where a frame falls on the time at which they answer in training, as is tested "
                "below. Towers that vary do not prevent that (generalization), control steps that vary do (timing).",
            )
        )
        found.append(
            claims.Claim(
                **common,
                text="No test episode ends by timeout",
                statistic="share of episodes without an answer, mean of agents",
                estimate=estimates.mean_share(silent),
                below=0.001,
                words="none of the test episodes terminate by timeout",
            )
        )
        found.append(
            claims.Claim(
                condition=condition,
                text="In finer time agents are right more often where a frame falls on the time of their answers in "
                "training",
                statistic="share of right answers at control steps of which the median time to the answer in training "
                "is a multiple, less that at the others, mean of agents; found in these data",
                estimate=estimates.mean(_on_time(agents[agents.condition == condition])),
                above=0.03,
                reason="It is so from pixels. From features, the finer time is, the earlier agents answer, and nine "
                "in ten of their wrong answers count too many bodies.",
            )
        )
    return found


def _on_time(agents) -> np.ndarray:
    """What accuracy gains in finer time where a step ends at the time of the answers in training, for each agent."""
    gains = []
    for _, rows in agents.groupby("training_seed"):
        is_trained = rows.control_timestep == _TRAINED
        steps = rows.time[is_trained].iloc[0] / rows.control_timestep
        is_whole = np.abs(steps - steps.round()) < 1e-3
        gains.append(rows.accuracy[is_whole & ~is_trained].mean() - rows.accuracy[~is_whole].mean())
    return np.array(gains)


def draw(frame):
    """Above, accuracy against the control step; below, the median time to the answer, of one agent."""
    agents = per_agent(frame)
    names = list(agents.condition.unique())
    figure, panels = plots.new(
        columns=len(names), rows=2, width=3.0, height=1.9, sharex=True, sharey="row", squeeze=False
    )
    for (above, below), name in zip(panels.T, names, strict=True):
        accuracy = agents[agents.condition == name].groupby("control_timestep").accuracy
        above.plot(accuracy.median(), color=plots.COLORS[1], marker="o", markersize=3)
        above.fill_between(
            accuracy.median().index, accuracy.min(), accuracy.max(), color=plots.COLORS[1], alpha=0.15, linewidth=0
        )
        plots.reference(above, conditions.chance("towers", CONDITIONS[0].task), "chance")
        above.set(title=conditions.spelled_out(name), ylim=(0, 1.05))
        _draw_times(below, frame[frame.condition == name])
        below.set_xlabel("control step, s")
    panels[0, 0].set_ylabel("share of right answers")
    panels[1, 0].set(ylabel="median time to answer, s", ylim=(0, None))
    return figure


def _draw_times(axes, rows) -> None:
    rows = rows.assign(step=rows.control_timestep.round(3))
    one = rows[rows.training_seed == rows.training_seed.min()]
    steps = np.sort(one.step.unique())
    medians = [estimates.median(one.time[one.step == step]) for step in steps]
    middle = np.array([estimate.value for estimate in medians])
    error = [[e.value - e.low for e in medians], [e.high - e.value for e in medians]]
    axes.errorbar(
        steps,
        middle,
        error,
        color=plots.COLORS[2],
        marker="s",
        markersize=3,
        linestyle=plots.DASHES[1],
        capsize=1.5,
    )
    axes.fill_between(steps, middle - steps, middle + steps, color=plots.COLORS[2], alpha=0.15, linewidth=0)


EXPERIMENT = base.Experiment(
    name="waiting",
    title="Waiting for information",
    section="6.3, Figure 5 (right)",
    caption="Fist agents, trained with a control step of 0.1 s, tested with smaller ones for at least 10,000 steps "
    "each. Above: median accuracy of the agents, shaded from the worst to the best. Below: median time to the answer "
    "of one agent (the first seed), with 95 % intervals; shaded: one control step to either side.",
    conditions=CONDITIONS,
    trials=TRIALS,
    load=lambda results: results.episodes(TRIALS, CONDITIONS, ["label", "reward", "interactions", "time"]),
    claims=find_claims,
    draw=draw,
)
