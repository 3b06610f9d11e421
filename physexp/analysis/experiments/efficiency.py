"""Data efficiency: the environment steps and minutes until learners come near the optimum. Ours.

Also the parts of the belief learner (ablations), and the way of the fist to the tower (reaching).
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from physexp.agents.belief import config as belief
from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves, ideal_towers

TASKS = tuple(conditions.BY_LABEL.values())
LEVEL = 0.95  # Of the ideal's return, for features; of right answers, for pixels.
_FLOOR = -0.5  # Of figures.

LEARNERS = {
    "a3c": "A3C",
    "ppo": "PPO",
    "belief": "belief",
    "belief_revealed": "belief, answers revealed",
    "a3c_paper": "the paper's own",
}
"""The learners by their titles, in words."""
CONDITIONS = (*conditions.with_each_learner(TASKS), conditions.PAPERS_OWN)

# Without replay, training uses only the last round.
VARIANTS: dict[str, tuple[str, dict[str, Any]]] = {
    "belief": ("belief learner", {}),
    "belief_no_replay": ("without replay", {"replay_episodes": belief.NUM_ENVIRONMENTS}),
    "belief_last_step": ("belief at the last step alone", {"every_step": False}),
    "belief_lstm": ("an LSTM in place of attention", {"memory": "lstm"}),
    "belief_revealed": ("answers revealed", {"answers_revealed": True}),
}
"""The variants of the belief learner by title: their names in the figure, and their configurations."""
ABLATED = tuple(
    conditions.with_belief(conditions.BY_LABEL[label], **changes)
    for label in ("5-F", "D-F")
    for _, changes in VARIANTS.values()
)

NEAR, FAR, DIRECT = "fist at the tower", "fist", "direct pushes"
_DISTANCE = 0.16  # m, of the fist from the tower's axis, which leaves 1 cm between them; usually it is 0.32 m.


def _reaching(kind: str) -> tuple[conditions.Condition, ...]:
    fist, direct = (conditions.with_belief(conditions.towers(actuator, kind)) for actuator in ("fist", "direct"))
    near = fist.changed(player=NEAR, fist_distance=_DISTANCE)
    return near, fist.changed(player=FAR), direct.changed(player=DIRECT)


REACHING = tuple(condition for kind in conditions.OBSERVATIONS for condition in _reaching(kind))


def load_curves(results: base.Results, wanted: Sequence[conditions.Condition]):
    """Returns learning curves with a `score`: the share of the ideal's return, from pixels that of right answers.

    It is the score of the greedy episodes for learners that play some greedily, else of all, with drawn actions.
    """
    frame = results.curves(wanted)
    returns, right = (
        frame.get(greedy, default=frame[drawn] * np.nan).fillna(frame[drawn])
        for greedy, drawn in (("greedy_return", "episode_return"), ("greedy_success_rate", "success_rate"))
    )
    tasks = [conditions.BY_LABEL[label] for label in frame.condition.unique()]
    units = {task.label: 1.0 if sees_pixels(task.label) else ideal_towers.ideal_return(task, results) for task in tasks}
    return frame.assign(score=returns.where(~frame.condition.map(sees_pixels), right) / frame.condition.map(units))


def evaluated(
    results: base.Results, wanted: Sequence[conditions.Condition], ideal: Callable[[conditions.Condition], float]
):
    """Returns a row for each evaluated agent: `ideal_towers.share`, and the share of right answers, `right`.

    `ideal` returns that of a condition.
    """
    agents = results.agents([base.EVALUATION], wanted, ["reward", "length"])
    return results.frame(
        names | ideal_towers.share(its, ideal(condition)) | {"right": (its.reward > 0).mean()}
        for names, condition, its in agents
    )


def load_efficiency(results: base.Results):
    """Returns the learning curves of all learners, each row with the agent's evaluation: see `evaluated`.

    The score of the finished agent with drawn actions is `final`.
    """
    frame = load_curves(results, CONDITIONS)
    agents = evaluated(results, CONDITIONS, lambda task: ideal_towers.ideal_return(task, results))
    final = agents.share.where(~agents.condition.map(sees_pixels), agents.right)
    return frame.merge(agents.assign(final=final), "left")


def load_ablations(results: base.Results):
    """Returns learning curves of all variants in the tasks in which some have been trained; see `load_curves`."""
    return results.with_player(load_curves(results, ABLATED), set(VARIANTS) - {"belief"})


def load_reaching(results: base.Results):
    """Returns learning curves, with the `score` in shares of right greedy answers.

    The `condition` is the kind of observations; it is left out if no fist that starts at the tower was trained.
    """
    frame = results.curves(REACHING)
    kinds = frame.task.str.rpartition("_")[2]
    return results.with_player(frame.assign(condition=kinds, score=frame.greedy_success_rate), [NEAR])


def sees_pixels(label: str) -> bool:
    """Returns whether agents observe pixels in a condition of the paper."""
    return label in conditions.BY_LABEL and conditions.BY_LABEL[label].observations == "pixels"


def reached(rows, along: str = "frames") -> np.ndarray:
    """Returns the position on a column at which each agent first reaches `LEVEL`; infinity if it does not."""
    return curves.reached(rows, LEVEL, along, "score")


def ratio_of_steps(quick: np.ndarray, slow) -> estimates.Estimate:
    """Returns the ratio of environment steps to `LEVEL` of some agents, [N], to those of others, from their rows.

    An agent of the quick ones that never reaches it counts as infinitely slow, so the ratio is unknown. A slow agent
    that never reaches it counts with all its training, which is less than it needs: the ratio is then an upper bound.
    """
    needed, trained = reached(slow), slow.groupby("training_seed").frames.max().to_numpy()
    ratio = estimates.ratio_of_means(quick, np.minimum(needed, trained))
    return ratio if np.isfinite(needed).all() else estimates.at_most(ratio)


def reached_at_end(rows) -> np.ndarray:
    """Returns the environment steps of the training of each evaluated agent; infinity if its `final` score is lower."""
    agents = _agents(rows)
    return agents.frames.where(agents.final >= LEVEL, np.inf).to_numpy()


def _ratio(*players: str) -> claims.Statistic:
    """Returns the statistic that compares two players in a condition."""

    def ratio(frame, condition: str) -> estimates.Estimate:
        quick, slow = (claims.rows(frame, condition=condition, player=player) for player in players)
        return ratio_of_steps(reached(quick), slow)

    return ratio


def _belief_over_a3c(frame, condition: str) -> estimates.Estimate:
    """Returns bounds of the ratio where actions are drawn, as the curves of A3C are.

    Belief learners' curves are of greedy episodes, in which they reach the level sooner. With drawn actions they are
    known to have reached it at the end.
    """
    belief, a3c = (claims.rows(frame, condition=condition, player=player) for player in ("belief", "a3c"))
    return estimates.between(*(ratio_of_steps(needed(belief), a3c) for needed in (reached, reached_at_end)))


def _fist_over_direct(frame, kind: str) -> estimates.Estimate:
    fist, direct = (claims.rows(frame, condition=name, player="belief") for name in conditions.by_actuator(kind))
    return ratio_of_steps(reached(fist), direct)


def _of_belief(statistic: Callable[[Any], estimates.Estimate], player: str = "belief") -> claims.Statistic:
    """Returns the statistic of the rows of the belief learner, with answers revealed if the condition says so."""

    def estimated(frame, condition: str) -> estimates.Estimate:
        its = "belief_revealed" if condition.endswith("answers revealed") else player
        return statistic(claims.rows(frame, condition=claims.named(condition), player=its))

    return estimated


def _mean_reached(rows, along: str = "frames") -> estimates.Estimate:
    return estimates.geometric_mean(reached(rows, along))


def _calibration(rows) -> estimates.Estimate:
    return estimates.mean(rows.sort_values("frames").groupby("training_seed").calibration_error.nth(-1))


def _agents(rows):
    """Returns the last row of each agent that has been evaluated."""
    rows = claims.rows(rows.dropna(subset=["share"]))
    return rows.sort_values("frames").drop_duplicates("training_seed", keep="last")


def _worst(rows) -> estimates.Estimate:
    agents = _agents(rows)
    worst = agents.loc[agents.share.idxmin()]
    return estimates.normal(worst.share, worst.error)


def _draw_scores(axes, frame, label: str, names: Mapping[str, str], along: str = "frames") -> None:
    """Draws the score of each learner in a condition, with a legend of their names by title."""
    for number, (learner, name) in enumerate(names.items()):
        its = frame[(frame.condition == label) & (frame.player == learner)]
        if len(its):
            curves.draw_range(axes, its, number, name, along)
    axes.set(xscale="log", ylim=(_FLOOR, 1.05))


def _draw_finished(axes, rows, along: str) -> None:
    """Draws the median final score of the agents of each learner, where the shortest run ends."""
    unit, _ = curves.AXES[along]
    for number, learner in enumerate(LEARNERS):
        agents = rows[rows.player == learner].groupby("training_seed").agg({along: "max", "final": "first"})
        axes.plot(agents[along].min() / unit, agents.final.median(), "o", color=plots.COLORS[number], markersize=3)


def _draw_efficiency(frame):
    """Draws a row for each task, features left and pixels right, each against frames and against minutes."""
    shown = [task for task in TASKS if (frame.condition == task.label).any()]
    kinds = [kind for kind in conditions.OBSERVATIONS if kind in {task.observations for task in shown}]
    rows = list(dict.fromkeys(task.label.split("-")[0] for task in shown))
    figure, panels = plots.new(
        rows=len(rows), columns=2 * len(kinds), width=2.0, height=1.5, sharex="col", sharey=True, squeeze=False
    )
    for axes in panels.flat:
        axes.set_axis_off()
    handles: dict[str, Any] = {}
    lowest: dict[int, Any] = {}  # Of each column.
    for task in shown:
        row, column = rows.index(task.label.split("-")[0]), 2 * kinds.index(task.observations)
        for place, along in enumerate(curves.AXES, column):
            axes = lowest[place] = panels[row, place]
            axes.set_axis_on()
            _draw_scores(axes, frame, task.label, LEARNERS, along)
            _draw_finished(axes, frame[frame.condition == task.label], along)
            plots.reference(axes, LEVEL, "")
            handles |= dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
        score = "right answers" if sees_pixels(task.label) else "share of the ideal"
        panels[row, column].set(title=conditions.spelled_out(task.label), ylabel=score)
    for place, axes in lowest.items():
        axes.set(xlabel=list(curves.AXES.values())[place % 2][1])
        axes.tick_params(labelbottom=True)
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=len(handles))
    return figure


def _draw_panels(frame, names: Mapping[str, str], level: float, text: str, **size: Any):
    """Draws a panel for each condition, and a line with a text at a level."""
    shown = list(frame.condition.unique())
    figure, panels = plots.new(columns=len(shown), sharey=True, squeeze=False, **size)
    for axes, label in zip(panels[0], shown, strict=True):
        _draw_scores(axes, frame, label, names)
        plots.reference(axes, level, text)
        axes.set(title=conditions.spelled_out(label), xlabel=curves.AXES["frames"][1])
    return figure, panels[0, 0]


def _draw_ablations(frame):
    names = {title: words for title, (words, _) in VARIANTS.items()}
    figure, first = _draw_panels(frame, names, LEVEL, "", width=3.2, height=2.4)
    first.set_ylabel("share of the ideal")
    figure.legend(*first.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


def _draw_reaching(frame):
    names = {player: player for player in (NEAR, FAR, DIRECT)}
    figure, first = _draw_panels(frame, names, conditions.TOWERS[0].chance, "chance", width=3.0, height=2.3)
    first.set(ylabel="share of right answers", ylim=(0, 1.02))
    first.legend(loc="upper left")
    return figure


EXPERIMENTS = {
    "data_efficiency": base.Experiment(
        **claims.described("data_efficiency"),
        conditions=CONDITIONS,
        trials=(base.EVALUATION,),
        prepare=ideal_towers.prepare,
        load=load_efficiency,
        statistics={
            "few_steps": _of_belief(_mean_reached),
            "few_steps_revealed": _of_belief(_mean_reached, "belief_revealed"),
            "minutes": _of_belief(lambda rows: _mean_reached(rows, "seconds")),
            "calibrated": _of_belief(_calibration),
            "near_optimum": _of_belief(lambda rows: estimates.mean(_agents(rows).share)),
            "none_far": _of_belief(_worst),
            "fewer_steps": _belief_over_a3c,
            "many_episodes": _ratio("a3c", "a3c_paper"),
            "fist_is_faster": _fist_over_direct,
        },
        draw=_draw_efficiency,
    ),
    "reaching": base.Experiment(
        **claims.described("reaching"),
        conditions=REACHING,
        load=load_reaching,
        statistics={"near_over_far": _ratio(NEAR, FAR), "near_over_direct": _ratio(NEAR, DIRECT)},
        draw=_draw_reaching,
    ),
    "ablations": base.Experiment(
        **claims.described("ablations"),
        conditions=ABLATED,
        prepare=ideal_towers.prepare,
        load=load_ablations,
        statistics={
            "replay": _ratio("belief", "belief_no_replay"),
            "every_step": _ratio("belief", "belief_last_step"),
            "attention": _ratio("belief", "belief_lstm"),
            "answers": _ratio("belief_revealed", "belief"),
        },
        draw=_draw_ablations,
    ),
}
