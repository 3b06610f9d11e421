"""Strategies that follow from the optimum in a domain: weighing, clamping, shaking, aiming, crushing, pressing. Ours.

An agent may come near the optimal return without them. In Strike the distance of pucks that are struck hard follows
from `m sqrt(mu)` alone: a strike that stops at D needs the impulse `m sqrt(2 mu g D)`.
"""

from collections.abc import Callable
import functools
import itertools
from typing import Any

import numpy as np
import pandas
from scipy import stats

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves
from physexp.suite.domains import balance, crush, lump, sealed_box, strike, strings

WEIGHING = conditions.with_belief(conditions.BALANCE, answers_revealed=True)
CLAMPING = conditions.with_belief(conditions.STRINGS)
SHAKING = conditions.with_belief(conditions.SEALED_BOX)
AIMING = conditions.with_belief(conditions.STRIKE)
CRUSHING = conditions.with_belief(conditions.CRUSH, answers_revealed=True)
PRESSING = conditions.with_belief(conditions.LUMP)

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

    The attribute `ideal` of the episodes has the ideal's share of episodes for each number of interactions. The returns
    of these agents are in `laboratory`.
    """

    def load(results: base.Results):
        frame = behaviour(results.episodes([base.EVALUATION], [condition], ["interactions", *columns]))
        frame.attrs["ideal"] = condition.ideal().figures()["histogram"]
        return frame

    return base.Experiment(
        **claims.described(name),
        conditions=(condition,),
        trials=(base.EVALUATION,),
        load=load,
        statistics=statistics,
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


def _rank_correlation(x, y) -> float:
    """Returns the rank correlation of two series, and 0 if the first is constant."""
    return stats.spearmanr(x, y).statistic if np.ptp(x) else 0.0


def _likeness(frame) -> estimates.Estimate:
    taken, best = _taken(frame), frame.groupby("content").ideal.first()
    ideal = best[taken.columns]
    return estimates.mean([_rank_correlation(row, ideal) for row in taken.to_numpy()])


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


# Crushing in Crush: the last whole can must be spared, so the force rises in steps, and the steps shrink.


def rising(actions, answer: int) -> np.ndarray:
    """Returns the steps between the forces of an episode's presses, up to the first press that crushes a can, int [N].

    The first step is the first force itself. `answer` is the label of the smallest force that crushes a can.
    """
    presses = np.array([action for action in actions if action < crush.NUM_FORCES], int)
    return np.diff(presses[: (presses < answer).cumprod().sum() + 1], prepend=-1)


def _with_steps(frame):
    episodes = zip(frame.actions, frame.answer, strict=True)
    return frame.assign(steps=[rising(*episode) for episode in episodes])


def _steps(frame):
    """Returns a row for each step: the agent, the step's `number` in its episode, from 1 on, and its `size`."""
    steps = frame[["training_seed", "steps"]].reset_index(drop=True).explode("steps").dropna()
    return steps.assign(number=steps.groupby(level=0).cumcount() + 1, size=steps.steps.astype(int))


def _shrinking(frame) -> estimates.Estimate:
    agents = _steps(frame).groupby("training_seed")
    return estimates.mean([_rank_correlation(steps["size"], steps.number) for _, steps in agents])


def _draw_steps(axes, frame) -> None:
    steps = _steps(frame)
    for _, sizes in steps.groupby(["training_seed", "number"])["size"].mean().groupby("training_seed"):
        axes.plot(
            sizes.index.get_level_values("number"), sizes, "o-", markersize=2, linewidth=0.8, color=plots.COLORS[2]
        )
    axes.set(xlabel="press while no can is crushed", ylabel="mean step between forces")
    axes.set_ylim(bottom=0)


# Pressing in Lump: only hard presses dent clay and putty clearly, and only waits show what comes back.

_HARD, _WAIT = int(np.argmax(lump.PRESSES)), len(lump.PRESSES)


def waits(actions) -> int:
    """Returns the number of waits in an episode's actions if two hard presses come first, else 0."""
    first, then = list(actions[:2]), list(actions[2:])
    return then.count(_WAIT) if first == [_HARD, _HARD] else 0


def _with_waits(frame):
    return frame.assign(waits=[waits(actions) for actions in frame.actions])


def _draw_waits(axes, frame) -> None:
    counts = np.arange(frame.waits.max() + 1)
    shares = pandas.crosstab(frame.waits, frame.answer, normalize="all").reindex(counts, fill_value=0.0)
    for kind, share in shares.items():
        below = shares.loc[:, :kind].sum(axis=1) - share
        axes.bar(counts, share, bottom=below, color=plots.COLORS[kind], label=lump.MATERIALS[kind])
    axes.set(xlabel="waits after two hard presses", ylabel="share of episodes")
    axes.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=len(lump.MATERIALS), fontsize=6)


_one_against_one = claims.mean_of_agents(lambda rows: rows["first"] == 1, estimates.mean_share)
_only_if_needed = claims.mean_of_agents(lambda rows: rows.clamps == rows.together, estimates.mean_share)
_aims = {
    "goal_is_known": claims.of_rows(lambda rows: estimates.mean(_spreads(rows, "asked"))),
    "rest_is_unknown": claims.of_rows(lambda rows: estimates.mean(_spreads(rows, "friction"))),
}
_longer_if_hard = claims.of_rows(_likeness)
_steps_shrink = claims.of_rows(_shrinking)
_hard_first = claims.mean_of_agents(lambda rows: rows.waits.between(1, 4), estimates.mean_share)

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
    "crushing": _experiment(
        "crushing", CRUSHING, ("actions", "answer"), _with_steps, {"steps_shrink": _steps_shrink}, _draw_steps
    ),
    "pressing": _experiment(
        "pressing", PRESSING, ("actions", "answer"), _with_waits, {"hard_first": _hard_first}, _draw_waits
    ),
}
