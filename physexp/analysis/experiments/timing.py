"""Timing: agents who know control steps of many lengths, against those who know one. Ours."""

from collections.abc import Callable
from typing import Any

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.domains import towers
from physexp.analysis.experiments import base, claims, conditions, generalization
from physexp.analysis.ideal import rollouts
from physexp.analysis.training import playing

ONE, MANY = "trained with control steps of 0.1 s", "trained with control steps of 0.05 to 0.15 s"
WAITS = "rule, after a fixed number of control steps"
_FIST = conditions.with_variation(conditions.with_belief(conditions.BY_LABEL["F-F"]))
CONDITIONS = {ONE: _FIST, MANY: conditions.with_step_variation(_FIST)}
"""The agents, by how they were trained; both with variation."""


def _trial(timestep: float) -> base.Trial:
    return generalization.make_trial(f"steps{timestep:g}", variation=1.0, control_timestep=timestep)


STEPS = {
    0.05: generalization.TRIALS["steps of 0.05 s"],
    0.075: _trial(0.075),
    0.1: generalization.TRIALS["varied"],
    0.125: _trial(0.125),
    0.15: generalization.TRIALS["steps of 0.15 s"],
}
"""What is played, by the length of the control step, s."""
FRICTION = generalization.TRIALS["friction 0.48"]
"""What neither was trained with."""
_SHORTEST, _, _USUAL, _, _LONGEST = STEPS
_NUM_ACTORS = 100  # Of the rule, side by side.

# Written down before any agent that was trained with control steps of many lengths had played.
LEAST_RIGHT, AS_LONG, MORE_STEPS = 0.97, (0.67, 1.5), 1.5


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Lets the rule play, with answers after as many control steps as it takes at most at 0.1 s; tells `report` so."""
    path = _path(results)
    if path.exists():
        return
    report("a rule that waits for a fixed number of control steps plays")
    _, lengths = _played(None, _USUAL)
    wait = int((lengths - 1).max())
    right = {f"{timestep:g}": float((_played(wait, timestep)[0] > 0).mean()) for timestep in STEPS}
    base.keep_made(path, {"wait": wait, "right": right})


def _played(wait: int | None, timestep: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns the rule's final rewards and numbers of actions in the episodes of a trial."""
    trial = STEPS[timestep]
    actors = [towers.rule(_FIST.task, wait=wait) for _ in range(_NUM_ACTORS)]
    rounds = trial.num_episodes // _NUM_ACTORS
    return rollouts.play(actors, _FIST.domain, _FIST.task, trial.task_kwargs, rounds, playing.SEED)


def _path(results: base.Results):
    return results.path / "timing" / f"{_FIST.label}.json"


def _is_made(found: Any) -> bool:
    return (
        isinstance(found, dict)
        and {name: type(value) for name, value in found.items()} == {"wait": int, "right": dict}
        and set(found["right"]) == {f"{timestep:g}" for timestep in STEPS}
        and all(isinstance(value, float) for value in found["right"].values())
    )


def load(results: base.Results):
    """How everybody has played: a row for each player, agent and test.

    Columns are condition, player, training_seed (-1 for the rule), step (the control step, s), friction (whether it is
    that of `FRICTION`), right (the share of right answers), interactions and time (s, medians), and too_many (the share
    of wrong answers that count too many bodies, NaN where none is wrong).

    Raises:
      ValueError: if no agent that knows many control steps has played at all of them.
    """
    import pandas

    columns = ["reward", "answer", "label", "interactions", "time"]
    tests = [(timestep, False, trial) for timestep, trial in STEPS.items()] + [(_USUAL, True, FRICTION)]
    rows = []
    for player, config in CONDITIONS.items():
        for timestep, friction, trial in tests:
            if results.has_played(trial, config):
                frame = results.episodes([trial], [config], columns)
                for seed, its in frame.groupby("training_seed"):
                    rows.append(_row(player, seed, timestep, friction, _summary(its)))
    if not rows or not len(_by_step(pandas.DataFrame(rows), MANY)):
        raise results.lacks("episodes")
    made = base.read_made(_path(results), "timing", _is_made)
    for timestep in STEPS:
        its = {"right": made["right"][f"{timestep:g}"], "interactions": made["wait"], "time": made["wait"] * timestep}
        rows.append(_row(WAITS, -1, timestep, False, {**its, "too_many": np.nan}))
    return pandas.DataFrame(rows)


def _summary(episodes) -> dict[str, float]:
    wrong = episodes[episodes.reward < 0]
    return {
        "right": (episodes.reward > 0).mean(),
        "interactions": episodes.interactions.median(),
        "time": episodes.time.median(),
        "too_many": (wrong.label > wrong.answer).mean(),
    }


def _row(player: str, seed: int, timestep: float, friction: bool, summary: dict[str, float]) -> dict:
    told = {"condition": _FIST.label, "player": player, "training_seed": seed, "step": timestep, "friction": friction}
    return {**told, **summary}


def find_claims(frame) -> list[claims.Claim]:
    """Who knows control steps of many lengths waits for information; who knows one takes another for other towers."""
    many, one, waits = (_by_step(frame, player) for player in (MANY, ONE, WAITS))
    common: dict[str, Any] = dict(condition=_FIST.label)
    times = f"median time to the answer, control steps of {_SHORTEST:g} s over {_USUAL:g} s, mean ratio"
    found = [
        claims.Claim(
            **common,
            text="Who was trained with control steps of many lengths is right at each of them",
            statistic="share of right answers at the worst control step, median of agents",
            estimate=estimates.median(many.right.min(axis=1)),
            above=LEAST_RIGHT,
        ),
        claims.Claim(
            **common,
            text="Who was trained with control steps of many lengths waits for a time",
            statistic=times,
            estimate=estimates.ratio_of_pairs(many.time[_SHORTEST], many.time[_USUAL]),
            above=AS_LONG[0],
            below=AS_LONG[1],
            words="approximate the same amount of real time",
        ),
        claims.Claim(
            **common,
            text="Who was trained with control steps of many lengths does not wait for a number of them",
            statistic=f"median control steps to the answer, of {_SHORTEST:g} s over {_USUAL:g} s, mean ratio; 1 for a "
            "number of steps, 2 for a time",
            estimate=estimates.ratio_of_pairs(many.interactions[_SHORTEST], many.interactions[_USUAL]),
            above=MORE_STEPS,
            words="waiting a fixed amount of steps",
        ),
        claims.Claim(
            **common,
            text="In fine time an agent is right more often than a rule that waits for a number of control steps",
            statistic=f"share of right answers at {_SHORTEST:g} s, less that of the rule, mean of agents",
            estimate=estimates.mean(many.right[_SHORTEST] - waits.right[_SHORTEST].iloc[0]),
            above=0,
        ),
    ]
    if len(one):
        errors = (one.too_many[_SHORTEST] - one.too_many[_LONGEST]).dropna()
        slippery = (frame[frame.friction & (frame.player == player)] for player in (MANY, ONE))
        pairs = [rows.set_index("training_seed").right for rows in slippery]
        found += [
            claims.Claim(
                **common,
                text="In fine time, who knows control steps of many lengths is right more often than who knows one",
                statistic=f"share of right answers at {_SHORTEST:g} s, with many less with one, mean difference; found "
                "in these data",
                estimate=estimates.difference_of_pairs(many.right[_SHORTEST], one.right[_SHORTEST]),
                above=0,
            ),
            claims.Claim(
                **common,
                text="Who was trained with control steps of one length waits for a time as well",
                statistic=f"{times}; found in these data",
                estimate=estimates.ratio_of_pairs(one.time[_SHORTEST], one.time[_USUAL]),
                above=AS_LONG[0],
                below=AS_LONG[1],
                words="approximate the same amount of real time",
            ),
            claims.Claim(
                **common,
                text="Who was trained with control steps of one length takes shorter ones for more bodies, and longer "
                "ones for fewer",
                statistic=f"share of wrong answers that count too many bodies, control steps of {_SHORTEST:g} s less "
                f"{_LONGEST:g} s, mean of agents; found in these data",
                estimate=estimates.mean(errors),
                above=0.5,
            ),
            claims.Claim(
                **common,
                text="Who was trained with control steps of many lengths is right more often where friction is high",
                statistic="share of right answers at friction 0.48, less that of who was trained with one length, mean "
                "difference",
                estimate=estimates.difference_of_pairs(*pairs),
                above=0,
            ),
        ]
    return found


def _by_step(frame, player: str):
    """Returns a player's figures: a row for each agent that had all control steps, columns by figure and step."""
    import pandas

    rows = frame[(frame.player == player) & ~frame.friction]
    values = ["right", "interactions", "time", "too_many"]
    columns = pandas.MultiIndex.from_product([values, sorted(STEPS)])
    table = rows.pivot(index="training_seed", columns="step", values=values).reindex(columns=columns)
    return table[table.right.notna().all(axis=1)]


def draw(frame):
    """Against the control step: the share of right answers, and the median time to the answer."""
    figure, panels = plots.new(columns=2, width=3.0, height=2.3)
    words = {"right": "share of right answers", "time": "time to the answer, s"}
    for axes, (column, label) in zip(panels, words.items(), strict=True):
        for number, player in enumerate((ONE, MANY, WAITS)):
            table = _by_step(frame, player)
            if not len(table):
                continue
            style = dict(color=plots.COLORS[number + 1], marker=plots.MARKERS[number], markersize=3)
            values = table[column]
            axes.fill_between(values.columns, values.min(), values.max(), alpha=0.2, color=style["color"])
            axes.plot(values.columns, values.median(), label=player, **style)
        axes.set(xlabel="control step, s", ylabel=label, ylim=(0, None))
    plots.reference(panels[0], conditions.chance(_FIST.domain, _FIST.task), "chance")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=1)
    return figure


EXPERIMENT = base.Experiment(
    name="timing",
    title="Control steps of many lengths",
    section=claims.OURS,
    caption="The fist, features, with variation: share of right answers and median time to the answer against the "
    "control step, of agents of the belief learner that were trained with control steps of one length and of many. "
    "Beside them the rule of `generalization`, here with its answer after as many control steps as it takes at most at "
    "0.1 s. Lines: medians of agents; shaded: from the worst to the best.",
    conditions=tuple(CONDITIONS.values()),
    trials=(*STEPS.values(), FRICTION),
    prepare=prepare,
    load=load,
    claims=find_claims,
    draw=draw,
)
