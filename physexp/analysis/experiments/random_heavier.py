"""Randomized interaction in Which is Heavier (paper, Section 5.3; Figure 4)."""

import numpy as np

from physexp.analysis.data import estimates
from physexp.analysis.experiments import base, blocks, claims, conditions, randomized


def find_claims(frame) -> list[claims.Claim]:
    """More accurate in all six; lengths differ little and in no consistent direction; as many blocks are looked at."""
    found = randomized.find_claims(
        frame,
        "5.3",
        text="The effect of randomized interaction on episode length is small",
        statistic="pokes before an answer, learned over randomized, mean ratio of agents",
        above=0.67,
        below=1.5,
        words="the effect on episode length is small",
        reason="Our agents go on until they know: poked at random, they need more pokes to see as many blocks. That "
        "they look at about as many is tested below.",
    )
    agents = randomized.per_agent(frame)
    names = agents.condition.unique()
    if len(names) == len(conditions.HEAVIER):
        ratios = [estimates.ratio_of_pairs(*randomized.paired(agents, name, "interactions")).value for name in names]
        found.append(
            claims.Claim(
                text="Randomized interaction makes episodes neither longer nor shorter in all conditions",
                section="5.3",
                condition="all",
                statistic="pokes before an answer, learned over randomized, geometric mean of the conditions",
                estimate=estimates.ratio_of_pairs(ratios, np.ones(len(ratios))),
                above=0.8,
                below=1.25,
                words="no consistent bias towards longer or shorter episodes",
                reason="They are longer in all conditions, as above.",
            )
        )
    return found + [
        claims.Claim(
            text="Agents look at as many blocks when their pokes are drawn at random",
            condition=name,
            statistic="different blocks poked before an answer, learned over randomized, mean ratio of agents",
            estimate=estimates.ratio_of_pairs(*randomized.paired(agents, name, "blocks")),
            above=0.9,
            below=1.1,
        )
        for name in names
    ]


def load(results: base.Results):
    """Episodes of both interactions, with the number of `blocks` that were poked in each."""
    return blocks.counted(randomized.load(results, conditions.HEAVIER, ["actions"]))


def draw(frame):
    """Draws with the ideal experimenters."""
    ideal = {config.label: conditions.ideal(config).figures() for config in conditions.HEAVIER}
    return randomized.draw(frame, conditions.HEAVIER, ideal)


EXPERIMENT = base.Experiment(
    name="random_heavier",
    title="Randomized interaction, Which is Heavier",
    section="5.3, Figure 4",
    caption="Interactions and accuracy of agents that choose their pokes, and of the same agents when their pokes are "
    "drawn at random. Dots: single agents. Dotted lines: the ideal experimenter.",
    conditions=conditions.HEAVIER,
    trials=randomized.TRIALS,
    load=load,
    claims=find_claims,
    draw=draw,
)
