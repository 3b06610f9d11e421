"""The laboratory: the return of each learner in every domain, as a share of the ideal's. Ours."""

from collections.abc import Callable
import itertools

import numpy as np
import pandas

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, efficiency

TASKS = (*(conditions.BY_LABEL[label] for label in ("5-F", "D-F", "F-F")), *conditions.OTHERS)
LEARNERS = {
    "a3c": "A3C",
    "ppo": "PPO",
    "belief": "belief",
    "belief_revealed": "belief,\nrevealed",
    "belief_foresight": "foresight",
    "belief_revealed_foresight": "foresight,\nrevealed",
}
"""Learners by title; the revealed ones are told the right answer after each episode, the others their reward alone."""

CONDITIONS = (*conditions.with_each_learner(TASKS), *itertools.chain(*map(conditions.with_foresight, TASKS)))
_FLOOR = -0.1  # Of the figure; smaller shares are drawn there.
_STORED = "ideal/laboratory"
_UNTRAINED = ["value", "at_once", "random_value"]


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Computes the returns without learning in each domain that is not there yet; `report` is told their names."""
    found = results.made(_STORED, {})
    for task in TASKS:
        if task.label not in found:
            report(f"searching for the ideal experimenter of {task.task_name}")
            summary = task.ideal().summary()
            found[task.label] = {name: summary[name] for name in _UNTRAINED}
            results.keep(_STORED, found)


def untrained(results: base.Results) -> dict[str, dict[str, float]]:
    """Returns the stored returns without learning, by task; raises ValueError if some are not there."""
    found = results.made(_STORED)
    if missing := [task.label for task in TASKS if task.label not in found]:
        raise results.lacks(f"ideal of {', '.join(missing)}")
    return found


def load(results: base.Results):
    """Returns a row for each agent that has been trained and evaluated: see `efficiency.evaluated`.

    With the `frames` and `minutes` of its training, and the returns in its task of the ideal, `value`, of an answer
    `at_once`, and of random interactions, `random_value`.
    """
    found = untrained(results)
    frame = efficiency.evaluated(results, CONDITIONS, lambda task: found[task.label]["value"])
    runs = results.curves(CONDITIONS).groupby(["condition", "player", "training_seed"])[["frames", "seconds"]].max()
    frame = frame.merge(runs.assign(minutes=runs.seconds / 60).reset_index())
    return frame.join(pandas.DataFrame.from_dict(found, "index", columns=_UNTRAINED), on="condition")


def _share(player: str) -> claims.Statistic:
    return claims.of_rows(lambda agents: estimates.mean(claims.rows(agents, player=player).share))


def table(frame) -> list[tuple[str, ...]]:
    """Returns a header and a row for each domain: the mean share of each learner, and its training."""
    header = ("task", "ideal's return", "answer at once", "random interactions", *LEARNERS.values())
    rows = [tuple(name.replace("\n", " ") for name in header)]
    for label, agents in frame.groupby("condition", sort=False):
        value, *others = agents[_UNTRAINED].iloc[0]
        shares = (f"{other / value:.2f}" for other in others)
        cells = (_cell(agents[agents.player == learner]) for learner in LEARNERS)
        rows.append((title(label), f"{value:.4f}", *shares, *cells))
    return rows


def _cell(agents) -> str:
    """Returns the mean share, frames and minutes in words; nothing without agents."""
    if not len(agents):
        return ""
    count, (share, frames, minutes) = len(agents), agents[["share", "frames", "minutes"]].mean()
    noun = "agent" if count == 1 else "agents"
    return f"{share:.3f} ({count} {noun}, {frames / 1000:,.0f} K steps, {minutes:.1f} min)"


def draw(frame):
    """Draws a panel for each domain: every agent's share of the ideal's return, and that of random interactions."""
    by_task = dict(list(frame.groupby("condition", sort=False)))
    figure, panels = plots.grid(
        len(by_task), columns=min(5, len(by_task)), width=1.9, height=2.0, sharex=True, sharey=True
    )
    for axes, (label, agents) in zip(panels.flat, by_task.items(), strict=False):
        value, _, random_value = agents[_UNTRAINED].iloc[0]
        plots.reference(axes, 1.0, "")
        axes.axhline(max(_FLOOR, random_value / value), color="0.85", linewidth=3, zorder=-1)
        for number, learner in enumerate(LEARNERS):
            _draw_shares(axes, number, agents.share[agents.player == learner].clip(lower=_FLOOR))
        axes.set(title=title(label), ylim=(_FLOOR - 0.03, 1.08), xlim=(-0.5, len(LEARNERS) - 0.5))
        axes.set_xticks(range(len(LEARNERS)), list(LEARNERS.values()), rotation=90)
    for axes in panels[:, 0]:
        axes.set_ylabel("share of the ideal's return")
    for axes in panels[-1]:
        axes.set_xlabel("learner")
    lines = [*panels[0, 0].lines[:2]]  # Of the ideal and of random interactions, in every panel.
    figure.legend(lines, ["ideal", "random interactions"], loc="outside lower center", ncols=2)
    return figure


def _draw_shares(axes, number: int, shares) -> None:
    """Draws the agents of a learner beside each other, and their mean."""
    if len(shares):
        spread = np.linspace(-0.15, 0.15, len(shares)) if len(shares) > 1 else 0.0
        color, marker = plots.COLORS[number], plots.MARKERS[number]
        axes.plot(number + spread, shares, marker, color=color, markersize=3, alpha=0.7)
        axes.plot([number - 0.3, number + 0.3], [shares.mean()] * 2, color=color, linewidth=1.6)


def title(label: str) -> str:
    """Returns a task's name in words, without the observations, as `towers direct`."""
    (name,) = (task.task_name for task in TASKS if task.label == label)
    return name.replace("/", "_").removesuffix("_features").replace("_", " ")


EXPERIMENTS = {
    "laboratory": base.Experiment(
        **claims.described("laboratory"),
        conditions=CONDITIONS,
        trials=(base.EVALUATION,),
        prepare=prepare,
        load=load,
        statistics={learner: _share(learner) for learner in LEARNERS},
        draw=draw,
        table=table,
    )
}
