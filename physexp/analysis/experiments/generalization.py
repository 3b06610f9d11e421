"""Generalization: how agents fare with towers that differ from those they were trained with. Ours."""

from collections.abc import Callable
import textwrap
from typing import Any

import numpy as np

from physexp.analysis import domains
from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, scores
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
CONDITIONS = {
    USUAL: tuple(conditions.with_belief(task) for task in conditions.TOWERS),
    VARIED: tuple(conditions.with_variation(conditions.with_belief(task)) for task in conditions.TOWERS),
}
"""The agents, by how they were trained."""

_NUM_EPISODES = 2000  # Of each test.
_NUM_ACTORS = 100  # Of those that nobody trained, side by side.


def make_trial(name: str, **task_kwargs: float) -> base.Trial:
    """Returns a test with options of the task; control steps are alike unless they say otherwise."""
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
"""What is played, by the names of the tests."""
HELD_OUT = tuple(TRIALS)[2:]
"""The tests of what no agent is trained with."""

# Written down before any agent was trained.
LEAST_RIGHT, LEAST_RIGHT_HELD_OUT, LEAST_SHARE = 0.97, 0.93, 0.9


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Lets the experimenters that nobody trained play, where they have not; `report` is told which."""
    for task in conditions.TOWERS:
        path = _path(results, task.task)
        baselines = domains.find(task.domain).baselines.get(task.task, {})
        rows = _baselines(results, task) if path.exists() else []
        done = {(row["player"], row["test"]) for row in rows}
        for player, make in baselines.items():
            missing = {test: trial for test, trial in TRIALS.items() if (player, test) not in done}
            if not missing:
                continue
            report(f"{player} plays {task.task}")
            actors = [make() for _ in range(_NUM_ACTORS)]
            for test, trial in missing.items():
                rewards, lengths = rollouts.play(
                    actors, task.domain, task.task, trial.task_kwargs, _NUM_EPISODES // _NUM_ACTORS, playing.SEED
                )
                rows.append(
                    {
                        "player": player,
                        "test": test,
                        "right": int((rewards > 0).sum()),
                        "return": float((rewards * task.agent.discount ** (lengths - 1)).mean()),
                    }
                )
                base.keep_made(path, rows)


def _path(results: base.Results, task: str):
    return results.path / "generalization" / f"{task}.json"


def _baselines(results: base.Results, task) -> list[dict]:
    """Reads what `prepare` has written.

    Raises:
      ValueError: if that is missing or damaged.
    """
    return base.read_made(_path(results, task.task), "generalization", _are_rows)


def _are_rows(rows: Any) -> bool:
    kinds = {"player": str, "test": str, "right": int, "return": float}
    return isinstance(rows, list) and all(
        isinstance(row, dict) and {name: type(value) for name, value in row.items()} == kinds for row in rows
    )


def load(results: base.Results):
    """How everybody has played: a row for each condition, player, agent and test.

    Columns are condition, player, training_seed (-1 for those whom nobody trained), test, right (the share of right
    answers) and return (the mean discounted one).

    Raises:
      ValueError: if no agent has played.
    """
    import pandas

    rows = []
    for player, configs in CONDITIONS.items():
        for config in configs:
            for test, trial in TRIALS.items():
                if results.has_played(trial, config):
                    frame = results.episodes([trial], [config], ["reward", "length"])
                    frame = frame.assign(discounted=records.discounted_return(frame))
                    rows += [
                        _row(config, player, seed, test, (its.reward > 0).mean(), its.discounted.mean())
                        for seed, its in frame.groupby("training_seed")
                    ]
    if not rows:
        raise results.lacks("episodes")
    played = {row["condition"] for row in rows}
    for task in conditions.TOWERS:
        if task.label in played and domains.find(task.domain).baselines.get(task.task):
            rows += [
                _row(task, row["player"], -1, row["test"], row["right"] / _NUM_EPISODES, row["return"])
                for row in _baselines(results, task)
            ]
    return pandas.DataFrame(rows)


def _row(config, player: str, seed: int, test: str, right: float, discounted: float) -> dict:
    return {
        "condition": config.label,
        "player": player,
        "training_seed": seed,
        "test": test,
        "right": right,
        "return": discounted,
    }


def find_claims(frame) -> list[claims.Claim]:
    """Agents trained with variation do well on fresh and on held-out episodes; those trained without do not."""
    found = []
    for condition, rows in frame.groupby("condition", sort=False):
        common = dict(condition=condition)
        word, middle = scores.middle(condition)
        varied, usual, rule = (_by_test(rows, player, "right") for player in (VARIED, USUAL, RULE))
        if len(varied):
            found += [
                claims.Claim(
                    **common,
                    text="Agents trained with variation are right in episodes that training never saw",
                    statistic=f"share of right answers with variation, {word} of agents",
                    estimate=middle(varied["varied"]),
                    above=LEAST_RIGHT,
                ),
                claims.Claim(
                    **common,
                    text="Agents trained with variation are right beyond what they were trained with",
                    statistic=f"share of right answers in the worst held-out test, {word} of agents",
                    estimate=middle(varied[list(HELD_OUT)].min(axis=1)),
                    above=LEAST_RIGHT_HELD_OUT,
                    reason="Agents know how towers move with the control steps and the friction that they were trained "
                    "with, and take others for other towers: timing tests that for control steps and the fist.",
                ),
            ]
        if len(varied) and len(usual):
            found.append(
                claims.Claim(
                    **common,
                    text="Agents trained without variation have learned the towers that they saw",
                    statistic="share of right answers with variation, trained with it less trained without, "
                    "mean difference",
                    estimate=estimates.difference_of_pairs(varied["varied"], usual["varied"]),
                    above=0,
                )
            )
        if len(rule):
            found.append(
                claims.Claim(
                    **common,
                    text="A rule of one line is right wherever towers vary",
                    statistic="share of right answers in the worst test; interval: of its episodes",
                    estimate=_share(float(rule.min(axis=1).iloc[0])),
                    above=LEAST_RIGHT,
                )
            )
            if len(varied):
                least = _by_test(rows, RULE, "return")["varied"].iloc[0]
                shares = _by_test(rows, VARIED, "return")["varied"] / least
                found.append(
                    claims.Claim(
                        **common,
                        text="Agents trained with variation earn nearly what the rule earns",
                        statistic="share of the rule's return with variation, which the ideal's is no less than, "
                        "median of agents",
                        estimate=estimates.median(shares),
                        above=LEAST_SHARE,
                    )
                )
    return found


def _by_test(rows, player: str, column: str):
    """Returns a table of a column of a player's: a row for each agent that had all tests, a column for each test."""
    table = rows[rows.player == player].pivot(index="training_seed", columns="test", values=column)
    return table.reindex(columns=list(TRIALS)).dropna()


def _share(right: float) -> estimates.Estimate:
    return estimates.proportion(np.arange(_NUM_EPISODES) < round(right * _NUM_EPISODES))


def draw(frame):
    """A panel for each condition: the share of right answers in each test."""
    names = list(frame.condition.unique())
    figure, panels = plots.new(rows=len(names), width=6.4, height=2.1, sharex=True, squeeze=False)
    places = np.arange(len(TRIALS))
    for axes, name in zip(panels[:, 0], names, strict=True):
        for number, (player, words) in enumerate(_WORDS.items()):
            table = _by_test(frame[frame.condition == name], player, "right")
            if not len(table):
                continue
            style = dict(color=plots.COLORS[number + 1], marker=plots.MARKERS[number], markersize=4)
            middle = table.median()
            spread = np.abs(table.agg(["min", "max"]) - middle).to_numpy() if len(table) > 1 else None
            shift = (number - 1.5) * 0.12
            axes.errorbar(places + shift, middle, yerr=spread, linestyle="none", capsize=2, label=words, **style)
        plots.reference(axes, conditions.chance("towers", conditions.TOWERS[0].task), "chance")
        axes.set(title=conditions.spelled_out(name), ylabel="share of right answers", ylim=(0, 1.05))
        axes.axvline(1.5, color=plots.GREY, linewidth=0.6)
    panels[-1, 0].set_xticks(places, [textwrap.fill(test, 9) for test in TRIALS])
    panels[-1, 0].set_xlabel("what is tested; right of the line: what no agent was trained with")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=2)
    return figure


EXPERIMENT = base.Experiment(
    name="generalization",
    title="Towers that nobody has seen",
    section=claims.OURS,
    caption="Share of right answers of agents that were trained as usual, where a tower with given actions plays one "
    "of 16 trajectories, and of agents that were trained with variation: of the tower's place and yaw, of where the "
    "fist starts, of forces or speed, friction and mass. Beside them two experimenters without training: a rule, which "
    "counts the neighbours whose distance has changed, and the best policy of an observer of 1 mm without variation, "
    "which takes each tower for the nearest of 16. Points are medians of agents, bars go from the worst to the best.",
    conditions=tuple(config for configs in CONDITIONS.values() for config in configs),
    trials=tuple(TRIALS.values()),
    prepare=prepare,
    load=load,
    claims=find_claims,
    draw=draw,
)
