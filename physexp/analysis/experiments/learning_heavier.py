"""Success in learning Which is Heavier (paper, Section 5.3; Figure 2)."""

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, learning

_STATISTIC = "share of right answers at the end of training, mean of agents"
_PERFECT = 0.99


def _names(kind: str) -> list[str]:
    """The conditions with a kind of observation, the hardest first."""
    return [condition.label for condition in conditions.HEAVIER if condition.task == kind]


def find_claims(frame) -> list[claims.Claim]:
    """Every condition is learned, and the easier the better."""
    final = learning.final_success(frame)
    found = learning.find_claims(
        frame,
        above=2 * conditions.chance("which_is_heavier", "features"),
        text="Agents are trained successfully from features and from pixels",
        section="5.3",
        statistic=f"{_STATISTIC}; twice chance is 0.5",
        words="a sanity check to show that we can train agents successfully",
        is_sanity_check=True,
    )
    found += learning.find_claims(
        frame,
        below=_PERFECT,
        text="Agents do not reach perfect performance",
        section="5.3",
        statistic=_STATISTIC,
        words="do not reach perfect performance",
        reason="The easier the task, the closer our agents come to the ideal experimenter, who is nearly always "
        "right; the paper's agents stopped short of it.",
    )
    for kind in conditions.OBSERVATIONS:
        names = _names(kind)
        for harder, easier in zip(names, names[1:], strict=False):
            rates = {name: final.success_rate[final.condition == name].to_numpy() for name in (harder, easier)}
            if min(map(len, rates.values())) > 0:
                found.append(
                    claims.Claim(
                        text="More difficult problems plateau at progressively lower performance",
                        section="5.3",
                        condition=f"{easier} against {harder}",
                        statistic="ratio of the shares of right answers",
                        estimate=estimates.ratio_of_means(rates[easier], rates[harder]),
                        above=1,
                        words="plateauing at progressively lower performance",
                    )
                )
    return found


def draw(frame):
    """A panel for each kind of observation."""
    curves = learning.smoothed(frame)
    accuracies = [conditions.heavier_ideal(beta).figures()["accuracy"] for beta in conditions.DIFFICULTIES]
    kinds = [kind for kind in conditions.OBSERVATIONS if (frame.task == kind).any()]
    figure, panels = plots.new(columns=len(kinds), sharey=True, squeeze=False)
    for axes, kind in zip(panels[0], kinds, strict=True):
        chance = conditions.chance("which_is_heavier", kind)
        labels = [f"β = {beta:g}" for beta in conditions.DIFFICULTIES]
        learning.draw_panel(axes, curves, _names(kind), labels, chance)
        low, high = min(accuracies), max(accuracies)
        plots.reference(axes, high, f"ideal: {low:.3f} to {high:.3f}")
        axes.set(ylim=(0, 1.08), yticks=[0, 0.2, 0.4, 0.6, 0.8, 1])
        axes.set_title(f"from {kind}")
        axes.legend(loc="lower right", bbox_to_anchor=(1, 0.3))
    panels[0, 0].set_ylabel("share of right answers")
    return figure


EXPERIMENT = base.Experiment(
    name="learning_heavier",
    title="Learning Which is Heavier",
    section="5.3, Figure 2",
    caption=f"{learning.CAPTION} Dotted at the top: the ideal experimenter, whose accuracy hardly depends on the "
    "difficulty.",
    conditions=conditions.HEAVIER,
    load=lambda results: results.curves(conditions.HEAVIER),
    claims=find_claims,
    draw=draw,
)
