"""Strategies that follow from the optimum in a domain: weighing, clamping, shaking and aiming. Ours.

An agent may come near the optimal return without them. In Strike the distance of pucks that are struck hard follows
from `m sqrt(mu)` alone: a strike that stops at D needs the impulse `m sqrt(2 mu g D)`.
"""

from collections.abc import Callable
import functools
import itertools
from typing import Any

import numpy as np
from scipy import stats

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves
from physexp.analysis.training import records
from physexp.suite.domains import balance, sealed_box, strike, strings

WEIGHING = conditions.with_belief(conditions.BALANCE, answers_revealed=True)
CLAMPING = conditions.with_belief(conditions.STRINGS)
SHAKING = conditions.with_belief(conditions.SEALED_BOX)
AIMING = conditions.with_belief(conditions.STRIKE)

_SIDES = np.array(list(balance.PLACES.values()))
_PROPERTIES = {"asked": "m √μ", "mass": "m", "friction": "μ"}


def _experiment(
    name: str,
    condition: conditions.Condition,
    columns: tuple[str, ...],
    behaviour: Callable[[Any], Any],
    statistics: dict[str, claims.Statistic],
    draw: Callable[[Any, Any], None],
) -> base.Experiment:
    """Returns an experiment on one condition; `behaviour` adds columns to its episodes, for `statistics` and `draw`.

    The episodes have the `share` of the ideal's value that each returned, and the attribute `ideal`: the ideal's share
    of episodes for each number of interactions.
    """

    def load(results: base.Results):
        episodes = results.episodes([base.EVALUATION], [condition], ["reward", "length", "interactions", *columns])
        ideal = condition.ideal()
        frame = behaviour(episodes.assign(share=records.discounted_return(episodes) / ideal.value))
        frame.attrs["ideal"] = ideal.figures()["histogram"]
        return frame

    return base.Experiment(
        **claims.described(name),
        conditions=(condition,),
        trials=(base.EVALUATION,),
        load=load,
        statistics=statistics | {"near_optimum": claims.mean_of_agents(lambda rows: rows.share, estimates.median)},
        draw=functools.partial(_draw, draw),
    )


def _draw(draw_behaviour: Callable[[Any, Any], None], episodes):
    """Draws the interactions before the answer beside the ideal's, and the behaviour."""
    figure, (left, right) = plots.new(columns=2, width=3.0, height=2.3)
    taken, ideal = episodes.interactions, episodes.attrs["ideal"]
    curves.draw_histogram(left, taken, ideal, max(len(ideal), int(taken.max()) + 1), plots.COLORS[1])
    left.set(xlabel="interactions before the answer", ylabel="share of episodes")
    left.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2)
    draw_behaviour(right, episodes)
    figure.suptitle(plots.seeds(episodes), fontsize=7, x=0.99, ha="right")
    return figure


# Weighing in Balance: each block that is laid on costs a step, the weighing does not.


def first_weighing(actions) -> int:
    """Returns the number of blocks on each pan when they are first equal, from an episode's actions; else 0."""
    places = np.zeros(balance.NUM_BLOCKS, int)
    for action in actions:
        if action >= len(_SIDES) * balance.NUM_BLOCKS:
            break
        places[action // len(_SIDES)] = _SIDES[action % len(_SIDES)]
        left, right = (places == -1).sum(), (places == 1).sum()
        if left == right > 0:
            return int(left)
    return 0


def _with_first(frame):
    return frame.assign(first=[first_weighing(actions) for actions in frame.actions])


def _draw_first(axes, frame) -> None:
    sizes = np.arange(balance.NUM_BLOCKS // 2 + 1)
    shares = np.bincount(frame["first"], minlength=len(sizes)) / len(frame)
    axes.bar([f"{size} : {size}" if size else "none" for size in sizes], shares, color=plots.COLORS[2])
    axes.set(xlabel="first weighing", ylabel="share of episodes", ylim=(0, 1.05))


# Clamping in Strings: pulls leave several graphs exactly if all pucks hang together.


def clamps(actions) -> bool:
    """Returns whether an episode's actions move the clamp."""
    return bool(np.isin(actions, strings.NUM_PUCKS + np.arange(strings.NUM_PUCKS)).any())


def hangs_together(graphs) -> np.ndarray:
    """Returns whether all pucks hang together in graphs with these labels, so that pulls leave several, bool [N]."""
    return strings.graphs()[graphs].sum(axis=1) >= strings.NUM_PUCKS - 1


def _with_clamps(frame):
    clamped = [clamps(actions) for actions in frame.actions]
    return frame.assign(clamps=clamped, together=hangs_together(frame.answer.to_numpy()))


def _draw_clamps(axes, frame) -> None:
    shares = frame.groupby("answer").clamps.mean().reindex(range(len(strings.graphs())), fill_value=0.0)
    colors = [plots.COLORS[2] if both else plots.GREY for both in hangs_together(shares.index.to_numpy())]
    named = [itertools.compress(strings.pairs(), joined) for joined in strings.graphs()]
    names = ["\n".join(f"{i}-{j}" for i, j in pairs) for pairs in named]
    axes.bar(range(len(names)), shares, color=colors)
    axes.set_xticks(range(len(names)), [name or "none" for name in names], fontsize=6)
    axes.set(xlabel="bands (grey: pulls are enough)", ylabel="share with a clamp", ylim=(0, 1.05))


# Shaking in Sealed Box: contents that are harder to identify need more interactions.


def _with_ideal(frame):
    """Returns the episodes with the interactions of the ideal experimenter, `ideal`."""
    return frame.assign(ideal=SHAKING.ideal().outcomes()[0][frame.content])


def _taken(frame):
    """Returns the mean interactions with each content, [agents, contents]."""
    return frame.groupby(["training_seed", "content"]).interactions.mean().unstack()


def _rank_correlation(frame) -> estimates.Estimate:
    taken, best = _taken(frame), frame.groupby("content").ideal.first()
    ideal = best[taken.columns]
    # An agent with a constant number has no correlation.
    ranks = [stats.spearmanr(row, ideal).statistic if np.ptp(row) else 0.0 for row in taken.to_numpy()]
    return estimates.median(ranks)


def _draw_contents(axes, frame) -> None:
    best, taken = frame.groupby("content").ideal.first(), _taken(frame).mean()
    for kind, name in enumerate(sealed_box.CONTENTS):
        its = [content for content in taken.index if sealed_box.KINDS[content] == kind]
        shift = 0.12 * (kind - 1.5)
        axes.plot(best[its] + shift, taken[its], "o", markersize=3, color=plots.COLORS[kind], label=name)
    ends = [0, max(best.max(), taken.max()) + 0.5]
    axes.plot(ends, ends, color=plots.GREY, linewidth=0.8)
    axes.set(xlabel="interactions of the ideal", ylabel="interactions of agents", xlim=ends, ylim=ends)
    axes.legend(fontsize=6)


# Aiming in Strike: the goal needs mass times root of friction, and neither of them alone.


def shares_left(pucks, actions) -> dict[str, np.ndarray]:
    """Returns the share of the prior's variance that is left at the answer, by property, of logarithms, float64 [N].

    `pucks` are the indices of the hidden pucks, int [N], and `actions` those of each episode.
    """
    frictions = np.array([friction for _, friction, _ in strike.PUCKS])
    masses, _ = strike.properties(np.arange(len(frictions)), strike.Options().goal_distance)
    mass, friction = np.log(masses), np.log(frictions)
    known, solution = {"asked": mass + friction / 2, "mass": mass, "friction": friction}, AIMING.ideal()

    @functools.cache
    def left(puck: int, taken: tuple[int, ...]) -> list[int]:
        return list(solution.supports(puck, taken)[-1])

    groups = [left(int(puck), tuple(map(int, taken))) for puck, taken in zip(pucks, actions, strict=True)]
    return {name: np.array([values[group].var() for group in groups]) / values.var() for name, values in known.items()}


def _with_left(frame):
    return frame.assign(**shares_left(frame.puck, frame.actions))


def _spreads(frame, name: str):
    """Returns the spread that is left as a share of the prior's, of each agent."""
    return np.sqrt(frame.groupby("training_seed")[name].mean())


def _draw_left(axes, frame) -> None:
    for place, name in enumerate(_PROPERTIES):
        spreads = _spreads(frame, name)
        axes.bar(place, spreads.mean(), color=plots.COLORS[place], width=0.7)
        axes.plot(np.full(len(spreads), place), spreads, "o", markersize=2, color="black")
    axes.set_xticks(range(len(_PROPERTIES)), list(_PROPERTIES.values()))
    axes.set(xlabel="logarithm of", ylabel="spread left, share of the prior's", ylim=(0, 1.05))


_one_against_one = claims.mean_of_agents(lambda rows: rows["first"] == 1, estimates.mean_share)
_only_if_needed = claims.mean_of_agents(lambda rows: rows.clamps == rows.together, estimates.mean_share)
_aims = {
    "goal_is_known": claims.of_rows(lambda rows: estimates.mean(_spreads(rows, "asked"))),
    "rest_is_unknown": claims.of_rows(lambda rows: estimates.mean(_spreads(rows, "friction"))),
}
_longer_if_hard = claims.of_rows(_rank_correlation)

EXPERIMENTS = {
    "weighing": _experiment(
        "weighing", WEIGHING, ("actions",), _with_first, {"one_against_one": _one_against_one}, _draw_first
    ),
    "clamping": _experiment(
        "clamping", CLAMPING, ("actions", "answer"), _with_clamps, {"only_if_needed": _only_if_needed}, _draw_clamps
    ),
    "shaking": _experiment(
        "shaking", SHAKING, ("content",), _with_ideal, {"longer_if_hard": _longer_if_hard}, _draw_contents
    ),
    "aiming": _experiment("aiming", AIMING, ("actions", "puck"), _with_left, _aims, _draw_left),
}
