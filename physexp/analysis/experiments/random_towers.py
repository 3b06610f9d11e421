"""Randomized interaction in Towers (paper, Section 6.3; Figure 7)."""

from physexp.analysis.experiments import base, claims, conditions, ideal_towers, randomized

_NAMES = [condition.label for condition in conditions.TOWERS]


def load(results: base.Results):
    """Episodes of both interactions; the ideal experimenters are in the frame's `attrs`."""
    frame = results.episodes([base.LEARNED, base.RANDOM], conditions.TOWERS, randomized.COLUMNS)
    frame.attrs["ideal"] = ideal_towers.lengths_and_accuracies(results)
    return frame


def find_claims(frame) -> list[claims.Claim]:
    """More accurate and quicker in all four."""
    found = randomized.more_accurate(frame, "6.3")
    for condition, ratio in randomized.length_ratios(frame).items():
        found.append(
            claims.Claim(
                text="Agents tend to answer more quickly when following their learned interaction",
                section="6.3",
                condition=condition,
                statistic="interactions before an answer, learned over randomized, mean ratio of agents",
                estimate=ratio,
                below=1,
            )
        )
    return found


EXPERIMENT = base.Experiment(
    name="random_towers",
    title="Randomized interaction, Towers",
    section="6.3, Figure 7",
    caption="Interactions and accuracy of agents that choose their interactions, and of the same agents when these are "
    "drawn at random. Timeouts left out. Dots: single agents. Dotted lines: the ideal experimenter, which sees "
    "every bit.",
    conditions=conditions.TOWERS,
    trials=(base.LEARNED, base.RANDOM),
    prepare=ideal_towers.prepare,
    load=load,
    claims=find_claims,
    draw=lambda frame: randomized.draw(
        frame, _NAMES, conditions.chance("towers", "fist_features"), frame.attrs["ideal"]
    ),
)
