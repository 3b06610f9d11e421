"""The laboratory: the return of each learner in every domain, as a share of the ideal's. Ours."""

from collections.abc import Callable, Mapping
import dataclasses
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, efficiency

TASKS = (*(conditions.BY_LABEL[label] for label in ("5-F", "D-F", "F-F")), *conditions.OTHERS)
LEARNERS = {"a3c": "A3C", "ppo": "PPO", "belief": "belief", "belief_revealed": "belief,\nrevealed"}
"""Learners by title; `belief_revealed` is told the right answer after each episode, the others their reward alone."""

CONDITIONS = conditions.with_each_learner(TASKS)
_FLOOR = -0.1  # Of the figure; smaller shares are drawn there.
_UNTRAINED = ("value", "at_once", "random_value")


@dataclasses.dataclass(frozen=True)
class Earned:
    """Returns of agents and of others.

    Attributes:
      agents: a row for each agent, as `efficiency.evaluated` returns them, with the `frames` and `minutes` of training.
      untrained: the returns of the ideal, of an answer at once and of random interactions, by condition.
    """

    agents: Any
    untrained: Mapping[str, Mapping[str, float]]

    def of(self, label: str, learner: str):
        """Returns the agents of a learner in a condition."""
        return self.agents[(self.agents.condition == label) & (self.agents.algorithm == learner)]


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Computes the returns without learning in each domain that is not there yet; `report` is told their names."""
    path = _path(results)
    found = base.read_made(path, "laboratory") if path.exists() else {}
    for task in TASKS:
        if task.label not in found:
            report(f"searching for the ideal experimenter of {task.task_name}")
            summary = conditions.ideal(task).summary()
            found[task.label] = {name: summary[name] for name in _UNTRAINED}
            base.keep_made(path, found)


def _path(results: base.Results):
    return results.path / "ideal" / "laboratory.json"


def load(results: base.Results) -> Earned:
    """Returns the returns of all agents that have been trained and evaluated."""
    untrained = base.read_made(_path(results), "laboratory")
    if missing := [task.label for task in TASKS if task.label not in untrained]:
        raise ValueError(f"{_path(results)} lacks {', '.join(missing)}; `physexp reproduce laboratory` adds that")
    frame = efficiency.evaluated(results, CONDITIONS, {label: row["value"] for label, row in untrained.items()})
    rows = results.curves(CONDITIONS).groupby(["condition", "algorithm", "training_seed"])
    ends = rows[["frames", "seconds"]].max().reset_index()
    return Earned(frame.merge(ends.assign(minutes=ends.seconds / 60).drop(columns="seconds")), untrained)


def _share(learner: str) -> claims.Statistic:
    def share(earned: Earned, label: str) -> estimates.Estimate | None:
        agents = earned.of(label, learner)
        return estimates.median(agents.share) if len(agents) else None

    return share


def table(earned: Earned) -> list[tuple[str, ...]]:
    """Returns a header and a row for each domain: the median share of each learner, and its training."""
    header = ("task", "ideal's return", "answer at once", "random interactions", *LEARNERS.values())
    rows = [tuple(name.replace("\n", " ") for name in header)]
    for task in TASKS:
        cells = [_cell(earned.of(task.label, learner)) for learner in LEARNERS]
        if any(cells):
            row = earned.untrained[task.label]
            shares = (f"{row[name] / row['value']:.2f}" for name in ("at_once", "random_value"))
            rows.append((_title(task), f"{row['value']:.4f}", *shares, *cells))
    return rows


def _cell(agents) -> str:
    """Returns the median share, frames and minutes in words; nothing without agents."""
    if not len(agents):
        return ""
    count, (share, frames, minutes) = len(agents), agents[["share", "frames", "minutes"]].median()
    noun = "agent" if count == 1 else "agents"
    return f"{share:.3f} ({count} {noun}, {frames / 1000:,.0f} K steps, {minutes:.1f} min)"


def draw(earned: Earned):
    """Draws a panel for each domain: every agent's share of the ideal's return, and that of random interactions."""
    shown = [task for task in TASKS if (earned.agents.condition == task.label).any()]
    num_columns = min(4, len(shown))
    grid: dict[str, Any] = dict(columns=num_columns, rows=-(-len(shown) // num_columns), width=1.9, height=2.0)
    figure, panels = plots.new(**grid, sharex=True, sharey=True, squeeze=False)
    for axes in panels.flat[len(shown) :]:
        axes.set_axis_off()
    for axes, task in zip(panels.flat, shown, strict=False):
        row = earned.untrained[task.label]
        plots.reference(axes, 1.0, "")
        axes.axhline(max(_FLOOR, row["random_value"] / row["value"]), color="0.85", linewidth=3, zorder=-1)
        for number, learner in enumerate(LEARNERS):
            _draw_shares(axes, number, earned.of(task.label, learner).share.clip(lower=_FLOOR))
        axes.set(title=_title(task), ylim=(_FLOOR - 0.03, 1.08), xlim=(-0.5, len(LEARNERS) - 0.5))
        axes.set_xticks(range(len(LEARNERS)), list(LEARNERS.values()), rotation=90)
    for axes in panels[:, 0]:
        axes.set_ylabel("share of the ideal's return")
    for axes in panels[-1]:
        axes.set_xlabel("learner")
    lines = [*panels[0, 0].lines[:2]]  # Of the ideal and of random interactions, in every panel.
    figure.legend(lines, ["ideal", "random interactions"], loc="outside lower center", ncols=2)
    return figure


def _draw_shares(axes, number: int, shares) -> None:
    """Draws the agents of a learner beside each other, and their median."""
    if len(shares):
        spread = np.linspace(-0.15, 0.15, len(shares)) if len(shares) > 1 else 0.0
        color, marker = plots.COLORS[number], plots.MARKERS[number]
        axes.plot(number + spread, shares, marker, color=color, markersize=3, alpha=0.7)
        axes.plot([number - 0.3, number + 0.3], [shares.median()] * 2, color=color, linewidth=1.6)


def _title(task) -> str:
    """Returns a task's name in words, without the observations, as `towers direct`."""
    return task.task_name.replace("/", "_").removesuffix("_features").replace("_", " ")


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
