"""Success in learning Towers (paper, Section 6.3; Figure 6)."""

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, learning

_NEARLY_PERFECT = 0.95
_LEARNED = 0.9  # The success whose first frame is compared between actuators.


def find_claims(frame) -> list[claims.Claim]:
    """All four conditions are solved, and the fist learns first."""
    found = learning.find_claims(
        frame,
        above=_NEARLY_PERFECT,
        text="All four conditions are solved nearly perfectly",
        section="6.3",
        statistic="share of right answers at the end of training, mean of agents",
        words="solve the task nearly perfectly",
    )
    for kind in conditions.OBSERVATIONS:
        names = [conditions.label("towers", f"{actuator}_{kind}") for actuator in ("fist", "direct")]
        fist, direct = learning.compare_first_reached(frame, names, _LEARNED)
        if len(fist) and len(direct):
            found.append(
                claims.Claim(
                    text="The fist leads to faster learning than direct actuation",
                    section="6.3",
                    condition=kind,
                    statistic=f"environment steps to {_LEARNED:.0%} right answers, fist over direct, ratio of "
                    "geometric means; fist agents alone were told in which direction the tower is",
                    estimate=estimates.ratio_of_means(fist, direct),
                    below=1,
                    words="the fist actuators lead to the fastest learning",
                    reason="Every push touches the tower, while the fist must first travel to it: reaching tests "
                    "whether that is why. Agents who are told nothing are compared in data_efficiency.",
                )
            )
    return found


def draw(frame):
    """A panel for each condition."""
    curves = learning.smoothed(frame)
    tasks = [condition.task for condition in conditions.TOWERS if (frame.task == condition.task).any()]
    figure, panels = plots.new(columns=len(tasks), width=2.0, height=2.2, sharey=True, squeeze=False)
    for axes, task in zip(panels[0], tasks, strict=True):
        name = conditions.label("towers", task)
        learning.draw_panel(axes, curves, [name], ["median"], conditions.chance("towers", task))
        axes.set_title(task.replace("_", ", "))
    panels[0, 0].set_ylabel("share of right answers")
    return figure


EXPERIMENT = base.Experiment(
    name="learning_towers",
    title="Learning Towers",
    section="6.3, Figure 6",
    caption=f"{learning.CAPTION} An ideal experimenter is always right. The steps to a level are compared within the "
    "shortest training of both actuators; an agent who needs longer counts as one who gets there at its end.",
    conditions=conditions.TOWERS,
    load=lambda results: results.curves(conditions.TOWERS),
    claims=find_claims,
    draw=draw,
)
