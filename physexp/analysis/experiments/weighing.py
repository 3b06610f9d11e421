"""What is weighed first in Balance, where not the weighing costs a step but each block that is laid on. Ours."""

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import claims, conditions, strategy
from physexp.suite.domains import balance

_SIDES = np.array(list(balance.PLACES.values()))

CONDITION = conditions.with_belief(conditions.BALANCE, answers_revealed=True)


def first_weighing(actions) -> int:
    """Returns how many blocks lie on each pan when they first are equally many, of an episode's actions; 0 if never."""
    places = np.zeros(balance.NUM_BLOCKS, int)
    for action in actions:
        if action >= len(_SIDES) * balance.NUM_BLOCKS:
            break
        places[action // len(_SIDES)] = _SIDES[action % len(_SIDES)]
        left, right = (places == -1).sum(), (places == 1).sum()
        if left == right > 0:
            return int(left)
    return 0


def _claims(frame) -> list[claims.Claim]:
    first = frame.groupby("training_seed")["first"]
    return [
        claims.Claim(
            text="Where each placing costs a step, one block is weighed against one first",
            condition=CONDITION.label,
            statistic="share of first weighings that are one against one, mean of agents",
            estimate=estimates.mean_share(first.agg(lambda first: (first == 1).mean())),
            above=0.95,
            reason="A third against a third, as in the puzzle of the twelve coins, saves a third of a weighing, and "
            "costs two placings.",
        ),
    ]


def _draw(axes, frame) -> None:
    sizes = np.arange(balance.NUM_BLOCKS // 2 + 1)
    shares = np.bincount(frame["first"], minlength=len(sizes)) / len(frame)
    axes.bar([f"{size} : {size}" if size else "none" for size in sizes], shares, color=plots.COLORS[2])
    axes.set(xlabel="first weighing", ylabel="share of episodes", ylim=(0, 1.05))


STRATEGY = strategy.Strategy(
    condition=CONDITION,
    columns=("actions",),
    seen=lambda frame: frame.assign(first=[first_weighing(actions) for actions in frame.actions]),
    claims=_claims,
    optimum="Agents who are told the answers come near the optimum of Balance",
    draw=_draw,
)

EXPERIMENT = STRATEGY.experiment(
    name="weighing",
    title="One against one first",
    caption="How the belief learner weighs in Balance, answers revealed, features: right, how many blocks lie on each "
    "pan when they first are equally many",
)
