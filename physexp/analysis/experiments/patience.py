"""The price of information (paper, Section 5.3): where waiting costs less, agents experiment for longer."""

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.domains import which_is_heavier
from physexp.analysis.experiments import base, claims, conditions, population

_DISCOUNTS = (which_is_heavier.DOMAIN.discount, conditions.PATIENT_DISCOUNT)
CONDITIONS = (*population.CONDITIONS, *conditions.PATIENT)


def load(results: base.Results):
    """Interactions of each episode under both discounts; the column `discount` is rounded to their digits."""
    frame = results.episodes([base.LEARNED], CONDITIONS, ["interactions"])
    return frame.assign(discount=frame.discount.astype(float).round(3))


def _means(frame, condition: str, discount: float):
    """Returns mean interactions of each agent of a condition."""
    rows = frame[(frame.condition == condition) & (frame.discount == discount)]
    return rows.groupby("training_seed").interactions.mean()


def find_claims(frame) -> list[claims.Claim]:
    """At every difficulty the patient agents poke more."""
    found = []
    for condition in frame.condition.unique():
        eager, patient = (_means(frame, condition, discount) for discount in _DISCOUNTS)
        if len(eager) and len(patient):
            found.append(
                claims.Claim(
                    text="A larger discount leads to longer episodes",
                    section="5.3",
                    condition=condition,
                    statistic="pokes before the answer, gamma {1:g} over {0:g}, ratio of geometric means".format(
                        *_DISCOUNTS
                    ),
                    estimate=estimates.ratio_of_means(patient, eager),
                    above=1,
                    words="encourages the agents to gather more information [...], leading to longer episodes",
                )
            )
    return found


def draw(frame):
    """Mean pokes of each agent under both discounts, and the ideal experimenter's."""
    names = list(frame.condition.unique())
    figure, axes = plots.new(width=3.6, height=2.4)
    places = np.arange(len(names))
    for number, (discount, shift) in enumerate(zip(_DISCOUNTS, (-0.2, 0.2), strict=True)):
        color = plots.COLORS[1 + number]
        means = [_means(frame, name, discount) for name in names]
        axes.bar(places + shift, [mean.mean() for mean in means], 0.36, color=color, label=f"γ = {discount:g}")
        for place, mean in zip(places + shift, means, strict=True):
            axes.plot([place] * len(mean), mean, "o", color="black", markersize=1.6, alpha=0.6)
        for place, name in zip(places, names, strict=True):
            (difficulty,) = frame.difficulty[frame.condition == name].unique()
            best = conditions.heavier_ideal(float(difficulty), discount).figures()["mean_interactions"]
            ends = [place + shift - 0.18, place + shift + 0.18]
            axes.plot(ends, [best] * 2, "k", linestyle=plots.DASHES[2], label=None if number or place else "ideal")
    axes.set_xticks(places, [conditions.tick(name).replace(", ", "\n") for name in names])
    axes.set_ylabel("pokes before the answer")
    axes.legend()
    return figure


EXPERIMENT = base.Experiment(
    name="patience",
    title="The price of information",
    section="5.3",
    caption="How often agents poke before they answer when waiting is dear and when it is cheap, features; at least "
    "10,000 test steps of each agent. Dots: single agents. Dotted lines: the ideal experimenter.",
    conditions=CONDITIONS,
    trials=(base.LEARNED,),
    load=load,
    claims=find_claims,
    draw=draw,
)
