"""When a puck is clamped in Strings: where pulls alone leave several graphs, and only there. Ours."""

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import claims, conditions, strategy
from physexp.suite.domains import strings

CONDITION = conditions.with_belief(conditions.STRINGS)


def clamps(actions) -> bool:
    """Returns whether the clamp is moved in an episode, of its actions."""
    return bool(np.isin(actions, strings.NUM_PUCKS + np.arange(strings.NUM_PUCKS)).any())


def hangs_together(graphs) -> np.ndarray:
    """Returns whether pulls leave several graphs, bool [N]: all pucks hang together in graphs with these labels."""
    return strings.is_joined(graphs).sum(axis=1) >= strings.NUM_PUCKS - 1


def _seen(frame):
    return frame.assign(
        clamps=[clamps(actions) for actions in frame.actions],
        together=hangs_together(frame.answer.to_numpy()),
    )


def _claims(frame) -> list[claims.Claim]:
    fits = frame.clamps == frame.together
    return [
        claims.Claim(
            text="A puck is clamped when, and only when, pulls leave several graphs",
            condition=CONDITION.label,
            statistic="share of episodes with a clamp where all pucks hang together, and without one elsewhere, "
            "mean of agents",
            estimate=estimates.mean_share(fits.groupby(frame.training_seed).mean()),
            above=0.95,
        ),
    ]


def _draw(axes, frame) -> None:
    shares = frame.groupby("answer").clamps.mean().reindex(range(strings.NUM_GRAPHS), fill_value=0.0)
    colors = [plots.COLORS[2] if both else plots.GREY for both in hangs_together(shares.index.to_numpy())]
    bands = strings.is_joined(shares.index.to_numpy())
    names = ["\n".join(f"{i}-{j}" for pair, (i, j) in zip(row, strings.PAIRS, strict=True) if pair) for row in bands]
    axes.bar(range(len(names)), shares, color=colors)
    axes.set_xticks(range(len(names)), [name or "none" for name in names], fontsize=6)
    axes.set(xlabel="bands (grey: pulls are enough)", ylabel="share with a clamp", ylim=(0, 1.05))


STRATEGY = strategy.Strategy(
    condition=CONDITION,
    columns=("actions", "answer"),
    seen=_seen,
    claims=_claims,
    optimum="Agents come near the optimum of Strings from the reward alone",
    draw=_draw,
)

EXPERIMENT = STRATEGY.experiment(
    name="clamping",
    title="Holding one thing still",
    caption="When the belief learner clamps a puck in Strings, from the reward alone, features: right, by what is "
    "joined",
)
