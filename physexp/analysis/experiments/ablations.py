"""Ablations: what the parts of the belief learner are good for. Ours."""

from typing import Any

from physexp.agents.belief import config as belief
from physexp.analysis.data import plots
from physexp.analysis.experiments import base, claims, conditions, ideal_towers, learning, scores

_WHOLE = "belief"
# Without replay only the last round is learned from.
VARIANTS: dict[str, tuple[str, dict[str, Any]]] = {
    "belief_no_replay": ("without replay", {"replay_episodes": belief.NUM_ENVIRONMENTS}),
    "belief_last_step": ("belief at the last step alone", {"every_step": False}),
    "belief_lstm": ("an LSTM in place of attention", {"memory": "lstm"}),
    "belief_revealed": ("answers revealed", {"answers_revealed": True}),
}
"""What the variants of the learner are called, and how they are configured, by title."""
WORDS = {_WHOLE: "belief learner", **{title: words for title, (words, _) in VARIANTS.items()}}

_TASKS = (conditions.BY_LABEL["5-F"], conditions.BY_LABEL["D-F"])
CONDITIONS = tuple(
    conditions.with_belief(task, **changes)
    for task in _TASKS
    for changes in ({}, *(changes for _, changes in VARIANTS.values()))
)
_CLAIMS = {
    "belief_no_replay": "Replay saves the belief learner environment steps",
    "belief_last_step": "A belief learned at every step saves environment steps",
    "belief_lstm": "Attention saves environment steps against an LSTM",
    "belief_revealed": "Revealed answers save environment steps",
}


def load(results: base.Results):
    """Learning curves of all variants; see `scores.load`.

    Raises:
      ValueError: if no variant has been trained.
    """
    frame = scores.load(results, CONDITIONS)
    if not frame.algorithm.isin(VARIANTS).any():
        raise results.lacks("finished runs")
    return frame


def find_claims(frame) -> list[claims.Claim]:
    """Each part pays, and so does more information."""
    found = []
    for label in frame.condition.unique():
        for variant, text in _CLAIMS.items():
            quick, slow = (variant, _WHOLE) if variant == "belief_revealed" else (_WHOLE, variant)
            found += scores.fewer_frames(
                *(scores.runs(frame, label, title) for title in (quick, slow)),
                text=text,
                condition=label,
                statistic=f"environment steps to {scores.level(label)}, ratio of geometric means "
                f"({WORDS[quick]} / {WORDS[slow]})",
            )
    return found


def draw(frame):
    """A panel for each task."""
    shown = [task for task in _TASKS if (frame.condition == task.label).any()]
    figure, panels = plots.new(columns=len(shown), width=3.2, height=2.4, sharey=True, squeeze=False)
    for axes, task in zip(panels[0], shown, strict=True):
        for number, (title, words) in enumerate(WORDS.items()):
            if runs := scores.runs(frame, task.label, title):
                learning.draw_range(axes, runs, number, words, "frames", "score")
        plots.reference(axes, scores.LEVEL, "")
        axes.set(xscale="log", ylim=(scores.FLOOR, 1.05), title=conditions.spelled_out(task.label))
        axes.set(xlabel=learning.AXES["frames"][1])
    panels[0, 0].set_ylabel("share of the ideal")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


EXPERIMENT = base.Experiment(
    name="ablations",
    title="What the parts of the belief learner are good for",
    section=claims.OURS,
    caption="The belief learner without one of its parts, and with answers revealed, against environment steps: return "
    "in the quarter of the episodes that are played greedily, averaged over the last 2000 episodes. An agent without "
    "replay learns from the last round of episodes alone, as often. Light: from the worst agent to the best; dark: "
    "their median.",
    conditions=CONDITIONS,
    prepare=ideal_towers.prepare,
    load=load,
    claims=find_claims,
    draw=draw,
)
