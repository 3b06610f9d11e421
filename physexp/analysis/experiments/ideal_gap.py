"""The return of every agent against the ideal experimenter's, and the kinds of loss (ours; docs/ideal.md)."""

import dataclasses
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, ideal_towers
from physexp.analysis.ideal import mistakes
from physexp.analysis.training import records

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


@dataclasses.dataclass(frozen=True)
class Gap:
    """Agents and ideal experimenters.

    Attributes:
      agents: a row for each condition and training_seed: the `share` of the ideal's return, the standard `error` of
        that, and in Which is Heavier the mean cost of each kind of mistake.
      towers: the summaries of `search.curve` by task.
    """

    agents: Any
    towers: dict[str, list[dict]]


def load(results: base.Results) -> Gap:
    """Returns the agents that have been trained and evaluated.

    Raises:
      ValueError: if there are none.
    """
    import pandas

    rows = []
    towers = ideal_towers.read(results)
    for wanted, hidden in ((conditions.HEAVIER, ["actions", "masses"]), (conditions.TOWERS, [])):
        for condition, seed, episodes in results.agents(base.EVALUATION, wanted, ["reward", "length", *hidden]):
            value = ideal_towers.ideal_return(condition, results)
            returns = records.discounted_return(episodes)
            error = float(returns.std(ddof=1)) / np.sqrt(len(returns))
            row = {"share": float(returns.mean()) / value, "error": error / value}
            row |= {"condition": condition.label, "training_seed": seed}
            rows.append(row | _costs(condition, episodes) if hidden else row)
    if not rows:
        raise results.lacks("episodes")
    return Gap(pandas.DataFrame(rows), towers)


def _costs(condition, episodes) -> dict[str, float]:
    """Returns the mean cost of an agent's mistakes, by kind."""
    actions = list(episodes.actions)
    judged = conditions.ideal(condition).judge_all(np.stack(episodes.masses.to_numpy()), actions)
    costs = mistakes.of_episodes(judged, actions, condition.agent.discount)
    return {kind: float(cost.mean()) for kind, cost in costs.items()}


def median_of_better_half(shares: np.ndarray) -> float:
    """Returns the median of the larger half of some values."""
    return float(np.median(shares[estimates.better_half(shares)]))


def _better_half(gap: Gap, condition: str) -> estimates.Estimate | None:
    shares = gap.agents.share[gap.agents.condition == condition]
    return estimates.bootstrap(shares.to_numpy(), median_of_better_half) if len(shares) else None


def _best(gap: Gap, condition: str) -> estimates.Estimate | None:
    agents = gap.agents[gap.agents.condition == condition]
    if not len(agents):
        return None
    best = agents.loc[agents.share.idxmax()]
    return estimates.normal(best.share, best.error)


def draw(gap: Gap):
    """Draws returns as shares of the ideal's, losses by kind, and the time to know a tower by resolution."""
    figure, (left, middle, right) = plots.new(columns=3, width=2.9, height=3.1)
    shares = {name: agents.share for name, agents in gap.agents.groupby("condition", sort=False)}
    for place, its in enumerate(shares.values()):
        left.plot([place] * len(its), its, "o", color=plots.COLORS[1], markersize=2.5, alpha=0.6)
    plots.reference(left, 1.0, "ideal", at=0.35)
    left.set_xticks(range(len(shares)), [conditions.tick(name) for name in shares], rotation=90)
    left.set(ylabel="discounted return, share of the ideal's")
    _draw_costs(middle, gap.agents)
    _draw_resolutions(right, gap.towers)
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
    axes.set(ylabel="return lost against the ideal")
    axes.tick_params(axis="x", rotation=90)
    axes.legend(fontsize=5.5, loc="upper left", bbox_to_anchor=(0, 1.18))
    axes.set_ylim(0, 1.35 * bottom.max())


def _draw_resolutions(axes, towers: dict[str, list[dict]]) -> None:
    tasks = [each.task for each in conditions.TOWERS if conditions.observations(each) == "features"]
    for number, task in enumerate(tasks):
        rows = [row for row in towers[task] if row["objective"] == "time" and row["value"] is not None]
        millimetres = [max(row["resolution"], 3e-4) * 1e3 for row in rows]
        color, dashes, marker = plots.COLORS[number], plots.DASHES[number], plots.MARKERS[number]
        label = conditions.tick(conditions.label("towers", task))
        style: dict[str, Any] = dict(color=color, linestyle=dashes, marker=marker, markersize=3.5)
        axes.plot(millimetres, [row["mean_seconds"] for row in rows], label=label, **style)
    axes.set(
        xscale="log",
        xlabel="resolution, mm (leftmost: every bit)",
        ylabel="least expected time to know, s",
        ylim=(0, None),
    )
    axes.legend(loc="upper left")


EXPERIMENTS = {
    "ideal_gap": base.Experiment(
        **claims.described("ideal_gap"),
        conditions=CONDITIONS,
        trials=(base.EVALUATION,),
        prepare=ideal_towers.prepare,
        load=load,
        statistics={"near_ideal_if_hard": _better_half, "near_ideal": _better_half, "none_better": _best},
        draw=draw,
    )
}
