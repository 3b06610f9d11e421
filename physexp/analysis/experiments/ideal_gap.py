"""The return of every agent against the ideal experimenter's, and the kinds of loss (ours; docs/ideal.md)."""

from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, ideal_towers
from physexp.analysis.ideal import mistakes

CONDITIONS = (*conditions.HEAVIER, *conditions.TOWERS)
_WORDS = {
    "uninformative": "poked a block that was known",
    "late": "poked a block when answering was better",
    "early": "answered when another poke was better",
    "wrong": "gave another answer than the likeliest",
    "silence": "never answered",
}
"""The kinds of mistakes in Which is Heavier; any block that is not known is as good as another."""
_HATCHES = (None, "///", "...", "xx", "++")


def load(results: base.Results):
    """Returns a row for each agent: its `share` of the ideal's return and the `error` of that.

    In Which is Heavier it has the mean cost of each kind of mistake, too. The attribute `towers` has the summaries of
    `search.curve` by the label of a task from features.

    Raises:
      ValueError: if no agents have been trained and evaluated.
    """
    rows = []
    for wanted, hidden in ((conditions.HEAVIER, ["actions", "masses"]), (conditions.TOWERS, [])):
        for names, condition, its in results.agents([base.EVALUATION], wanted, ["reward", "length", *hidden]):
            share = ideal_towers.share(its, ideal_towers.ideal_return(condition, results))
            rows.append(names | share | (_costs(condition, its) if hidden else {}))
    frame = results.frame(rows)
    shown = [task for task in conditions.TOWERS if task.observations == "features"]
    frame.attrs["towers"] = {task.label: ideal_towers.curve(task, results) for task in shown}
    return frame


def _costs(condition: conditions.Condition, episodes) -> dict[str, float]:
    """Returns the mean cost of an agent's mistakes, by kind."""
    actions = list(episodes.actions)
    judged = condition.ideal().judge_all(np.stack(episodes.masses.to_numpy()), actions)
    costs = mistakes.of_episodes(judged, actions, condition.agent.discount)
    return {kind: float(cost.mean()) for kind, cost in costs.items()}


def _best(agents) -> estimates.Estimate:
    best = agents.loc[agents.share.idxmax()]
    return estimates.normal(best.share, best.error)


_mean_share = claims.of_rows(lambda agents: estimates.mean(agents.share))


def draw(agents):
    """Draws returns as shares of the ideal's, losses by kind, and the time to know a tower by resolution."""
    figure, (left, middle, right) = plots.new(columns=3, width=2.9, height=3.1)
    shares = {name: its.share for name, its in agents.groupby("condition", sort=False)}
    for place, its in enumerate(shares.values()):
        left.plot([place] * len(its), its, "o", color=plots.COLORS[1], markersize=2.5, alpha=0.6)
    plots.reference(left, 1.0, "ideal", at=0.35)
    left.set_xticks(range(len(shares)), [conditions.tick(name) for name in shares], rotation=90)
    left.set(ylabel="discounted return, share of the ideal's")
    _draw_costs(middle, agents)
    _draw_resolutions(right, agents.attrs["towers"])
    return figure


def _draw_costs(axes, agents) -> None:
    heavier = agents[agents.condition.isin([condition.label for condition in conditions.HEAVIER])]
    if heavier.empty:
        axes.set_axis_off()
        return
    means = heavier.groupby("condition", sort=False)[list(_WORDS)].mean()
    ticks = [conditions.tick(name) for name in means.index]
    bottom = np.zeros(len(means))
    for number, (kind, words) in enumerate(_WORDS.items()):
        if (means[kind] > 1e-4).any():
            style: dict[str, Any] = dict(hatch=_HATCHES[number], edgecolor="white", linewidth=0.3)
            axes.bar(ticks, means[kind], bottom=bottom, color=plots.COLORS[1 + number], label=words, **style)
        bottom = bottom + means[kind].to_numpy()
    axes.set(ylabel="return lost against the ideal", ylim=(0, 1.35 * bottom.max()))
    axes.tick_params(axis="x", rotation=90)
    axes.legend(fontsize=5.5, loc="upper left", bbox_to_anchor=(0, 1.18))


def _draw_resolutions(axes, towers: dict[str, list[dict]]) -> None:
    for number, (task, summaries) in enumerate(towers.items()):
        rows = [row for row in summaries if row["objective"] == "time" and row["value"] is not None]
        millimetres = [max(row["resolution"], 3e-4) * 1e3 for row in rows]
        style: dict[str, Any] = dict(linestyle=plots.DASHES[number], marker=plots.MARKERS[number], markersize=3.5)
        style |= dict(color=plots.COLORS[number], label=conditions.tick(task))
        axes.plot(millimetres, [row["mean_seconds"] for row in rows], **style)
    axes.set(xscale="log", xlabel="resolution, mm (leftmost: every bit)")
    axes.set(ylabel="least expected time to know, s", ylim=(0, None))
    axes.legend(loc="upper left")


EXPERIMENTS = {
    "ideal_gap": base.Experiment(
        **claims.described("ideal_gap"),
        conditions=CONDITIONS,
        trials=(base.EVALUATION,),
        prepare=ideal_towers.prepare,
        load=load,
        statistics={
            "near_ideal_if_hard": _mean_share,
            "near_ideal": _mean_share,
            "none_better": claims.of_rows(_best),
        },
        draw=draw,
    )
}
