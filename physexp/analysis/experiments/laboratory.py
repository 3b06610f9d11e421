"""The laboratory: what each learner earns of the ideal's return in every domain. Ours."""

from collections.abc import Callable
from typing import Any

import numpy as np

from physexp.analysis import domains
from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, scores

TASKS = (
    *(conditions.BY_LABEL[label] for label in ("5-F", "D-F", "F-F")),
    conditions.THRESHOLD,
    conditions.BALANCE,
    conditions.STRINGS,
    conditions.SEALED_BOX,
    conditions.STRIKE,
)
LEARNERS = {
    "a3c": "A3C",
    "ppo": "PPO",
    "belief": "belief",
    "belief_revealed": "belief,\nrevealed",
}
"""Learners by title; `belief_revealed` is told the right answer after each episode, the others their reward alone."""

CONDITIONS = conditions.with_each_learner(TASKS)
LEAST_SHARE = 0.95  # Of the ideal's return, that an agent who has learned a domain earns.
FLOOR = -0.1  # Of the figure; what is less is drawn there.
_CLAIMS = {
    "a3c": "A3C learns every domain from the reward alone",
    "ppo": "PPO learns every domain from the reward alone",
    "belief": "The belief learner learns every domain from the reward alone",
    "belief_revealed": "The belief learner learns every domain where answers are revealed",
}
_LATE = (
    "In Towers A3C is right, but late: it takes four pushes on average, where one tells all, and six and a half "
    "steps with the fist, where three do."
)
_REASONS = {("a3c", "towers"): _LATE}
"""Our explanations, by learner and domain, of claims that fail."""
_UNTRAINED = ("value", "at_once", "random_value")


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Computes what is earned without learning in each domain, if that is not there yet; `report` is told which."""
    path = _path(results)
    found = base.read_made(path, "laboratory", _are_returns) if path.exists() else {}
    missing = [task for task in TASKS if task.label not in found]
    for task in missing:
        report(f"searching for the ideal experimenter of {task.task_name}")
        known = domains.find(task.domain)
        assert known.ideal is not None
        summary = known.ideal(task.task, task.task_kwargs, task.agent.discount).summary()
        found[task.label] = {name: summary[name] for name in _UNTRAINED}
        base.keep_made(path, found)


def _path(results: base.Results):
    return results.path / "ideal" / "laboratory.json"


def _are_returns(found: Any) -> bool:
    return isinstance(found, dict) and all(
        isinstance(row, dict) and all(type(row.get(name)) is float for name in _UNTRAINED) for row in found.values()
    )


def load(results: base.Results):
    """Returns a DataFrame with a row for each agent that has been trained and evaluated.

    Columns beside those of `scores.final`: the `frames` it was trained for, and the `minutes` that took. The attribute
    `untrained` has, by condition, the returns of the ideal, of an answer at once and of random interactions.
    """
    untrained = base.read_made(_path(results), "laboratory", _are_returns)
    if missing := [task.label for task in TASKS if task.label not in untrained]:
        raise ValueError(f"{_path(results)} lacks {', '.join(missing)}; `physexp reproduce laboratory` adds that")
    frame = scores.final(results, CONDITIONS, {label: row["value"] for label, row in untrained.items()})
    curves = results.curves(CONDITIONS)
    ends = curves.groupby(["condition", "algorithm", "training_seed"])[["frames", "seconds"]].max().reset_index()
    frame = frame.merge(ends.assign(minutes=ends.seconds / 60).drop(columns="seconds"))
    frame.attrs["untrained"] = untrained
    return frame


def find_claims(frame) -> list[claims.Claim]:
    """Each learner comes near the optimum in each domain."""
    return [
        claims.Claim(
            text=text,
            condition=task.label,
            statistic="share of the ideal's return, median of agents",
            estimate=estimates.median(agents.share),
            above=LEAST_SHARE,
            reason=_REASONS.get((learner, task.domain), ""),
        )
        for learner, text in _CLAIMS.items()
        for task in TASKS
        if len(agents := _agents(frame, task.label, learner))
    ]


def table(frame) -> list[tuple[str, ...]]:
    """Returns a header and a row for each domain: what each learner earned, from how much."""
    header = ("task", "ideal's return", "answer at once", "random interactions", *LEARNERS.values())
    rows = [tuple(name.replace("\n", " ") for name in header)]
    for task in TASKS:
        cells = [_cell(_agents(frame, task.label, learner)) for learner in LEARNERS]
        if any(cells):
            row = frame.attrs["untrained"][task.label]
            ideal = row["value"]
            shares = (f"{row[name] / ideal:.2f}" for name in ("at_once", "random_value"))
            rows.append((_title(task), f"{ideal:.4f}", *shares, *cells))
    return rows


def _cell(agents) -> str:
    """Returns the median share, and the medians of frames and minutes, in words; nothing without agents."""
    if not len(agents):
        return ""
    count = len(agents)
    return (
        f"{agents.share.median():.3f} ({count} agent{'s' if count > 1 else ''}, {agents.frames.median() / 1000:,.0f} K "
        f"steps, {agents.minutes.median():.1f} min)"
    )


def _agents(frame, label: str, learner: str):
    return frame[(frame.condition == label) & (frame.algorithm == learner)]


def draw(frame):
    """A panel for each domain: every agent's share of the ideal's return, beside what random interactions earn."""
    shown = [task for task in TASKS if (frame.condition == task.label).any()]
    num_columns = min(4, len(shown))
    num_rows = -(-len(shown) // num_columns)
    figure, panels = plots.new(
        columns=num_columns, rows=num_rows, width=1.9, height=2.0, sharex=True, sharey=True, squeeze=False
    )
    for axes in panels.flat[len(shown) :]:
        axes.set_axis_off()
    for axes, task in zip(panels.flat, shown, strict=False):
        row = frame.attrs["untrained"][task.label]
        by_chance = row["random_value"] / row["value"]
        plots.reference(axes, 1.0, "")
        axes.axhline(max(FLOOR, by_chance), color="0.85", linewidth=3, zorder=-1)
        for number, learner in enumerate(LEARNERS):
            shares = _agents(frame, task.label, learner).share.clip(lower=FLOOR)
            spread = np.linspace(-0.15, 0.15, len(shares)) if len(shares) > 1 else np.zeros(len(shares))
            color, marker = plots.COLORS[number], plots.MARKERS[number]
            axes.plot(number + spread, shares, marker, color=color, markersize=3, alpha=0.7)
            if len(shares):
                axes.plot([number - 0.3, number + 0.3], [shares.median()] * 2, color=color, linewidth=1.6)
        axes.set(title=_title(task), ylim=(FLOOR - 0.03, 1.08), xlim=(-0.5, len(LEARNERS) - 0.5))
        axes.set_xticks(range(len(LEARNERS)), list(LEARNERS.values()), rotation=90)
    for axes in panels[:, 0]:
        axes.set_ylabel("share of the ideal's return")
    for axes in panels[-1]:
        axes.set_xlabel("learner")
    lines = [*panels[0, 0].lines[:2]]  # Of the ideal and of random interactions, in every panel.
    figure.legend(lines, ["ideal", "random interactions"], loc="outside lower center", ncols=2)
    return figure


def _title(task) -> str:
    """Returns a task's name in words, without what is the same for all: `towers direct`."""
    return task.task_name.replace("/", "_").removesuffix("_features").replace("_", " ")


EXPERIMENT = base.Experiment(
    name="laboratory",
    title="The laboratory",
    section=claims.OURS,
    caption="What agents earn in every domain, features, as a share of the ideal experimenter's return, actions "
    "drawn. Dots: agents; lines: their median; dotted: the ideal; grey: random interactions with the best answers at "
    f"the best moment. What is less than {FLOOR:g} is drawn there. The belief learner has one configuration for all "
    "domains; the other two have one that was chosen for each, and in Towers a hint of how to begin. Below: the median "
    "share of the ideal's return, with how many agents, environment steps and minutes (on several machines, "
    "not all equally fast, with other agents beside).",
    conditions=CONDITIONS,
    trials=(base.EVALUATION,),
    prepare=prepare,
    load=load,
    claims=find_claims,
    draw=draw,
    table=table,
)
