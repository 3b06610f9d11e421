"""Randomized interaction in Towers (paper, Section 6.3; Figure 7)."""

from physexp.analysis.experiments import base, claims, conditions, ideal_towers, randomized


def load(results: base.Results):
    """Episodes of both interactions; the ideal experimenters are in the frame's `attrs`."""
    frame = randomized.load(results, conditions.TOWERS)
    frame.attrs["ideal"] = ideal_towers.summaries(results)
    return frame


def find_claims(frame) -> list[claims.Claim]:
    """More accurate and quicker in all four."""
    return randomized.find_claims(
        frame,
        "6.3",
        text="Agents tend to answer more quickly when following their learned interaction",
        statistic="interactions before an answer, learned over randomized, mean ratio of agents",
        below=1,
        words="tend to produce labels more quickly",
    )


EXPERIMENT = base.Experiment(
    name="random_towers",
    title="Randomized interaction, Towers",
    section="6.3, Figure 7",
    caption="Interactions and accuracy of agents that choose their interactions, and of the same agents when these are "
    "drawn at random. Timeouts left out. Dots: single agents. Dotted lines: the ideal experimenter, which sees "
    "every bit.",
    conditions=conditions.TOWERS,
    trials=randomized.TRIALS,
    prepare=ideal_towers.prepare,
    load=load,
    claims=find_claims,
    draw=lambda frame: randomized.draw(frame, conditions.TOWERS, frame.attrs["ideal"]),
)
