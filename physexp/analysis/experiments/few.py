"""Few steps: how soon one configuration of the belief learner comes near the optimum in every domain. Ours."""

from typing import Any

import numpy as np
import pandas

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves, laboratory

TARGETS = (0.5, 0.8, 0.9, 0.95, 0.99)
"""Shares of the ideal's return."""
FEW = 20_000
"""Environment steps."""

LEARNERS = {"belief_foresight": "with foresight", "belief": "without"}
"""Learners by title."""

CONDITIONS = tuple(
    condition
    for task in laboratory.TASKS
    for condition in (conditions.with_foresight(task)[0], conditions.with_belief(task))
)


def load(results: base.Results):
    """Returns a row for each agent and target: the `steps` until its greedy episodes reach it; infinity if they do not.

    With the `condition`, the `player`, the `training_seed` and the `target`.
    """
    values = {label: its["value"] for label, its in laboratory.untrained(results).items()}
    frame = results.curves(CONDITIONS)
    frame = frame.assign(share=frame.greedy_return / frame.condition.map(values))
    return pandas.DataFrame(
        {"condition": condition, "player": player, "training_seed": seed, "target": target}
        | {"steps": curves.first_reached(run, target, of="share")}
        for (condition, player, seed), run in frame.groupby(["condition", "player", "training_seed"], sort=False)
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


def _soon(player: str) -> claims.Statistic:
    def share(agents: Any) -> estimates.Estimate:
        reached = claims.rows(agents, player=player)
        return estimates.mean((reached.steps <= FEW).groupby(reached.training_seed).mean())

    return claims.of_rows(share)


def draw(frame):
    """Draws the share of pairs reached against steps: of all targets, with foresight and without, and of each."""
    figure, axes = plots.new(width=4.6, height=3.0)
    by_learner = dict(list(frame.groupby("player")))
    with_foresight = by_learner[next(iter(LEARNERS))]
    groups = {f"{target:.0%} of the ideal's return": rows for target, rows in with_foresight.groupby("target")}
    for number, (name, rows) in enumerate(groups.items()):
        axes.step(*shares(rows), where="post", color=plots.COLORS[number + 1], linewidth=1.0, label=name)
    for (player, name), style in zip(LEARNERS.items(), ("-", ":"), strict=True):
        label = f"all targets, {name}"
        axes.step(*shares(by_learner[player]), style, where="post", color="black", linewidth=2.2, label=label)
    axes.axvline(FEW, color="0.8", zorder=-1)
    axes.set(xscale="log", ylim=(0, 1.02), xlabel="environment steps", ylabel="share of tasks and targets reached")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def table(frame) -> list[tuple[str, ...]]:
    """Returns a header and two rows for each task: the median steps of its agents to each target."""
    rows = [("task", "foresight", "agents", *(f"steps to {target:.0%}" for target in TARGETS))]
    for (condition, player), agents in frame.groupby(["condition", "player"], sort=False):
        medians = agents.groupby("target").steps.median()
        cells = (f"{steps:,.0f}" if np.isfinite(steps) else "not reached" for steps in medians)
        name = LEARNERS[player].removesuffix(" foresight")
        rows.append((laboratory.title(condition), name, str(agents.training_seed.nunique()), *cells))
    return rows


EXPERIMENTS = {
    "few": base.Experiment(
        **claims.described("few"),
        conditions=CONDITIONS,
        prepare=laboratory.prepare,
        load=load,
        statistics={"soon": _soon("belief_foresight"), "soon_without": _soon("belief")},
        draw=draw,
        table=table,
    )
}
