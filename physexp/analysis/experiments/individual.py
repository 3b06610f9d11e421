"""Individual strategy differentiation (paper, Section 5.3; right of Figure 3): hard instances take longer."""

import math
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, blocks, claims, conditions
from physexp.suite.domains import which_is_heavier

_SHOWN = 4000  # Episodes drawn as dots.
_CLEAR = -0.3  # Of correlations.


def load(results: base.Results):
    """Episodes with the number of `blocks` that were poked."""
    columns = ["mass_gap", "interactions", "label", "actions"]
    return blocks.counted(results.episodes([base.LONG], conditions.PATIENT, columns))


def find_claims(frame) -> list[claims.Claim]:
    """A clear correlation in each agent, and on average, and what it comes from."""
    found = []
    for beta in conditions.DIFFICULTIES:
        rows = frame[(frame.difficulty == beta) & (frame.label >= 0)]
        if not len(rows):
            continue
        agents = [agent for _, agent in rows.groupby("training_seed")]
        gaps = [agent.mass_gap.to_numpy(float) for agent in agents]
        pokes, blocks_seen = ([agent[name].to_numpy(float) for agent in agents] for name in ("interactions", "blocks"))
        correlations = list(map(estimates.correlation, gaps, pokes))
        of_blocks, of_pokes = (
            [estimates.slope(gap, one).value for gap, one in zip(gaps, each, strict=True)]
            for each in (blocks_seen, pokes)
        )
        shares = [seen / poked if poked else math.nan for seen, poked in zip(of_blocks, of_pokes, strict=True)]
        common: dict[str, Any] = dict(
            text="The smaller the mass gap, the longer an agent experiments",
            section="5.3",
            below=_CLEAR,
            words="a clear correlation",
            reason="The effect is there, and small: with easy masses few episodes have a small gap.",
        )
        silent = (frame[frame.difficulty == beta].label < 0).groupby(frame.training_seed).mean()
        found += [
            claims.Claim(
                **common,
                condition=f"{beta:g}-F",
                statistic="correlation of pokes and mass gap, mean of agents",
                estimate=estimates.mean([estimate.value for estimate in correlations]),
            ),
            claims.Claim(
                **common,
                condition=f"{beta:g}-F, each agent",
                statistic="the same in the agent where it is least sure",
                estimate=max(correlations, key=lambda estimate: estimate.high),
            ),
            claims.Claim(
                text="Hardly any episode ends by timeout",
                section="5.3",
                condition=f"{beta:g}-F",
                statistic="share of episodes without an answer, mean of agents",
                estimate=estimates.mean_share(silent),
                below=0.01,
                words="the very small proportion of episodes",
            ),
            claims.Claim(
                text="Where the mass gap is small, most of the further pokes are of further blocks",
                condition=f"{beta:g}-F",
                statistic="slope on mass gap of the number of blocks poked over that of pokes, mean of agents",
                estimate=estimates.mean(shares),
                above=0.5,
                reason="Most of the effect is pokes of blocks that have been poked before. Sensing is without noise, "
                "so these tell nothing new: that small gaps need more information, as the paper reads it, is not the "
                "cause here.",
            ),
        ]
    return found


def draw(frame):
    """One agent of each difficulty: dots, trend, spread, and the ideal experimenter's mean."""
    present = [beta for beta in conditions.DIFFICULTIES if (frame.difficulty == beta).any()]
    figure, panels = plots.new(columns=len(present), width=2.3, height=2.3, sharey=True, squeeze=False)
    for axes, beta in zip(panels[0], present, strict=True):
        rows = frame[(frame.difficulty == beta) & (frame.label >= 0)]
        rows = rows[rows.training_seed == rows.training_seed.min()]
        gaps, pokes = rows.mass_gap.to_numpy(float), rows.interactions.to_numpy(float)
        generator = np.random.default_rng(0)
        spread = generator.uniform(-0.3, 0.3, min(_SHOWN, len(rows)))  # Pokes are whole numbers: dots would coincide.
        axes.scatter(
            gaps[:_SHOWN], pokes[:_SHOWN] + spread, s=1, color="black", alpha=0.25, linewidths=0, rasterized=True
        )
        means, deviations = (blocks.by_gap(gaps, pokes, statistic) for statistic in (np.mean, np.std))
        axes.errorbar(
            blocks.GAPS,
            means,
            deviations,
            fmt="s",
            color=plots.COLORS[2],
            markersize=3,
            linewidth=1,
            capsize=1.5,
            label="mean and standard deviation",
        )
        trend = estimates.slope(gaps, pokes)
        ends = np.array([0.0, 1.0])
        axes.plot(ends, pokes.mean() + trend.value * (ends - gaps.mean()), color=plots.COLORS[2], label="OLS")
        axes.plot(*_ideal_means(beta), color=plots.COLORS[1], linestyle=plots.DASHES[1], label="ideal")
        axes.set(xlabel="mass gap", title=f"β = {beta:g}: slope {trend.value:.2f}", xlim=(0, 1), ylim=(0, 15))
    panels[0, 0].set_ylabel("pokes before the answer")
    panels[0, -1].legend(loc="upper right", fontsize=6)
    return figure


def _ideal_means(beta: float):
    """The ideal experimenter's mean pokes for mass gaps in the bins."""
    seeds, episodes = np.full(50_000, 1), np.arange(50_000)
    masses = which_is_heavier.draw_masses(seeds, episodes, beta)
    pokes, _ = conditions.heavier_ideal(beta, conditions.PATIENT_DISCOUNT).play(masses)
    return blocks.GAPS, blocks.by_gap(which_is_heavier.mass_gaps(masses), pokes, fewest=1)


EXPERIMENT = base.Experiment(
    name="individual",
    title="Individual strategy differentiation",
    section="5.3, Figure 3 (right)",
    caption="Pokes of single agents (the first seed) against the mass gap of the episode, features, gamma 0.99; at "
    f"least 100,000 test steps, of which {_SHOWN:,} episodes are drawn; timeouts left out. Dashed: the ideal's mean.",
    conditions=conditions.PATIENT,
    trials=(base.LONG,),
    load=load,
    claims=find_claims,
    draw=draw,
)
