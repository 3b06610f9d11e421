"""The return of every agent against the ideal experimenter's, and the kinds of loss (ours; docs/ideal.md)."""

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, ideal_towers
from physexp.analysis.ideal import mistakes
from physexp.analysis.training import records

CONDITIONS = (*conditions.HEAVIER, *conditions.TOWERS)
_WORDS = {
    "uninformative": "poked a block that was known",
    "late": "poked a block when answering was better",
    "early": "answered when another poke was better",
    "wrong": "gave another answer than the likeliest",
    "silence": "never answered",
}
"""What the kinds of mistakes are in this domain; any block that is not known is as good as another."""

LEAST = {3.0: 0.95, 5.0: 0.97, 10.0: 0.97}  # Share of the ideal's return that feature agents are to reach.


def load(results: base.Results):
    """A row for each agent: return, accuracy, interactions, the ideal's, and for Which is Heavier the cost by kind."""
    import pandas

    rows = []
    columns = ["actions", "label", "reward", "length", "interactions"]
    towers = ideal_towers.read(results)
    for condition in CONDITIONS:
        if not results.has_played(base.EVALUATION, condition):
            continue  # The figure shows those that have been trained.
        hidden = [] if condition.task in towers else ["masses"]
        frame = results.episodes([base.EVALUATION], [condition], [*columns, *hidden])
        for seed, episodes in frame.groupby("training_seed"):
            returns = records.discounted_return(episodes)
            rows.append(
                {
                    "condition": episodes.condition.iloc[0],
                    "domain": condition.domain,
                    "difficulty": condition.task_kwargs.get("difficulty"),
                    "training_seed": seed,
                    "agent_return": returns.mean(),
                    "return_error": returns.std(ddof=1) / np.sqrt(len(returns)),
                    "accuracy": (episodes.reward > 0).mean(),
                    "interactions": episodes.interactions.mean(),
                    **_ideal_of(condition, episodes, towers),
                }
            )
    if not rows:
        raise results.lacks("episodes")
    frame = pandas.DataFrame(rows)
    frame.attrs["towers"] = towers
    return frame


def _ideal_of(condition, episodes, stored: dict[str, list[dict]]) -> dict[str, float]:
    """The ideal's figures, kept with the results or else computed, and then what the agent's mistakes cost, by kind."""
    if condition.task in stored:
        summary, costs = ideal_towers.best(stored[condition.task]), {}
    else:
        solution = conditions.ideal(condition)
        summary = solution.figures()
        masses = np.stack(episodes.masses.to_numpy())
        actions = list(episodes.actions)
        costs = mistakes.of_episodes(solution.judge_all(masses, actions), actions, condition.agent.discount)
    return {
        "ideal_return": summary["value"],
        "ideal_accuracy": summary["accuracy"],
        "ideal_interactions": summary["mean_interactions"],
        **{kind: float(cost.mean()) for kind, cost in costs.items()},
    }


def median_of_top_half(values: np.ndarray) -> float:
    """The median of the larger half of some values."""
    return float(np.median(values[estimates.better_half(values)]))


def find_claims(frame) -> list[claims.Claim]:
    """Feature agents come close to the ideal; none beats it."""
    found = []
    for condition, agents in frame.groupby("condition", sort=False):
        shares = (agents.agent_return / agents.ideal_return).to_numpy()
        beta = agents.difficulty.iloc[0]
        least = LEAST[beta] if condition in ("3-F", "5-F", "10-F") else None
        if least is not None:
            found.append(
                claims.Claim(
                    text=f"Feature agents reach {least:.0%} of the ideal experimenter's return",
                    condition=condition,
                    statistic="share of the ideal's return, median of the better half of the agents",
                    estimate=estimates.bootstrap(shares, median_of_top_half),
                    above=least,
                )
            )
        best = int(shares.argmax())
        error = (agents.return_error / agents.ideal_return).to_numpy()[best]
        found.append(
            claims.Claim(
                text="No agent beats the ideal experimenter",
                condition=condition,
                statistic="share of the ideal's return, the best agent; interval: of its episodes; "
                "1 % allowed for luck",
                estimate=estimates.normal(shares[best], error),
                below=1.01,
                is_sanity_check=True,
            )
        )
    return found


def draw(frame):
    """Returns as shares of the ideal's, what is lost by kind, and how fine the towers' observer must see."""
    figure, (left, middle, right) = plots.new(columns=3, width=2.9, height=3.1)
    names = list(frame.condition.unique())
    places = np.arange(len(names))
    for place, name in zip(places, names, strict=True):
        agents = frame[frame.condition == name]
        left.plot(
            [place] * len(agents),
            agents.agent_return / agents.ideal_return,
            "o",
            color=plots.COLORS[1],
            markersize=2.5,
            alpha=0.6,
        )
    plots.reference(left, 1.0, "ideal", at=0.35)
    left.set_xticks(places, [conditions.tick(name) for name in names], rotation=90)
    left.set(ylabel="discounted return, share of the ideal's")
    _draw_costs(middle, frame)
    _draw_resolutions(right, frame.attrs["towers"])
    return figure


def _draw_costs(axes, frame) -> None:
    heavier = frame[frame.domain == "which_is_heavier"]
    if heavier.empty:
        axes.set_axis_off()
        return
    means = heavier.groupby("condition", sort=False)[list(_WORDS)].mean()
    ticks = [conditions.tick(name) for name in means.index]
    base_of_bar = np.zeros(len(means))
    for number, (kind, words) in enumerate(_WORDS.items()):
        if (means[kind] > 1e-4).any():
            axes.bar(
                ticks,
                means[kind],
                bottom=base_of_bar,
                color=plots.COLORS[1:][number],
                label=words,
                hatch=[None, "///", "...", "xx", "++"][number],
                edgecolor="white",
                linewidth=0.3,
            )
        base_of_bar = base_of_bar + means[kind].to_numpy()
    axes.set(ylabel="return lost against the ideal")
    axes.tick_params(axis="x", rotation=90)
    axes.legend(fontsize=5.5, loc="upper left", bbox_to_anchor=(0, 1.18))
    axes.set_ylim(0, 1.35 * base_of_bar.max())


def _draw_resolutions(axes, towers: dict[str, list[dict]]) -> None:
    tasks = [each.task for each in conditions.TOWERS if conditions.observations(each) == "features"]
    for number, task in enumerate(tasks):
        rows = [row for row in towers[task] if row["objective"] == "time" and row["value"] is not None]
        axes.plot(
            [max(row["resolution"], 3e-4) * 1e3 for row in rows],
            [row["mean_seconds"] for row in rows],
            color=plots.COLORS[number],
            linestyle=plots.DASHES[number],
            marker=plots.MARKERS[number],
            markersize=3.5,
            label=conditions.tick(conditions.label("towers", task)),
        )
    axes.set(
        xscale="log",
        xlabel="resolution, mm (leftmost: every bit)",
        ylabel="least expected time to know, s",
        ylim=(0, None),
    )
    axes.legend(loc="upper left")


EXPERIMENT = base.Experiment(
    name="ideal_gap",
    title="Agents against the ideal experimenter",
    section=claims.OURS,
    caption="Left: each agent's mean discounted return over 10,000 episodes, actions drawn, as a share of the ideal "
    "experimenter's; in Towers, of the one to whom every bit tells something. Middle: what of the ideal's return is "
    "lost to which kind of mistake, mean of agents. Right: the least expected time after which the number of bodies "
    "of a tower can be known, by the observer's resolution.",
    conditions=CONDITIONS,
    trials=(base.EVALUATION,),
    prepare=ideal_towers.prepare,
    load=load,
    claims=find_claims,
    draw=draw,
)
