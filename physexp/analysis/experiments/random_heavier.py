"""Randomized interaction in Which is Heavier (paper, Section 5.3; Figure 4)."""

from physexp.analysis.experiments import base, claims, conditions, randomized


def find_claims(frame) -> list[claims.Claim]:
    """More accurate in all six; lengths differ little and in no consistent direction."""
    return randomized.find_claims(
        frame,
        "5.3",
        text="The effect of randomized interaction on episode length is small",
        statistic="pokes before an answer, learned over randomized, mean ratio of agents",
        above=0.67,
        below=1.5,
        reason="Our agents go on until they know: poked at random, they need more pokes to see every block, and wait "
        "for them, where the paper's answered after about as many as usual.",
    )


def draw(frame):
    """Draws with the ideal experimenters."""
    ideal = {config.label: conditions.ideal(config).summary() for config in conditions.HEAVIER}
    return randomized.draw(frame, conditions.HEAVIER, ideal)


EXPERIMENT = base.Experiment(
    name="random_heavier",
    title="Randomized interaction, Which is Heavier",
    section="5.3, Figure 4",
    caption="Interactions and accuracy of agents that choose their pokes, and of the same agents when their pokes are "
    "drawn at random. Dots: single agents. Dotted lines: the ideal experimenter.",
    conditions=conditions.HEAVIER,
    trials=randomized.TRIALS,
    load=lambda results: randomized.load(results, conditions.HEAVIER),
    claims=find_claims,
    draw=draw,
)
