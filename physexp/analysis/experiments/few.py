"""Few steps: how soon one configuration of the belief learner comes near the optimum in every domain. Ours."""

import numpy as np
import pandas

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves, laboratory

TARGETS = (0.5, 0.8, 0.9, 0.95, 0.99)
"""Shares of the ideal's return."""
FEW = 20_000
"""Environment steps."""

CONDITIONS = tuple(map(conditions.with_belief, laboratory.TASKS))


def load(results: base.Results):
    """Returns a row for each agent and target: the `steps` until its greedy episodes reach it; infinity if they do not.

    With the `condition`, the `training_seed` and the `target`.
    """
    values = {label: its["value"] for label, its in laboratory.untrained(results).items()}
    frame = results.curves(CONDITIONS)
    frame = frame.assign(share=frame.greedy_return / frame.condition.map(values))
    return pandas.DataFrame(
        {"condition": condition, "training_seed": seed, "target": target}
        | {"steps": curves.first_reached(run, target, of="share")}
        for (condition, seed), run in frame.groupby(["condition", "training_seed"], sort=False)
        for target in TARGETS
    )


def shares(rows) -> tuple[np.ndarray, np.ndarray]:
    """Returns numbers of steps, in order, and the share of pairs of a task and a target that is reached until then.

    All tasks count alike, however many agents they have.
    """
    rows = rows.sort_values("steps")
    weights = 1 / rows.groupby(["condition", "target"]).steps.transform("size")
    reached = (weights.cumsum() / weights.sum())[np.isfinite(rows.steps)]
    return rows.steps.to_numpy()[: len(reached)], reached.to_numpy()


def draw(frame):
    """Draws the share of pairs reached against steps, of all targets and of each."""
    figure, axes = plots.new(width=4.6, height=3.0)
    groups = {f"{target:.0%} of the ideal's return": rows for target, rows in frame.groupby("target")}
    for number, (name, rows) in enumerate(groups.items()):
        axes.step(*shares(rows), where="post", color=plots.COLORS[number + 1], linewidth=1.0, label=name)
    axes.step(*shares(frame), where="post", color="black", linewidth=2.2, label="all targets")
    axes.set(xscale="log", ylim=(0, 1.02), xlabel="environment steps", ylabel="share of tasks and targets reached")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def table(frame) -> list[tuple[str, ...]]:
    """Returns a header and a row for each task: the median steps of its agents to each target."""
    rows = [("task", "agents", *(f"steps to {target:.0%}" for target in TARGETS))]
    for condition, agents in frame.groupby("condition", sort=False):
        medians = agents.groupby("target").steps.median()
        cells = (f"{steps:,.0f}" if np.isfinite(steps) else "not reached" for steps in medians)
        rows.append((laboratory.title(condition), str(agents.training_seed.nunique()), *cells))
    return rows


EXPERIMENTS = {
    "few": base.Experiment(
        **claims.described("few"),
        conditions=CONDITIONS,
        prepare=laboratory.prepare,
        load=load,
        statistics={"soon": claims.mean_of_agents(lambda rows: rows.steps <= FEW, estimates.mean)},
        draw=draw,
        table=table,
    )
}
