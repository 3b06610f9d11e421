"""Few steps: how soon a configuration of the belief learner comes near the optimum in every domain. Ours."""

import numpy as np
import pandas

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves, laboratory

TARGETS = (0.5, 0.8, 0.9, 0.95, 0.99)
"""Shares of the ideal's return."""
FEW = 20_000
"""Environment steps."""

LEARNERS = {"belief": "belief", "belief_foresight": "belief, with foresight"}
"""Configurations by title; both learn from the reward alone."""

CONDITIONS = tuple(
    condition
    for task in laboratory.TASKS
    for condition in (conditions.with_belief(task), conditions.with_foresight(task)[0])
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


def draw(frame):
    """Draws the share of pairs reached against steps, of all targets and of each: a panel for each configuration."""
    by_player = dict(list(frame.groupby("player", sort=False)))
    figure, panels = plots.new(columns=len(by_player), width=3.2, height=2.8, sharex=True, sharey=True, squeeze=False)
    for axes, (player, rows) in zip(panels[0], by_player.items(), strict=True):
        for number, (target, reached) in enumerate(rows.groupby("target"), 1):
            label = f"{target:.0%} of the ideal's return"
            axes.step(*shares(reached), where="post", color=plots.COLORS[number], linewidth=1.0, label=label)
        axes.step(*shares(rows), where="post", color="black", linewidth=2.2, label="all targets")
        axes.set(xscale="log", ylim=(0, 1.02), xlabel="environment steps", title=LEARNERS[player])
    panels[0, 0].set_ylabel("share of tasks and targets reached")
    panels[0, -1].legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def table(frame) -> list[tuple[str, ...]]:
    """Returns a header and a row for each task and configuration: the median steps of its agents to each target."""
    rows = [("task", "learner", "agents", *(f"steps to {target:.0%}" for target in TARGETS))]
    for (condition, player), agents in frame.groupby(["condition", "player"], sort=False):
        medians = agents.groupby("target").steps.median()
        cells = (f"{steps:,.0f}" if np.isfinite(steps) else "not reached" for steps in medians)
        rows.append((laboratory.title(condition), LEARNERS[player], str(agents.training_seed.nunique()), *cells))
    return rows


def _soon(player: str) -> claims.Statistic:
    """Returns the statistic of the share of targets that are reached within `FEW` steps."""

    def share(rows) -> estimates.Estimate:
        rows = claims.rows(rows, player=player)
        return estimates.mean((rows.steps <= FEW).groupby(rows.training_seed).mean())

    return claims.of_rows(share)


EXPERIMENTS = {
    "few": base.Experiment(
        **claims.described("few"),
        conditions=CONDITIONS,
        prepare=laboratory.prepare,
        load=load,
        statistics={"soon": _soon("belief"), "soon_foreseeing": _soon("belief_foresight")},
        draw=draw,
        table=table,
    )
}
