"""What is found out in Strike: just what the goal asks for, mass times root of friction, and not both. Ours.

For pucks that are struck hard the distance follows from `m sqrt(mu)` alone: a strike that stops at D needs the impulse
`m sqrt(2 mu g D)`.
"""

import functools

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import claims, conditions, strategy
from physexp.suite.domains import strike

CONDITION = conditions.with_belief(conditions.STRIKE)
_NAMES = {"asked": "m √μ", "mass": "m", "friction": "μ"}


def logarithms() -> dict[str, np.ndarray]:
    """Returns logarithms of what may be known of each puck, float64 [H]: what is `asked`, `mass` and `friction`."""
    frictions = np.array([friction for _, friction, _ in strike.PUCKS])
    masses, _ = strike.properties(np.arange(len(frictions)), strike.Options().goal_distance)
    return {
        "asked": np.log(masses) + np.log(frictions) / 2,
        "mass": np.log(masses),
        "friction": np.log(frictions),
    }


def shares_left(pucks, actions) -> dict[str, np.ndarray]:
    """Returns which share of the prior's variance is left at the answer, of each logarithm, float64 [N].

    Args:
      pucks: what was hidden, indices, int [N].
      actions: of each episode.
    """
    known, solution = logarithms(), conditions.ideal(CONDITION)

    @functools.cache
    def left(puck, taken):
        return list(solution.supports(puck, taken)[-1])

    groups = [left(int(puck), tuple(map(int, taken))) for puck, taken in zip(pucks, actions, strict=True)]
    return {name: np.array([values[group].var() for group in groups]) / values.var() for name, values in known.items()}


def _spreads(frame, name: str):
    """Returns the spread that is left as a share of the prior's, of each agent."""
    return np.sqrt(frame.groupby("training_seed")[name].mean())


def _claims(frame) -> list[claims.Claim]:
    return [
        claims.Claim(
            text="What the goal asks for is known at the answer",
            condition=CONDITION.label,
            statistic="spread of log(m sqrt(mu)) that is left, as a share of the prior's, mean of agents",
            estimate=estimates.mean(_spreads(frame, "asked")),
            below=0.2,
        ),
        claims.Claim(
            text="What the goal does not ask for is hardly found out",
            condition=CONDITION.label,
            statistic="spread of log(mu) that is left, as a share of the prior's, mean of agents",
            estimate=estimates.mean(_spreads(frame, "friction")),
            above=0.6,
        ),
    ]


def _draw(axes, frame) -> None:
    for place, name in enumerate(_NAMES):
        spreads = _spreads(frame, name)
        axes.bar(place, spreads.mean(), color=plots.COLORS[place], width=0.7)
        axes.plot(np.full(len(spreads), place), spreads, "o", markersize=2, color="black")
    axes.set_xticks(range(len(_NAMES)), list(_NAMES.values()))
    axes.set(xlabel="logarithm of", ylabel="spread left, share of the prior's", ylim=(0, 1.05))


STRATEGY = strategy.Strategy(
    condition=CONDITION,
    columns=("actions", "puck"),
    seen=lambda frame: frame.assign(**shares_left(frame.puck, frame.actions)),
    claims=_claims,
    optimum="Agents come near the optimum of Strike from the reward alone",
    draw=_draw,
)

EXPERIMENT = STRATEGY.experiment(
    name="aiming",
    title="Just what the goal asks for",
    caption="What the belief learner knows of a puck in Strike when it answers, from the reward alone, features: "
    "right, the spread of logarithms that is left",
)
