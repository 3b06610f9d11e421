"""Data efficiency: the environment steps and minutes until learners come near the optimum. Ours.

Also the parts of the belief learner (ablations), and the way of the fist to the tower (reaching).
"""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
from typing import Any

import numpy as np

from physexp.agents.belief import config as belief
from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves, ideal_towers
from physexp.analysis.training import records

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
CONDITIONS = (
    *conditions.with_each_learner(TASKS),
    conditions.with_papers_learner(conditions.BY_LABEL["10-F"]),  # Answers are learned soonest there.
)

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


def _actuated(actuator: str, kind: str, **task_kwargs: Any) -> conditions.Condition:
    return conditions.with_belief(conditions.towers(actuator, kind)).changed(**task_kwargs)


REACHING = {
    kind: {
        NEAR: _actuated("fist", kind, fist_distance=_DISTANCE),
        FAR: _actuated("fist", kind),
        DIRECT: _actuated("direct", kind),
    }
    for kind in conditions.OBSERVATIONS
}
"""The agents of `reaching`, by observations and actuator."""


@dataclasses.dataclass(frozen=True)
class Learned:
    """Agents in training and afterwards.

    Attributes:
      curves: learning curves with a `score`, as `load_curves` returns them.
      final: a row for each evaluated agent, as `evaluated` returns them.
    """

    curves: Any
    final: Any


def load_curves(results: base.Results, configs: Sequence[conditions.Condition]):
    """Returns learning curves with a `score`: the share of the ideal's return, from pixels that of right answers.

    It is the score of the greedy episodes for learners that play some greedily, else of all, with drawn actions.
    """
    frame = results.curves(configs)
    returns, right = (
        frame.get(greedy, default=frame[drawn] * np.nan).fillna(frame[drawn])
        for greedy, drawn in (("greedy_return", "episode_return"), ("greedy_success_rate", "success_rate"))
    )
    labels = frame.condition.unique()
    units = {
        label: 1.0 if sees_pixels(label) else ideal_towers.ideal_return(conditions.BY_LABEL[label], results)
        for label in labels
    }
    return frame.assign(score=returns.where(~frame.condition.map(sees_pixels), right) / frame.condition.map(units))


def evaluated(
    results: base.Results, configs: Sequence[conditions.Condition], ideals: Mapping[str, float] | None = None
):
    """Returns a row for each evaluated agent: its `share` of the ideal's return, and the standard `error` of that.

    `ideals` are the ideal's returns by condition; by default they are looked up.
    """
    import pandas

    rows = []
    known = dict(ideals or {})
    for config, seed, episodes in results.agents(base.EVALUATION, configs, ["reward", "length"]):
        if config.label not in known:
            known[config.label] = ideal_towers.ideal_return(conditions.BY_LABEL[config.label], results)
        shares = records.discounted_return(episodes) / known[config.label]
        error = shares.std(ddof=1) / np.sqrt(len(shares))
        rows.append((config.label, config.agent.title, seed, shares.mean(), error))
    return pandas.DataFrame(rows, columns=["condition", "algorithm", "training_seed", "share", "error"])


def load_efficiency(results: base.Results) -> Learned:
    """Returns all learners in training and afterwards."""
    return Learned(load_curves(results, CONDITIONS), evaluated(results, CONDITIONS))


def load_ablations(results: base.Results):
    """Returns learning curves of all variants; see `load_curves`.

    Raises:
      ValueError: if no variant has been trained.
    """
    frame = load_curves(results, ABLATED)
    if set(frame.algorithm) <= {"belief"}:
        raise results.lacks("finished runs")
    return frame


def load_reaching(results: base.Results):
    """Returns learning curves, with the `score` in shares of right greedy answers.

    The `condition` is the kind of observations, and the `algorithm` is the actuator.

    Raises:
      ValueError: if no agent was trained with a fist that starts at the tower.
    """
    import pandas

    frames = []
    for kind, players in REACHING.items():
        if results.has_finished(players[NEAR]):
            for player, config in players.items():
                if results.has_finished(config):
                    frame = results.curves([config])
                    frames.append(frame.assign(condition=kind, algorithm=player, score=frame.greedy_success_rate))
    if not frames:
        raise results.lacks("finished runs")
    return pandas.concat(frames, ignore_index=True)


def sees_pixels(label: str) -> bool:
    """Returns whether agents observe pixels in a condition of the paper."""
    return label in conditions.BY_LABEL and conditions.observations(conditions.BY_LABEL[label]) == "pixels"


def middle(label: str) -> Callable[..., estimates.Estimate]:
    """Returns the estimator of the middle of agents.

    From pixels it is their mean: five agents are too few for an interval of the median at the corrected level.
    """
    return estimates.mean if sees_pixels(label) else estimates.median


def runs(frame, label: str, learner: str) -> list:
    """Returns the rows of each agent of a condition with a learner, named by its title."""
    return curves.runs(frame[(frame.condition == label) & (frame.algorithm == learner)])


def reached(runs: Sequence, along: str = "frames") -> np.ndarray:
    """Returns the position on a column at which runs first reach `LEVEL`; infinity if they do not."""
    return np.array([curves.first_reached(run, LEVEL, along, "score") for run in runs])


def ratio_of_steps(quick: Sequence, slow: Sequence) -> estimates.Estimate | None:
    """Returns the ratio of the environment steps to `LEVEL` of some runs to those of others, None without either.

    A run of the quick ones that never reaches it counts as infinitely slow, so the ratio is unknown. A slow run that
    never reaches it counts with all its training, which is less than it needs: the ratio is then an upper bound.
    """
    if not quick or not slow:
        return None
    needed = reached(slow)
    ratio = estimates.ratio_of_means(reached(quick), np.minimum(needed, [run.frames.max() for run in slow]))
    return ratio if np.isfinite(needed).all() else estimates.at_most(ratio)


def _ratio(quick: str, slow: str) -> claims.Statistic:
    """Returns the statistic that compares two learners in a condition."""

    def ratio(data, label: str) -> estimates.Estimate | None:
        frame = data.curves if isinstance(data, Learned) else data
        return ratio_of_steps(runs(frame, label, quick), runs(frame, label, slow))

    return ratio


def _learner(condition: str) -> str:
    return "belief_revealed" if condition.endswith("answers revealed") else "belief"


def _steps(learner: str) -> claims.Statistic:
    def steps(data: Learned, label: str) -> estimates.Estimate | None:
        its = runs(data.curves, label, learner)
        estimate = estimates.geometric_mean if sees_pixels(label) else estimates.median
        return estimate(reached(its)) if its else None

    return steps


def _of_runs(value: Callable[[Any], float]) -> claims.Statistic:
    """Returns the median over agents of a value of their learning curves."""

    def statistic(data: Learned, condition: str) -> estimates.Estimate | None:
        its = runs(data.curves, claims.named(condition), _learner(condition))
        return estimates.median([value(run) for run in its]) if its else None

    return statistic


def _agents(data: Learned, condition: str):
    final = data.final
    return final[(final.condition == claims.named(condition)) & (final.algorithm == _learner(condition))]


def _share(data: Learned, condition: str) -> estimates.Estimate | None:
    agents = _agents(data, condition)
    return middle(claims.named(condition))(agents.share) if len(agents) else None


def _worst(data: Learned, condition: str) -> estimates.Estimate | None:
    agents = _agents(data, condition)
    if not len(agents):
        return None
    worst = agents.loc[agents.share.idxmin()]
    return estimates.normal(worst.share, worst.error)


def _fist_over_direct(data: Learned, kind: str) -> estimates.Estimate | None:
    labels = (conditions.label("towers", f"{actuator}_{kind}") for actuator in ("fist", "direct"))
    return ratio_of_steps(*(runs(data.curves, label, "belief") for label in labels))


def _draw_scores(axes, frame, label: str, names: Mapping[str, str], along: str = "frames") -> None:
    """Draws the score of each learner in a condition, with a legend of their names by title."""
    for number, (learner, name) in enumerate(names.items()):
        if its := runs(frame, label, learner):
            curves.draw_range(axes, its, number, name, along)
    axes.set(xscale="log", ylim=(_FLOOR, 1.05))


def _draw_efficiency(data: Learned):
    """Draws a row for each task, features left and pixels right, each against frames and against minutes."""
    shown = [task for task in TASKS if (data.curves.condition == task.label).any()]
    kinds = [kind for kind in conditions.OBSERVATIONS if kind in map(conditions.observations, shown)]
    rows = list(dict.fromkeys(task.label.split("-")[0] for task in shown))
    figure, panels = plots.new(
        rows=len(rows), columns=2 * len(kinds), width=2.0, height=1.5, sharex="col", sharey=True, squeeze=False
    )
    for axes in panels.flat:
        axes.set_axis_off()
    handles: dict[str, Any] = {}
    lowest: dict[int, Any] = {}  # Of each column.
    for task in shown:
        row, column = rows.index(task.label.split("-")[0]), 2 * kinds.index(conditions.observations(task))
        for place, along in enumerate(curves.AXES, column):
            axes = lowest[place] = panels[row, place]
            axes.set_axis_on()
            _draw_scores(axes, data.curves, task.label, LEARNERS, along)
            plots.reference(axes, LEVEL, "")
            handles |= dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
        score = "right answers" if sees_pixels(task.label) else "share of the ideal"
        panels[row, column].set(title=conditions.spelled_out(task.label), ylabel=score)
    for place, axes in lowest.items():
        axes.set(xlabel=list(curves.AXES.values())[place % 2][1])
        axes.tick_params(labelbottom=True)
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=len(handles))
    return figure


def _draw_ablations(frame):
    """Draws a panel for each task."""
    shown = list(frame.condition.unique())
    figure, panels = plots.new(columns=len(shown), width=3.2, height=2.4, sharey=True, squeeze=False)
    for axes, label in zip(panels[0], shown, strict=True):
        _draw_scores(axes, frame, label, {title: words for title, (words, _) in VARIANTS.items()})
        plots.reference(axes, LEVEL, "")
        axes.set(title=conditions.spelled_out(label), xlabel=curves.AXES["frames"][1])
    panels[0, 0].set_ylabel("share of the ideal")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


def _draw_reaching(frame):
    """Draws a panel for each kind of observation."""
    kinds = list(frame.condition.unique())
    figure, panels = plots.new(columns=len(kinds), width=3.0, height=2.3, sharey=True, squeeze=False)
    for axes, kind in zip(panels[0], kinds, strict=True):
        _draw_scores(axes, frame, kind, {player: player for player in (NEAR, FAR, DIRECT)})
        plots.reference(axes, conditions.chance("towers", conditions.TOWERS[0].task), "chance")
        axes.set(title=kind, xlabel=curves.AXES["frames"][1])
    panels[0, 0].set(ylabel="share of right answers", ylim=(0, 1.02))
    panels[0, 0].legend(loc="upper left")
    return figure


EXPERIMENTS = {
    "data_efficiency": base.Experiment(
        **claims.described("data_efficiency"),
        conditions=CONDITIONS,
        trials=(base.EVALUATION,),
        prepare=ideal_towers.prepare,
        load=load_efficiency,
        statistics={
            "few_steps": _steps("belief"),
            "few_steps_revealed": _steps("belief_revealed"),
            "minutes": _of_runs(lambda run: curves.first_reached(run, LEVEL, "seconds", "score")),
            "calibrated": _of_runs(lambda run: run.sort_values("frames").calibration_error.iloc[-1]),
            "near_optimum": _share,
            "none_far": _worst,
            "fewer_steps": _ratio("belief", "a3c"),
            "many_episodes": _ratio("a3c", "a3c_paper"),
            "fist_is_faster": _fist_over_direct,
        },
        draw=_draw_efficiency,
    ),
    "reaching": base.Experiment(
        **claims.described("reaching"),
        conditions=tuple(config for players in REACHING.values() for config in players.values()),
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
