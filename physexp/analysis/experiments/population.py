"""Population strategy differentiation (paper, Section 5.3; left of Figure 3): how long agents experiment."""

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions

_ALL_BLOCKS = 4
_LONGEST = 10  # Interactions shown.
CONDITIONS = tuple(condition for condition in conditions.HEAVIER if condition.task == "features")


def find_claims(frame) -> list[claims.Claim]:
    """Few pokes where one heavy block is likely to be the only one, all blocks where it is not."""
    found: list[claims.Claim] = []
    easy, hard = (frame[frame.difficulty == beta] for beta in (10.0, 3.0))
    if easy.empty or hard.empty:
        return found  # Both ends are needed for the transition from one to the other.
    agents = easy.groupby("training_seed").interactions
    found.append(
        claims.Claim(
            text="At difficulty 10 agents stop as soon as they find a heavy block",
            section="5.3",
            condition="10-F",
            statistic="mean number of pokes, mean of agents",
            estimate=estimates.mean(agents.mean()),
            above=1.5,
            below=2.5,
            words="an average of two interactions",
        )
    )
    shares = (hard.interactions >= _ALL_BLOCKS).groupby(hard.training_seed).mean()
    found.append(
        claims.Claim(
            text="At difficulty 3 agents poke all four blocks before answering",
            section="5.3",
            condition="3-F",
            statistic="share of episodes with at least four pokes, mean of agents",
            estimate=estimates.mean_share(shares),
            above=0.5,
            words="a strong bias away from terminating the episode before",
        )
    )
    short = (frame.interactions < 30).groupby([frame.condition, frame.training_seed]).mean()
    found.append(
        claims.Claim(
            text="The vast majority of episodes ends in less than 30 steps",
            section="5.3",
            condition="all",
            statistic="share of such episodes, mean of agents",
            estimate=estimates.mean_share(short),
            above=0.95,
            words="the vast majority",
        )
    )
    return found


def draw(frame):
    """A histogram for each difficulty, the ideal experimenter's beside it."""
    present = [beta for beta in conditions.DIFFICULTIES if (frame.difficulty == beta).any()]
    figure, panels = plots.new(columns=len(present), width=2.2, height=2.2, sharey=True, squeeze=False)
    bins = np.arange(_LONGEST + 1)
    for number, (axes, beta) in enumerate(zip(panels[0], present, strict=True)):
        pokes = frame.interactions[frame.difficulty == beta].clip(upper=_LONGEST)
        axes.bar(
            bins,
            np.bincount(pokes, minlength=len(bins)) / len(pokes),
            color=plots.COLORS[number],
            width=0.8,
            alpha=0.75,
            label="agents",
        )
        solution = conditions.heavier_ideal(beta).figures()
        best = np.zeros(len(bins))
        best[: len(solution["histogram"])] = list(solution["histogram"].values())
        axes.stairs(best, np.arange(len(bins) + 1) - 0.5, color=plots.GREY, linewidth=1.3, label="ideal")
        plots.reference(axes, _ALL_BLOCKS, "all blocks" if beta == present[-1] else "", vertical=True)
        axes.set(xlabel="pokes before the answer", title=f"β = {beta:g}", xticks=bins[::2])
        axes.set_xticklabels([*bins[:-1:2], f"≥{_LONGEST}"])
    panels[0, 0].set_ylabel("share of episodes")
    panels[0, -1].legend(loc="upper right")
    figure.suptitle(plots.seeds(frame), fontsize=7, x=0.99, ha="right")
    return figure


EXPERIMENT = base.Experiment(
    name="population",
    title="Population strategy differentiation",
    section="5.3, Figure 3 (left)",
    caption="How often agents poke before they answer, features, gamma 0.95, at least 10,000 test steps of each agent; "
    "outlined: the ideal experimenter.",
    conditions=CONDITIONS,
    trials=(base.LEARNED,),
    load=lambda results: results.episodes([base.LEARNED], CONDITIONS, ["interactions"]),
    claims=find_claims,
    draw=draw,
)
