"""The number of interactions before the answer (paper, Sections 5.3 and 6.3; Figures 3, left, 4 and 7).

It depends on the difficulty and the discount, and is compared with that of randomized interaction.
"""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.domains import which_is_heavier
from physexp.analysis.experiments import base, claims, conditions, ideal_towers, mass_gaps

FEATURES = tuple(condition for condition in conditions.HEAVIER if condition.task == "features")
TRIALS = (base.LEARNED, base.RANDOM)
DISCOUNTS = (which_is_heavier.DOMAIN.discount, conditions.PATIENT_DISCOUNT)

_ALL_BLOCKS = 4
_SHORT = 30  # Interactions; few episodes are longer.
_LONGEST = 10  # Interactions shown.


# Population: all agents of a difficulty together.


def _share_short(frame) -> estimates.Estimate:
    is_short = frame.interactions < _SHORT
    return estimates.mean_share(is_short.groupby([frame.condition, frame.training_seed]).mean())


def _mean_pokes(rows) -> estimates.Estimate:
    return estimates.mean(rows.groupby("training_seed").interactions.mean())


def _share_of_all_blocks(rows) -> estimates.Estimate:
    return estimates.mean_share((rows.interactions >= _ALL_BLOCKS).groupby(rows.training_seed).mean())


def _draw_population(frame):
    """Draws a histogram for each difficulty, the ideal experimenter's beside it."""
    present = [beta for beta in conditions.DIFFICULTIES if (frame.difficulty == beta).any()]
    figure, panels = plots.new(columns=len(present), width=2.2, height=2.2, sharey=True, squeeze=False)
    bins = np.arange(_LONGEST + 1)
    for number, (axes, beta) in enumerate(zip(panels[0], present, strict=True)):
        pokes = frame.interactions[frame.difficulty == beta].clip(upper=_LONGEST)
        shares = np.bincount(pokes, minlength=len(bins)) / len(pokes)
        axes.bar(bins, shares, color=plots.COLORS[number], width=0.8, alpha=0.75, label="agents")
        histogram = conditions.heavier_ideal(beta).figures()["histogram"]
        best = [histogram.get(pokes, 0.0) for pokes in bins]
        axes.stairs(best, np.arange(len(bins) + 1) - 0.5, color=plots.GREY, linewidth=1.3, label="ideal")
        plots.reference(axes, _ALL_BLOCKS, "all blocks" if beta == present[-1] else "", vertical=True)
        axes.set(xlabel="pokes before the answer", title=f"β = {beta:g}", xticks=bins[::2])
        axes.set_xticklabels([*bins[:-1:2], f"≥{_LONGEST}"])
    panels[0, 0].set_ylabel("share of episodes")
    panels[0, -1].legend(loc="upper right")
    figure.suptitle(plots.seeds(frame), fontsize=7, x=0.99, ha="right")
    return figure


# Two groups of each agent or condition beside each other: two discounts, or learned and randomized interaction.


def _draw_bars(axes, names: Sequence[str], groups: Mapping[str, Sequence[np.ndarray]], ideals, styles) -> None:
    """Draws means as bars, agents as dots, and the ideal's values, [groups, conditions], as dotted lines.

    The groups have the values of agents for each condition; the styles are a color and a hatch for each group.
    """
    for name, best, (color, hatch), shift in zip(groups, ideals, styles, (-0.2, 0.2), strict=True):
        places = np.arange(len(names)) + shift
        means = [values.mean() for values in groups[name]]
        style: dict[str, Any] = dict(color=color, hatch=hatch, edgecolor="white", linewidth=0.3)
        axes.bar(places, means, 0.38, label=name, **style)
        for place, values in zip(places, groups[name], strict=True):
            axes.plot([place] * len(values), values, "o", color="black", markersize=1.6, alpha=0.6)
        for number, (place, level) in enumerate(zip(places, best, strict=True)):
            label = None if number or shift > 0 else "ideal"
            axes.plot([place - 0.18, place + 0.18], [level] * 2, "k", linestyle=plots.DASHES[2], label=label)
    ticks = [conditions.tick(name).replace(", ", "\n") for name in names]
    axes.set_xticks(np.arange(len(names)), ticks, fontsize=6.5)


# Patience: where waiting costs less.


def load_patience(results: base.Results):
    """Returns the interactions of each episode under both discounts; `discount` is rounded to their digits."""
    frame = results.episodes([base.LEARNED], (*FEATURES, *conditions.PATIENT), ["interactions"])
    return frame.assign(discount=frame.discount.astype(float).round(3))


def _pokes(rows, discount: float):
    """Returns the mean pokes of each agent with a discount."""
    return rows[rows.discount == discount].groupby("training_seed").interactions.mean()


def _patient_over_eager(frame, condition: str) -> estimates.Estimate | None:
    eager, patient = (_pokes(frame[frame.condition == condition], discount) for discount in DISCOUNTS)
    return estimates.ratio_of_means(patient, eager) if len(eager) and len(patient) else None


def _draw_patience(frame):
    """Draws the mean pokes of each agent under both discounts, and the ideal experimenter's."""
    by_name = dict(list(frame.groupby("condition", sort=False)))
    figure, axes = plots.new(width=3.6, height=2.4)
    groups = {f"γ = {discount:g}": [_pokes(rows, discount) for rows in by_name.values()] for discount in DISCOUNTS}
    betas = [float(rows.difficulty.iloc[0]) for rows in by_name.values()]
    ideals = [
        [conditions.heavier_ideal(beta, discount).figures()["mean_interactions"] for beta in betas]
        for discount in DISCOUNTS
    ]
    _draw_bars(axes, list(by_name), groups, ideals, [(color, None) for color in plots.COLORS[1:3]])
    axes.set_ylabel("pokes before the answer")
    axes.legend()
    return figure


# Learned against randomized interaction.


@dataclasses.dataclass(frozen=True)
class Played:
    """Agents with both interactions, and ideal experimenters.

    Attributes:
      agents: a row for each condition, training_seed and interaction, see `per_agent`.
      ideals: the summary of the ideal experimenter of each condition.
      chance: the share of right answers of a random label.
    """

    agents: Any
    ideals: Mapping[str, Mapping[str, float]]
    chance: float


def load_heavier(results: base.Results) -> Played:
    """Returns the agents in Which is Heavier."""
    columns = ["label", "reward", "interactions", "actions"]
    episodes = mass_gaps.with_blocks(results.episodes(TRIALS, conditions.HEAVIER, columns))
    ideals = {config.label: conditions.ideal(config).figures() for config in conditions.HEAVIER}
    return Played(per_agent(episodes), ideals, conditions.chance("which_is_heavier", "features"))


def load_towers(results: base.Results) -> Played:
    """Returns the agents in Towers."""
    episodes = results.episodes(TRIALS, conditions.TOWERS, ["label", "reward", "interactions"])
    chance = conditions.chance("towers", conditions.TOWERS[0].task)
    return Played(per_agent(episodes), ideal_towers.summaries(results), chance)


def per_agent(episodes):
    """Returns a row for each condition, agent and interaction.

    The columns are the share of `timeouts`, and of the answered episodes, as in the paper, the accuracy and the mean
    numbers of interactions and, if counted, of blocks.
    """
    keys = ["condition", "training_seed", "interaction"]
    names = ["timeouts", "accuracy", *(name for name in ("interactions", "blocks") if name in episodes)]
    rows = episodes.assign(timeouts=episodes.label < 0, accuracy=episodes.reward > 0)
    rows[names[1:]] = rows[names[1:]].where(~rows.timeouts)
    return rows.groupby(keys, sort=False, observed=True)[names].mean().reset_index()


def _pairs(played: Played, condition: str, column: str) -> tuple[np.ndarray, np.ndarray]:
    """Returns a column for each agent of a condition with learned and with randomized interaction."""
    agents = played.agents[played.agents.condition == condition]
    table = agents.pivot(index="training_seed", columns="interaction", values=column).dropna()
    return table["learned"].to_numpy(), table["random"].to_numpy()


def _of_pairs(column: str, compare: Callable[..., estimates.Estimate]) -> claims.Statistic:
    """Returns the statistic that compares a column with learned interaction to that with randomized interaction."""

    def compared(played: Played, condition: str) -> estimates.Estimate | None:
        is_there = (played.agents.condition == condition).any()
        return compare(*_pairs(played, condition, column)) if is_there else None

    return compared


def _ratio_over_conditions(played: Played) -> estimates.Estimate | None:
    names = played.agents.condition.unique()
    if len(names) < len(conditions.HEAVIER):
        return None
    ratios = [estimates.ratio_of_pairs(*_pairs(played, name, "interactions")).value for name in names]
    return estimates.geometric_mean(ratios)


def _timeouts(played: Played, condition: str) -> estimates.Estimate | None:
    agents = played.agents
    shares = agents.timeouts[(agents.condition == condition) & (agents.interaction == "random")]
    return estimates.mean_share(shares) if len(shares) else None


def _draw_played(played: Played):
    """Draws lengths at the left and accuracies at the right."""
    agents = played.agents
    names = [name for name in played.ideals if name in set(agents.condition)]
    figure, panels = plots.new(columns=2, width=3.4, height=2.4)
    styles = ((plots.COLORS[1], None), (plots.COLORS[5], "///"))
    for axes, column, best in zip(panels, ("interactions", "accuracy"), ("mean_interactions", "accuracy"), strict=True):
        groups = {}
        for interaction in ("learned", "random"):
            its = agents[agents.interaction == interaction]
            groups[interaction] = [its[its.condition == name][column] for name in names]
        _draw_bars(axes, names, groups, [[played.ideals[name][best] for name in names]] * 2, styles)
    panels[0].set(ylabel="interactions before the answer")
    panels[1].set(ylabel="share of right answers", ylim=(0, 1.05))
    plots.reference(panels[1], played.chance, "chance")
    panels[0].legend(loc="upper right", bbox_to_anchor=(1, 1.12), ncols=3, fontsize=6.5)
    return figure


_RANDOMIZED = {
    "more_accurate": _of_pairs("accuracy", lambda learned, random: estimates.mean(learned - random)),
    "no_timeouts": _timeouts,
}

EXPERIMENTS = {
    "population": base.Experiment(
        **claims.described("population"),
        conditions=FEATURES,
        trials=(base.LEARNED,),
        load=lambda results: results.episodes([base.LEARNED], FEATURES, ["interactions"]),
        statistics={
            "few_if_easy": claims.of_rows(_mean_pokes),
            "all_if_hard": claims.of_rows(_share_of_all_blocks),
            "short": claims.of_all(_share_short),
        },
        draw=_draw_population,
    ),
    "patience": base.Experiment(
        **claims.described("patience"),
        conditions=(*FEATURES, *conditions.PATIENT),
        trials=(base.LEARNED,),
        load=load_patience,
        statistics={"longer_if_patient": _patient_over_eager},
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
            "no_bias": claims.of_all(_ratio_over_conditions),
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
