"""Learned against randomized interaction: what the two experiments share."""

from collections.abc import Mapping, Sequence

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions
from physexp.analysis.training import config as config_lib

TRIALS = (base.LEARNED, base.RANDOM)
_FEW = 0.1  # Of the episodes.


def load(results: base.Results, configs: Sequence[config_lib.TrainConfig], columns: Sequence[str] = ()):
    """Episodes of both interactions; `columns` are wanted beside those that every claim here needs."""
    return results.episodes(TRIALS, configs, ["label", "reward", "interactions", "time", *columns])


def per_agent(frame):
    """For each condition, agent and interaction: accuracy (timeouts left out, as in the paper) and means.

    The means are those of `interactions` before an answer, and of the `blocks` looked at, where counted.
    """
    answered = frame[frame.label >= 0]
    keys = ["condition", "training_seed", "interaction"]
    grouped = answered.assign(right=answered.reward > 0).groupby(keys, sort=False)
    means = {name: (name, "mean") for name in ("interactions", "blocks") if name in frame}
    return grouped.agg(accuracy=("right", "mean"), **means).reset_index()


def timeouts(frame):
    """Returns the share of episodes without an answer, a column for each condition and a row for each agent."""
    rows = frame.assign(is_silent=frame.label < 0)
    return rows.pivot_table("is_silent", "training_seed", "condition", sort=False, observed=True)


def paired(agents, condition: str, column: str) -> tuple[np.ndarray, np.ndarray]:
    """Values of each agent of a condition with learned and with randomized interaction."""
    table = agents[agents.condition == condition].pivot(index="training_seed", columns="interaction", values=column)
    table = table.dropna()
    return table["learned"].to_numpy(), table["random"].to_numpy()


def find_claims(frame, section: str, **of_lengths) -> list[claims.Claim]:
    """In each condition the learned interaction is more accurate; `of_lengths` is the claim of how long it takes."""
    agents = per_agent(frame)
    names = agents.condition.unique()
    accurate = [
        claims.Claim(
            text="Learned interaction leads to more accurate answers than randomized interaction",
            section=section,
            condition=name,
            statistic="difference of the shares of right answers, mean of agents",
            estimate=estimates.mean(np.subtract(*paired(agents, name, "accuracy"))),
            above=0,
        )
        for name in names
    ]
    lengths = {name: estimates.ratio_of_pairs(*paired(agents, name, "interactions")) for name in names}
    silent = timeouts(frame[frame.interaction == "random"])
    return [
        *accurate,
        *(
            claims.Claim(section=section, condition=name, estimate=ratio, **of_lengths)
            for name, ratio in lengths.items()
        ),
        *(
            claims.Claim(
                text="Few episodes of randomized interaction, which are left out above, end by timeout",
                condition=name,
                statistic="share of episodes without an answer, mean of agents",
                estimate=estimates.mean_share(silent[name].dropna()),
                below=_FEW,
                reason="A fist that moves at random often does not reach the tower before time is over.",
            )
            for name in silent
        ),
    ]


def draw(frame, configs: Sequence[config_lib.TrainConfig], ideal: Mapping[str, Mapping[str, float]]):
    """Lengths at the left, accuracies at the right; `ideal` has the summary for each condition's label."""
    agents = per_agent(frame)
    names = [config.label for config in configs if config.label in set(agents.condition)]
    figure, panels = plots.new(columns=2, width=3.4, height=2.4)
    places = np.arange(len(names))
    for axes, column, best in zip(panels, ("interactions", "accuracy"), ("mean_interactions", "accuracy"), strict=True):
        for offset, interaction, color, hatch in (
            (-0.2, "learned", plots.COLORS[1], None),
            (0.2, "random", plots.COLORS[5], "///"),
        ):
            groups = [
                agents[(agents.condition == name) & (agents.interaction == interaction)][column] for name in names
            ]
            axes.bar(
                places + offset,
                [group.mean() for group in groups],
                0.38,
                color=color,
                hatch=hatch,
                edgecolor="white",
                linewidth=0.3,
                label=interaction,
            )
            for place, group in zip(places + offset, groups, strict=True):
                axes.plot([place] * len(group), group, "o", color="black", markersize=1.6, alpha=0.6)
        for place, name in zip(places, names, strict=True):
            axes.plot(
                [place - 0.42, place + 0.42],
                [ideal[name][best]] * 2,
                color="black",
                linewidth=1.2,
                linestyle=plots.DASHES[2],
                label="ideal" if place == 0 else None,
            )
        axes.set_xticks(places, [conditions.tick(name).replace(", ", "\n") for name in names], fontsize=6.5)
    panels[0].set(ylabel="interactions before the answer")
    panels[1].set(ylabel="share of right answers", ylim=(0, 1.05))
    plots.reference(panels[1], conditions.chance(configs[0].domain, configs[0].task), "chance")
    panels[0].legend(loc="upper right", bbox_to_anchor=(1, 1.12), ncols=3, fontsize=6.5)
    return figure
