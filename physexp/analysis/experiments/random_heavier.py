"""Randomized interaction in Which is Heavier (paper, Section 5.3; Figure 4)."""

import functools

from physexp.analysis.experiments import base, claims, conditions, randomized

_NAMES = [
    conditions.label("which_is_heavier", kind, difficulty=beta)
    for kind in conditions.OBSERVATIONS
    for beta in conditions.DIFFICULTIES
]


def find_claims(frame) -> list[claims.Claim]:
    """More accurate in all six; lengths differ little and in no consistent direction."""
    found = randomized.more_accurate(frame, "5.3")
    for condition, ratio in randomized.length_ratios(frame).items():
        found.append(
            claims.Claim(
                text="The effect of randomized interaction on episode length is small",
                section="5.3",
                condition=condition,
                statistic="pokes before an answer, learned over randomized, mean ratio of agents",
                estimate=ratio,
                above=0.67,
                below=1.5,
                reason="Our agents go on until they know: poked at random, they need more pokes to see every block, "
                "and wait for them, where the paper's answered after about as many as usual.",
            )
        )
    return found


@functools.cache
def _ideal() -> dict[str, tuple[float, float]]:
    found = {}
    for beta in conditions.DIFFICULTIES:
        summary = conditions.heavier_ideal(beta).summary()
        for kind in conditions.OBSERVATIONS:
            found[conditions.label("which_is_heavier", kind, difficulty=beta)] = (
                summary["mean_interactions"],
                summary["accuracy"],
            )
    return found


EXPERIMENT = base.Experiment(
    name="random_heavier",
    title="Randomized interaction, Which is Heavier",
    section="5.3, Figure 4",
    caption="Interactions and accuracy of agents that choose their pokes, and of the same agents when their pokes are "
    "drawn at random. Dots: single agents. Dotted lines: the ideal experimenter.",
    conditions=conditions.HEAVIER,
    trials=(base.LEARNED, base.RANDOM),
    load=lambda results: results.episodes([base.LEARNED, base.RANDOM], conditions.HEAVIER, randomized.COLUMNS),
    claims=find_claims,
    draw=lambda frame: randomized.draw(frame, _NAMES, conditions.chance("which_is_heavier", "features"), _ideal()),
)
