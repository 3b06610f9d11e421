"""What is weighed first in Balance, where not the weighing costs a step but each block that is laid on. Ours."""

import numpy as np

from physexp.analysis.data import estimates
from physexp.analysis.evaluation import figures, records
from physexp.analysis.experiments import base, claims, conditions
from physexp.suite.domains import balance

CONDITION = conditions.with_belief(conditions.BALANCE, answers_revealed=True)
_LEAST_SHARE = 0.95  # Of first weighings, and of the ideal's return.
_SIDES = np.array(list(balance.PLACES.values()))


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


def load(results: base.Results):
    """Episodes, with the size of the `first` weighing and the `share` of the ideal's value that each returned."""
    frame = results.episodes([base.EVALUATION], [CONDITION], ["actions", "reward", "length", "interactions"])
    share = records.discounted_return(frame) / conditions.ideal(CONDITION).value
    return frame.assign(first=[first_weighing(actions) for actions in frame.actions], share=share)


def find_claims(frame) -> list[claims.Claim]:
    """Agents weigh one block against one first, as the ideal does, and come near its return."""
    agents = frame.groupby("training_seed")
    return [
        claims.Claim(
            text="Where each placing costs a step, one block is weighed against one first",
            condition="balance features",
            statistic="share of first weighings that are one against one, mean of agents",
            estimate=estimates.mean_share(agents["first"].agg(lambda first: (first == 1).mean())),
            above=_LEAST_SHARE,
            reason="A third against a third, as in the puzzle of the twelve coins, saves a third of a weighing, and "
            "costs two placings.",
        ),
        claims.Claim(
            text="Agents who are told the answers come near the optimum of Balance",
            condition="balance features",
            statistic="share of the ideal's return, median of agents",
            estimate=estimates.median(agents.share.mean()),
            above=_LEAST_SHARE,
        ),
    ]


def draw(frame):
    """Interactions before the answer beside the ideal's, and the sizes of first weighings."""
    figure, (left, right) = figures.new(columns=2, width=3.0, height=2.3)
    best = conditions.ideal(CONDITION).summary()["histogram"]
    longest = max(len(best), int(frame.interactions.max()) + 1)
    bins = np.arange(longest)
    shares = np.bincount(frame.interactions, minlength=longest) / len(frame)
    left.bar(bins, shares, color=figures.COLORS[1], width=0.8, alpha=0.75, label="agents")
    ideal = [best.get(number, 0.0) for number in bins]
    left.stairs(ideal, np.arange(longest + 1) - 0.5, color=figures.GREY, linewidth=1.3, label="ideal")
    left.set(xlabel="interactions before the answer", ylabel="share of episodes")
    left.legend()
    sizes = np.arange(balance.NUM_BLOCKS // 2 + 1)
    shares = np.bincount(frame["first"], minlength=len(sizes)) / len(frame)
    right.bar([f"{size} : {size}" if size else "none" for size in sizes], shares, color=figures.COLORS[2])
    right.set(xlabel="first weighing", ylabel="share of episodes", ylim=(0, 1.05))
    figure.suptitle(figures.seeds(frame), fontsize=7, x=0.99, ha="right")
    return figure


EXPERIMENT = base.Experiment(
    name="weighing",
    title="One against one first",
    section="ours",
    caption="How the belief learner weighs in Balance, answers revealed, features, gamma 0.95; greedy play. Left: "
    "interactions before the answer; outlined: the ideal experimenter. Right: how many blocks lie on each pan when "
    "they first are equally many.",
    conditions=(CONDITION,),
    trials=(base.EVALUATION,),
    load=load,
    claims=find_claims,
    draw=draw,
)
