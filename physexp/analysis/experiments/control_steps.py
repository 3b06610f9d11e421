"""Waiting for information (paper, Section 6.3; right of Figure 5), and agents trained with many control steps. Ours.

Fist agents are tested in control steps of other lengths than those of training: an agent that waits for information
answers after the same time, and not after the same number of steps.
"""

from collections.abc import Callable
import dataclasses
import functools
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.domains import towers
from physexp.analysis.experiments import base, claims, conditions, curves, generalization

TIMESTEPS = tuple(round(0.01 * number, 2) for number in range(1, 11))  # s; the last is that of training.
FISTS = tuple(conditions.towers("fist", kind) for kind in conditions.OBSERVATIONS)
TRIALS = tuple(
    base.Trial(name=f"timestep{timestep:g}", num_steps=10_000, task_kwargs={"control_timestep": timestep})
    for timestep in TIMESTEPS
)

ONE, MANY = "trained with control steps of 0.1 s", "trained with control steps of 0.05 to 0.15 s"
WAITS = "rule, after a fixed number of control steps"
_FIST = conditions.with_variation(conditions.with_belief(conditions.BY_LABEL["F-F"]))
PLAYERS = {ONE: _FIST, MANY: conditions.with_step_variation(_FIST)}
"""The agents of `timing`, by the control steps in training; both with variation."""

STEPS = {
    timestep: generalization.make_trial(f"steps{timestep:g}", variation=1.0, control_timestep=timestep)
    for timestep in (0.05, 0.075, 0.1, 0.125, 0.15)
} | {0.1: generalization.TRIALS["varied"]}  # 0.1 s is the default.
"""The trials of `timing`, by the length of the control step, s."""
FRICTION = generalization.TRIALS["friction 0.48"]
"""A trial unlike the training of either."""
_SHORTEST, _, _USUAL, _, _LONGEST = STEPS


# Waiting: agents as in the paper.


def load_waiting(results: base.Results):
    """Returns the episodes of all control steps."""
    frame = results.episodes(TRIALS, FISTS, ["label", "reward", "interactions", "time"])
    return frame.assign(step=frame.control_timestep.astype(float).round(3))


def per_agent(frame):
    """Returns accuracy, median time to the answer (s) and median interactions for each condition, agent and step."""
    grouped = frame.assign(right=frame.reward > 0).groupby(["condition", "training_seed", "step"], sort=False)
    named = {"accuracy": ("right", "mean"), "time": ("time", "median"), "interactions": ("interactions", "median")}
    return grouped.agg(**named).reset_index()


def _by_agent(rows, column: str):
    """Returns a column of `per_agent`: a row for each agent, a column for each control step."""
    return per_agent(rows).pivot(index="training_seed", columns="step", values=column)


def _finest_over_trained(column: str) -> claims.Statistic:
    def ratio(rows) -> estimates.Estimate:
        pairs = _by_agent(rows, column)[[TIMESTEPS[0], TIMESTEPS[-1]]].dropna()
        return estimates.ratio_of_pairs(*pairs.to_numpy().T)

    return claims.of_rows(ratio)


def _worst_over_trained(rows) -> estimates.Estimate:
    accuracy = _by_agent(rows, "accuracy")
    return estimates.ratio_of_pairs(accuracy.min(axis=1), accuracy[TIMESTEPS[-1]])


def _gain_on_time(rows) -> estimates.Estimate:
    """Returns the gain in accuracy if a smaller control step ends at the time of the answers in training."""
    gains = []
    for _, its in per_agent(rows).groupby("training_seed"):
        is_trained = its.step == TIMESTEPS[-1]
        steps = its.time[is_trained].iloc[0] / its.step
        is_whole = np.abs(steps - steps.round()) < 1e-3
        gains.append(its.accuracy[is_whole & ~is_trained].mean() - its.accuracy[~is_whole].mean())
    return estimates.mean(gains)


def _draw_waiting(frame):
    """Draws accuracy above, and the median time to the answer of one agent below, against the control step."""
    names = list(frame.condition.unique())
    figure, panels = plots.new(
        columns=len(names), rows=2, width=3.0, height=1.9, sharex=True, sharey="row", squeeze=False
    )
    for (above, below), name in zip(panels.T, names, strict=True):
        rows = frame[frame.condition == name]
        accuracy = per_agent(rows).groupby("step").accuracy
        above.plot(accuracy.median(), color=plots.COLORS[1], marker="o", markersize=3)
        style: dict[str, Any] = dict(color=plots.COLORS[1], alpha=0.15, linewidth=0)
        above.fill_between(accuracy.median().index, accuracy.min(), accuracy.max(), **style)
        plots.reference(above, conditions.chance("towers", FISTS[0].task), "chance")
        above.set(title=conditions.spelled_out(name), ylim=(0, 1.05))
        _draw_times(below, rows[rows.training_seed == rows.training_seed.min()])
        below.set_xlabel("control step, s")
    panels[0, 0].set_ylabel("share of right answers")
    panels[1, 0].set(ylabel="median time to answer, s", ylim=(0, None))
    return figure


def _draw_times(axes, agent) -> None:
    medians = {step: estimates.median(times) for step, times in agent.groupby("step").time}
    steps, middle = np.array(list(medians)), np.array([each.value for each in medians.values()])
    low, high = (np.array([getattr(each, end) for each in medians.values()]) for end in ("low", "high"))
    style: dict[str, Any] = dict(marker="s", markersize=3, linestyle=plots.DASHES[1], capsize=1.5)
    axes.errorbar(steps, middle, [middle - low, high - middle], color=plots.COLORS[2], **style)
    axes.fill_between(steps, middle - steps, middle + steps, color=plots.COLORS[2], alpha=0.15, linewidth=0)


# Timing: agents trained with control steps of one length and of many.


def prepare_timing(results: base.Results, report: Callable[[str], None]) -> None:
    """Plays the rule with answers after a fixed number of control steps, the most that it takes at 0.1 s."""
    path = _path(results)
    if path.exists():
        return
    report("a rule that waits for a fixed number of control steps plays")
    _, lengths = generalization.play(functools.partial(towers.rule, _FIST.task), _FIST, STEPS[_USUAL])
    wait = int((lengths - 1).max())
    rule = functools.partial(towers.rule, _FIST.task, wait=wait)
    played = {f"{timestep:g}": generalization.play(rule, _FIST, trial) for timestep, trial in STEPS.items()}
    right = {timestep: float((rewards > 0).mean()) for timestep, (rewards, _) in played.items()}
    base.keep_made(path, {"wait": wait, "right": right})


def _path(results: base.Results):
    return results.path / "timing" / f"{_FIST.label}.json"


@dataclasses.dataclass(frozen=True)
class Timed:
    """The performance of the players.

    Attributes:
      agents: a row for each player, training_seed and step (the control step, s): the share of right answers, `right`;
        the medians of interactions and time (s); and the share of wrong answers that count too many bodies, `too_many`.
      friction: the share of right answers at high friction, for each player and training_seed.
      rule: the rule's `right`, `interactions` and `time` for each step.
    """

    agents: Any
    friction: Any
    rule: Any


def load_timing(results: base.Results) -> Timed:
    """Returns the performance of agents and of the rule.

    Raises:
      ValueError: if no agent trained with many control steps has played at all of them.
    """
    import pandas

    columns = ["reward", "answer", "label", "interactions", "time"]
    rows = [
        {"player": player, "training_seed": seed, "step": timestep, **_summary(episodes)}
        for player, config in PLAYERS.items()
        for timestep, trial in [*STEPS.items(), (None, FRICTION)]
        for _, seed, episodes in results.agents(trial, [config], columns)
    ]
    frame = pandas.DataFrame(rows, columns=["player", "training_seed", "step", *_COLUMNS])
    if not len(_by_step(frame, MANY)):
        raise results.lacks("episodes")
    made = base.read_made(_path(results), "timing")
    right, wait = [made["right"][f"{step:g}"] for step in STEPS], made["wait"]
    times = [wait * step for step in STEPS]
    rule = pandas.DataFrame({"right": right, "interactions": wait, "time": times}, index=list(STEPS))
    return Timed(frame[frame.step.notna()], frame[frame.step.isna()], rule)


_COLUMNS = ("right", "interactions", "time", "too_many")


def _summary(episodes) -> dict[str, float]:
    wrong = episodes[episodes.reward < 0]
    return {
        "right": (episodes.reward > 0).mean(),
        "interactions": episodes.interactions.median(),
        "time": episodes.time.median(),
        "too_many": (wrong.label > wrong.answer).mean(),
    }


def _by_step(agents, player: str):
    """Returns a row for each agent with all control steps, and columns by value and step."""
    import pandas

    columns = pandas.MultiIndex.from_product([_COLUMNS, STEPS])
    rows = agents[(agents.player == player) & agents.step.notna()]
    table = rows.pivot(index="training_seed", columns="step", values=list(_COLUMNS)).reindex(columns=columns)
    return table[table.right.notna().all(axis=1)]


def _shortest_over_usual(player: str, column: str) -> claims.Statistic:
    def ratio(timed: Timed) -> estimates.Estimate | None:
        values = _by_step(timed.agents, player)[column]
        return estimates.ratio_of_pairs(values[_SHORTEST], values[_USUAL]) if len(values) else None

    return claims.of_all(ratio)


def _better_than_one(timed: Timed) -> estimates.Estimate | None:
    many, one = (_by_step(timed.agents, player).right[_SHORTEST] for player in (MANY, ONE))
    return estimates.difference_of_pairs(many, one) if len(one) else None


def _too_many_if_short(timed: Timed) -> estimates.Estimate | None:
    shares = _by_step(timed.agents, ONE).too_many
    return estimates.mean((shares[_SHORTEST] - shares[_LONGEST]).dropna()) if len(shares) else None


def _better_at_high_friction(timed: Timed) -> estimates.Estimate | None:
    rows = timed.friction.set_index("training_seed")
    many, one = (rows.right[rows.player == player] for player in (MANY, ONE))
    return estimates.difference_of_pairs(many, one) if len(one) else None


def _draw_timing(timed: Timed):
    """Draws the share of right answers and the median time to the answer against the control step."""
    figure, panels = plots.new(columns=2, width=3.0, height=2.3)
    words = {"right": "share of right answers", "time": "time to the answer, s"}
    for axes, (column, label) in zip(panels, words.items(), strict=True):
        for number, player in enumerate((ONE, MANY)):
            values = _by_step(timed.agents, player)[column]
            if len(values):
                curves.draw_spread(axes, values.columns, values.to_numpy(), number, player)
        curves.draw_spread(axes, timed.rule.index, [timed.rule[column]], 2, WAITS)
        axes.set(xlabel="control step, s", ylabel=label, ylim=(0, None))
    plots.reference(panels[0], conditions.chance(_FIST.domain, _FIST.task), "chance")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=1)
    return figure


EXPERIMENTS = {
    "waiting": base.Experiment(
        **claims.described("waiting"),
        conditions=FISTS,
        trials=TRIALS,
        load=load_waiting,
        statistics={
            "same_time": _finest_over_trained("time"),
            "not_same_steps": _finest_over_trained("interactions"),
            "small_drop": claims.of_rows(_worst_over_trained),
            "no_timeouts": claims.of_rows(claims.share_of_timeouts),
            "on_time": claims.of_rows(_gain_on_time),
        },
        draw=_draw_waiting,
    ),
    "timing": base.Experiment(
        **claims.described("timing"),
        conditions=tuple(PLAYERS.values()),
        trials=(*STEPS.values(), FRICTION),
        prepare=prepare_timing,
        load=load_timing,
        statistics={
            "right": claims.of_all(lambda timed: estimates.median(_by_step(timed.agents, MANY).right.min(axis=1))),
            "same_time": _shortest_over_usual(MANY, "time"),
            "not_same_steps": _shortest_over_usual(MANY, "interactions"),
            "better_than_rule": claims.of_all(
                lambda timed: estimates.mean(
                    _by_step(timed.agents, MANY).right[_SHORTEST] - timed.rule.right[_SHORTEST]
                )
            ),
            "better_than_one": claims.of_all(_better_than_one),
            "one_same_time": _shortest_over_usual(ONE, "time"),
            "one_counts": claims.of_all(_too_many_if_short),
            "friction": claims.of_all(_better_at_high_friction),
        },
        draw=_draw_timing,
    ),
}
