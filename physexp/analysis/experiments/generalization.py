"""Generalization: agents in towers that differ from those of their training. Ours."""

from collections.abc import Callable
import functools
import textwrap
from typing import Any

import numpy as np
import pandas

from physexp.analysis import domains
from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions
from physexp.analysis.ideal import rollouts
from physexp.analysis.training import playing, records

USUAL, VARIED = "trained as usual", "trained with variation"
RULE, LOOKUP = "rule", "lookup"
_WORDS = {
    USUAL: USUAL,
    VARIED: VARIED,
    RULE: "rule: cubes whose distance changes are not glued",
    LOOKUP: "observer of 1 mm: the nearest of 16",
}
CONDITIONS = (
    *(conditions.with_belief(task).changed(player=USUAL) for task in conditions.TOWERS),
    *(conditions.with_variation(conditions.with_belief(task), VARIED) for task in conditions.TOWERS),
)

_NUM_EPISODES = 2000  # Of each test.
_NUM_ACTORS = 100  # Of the rule and the lookup, side by side.


def make_trial(name: str, **task_kwargs: float) -> base.Trial:
    """Returns a test with options of the task; all control steps have one length unless they say otherwise."""
    return base.Trial(name=name, num_episodes=_NUM_EPISODES, task_kwargs={"step_variation": 0.0, **task_kwargs})


TRIALS = {
    "as usual": make_trial("usual", variation=0.0),
    "varied": make_trial("varied", variation=1.0),
    "friction 0.42": make_trial("friction0.42", variation=1.0, sliding_friction=0.42),
    "friction 0.45": make_trial("friction0.45", variation=1.0, sliding_friction=0.45),
    "friction 0.48": make_trial("friction0.48", variation=1.0, sliding_friction=0.48),
    "cubes of 95 mm": make_trial("cubes0.095", variation=1.0, cube_size=0.095),
    "steps of 0.05 s": make_trial("steps0.05", variation=1.0, control_timestep=0.05),
    "steps of 0.15 s": make_trial("steps0.15", variation=1.0, control_timestep=0.15),
}
"""The tests, by their names."""
HELD_OUT = list(TRIALS)[2:]
"""The tests outside the range of all training."""


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Lets the rule and the lookup play the tasks that they have not played yet; `report` is told which."""
    for task in conditions.TOWERS:
        if players := domains.find(task.domain).baselines.get(task.task):
            make = functools.partial(_played, task, players)
            results.make(f"generalization/{task.task}", report, f"{' and '.join(players)} play {task.task}", make)


def _played(task: conditions.Condition, players) -> list[dict[str, Any]]:
    """Returns the number of right answers and the mean return of each player in each test."""
    rows = []
    for player, make in players.items():
        for test, trial in TRIALS.items():
            rewards, lengths = play(make, task, trial)
            earned = float((rewards * task.agent.discount ** (lengths - 1)).mean())
            rows.append({"player": player, "test": test, "right": int((rewards > 0).sum()), "return": earned})
    return rows


def play(make: Callable[[], Any], task: conditions.Condition, trial: base.Trial) -> tuple[np.ndarray, np.ndarray]:
    """Returns the final rewards and the numbers of actions of untrained actors in the episodes of a test."""
    actors, rounds = [make() for _ in range(_NUM_ACTORS)], trial.num_episodes // _NUM_ACTORS
    return rollouts.play(actors, task.domain, task.task, trial.task_kwargs, rounds, playing.SEED)


def load(results: base.Results):
    """Returns a row for each condition, player, training_seed (-1 without training) and test.

    The values are `right`, the share of right answers, and `return`, the mean discounted one. Agents are left out until
    they have played all tests.
    """
    tests = {trial.name: test for test, trial in TRIALS.items()}
    agents = results.frame(
        names | {"right": (its.reward > 0).mean(), "return": records.discounted_return(its).mean()}
        for names, _, its in results.agents(list(TRIALS.values()), CONDITIONS, ["reward", "length"])
    )
    frames = [agents.assign(test=agents.trial.map(tests))]
    for task in conditions.TOWERS:
        if (agents.condition == task.label).any() and task.task in domains.find(task.domain).baselines:
            frame = pandas.DataFrame(results.made(f"generalization/{task.task}"))
            frames.append(frame.assign(condition=task.label, training_seed=-1, right=frame.right / _NUM_EPISODES))
    return pandas.concat(frames, ignore_index=True)


def _by_test(rows, player: str, column: str = "right"):
    return claims.by_agent(claims.rows(rows, player=player), "test", column)


def _gain(rows) -> estimates.Estimate:
    return estimates.difference_of_pairs(*(_by_test(rows, player)["varied"] for player in (VARIED, USUAL)))


def _worst_of_rule(rows) -> estimates.Estimate:
    return estimates.proportion(round(_by_test(rows, RULE).min(axis=None) * _NUM_EPISODES), _NUM_EPISODES)


def _share_of_rule(rows) -> estimates.Estimate:
    varied, rule = (_by_test(rows, player, "return")["varied"] for player in (VARIED, RULE))
    return estimates.mean(varied / rule.iloc[0])


def draw(frame):
    """Draws a panel for each condition: the share of right answers in each test."""
    names = list(frame.condition.unique())
    figure, panels = plots.new(rows=len(names), width=6.4, height=2.1, sharex=True, squeeze=False)
    places = np.arange(len(TRIALS))
    for axes, name in zip(panels[:, 0], names, strict=True):
        players = dict(list(frame[frame.condition == name].groupby("player")))
        for number, (player, words) in enumerate(_WORDS.items()):
            if player not in players:
                continue
            right = claims.by_agent(players[player], "test", "right")[list(TRIALS)]
            style = dict(color=plots.COLORS[number + 1], marker=plots.MARKERS[number], markersize=4)
            middle = right.median()
            spread = np.abs(right.agg(["min", "max"]) - middle).to_numpy() if len(right) > 1 else None
            shift = (number - 1.5) * 0.12
            axes.errorbar(places + shift, middle, yerr=spread, linestyle="none", capsize=2, label=words, **style)
        plots.reference(axes, conditions.TOWERS[0].chance, "chance")
        axes.set(title=conditions.spelled_out(name), ylabel="share of right answers", ylim=(0, 1.05))
        axes.axvline(1.5, color=plots.GREY, linewidth=0.6)
    panels[-1, 0].set_xticks(places, [textwrap.fill(test, 9) for test in TRIALS])
    panels[-1, 0].set_xlabel("test; right of the line: outside the range of all training")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return figure


EXPERIMENTS = {
    "generalization": base.Experiment(
        **claims.described("generalization"),
        conditions=CONDITIONS,
        trials=tuple(TRIALS.values()),
        prepare=prepare,
        load=load,
        statistics={
            "unseen": claims.of_rows(lambda rows: estimates.mean(_by_test(rows, VARIED)["varied"])),
            "held_out": claims.of_rows(lambda rows: estimates.mean(_by_test(rows, VARIED)[HELD_OUT].min(axis=1))),
            "by_heart": claims.of_rows(_gain),
            "rule": claims.of_rows(_worst_of_rule),
            "near_rule": claims.of_rows(_share_of_rule),
        },
        draw=draw,
    )
}
