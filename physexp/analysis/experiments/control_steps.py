"""Waiting for information (paper, Section 6.3; right of Figure 5), and agents trained with many control steps. Ours.

Fist agents are tested in control steps of other lengths than those of training: an agent that waits for information
answers after the same time, and not after the same number of steps.
"""

from collections.abc import Callable, Mapping, Sequence
import functools
from typing import Any

import numpy as np
import pandas

from physexp.analysis.data import estimates, plots
from physexp.analysis.domains import towers
from physexp.analysis.experiments import base, claims, conditions, curves, generalization

FISTS = tuple(conditions.towers("fist", kind) for kind in conditions.OBSERVATIONS)
TRIALS = {
    step: base.Trial(name=f"timestep{step:g}", num_steps=10_000, task_kwargs={"control_timestep": step})
    for step in (round(0.01 * number, 2) for number in range(1, 11))
}
"""The trials of `waiting`, by the length of the control step, s."""
FINEST, TRAINED = min(TRIALS), max(TRIALS)

ONE, MANY = "trained with control steps of 0.1 s", "trained with control steps of 0.05 to 0.15 s"
WAITS = "rule, after a fixed number of control steps"
_RULE = "timing/F-F"  # Stored.
_FIST = conditions.with_variation(conditions.with_belief(conditions.BY_LABEL["F-F"]), ONE)
PLAYERS = (_FIST, conditions.with_step_variation(_FIST, MANY))
"""The agents of `timing`, by the control steps in training; both with variation."""

STEPS = {
    step: generalization.make_trial(f"steps{step:g}", variation=1.0, control_timestep=step)
    for step in (0.05, 0.075, 0.1, 0.125, 0.15)
} | {0.1: generalization.TRIALS["varied"]}  # 0.1 s is the default.
"""The trials of `timing`, by the length of the control step, s."""
SHORTEST, _, _USUAL, _, LONGEST = STEPS
FRICTION = generalization.TRIALS["friction 0.48"]
"""A trial unlike the training of either."""


def _load(results: base.Results, trials: Mapping[float, base.Trial], wanted: Sequence[conditions.Condition]):
    """Returns a row for each condition, player, training_seed and step (the control step, s).

    Its columns are the number of `episodes`, and of `timeouts` among them; the share of right answers, `right`; the
    medians of `interactions` and `time` (s), with the ends `low` and `high` of its interval; and the share of wrong
    answers that count too many bodies, `too_many`. Agents are left out until they have played all trials.
    """
    steps = {trial.name: step for step, trial in trials.items()}
    columns = ["reward", "answer", "label", "interactions", "time"]
    rows = []
    for names, _, its in results.agents(list(trials.values()), wanted, columns):
        wrong, (low, high) = its[its.reward < 0], estimates.median_interval(its.time)
        summary = {
            "episodes": len(its),
            "timeouts": (its.label < 0).sum(),
            "right": (its.reward > 0).mean(),
            "interactions": its.interactions.median(),
            "time": its.time.median(),
            "low": low,
            "high": high,
            "too_many": (wrong.label > wrong.answer).mean(),
        }
        rows.append(names | {"step": steps[names["trial"]]} | summary)
    return results.frame(rows)


def _by_step(rows, player: str, column: str = "right"):
    return claims.by_agent(claims.rows(rows, player=player), "step", column)


def _ratio_of_steps(column: str, short: float, usual: float, player: str) -> claims.Statistic:
    """Returns the statistic that compares a column in two control steps."""

    def ratio(rows) -> estimates.Estimate:
        values = _by_step(rows, player, column)
        return estimates.ratio_of_pairs(values[short], values[usual])

    return claims.of_rows(ratio)


# Waiting: agents as in the paper.


def _worst_over_trained(rows) -> estimates.Estimate:
    right = claims.by_agent(rows, "step", "right")
    return estimates.ratio_of_pairs(right.min(axis=1), right[TRAINED])


def _share_of_timeouts(rows) -> estimates.Estimate:
    counts = rows.groupby("training_seed")[["timeouts", "episodes"]].sum()
    return estimates.mean_share(counts.timeouts / counts.episodes)


def _gain_on_time(rows) -> estimates.Estimate:
    """Returns the gain in right answers if a smaller control step ends at the time of the answers in training."""
    gains = []
    for _, its in rows.groupby("training_seed"):
        is_trained = its.step == TRAINED
        steps = its.time[is_trained].iloc[0] / its.step
        is_whole = np.abs(steps - steps.round()) < 1e-3
        gains.append(its.right[is_whole & ~is_trained].mean() - its.right[~is_whole].mean())
    return estimates.mean(gains)


def _draw_waiting(frame):
    """Draws right answers above, and the median time to the answer of one agent below, against the control step."""
    by_name = dict(list(frame.groupby("condition", sort=False)))
    figure, panels = plots.new(
        columns=len(by_name), rows=2, width=3.0, height=1.9, sharex=True, sharey="row", squeeze=False
    )
    style: dict[str, Any] = dict(alpha=0.15, linewidth=0)
    for (above, below), (name, rows) in zip(panels.T, by_name.items(), strict=True):
        right = rows.groupby("step").right.agg(["median", "min", "max"])
        above.plot(right["median"], color=plots.COLORS[1], marker="o", markersize=3)
        above.fill_between(right.index, right["min"], right["max"], color=plots.COLORS[1], **style)
        plots.reference(above, FISTS[0].chance, "chance")
        above.set(title=conditions.spelled_out(name), ylim=(0, 1.05))
        agent = rows[rows.training_seed == rows.training_seed.min()].sort_values("step")
        step, time = agent.step, agent.time
        bars: dict[str, Any] = dict(marker="s", markersize=3, linestyle=plots.DASHES[1], capsize=1.5)
        below.errorbar(step, time, [time - agent.low, agent.high - time], color=plots.COLORS[2], **bars)
        below.fill_between(step, time - step, time + step, color=plots.COLORS[2], **style)
        below.set_xlabel("control step, s")
    panels[0, 0].set_ylabel("share of right answers")
    panels[1, 0].set(ylabel="median time to answer, s", ylim=(0, None))
    return figure


# Timing: agents trained with control steps of one length and of many.


def prepare_timing(results: base.Results, report: Callable[[str], None]) -> None:
    """Plays the rule with answers after a fixed number of control steps, the most that it takes at 0.1 s."""
    results.make(_RULE, report, "a rule that waits for a fixed number of control steps plays", _played_by_rule)


def _played_by_rule() -> dict[str, Any]:
    _, lengths = generalization.play(functools.partial(towers.rule, _FIST.task), _FIST, STEPS[_USUAL])
    wait = int((lengths - 1).max())
    rule = functools.partial(towers.rule, _FIST.task, wait=wait)
    played = {f"{step:g}": generalization.play(rule, _FIST, trial) for step, trial in STEPS.items()}
    return {"wait": wait, "right": {step: float((rewards > 0).mean()) for step, (rewards, _) in played.items()}}


def load_timing(results: base.Results):
    """Returns the rows of `_load` of agents, and of the rule, with `right`, `interactions` and `time` alone.

    Their column `slippery` has the share of right answers at high friction.

    Raises:
      ValueError: if no agent trained with many control steps has played at all of them.
    """
    made = results.made(_RULE)
    rule = {"condition": _FIST.label, "player": WAITS, "training_seed": -1, "interactions": made["wait"]}
    rules = [rule | {"step": step, "right": made["right"][f"{step:g}"], "time": made["wait"] * step} for step in STEPS]
    slippery = _load(results, {_USUAL: FRICTION}, PLAYERS)[["player", "training_seed", "right"]]
    agents = _load(results, STEPS, PLAYERS).merge(slippery.rename(columns={"right": "slippery"}), "left")
    return results.with_player(pandas.concat([agents, pandas.DataFrame(rules)], ignore_index=True), [MANY])


def _less_rule(frame) -> estimates.Estimate:
    return estimates.mean(_by_step(frame, MANY)[SHORTEST] - _by_step(frame, WAITS)[SHORTEST].iloc[0])


def _many_less_one(column: str, step: float) -> claims.Statistic:
    def difference(rows) -> estimates.Estimate:
        return estimates.difference_of_pairs(*(_by_step(rows, player, column)[step] for player in (MANY, ONE)))

    return claims.of_rows(difference)


def _too_many_if_short(frame) -> estimates.Estimate:
    shares = _by_step(frame, ONE, "too_many")
    return estimates.mean((shares[SHORTEST] - shares[LONGEST]).dropna())


def _draw_timing(frame):
    """Draws the share of right answers and the median time to the answer against the control step."""
    figure, panels = plots.new(columns=2, width=3.0, height=2.3)
    words = {"right": "share of right answers", "time": "time to the answer, s"}
    players = dict(list(frame.groupby("player")))
    for axes, (column, label) in zip(panels, words.items(), strict=True):
        for number, player in enumerate((ONE, MANY, WAITS)):
            if player in players:
                values = claims.by_agent(players[player], "step", column)
                curves.draw_spread(axes, values.columns, values.to_numpy(), number, player)
        axes.set(xlabel="control step, s", ylabel=label, ylim=(0, None))
    plots.reference(panels[0], _FIST.chance, "chance")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=1)
    return figure


EXPERIMENTS = {
    "waiting": base.Experiment(
        **claims.described("waiting"),
        conditions=FISTS,
        trials=tuple(TRIALS.values()),
        load=lambda results: _load(results, TRIALS, FISTS),
        statistics={
            "same_time": _ratio_of_steps("time", FINEST, TRAINED, "a3c"),
            "not_same_steps": _ratio_of_steps("interactions", FINEST, TRAINED, "a3c"),
            "small_drop": claims.of_rows(_worst_over_trained),
            "no_timeouts": claims.of_rows(_share_of_timeouts),
            "on_time": claims.of_rows(_gain_on_time),
        },
        draw=_draw_waiting,
    ),
    "timing": base.Experiment(
        **claims.described("timing"),
        conditions=PLAYERS,
        trials=(*STEPS.values(), FRICTION),
        prepare=prepare_timing,
        load=load_timing,
        statistics={
            "right": claims.of_rows(lambda frame: estimates.mean(_by_step(frame, MANY).min(axis=1))),
            "same_time": _ratio_of_steps("time", SHORTEST, _USUAL, MANY),
            "not_same_steps": _ratio_of_steps("interactions", SHORTEST, _USUAL, MANY),
            "better_than_rule": claims.of_rows(_less_rule),
            "better_than_one": _many_less_one("right", SHORTEST),
            "one_same_time": _ratio_of_steps("time", SHORTEST, _USUAL, ONE),
            "one_counts": claims.of_rows(_too_many_if_short),
            "friction": _many_less_one("slippery", _USUAL),
        },
        draw=_draw_timing,
    ),
}
