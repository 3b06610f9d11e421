"""Does an agent that is in a hurry experiment less? Agents with a gamma of 0.9 against agents with 0.98."""

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions

HASTY, PATIENT = (
    conditions.heavier(difficulty=5.0, observations="features", frames=2_000_000, discount=discount)
    for discount in (0.9, 0.98)
)


def load(results):
    """The episodes that the agents have played: one row each."""
    return results.episodes([base.LEARNED], [HASTY, PATIENT], ["interactions"])


def mean_pokes(frame, config):
    """Mean pokes of each agent of a condition."""
    rows = frame[frame.discount == config.agent.discount]
    return rows.groupby("training_seed").interactions.mean()


CLAIM = claims.Claim(
    id="less_if_hasty",
    text="An agent that is in a hurry experiments less",
    on=["5-F"],
    statistic="mean pokes at gamma 0.9 over those at 0.98, ratio of geometric means over agents",
    below=1,
)


def ratio(frame):
    """The statistic of the claim, with its interval."""
    return estimates.ratio_of_means(mean_pokes(frame, HASTY), mean_pokes(frame, PATIENT))


def draw(frame):
    """A dot for each agent."""
    figure, axes = plots.new()
    for number, config in enumerate((HASTY, PATIENT)):
        pokes = mean_pokes(frame, config)
        axes.plot([number] * len(pokes), pokes, plots.MARKERS[number], color=plots.COLORS[number])
    axes.set_xticks([0, 1], ["0.9", "0.98"])
    axes.set(xlabel="the agent's gamma", ylabel="pokes in an episode", xlim=(-0.5, 1.5), ylim=(0, None))
    return figure


EXPERIMENT = base.Experiment(
    name="haste",
    title="Haste and patience",
    section="ours",
    caption="Mean pokes of each agent.",
    claims=(CLAIM,),
    conditions=(HASTY, PATIENT),
    trials=(base.LEARNED,),
    load=load,
    statistics={"less_if_hasty": claims.of_rows(ratio)},
    draw=draw,
)
