"""The number of interactions before the answer (paper, Sections 5.3 and 6.3; Figures 3, left, 4 and 7).

It depends on the difficulty and the discount, and is compared with that of randomized interaction.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves, ideal_towers, mass_gaps

TRIALS = (base.LEARNED, base.RANDOM)

_ALL_BLOCKS = 4
_SHORT = 30  # Interactions; few episodes are longer.
_LONGEST = 10  # Interactions shown.


# Population: all agents of a difficulty together.


def load_population(results: base.Results):
    """Returns episodes; the attribute `ideal` has the ideal's shares of episodes by interactions, by condition."""
    frame = results.episodes([base.LEARNED], conditions.FEATURES, ["interactions"])
    frame.attrs["ideal"] = {each.label: each.ideal().figures()["histogram"] for each in conditions.FEATURES}
    return frame


def _share_short(frame, condition: str) -> estimates.Estimate:
    is_short = frame.interactions < _SHORT
    return estimates.mean_share(is_short.groupby([frame.condition, frame.training_seed]).mean())


def _draw_population(frame):
    """Draws a histogram for each difficulty, the ideal experimenter's beside it."""
    shown = [each for each in conditions.FEATURES if (frame.condition == each.label).any()]
    figure, panels = plots.new(columns=len(shown), width=2.2, height=2.2, sharey=True, squeeze=False)
    ticks = np.arange(0, _LONGEST + 1, 2)
    for number, (axes, each) in enumerate(zip(panels[0], shown, strict=True)):
        pokes = frame.interactions[frame.condition == each.label].clip(upper=_LONGEST)
        curves.draw_histogram(axes, pokes, frame.attrs["ideal"][each.label], _LONGEST + 1, plots.COLORS[number])
        plots.reference(axes, _ALL_BLOCKS, "all blocks" if each is shown[-1] else "", vertical=True)
        title = f"β = {each.task_kwargs['difficulty']:g}"
        axes.set(xlabel="pokes before the answer", title=title, xticks=ticks)
        axes.set_xticklabels([*ticks[:-1], f"≥{_LONGEST}"])
    panels[0, 0].set_ylabel("share of episodes")
    panels[0, -1].legend(loc="upper right")
    figure.suptitle(plots.seeds(frame), fontsize=7, x=0.99, ha="right")
    return figure


# Two groups of each agent or condition beside each other: two discounts, or learned and randomized interaction.


def _draw_bars(axes, agents, group: str, column: str, styles: Mapping[Any, tuple[str, str, str | None]]) -> None:
    """Draws means as bars, agents as dots, and the ideal's values, in the column `ideal_COLUMN`, as dotted lines.

    The styles are a label, a color and a hatch for each of two values of the column `group`.
    """
    names = list(agents.condition.unique())
    for (value, (label, color, hatch)), shift in zip(styles.items(), (-0.2, 0.2), strict=True):
        by_name = agents[agents[group] == value].groupby("condition", sort=False)
        places = [names.index(name) + shift for name in by_name.groups]
        style: dict[str, Any] = dict(color=color, hatch=hatch, edgecolor="white", linewidth=0.3)
        axes.bar(places, by_name[column].mean(), 0.38, label=label, **style)
        for place, (_, its) in zip(places, by_name, strict=True):
            axes.plot([place] * len(its), its[column], "o", color="black", markersize=1.6, alpha=0.6)
        for number, (place, level) in enumerate(zip(places, by_name[f"ideal_{column}"].first(), strict=True)):
            named = None if number or shift > 0 else "ideal"
            axes.plot([place - 0.18, place + 0.18], [level] * 2, "k", linestyle=plots.DASHES[2], label=named)
    ticks = [conditions.tick(name).replace(", ", "\n") for name in names]
    axes.set_xticks(np.arange(len(names)), ticks, fontsize=6.5)


# Patience: where waiting costs less.

EAGER, PATIENT = "γ = 0.95", "γ = 0.99"
PATIENCE = tuple(
    condition.changed(player=player)
    for player, group in ((EAGER, conditions.FEATURES), (PATIENT, conditions.PATIENT))
    for condition in group
)


def load_patience(results: base.Results):
    """Returns the mean interactions of each agent under both discounts, and the ideal's, `ideal_interactions`."""
    episodes = results.episodes([base.LEARNED], PATIENCE, ["interactions"])
    agents = episodes.groupby(["condition", "player", "training_seed"], sort=False).interactions.mean().reset_index()
    ideals = {(each.label, each.player): each.ideal().figures()["mean_interactions"] for each in PATIENCE}
    return agents.assign(ideal_interactions=[ideals[key] for key in zip(agents.condition, agents.player, strict=True)])


def _patient_over_eager(agents) -> estimates.Estimate:
    return estimates.ratio_of_means(*(claims.rows(agents, player=player).interactions for player in (PATIENT, EAGER)))


def _draw_patience(agents):
    """Draws the mean pokes of each agent under both discounts, and the ideal experimenter's."""
    figure, axes = plots.new(width=3.6, height=2.4)
    styles = {EAGER: (EAGER, plots.COLORS[1], None), PATIENT: (PATIENT, plots.COLORS[2], None)}
    _draw_bars(axes, agents, "player", "interactions", styles)
    axes.set_ylabel("pokes before the answer")
    axes.legend()
    return figure


# Learned against randomized interaction.


def load_heavier(results: base.Results):
    """Returns the agents in Which is Heavier; see `per_agent`."""
    columns = ["label", "reward", "interactions", "actions"]
    episodes = mass_gaps.with_blocks(results.episodes(TRIALS, conditions.HEAVIER, columns))
    return per_agent(episodes, {each.label: each.ideal().figures() for each in conditions.HEAVIER})


def load_towers(results: base.Results):
    """Returns the agents in Towers; see `per_agent`."""
    episodes = results.episodes(TRIALS, conditions.TOWERS, ["label", "reward", "interactions"])
    return per_agent(episodes, {each.label: ideal_towers.best(each, results) for each in conditions.TOWERS})


def per_agent(episodes, ideals: Mapping[str, Mapping[str, float]]):
    """Returns a row for each condition, agent and interaction.

    The columns are the share of `timeouts`, and of the answered episodes, as in the paper, the accuracy and the mean
    numbers of interactions and, if counted, of blocks; and `ideal_accuracy` and `ideal_interactions`.
    """
    keys = ["condition", "training_seed", "interaction"]
    names = ["timeouts", "accuracy", *(name for name in ("interactions", "blocks") if name in episodes)]
    rows = episodes.assign(timeouts=episodes.label < 0, accuracy=episodes.reward > 0)
    rows[names[1:]] = rows[names[1:]].where(~rows.timeouts)
    agents = rows.groupby(keys, sort=False, observed=True)[names].mean().reset_index()
    return agents.assign(
        ideal_accuracy=[ideals[name]["accuracy"] for name in agents.condition],
        ideal_interactions=[ideals[name]["mean_interactions"] for name in agents.condition],
    )


def _pairs(rows, column: str) -> tuple[np.ndarray, np.ndarray]:
    """Returns a column for each agent of a condition with learned and with randomized interaction."""
    values = claims.by_agent(rows, "interaction", column).dropna()
    return values["learned"].to_numpy(), values["random"].to_numpy()


def _of_pairs(column: str, compare: Callable[..., estimates.Estimate]) -> claims.Statistic:
    """Returns the statistic that compares a column with learned interaction to that with randomized interaction."""
    return claims.of_rows(lambda rows: compare(*_pairs(rows, column)))


def _ratio_over_conditions(agents, condition: str) -> estimates.Estimate:
    groups = [claims.rows(agents, condition=each.label) for each in conditions.HEAVIER]
    return estimates.geometric_mean([estimates.ratio_of_pairs(*_pairs(its, "interactions")).value for its in groups])


def _draw_played(agents):
    """Draws lengths at the left and accuracies at the right."""
    figure, panels = plots.new(columns=2, width=3.4, height=2.4)
    styles = {"learned": ("learned", plots.COLORS[1], None), "random": ("random", plots.COLORS[5], "///")}
    for axes, column in zip(panels, ("interactions", "accuracy"), strict=True):
        _draw_bars(axes, agents, "interaction", column, styles)
    panels[0].set(ylabel="interactions before the answer")
    panels[1].set(ylabel="share of right answers", ylim=(0, 1.05))
    plots.reference(panels[1], conditions.BY_LABEL[agents.condition.iloc[0]].chance, "chance")
    panels[0].legend(loc="upper right", bbox_to_anchor=(1, 1.12), ncols=3, fontsize=6.5)
    return figure


_RANDOMIZED = {
    "more_accurate": _of_pairs("accuracy", lambda learned, random: estimates.mean(learned - random)),
    "no_timeouts": claims.of_rows(
        lambda agents: estimates.mean_share(claims.rows(agents, interaction="random").timeouts)
    ),
}

EXPERIMENTS = {
    "population": base.Experiment(
        **claims.described("population"),
        conditions=conditions.FEATURES,
        trials=(base.LEARNED,),
        load=load_population,
        statistics={
            "few_if_easy": claims.mean_of_agents(lambda rows: rows.interactions, estimates.mean),
            "all_if_hard": claims.mean_of_agents(lambda rows: rows.interactions >= _ALL_BLOCKS, estimates.mean_share),
            "short": _share_short,
        },
        draw=_draw_population,
    ),
    "patience": base.Experiment(
        **claims.described("patience"),
        conditions=PATIENCE,
        trials=(base.LEARNED,),
        load=load_patience,
        statistics={"longer_if_patient": claims.of_rows(_patient_over_eager)},
        draw=_draw_patience,
    ),
    "random_heavier": base.Experiment(
        **claims.described("random_heavier"),
        conditions=conditions.HEAVIER,
        trials=TRIALS,
        load=load_heavier,
        statistics={
            **_RANDOMIZED,
            "as_long": _of_pairs("interactions", estimates.ratio_of_pairs),
            "no_bias": _ratio_over_conditions,
            "as_many_blocks": _of_pairs("blocks", estimates.ratio_of_pairs),
        },
        draw=_draw_played,
    ),
    "random_towers": base.Experiment(
        **claims.described("random_towers"),
        conditions=conditions.TOWERS,
        trials=TRIALS,
        prepare=ideal_towers.prepare,
        load=load_towers,
        statistics={**_RANDOMIZED, "quicker": _of_pairs("interactions", estimates.ratio_of_pairs)},
        draw=_draw_played,
    ),
}
