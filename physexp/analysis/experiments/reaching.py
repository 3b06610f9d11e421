"""Reaching: whether a fist is learned more slowly than direct pushes since it must first travel to the tower. Ours."""

from typing import Any

from physexp.analysis.data import plots
from physexp.analysis.experiments import base, claims, conditions, learning, scores

NEAR, FAR, DIRECT = "fist at the tower", "fist", "direct pushes"
_DISTANCE = 0.16  # m, of the fist from the tower's axis, which leaves 1 cm between them; usually it is 0.32 m.


def _condition(actuator: str, kind: str, **task_kwargs: float):
    """Returns a condition of the belief learner, who is told nothing of where the tower is."""
    return conditions.with_task_kwargs(conditions.with_belief(conditions.towers(actuator, kind)), **task_kwargs)


CONDITIONS = {
    kind: {
        NEAR: _condition("fist", kind, fist_distance=_DISTANCE),
        FAR: _condition("fist", kind),
        DIRECT: _condition("direct", kind),
    }
    for kind in conditions.OBSERVATIONS
}
"""The agents, by what they observe and how they act."""


def load(results: base.Results):
    """Learning curves of all agents: rows of metrics, with their `player` and `score`.

    The column `condition` is what they observe, and `score` is the share of right answers in greedy episodes.

    Raises:
      ValueError: if no agent was trained with a fist that stands at the tower.
    """
    import pandas

    frames = []
    for kind, players in CONDITIONS.items():
        if not results.has_finished(players[NEAR]):
            continue
        for player, config in players.items():
            if results.has_finished(config):
                frame = results.curves([config])
                frames.append(frame.assign(condition=kind, player=player, score=frame.greedy_success_rate))
    if not frames:
        raise results.lacks("finished runs")
    return pandas.concat(frames, ignore_index=True)


def find_claims(frame) -> list[claims.Claim]:
    """What the way to the tower costs, and whether the fist leads to faster learning where there is none."""
    found = []
    for kind in frame.condition.unique():
        near, far, direct = (_runs(frame, kind, player) for player in (NEAR, FAR, DIRECT))
        common: dict[str, Any] = dict(condition=kind)
        reached = f"environment steps to {scores.LEVEL:.0%} right answers"
        found += scores.fewer_frames(
            near,
            far,
            **common,
            text="A fist that stands at the tower is learned from fewer environment steps than one that must travel",
            statistic=f"{reached}, fist at the tower over fist, ratio of geometric means",
        )
        found += scores.fewer_frames(
            near,
            direct,
            **common,
            text="A fist that stands at the tower leads to faster learning than direct actuation",
            statistic=f"{reached}, fist at the tower over direct, ratio of geometric means",
            words="the fist actuators lead to the fastest learning",
        )
    return found


def _runs(frame, kind: str, player: str) -> list:
    return [run for _, run in frame[(frame.condition == kind) & (frame.player == player)].groupby("training_seed")]


def draw(frame):
    """A panel for each kind of observation: the share of right answers against environment steps."""
    kinds = list(frame.condition.unique())
    figure, panels = plots.new(columns=len(kinds), width=3.0, height=2.3, sharey=True, squeeze=False)
    for axes, kind in zip(panels[0], kinds, strict=True):
        for number, player in enumerate((NEAR, FAR, DIRECT)):
            if runs := _runs(frame, kind, player):
                learning.draw_range(axes, runs, number, player, "frames", "score")
        plots.reference(axes, conditions.chance("towers", conditions.TOWERS[0].task), "chance")
        axes.set(title=kind, xscale="log", xlabel=learning.AXES["frames"][1])
    panels[0, 0].set(ylabel="share of right answers", ylim=(0, 1.02))
    panels[0, 0].legend(loc="upper left")
    return figure


EXPERIMENT = base.Experiment(
    name="reaching",
    title="The way to the tower",
    section=claims.OURS,
    caption="Share of right greedy answers of the belief learner in Towers, against the environment steps that it has "
    "learned from: with the fist, with a fist that starts 1 cm from the tower, and with direct pushes. Nobody is told "
    "where the tower is. Dark: the median of agents; light: from the worst to the best.",
    conditions=tuple(config for players in CONDITIONS.values() for config in players.values()),
    load=load,
    claims=find_claims,
    draw=draw,
)
