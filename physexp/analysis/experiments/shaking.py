"""How long the box is shaken in Sealed Box: the longer, the harder it is to tell what is in it. Ours."""

import numpy as np
from scipy import stats

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import claims, conditions, strategy
from physexp.suite.domains import sealed_box

CONDITION = conditions.with_belief(conditions.SEALED_BOX)


def ideal_interactions() -> np.ndarray:
    """Returns how many interactions the ideal experimenter takes with each content, int64 [H]."""
    return conditions.ideal(CONDITION).outcomes()[:, 0]


def _mean_interactions(frame):
    """What an agent takes with each content, [agents, contents]."""
    return frame.groupby(["training_seed", "content"]).interactions.mean().unstack()


def _claims(frame) -> list[claims.Claim]:
    taken, best = _mean_interactions(frame), frame.groupby("content").ideal.first()
    ranks = [
        stats.spearmanr(row, best[taken.columns]).statistic if np.ptp(row) else 0.0  # Always as long: no correlation.
        for row in taken.to_numpy()
    ]
    return [
        claims.Claim(
            text="The harder a content is to tell, the longer the box is experimented with",
            condition=CONDITION.label,
            statistic="rank correlation over contents of an agent's interactions with the ideal's, median of agents",
            estimate=estimates.median(ranks),
            above=0.5,
        ),
    ]


def _draw(axes, frame) -> None:
    best = frame.groupby("content").ideal.first()
    taken = _mean_interactions(frame).mean()
    for kind, name in enumerate(sealed_box.CONTENTS):
        those = [content for content in taken.index if sealed_box.KINDS[content] == kind]
        shift = 0.12 * (kind - 1.5)
        axes.plot(best[those] + shift, taken[those], "o", markersize=3, color=plots.COLORS[kind], label=name)
    ends = [0, max(best.max(), taken.max()) + 0.5]
    axes.plot(ends, ends, color=plots.GREY, linewidth=0.8)
    axes.set(xlabel="interactions of the ideal", ylabel="interactions of agents", xlim=ends, ylim=ends)
    axes.legend(fontsize=6)


STRATEGY = strategy.Strategy(
    condition=CONDITION,
    columns=("content",),
    seen=lambda frame: frame.assign(ideal=ideal_interactions()[frame.content]),
    claims=_claims,
    optimum="Agents come near the optimum of Sealed Box from the reward alone",
    draw=_draw,
)

EXPERIMENT = STRATEGY.experiment(
    name="shaking",
    title="The harder to tell, the longer",
    caption="How long the belief learner experiments in Sealed Box, from the reward alone, features: right, a point "
    "for each content",
)
