"""Mass gaps in Which is Heavier, and the behaviour of agents at small gaps (paper, Section 5; Figures 1 and 3, right).

The gap is the difference between the heaviest and the second heaviest block. With noise, which the paper does not have,
a second poke of a block is informative.
"""

from collections.abc import Callable
import math
from typing import Any

import numpy as np
import pandas
from scipy import stats

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions, curves
from physexp.analysis.training import records
from physexp.suite.domains import which_is_heavier

_EPISODES = 200_000  # Of which the gaps are shown.
_SMALL = 0.1  # A gap that is hard to tell from none.
_DOTS = 4000  # Episodes drawn as dots.
_FEWEST = 20  # Episodes in a bin that is drawn.
_EDGES = np.linspace(0, 1, 11)
_GAPS = (_EDGES[1:] + _EDGES[:-1]) / 2  # The middles of the bins.

_NOISE = 0.03  # m, of each reading.
EXACT, NOISY = "exact readings", f"readings with noise of {1000 * _NOISE:g} mm"
FORESEEING = "the same noise, with foresight"
_BELIEF = conditions.with_belief(conditions.BY_LABEL["5-F"])
READINGS = (
    _BELIEF.changed(player=EXACT),
    conditions.with_noise(_BELIEF, NOISY, _NOISE),
    conditions.with_noise(conditions.with_foresight(conditions.BY_LABEL["5-F"])[0], FORESEEING, _NOISE),
)
"""The agents of `noise`, by the readings in training and test, and by the learner."""


def with_blocks(episodes):
    """Returns the episodes with `blocks`, the number of different blocks poked, in place of `actions`."""
    is_poke = which_is_heavier.NUM_BLOCKS
    poked = [len({action for action in actions if action < is_poke}) for actions in episodes.actions]
    return episodes.drop(columns="actions").assign(blocks=poked)


def by_gap(gaps: np.ndarray, values: np.ndarray, statistic: Callable = np.mean, fewest: int = _FEWEST) -> np.ndarray:
    """Returns a statistic of the values in each bin of mass gaps; NaN for bins with fewer values than the fewest."""
    bins = np.digitize(gaps, _EDGES[1:-1])
    chosen = [values[bins == number] for number in range(len(_GAPS))]
    return np.array([statistic(each) if len(each) >= fewest else np.nan for each in chosen])


def slope(x: np.ndarray, y: np.ndarray) -> float:
    """Returns the slope of the least-squares line, NaN if all x are the same."""
    return float(stats.linregress(x, y).slope) if np.ptp(x) else math.nan


# The gaps themselves, which no agent influences.


def load_gaps(results: base.Results):
    """Returns the mass gaps of the first episodes of seed 0, as the task draws them."""
    del results  # They need none.
    seeds, episodes = np.zeros(_EPISODES, np.int64), np.arange(_EPISODES)
    drawn = {beta: which_is_heavier.draw_masses(seeds, episodes, beta) for beta in conditions.DIFFICULTIES}
    frames = [
        pandas.DataFrame({"difficulty": beta, "mass_gap": which_is_heavier.mass_gaps(masses)})
        for beta, masses in drawn.items()
    ]
    return pandas.concat(frames, ignore_index=True)


def _more_small_gaps(frame, condition: str) -> estimates.Estimate:
    """Returns the difference of the shares of small gaps, in a condition as `beta 3 against 5`."""
    betas = map(float, condition.removeprefix("beta ").split(" against "))
    small = [frame.mass_gap[frame.difficulty == beta] < _SMALL for beta in betas]
    error = math.sqrt(sum(each.var(ddof=0) / len(each) for each in small))
    return estimates.normal(small[0].mean() - small[1].mean(), error)


def _draw_gaps(frame):
    """Draws the density of the mass gap."""
    figure, axes = plots.new()
    for number, difficulty in enumerate(conditions.DIFFICULTIES):
        gaps = frame.mass_gap[frame.difficulty == difficulty]
        density, edges = np.histogram(gaps, bins=np.linspace(0, 1, 51), density=True)
        style: dict[str, Any] = dict(color=plots.COLORS[number], linestyle=plots.DASHES[number], linewidth=1.4)
        axes.stairs(density, edges, label=f"β = {difficulty:g}", **style)
    axes.set(xlabel="mass gap (range of masses = 1)", ylabel="density", xlim=(0, 1), ylim=(0, None))
    axes.legend()
    return figure


# Individual agents with exact readings.


def load_individual(results: base.Results):
    """Returns episodes with the number of `blocks` that were poked.

    The attribute `ideal` has the ideal experimenter's mean pokes in each bin of mass gaps, by condition.
    """
    columns = ["mass_gap", "interactions", "label", "actions"]
    frame = with_blocks(results.episodes([base.LONG], conditions.PATIENT, columns))
    frame.attrs["ideal"] = {each.label: _ideal_pokes(each) for each in conditions.PATIENT}
    return frame


def _ideal_pokes(condition: conditions.Condition) -> list[float]:
    difficulty = condition.task_kwargs["difficulty"]
    masses = which_is_heavier.draw_masses(np.full(50_000, 1), np.arange(50_000), difficulty)
    pokes, _ = condition.ideal().play(masses)
    return by_gap(which_is_heavier.mass_gaps(masses), pokes, fewest=1).tolist()


def _answered(rows) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Returns the mass gaps, pokes and poked blocks of the answered episodes of each agent."""
    agents = rows[rows.label >= 0].groupby("training_seed")
    return [tuple(agent[["mass_gap", "interactions", "blocks"]].to_numpy(float).T) for _, agent in agents]


def _correlation_of_pokes(frame, condition: str) -> estimates.Estimate:
    rows = claims.rows(frame, condition=claims.named(condition))
    found = [estimates.correlation(gaps, pokes) for gaps, pokes, _ in _answered(rows)]
    if condition.endswith("each agent"):
        return max(found, key=lambda estimate: estimate.high)
    return estimates.mean([estimate.value for estimate in found])


def _share_of_blocks(rows) -> estimates.Estimate:
    slopes = [(slope(gaps, blocks), slope(gaps, pokes)) for gaps, pokes, blocks in _answered(rows)]
    return estimates.mean([of_blocks / of_pokes if of_pokes else math.nan for of_blocks, of_pokes in slopes])


def _draw_individual(frame):
    """Draws an agent of each difficulty: episodes, trend, spread, and the ideal experimenter's mean."""
    shown = [each for each in conditions.PATIENT if (frame.condition == each.label).any()]
    figure, panels = plots.new(columns=len(shown), width=2.3, height=2.3, sharey=True, squeeze=False)
    red, blue = plots.COLORS[2], plots.COLORS[1]
    for axes, each in zip(panels[0], shown, strict=True):
        gaps, pokes, _ = _answered(frame[frame.condition == each.label])[0]
        spread = np.random.default_rng(0).uniform(-0.3, 0.3, len(pokes[:_DOTS]))  # Dots of whole numbers coincide.
        style: dict[str, Any] = dict(s=1, color="black", alpha=0.25, linewidths=0, rasterized=True)
        axes.scatter(gaps[:_DOTS], pokes[:_DOTS] + spread, **style)
        means, deviations = (by_gap(gaps, pokes, statistic) for statistic in (np.mean, np.std))
        style = dict(fmt="s", color=red, markersize=3, linewidth=1, capsize=1.5)
        axes.errorbar(_GAPS, means, deviations, label="mean and standard deviation", **style)
        trend, ends = slope(gaps, pokes), np.array([0.0, 1.0])
        axes.plot(ends, pokes.mean() + trend * (ends - gaps.mean()), color=red, label="OLS")
        axes.plot(_GAPS, frame.attrs["ideal"][each.label], color=blue, linestyle=plots.DASHES[1], label="ideal")
        title = f"β = {each.task_kwargs['difficulty']:g}: slope {trend:.2f}"
        axes.set(xlabel="mass gap", title=title, xlim=(0, 1), ylim=(0, 15))
    panels[0, 0].set_ylabel("pokes before the answer")
    panels[0, -1].legend(loc="upper right", fontsize=6)
    return figure


# The same with noise.


_KNOWING = "noise/5-F"  # Stored.


def prepare_noise(results: base.Results, report: Callable[[str], None]) -> None:
    """Computes the return of an experimenter that knows of the noise, if it is not there yet."""
    words = "an experimenter that knows of the noise plays"
    results.make(_KNOWING, report, words, lambda: {"value": READINGS[1].ideal().value})


def load_noise(results: base.Results):
    """Returns episodes with the number of repeated pokes, `again`; the player is EXACT, NOISY, or FORESEEING.

    With noise, the `share` is that of the return of an experimenter that knows of the noise.

    Raises:
      ValueError: if no agent has played with noise.
    """
    columns = ["mass_gap", "interactions", "label", "actions", "reward", "length"]
    frame = with_blocks(results.with_player(results.episodes([base.EVALUATION], READINGS, columns), [NOISY]))
    share = (records.discounted_return(frame) / results.made(_KNOWING)["value"]).astype(float)
    return frame.assign(again=frame.interactions - frame.blocks, share=share)


def _by_agent(statistic: Callable[[Any], float], player: str, frame):
    """Returns a statistic of the episodes of each agent with some readings, by seed."""
    agents = claims.rows(frame, player=player).groupby("training_seed")
    return pandas.Series({seed: statistic(agent) for seed, agent in agents}, dtype=float)


def _with_noise(statistic: Callable[[Any], float], player: str = NOISY) -> claims.Statistic:
    """Returns the mean over agents of a statistic of the episodes with noise."""
    return claims.of_rows(lambda frame: estimates.mean(_by_agent(statistic, player, frame)))


def _noisy_less_exact(statistic: Callable[[Any], float]) -> claims.Statistic:
    """Returns the difference that noise makes to a statistic, over the seeds with both readings."""
    return claims.of_rows(
        lambda frame: estimates.difference_of_pairs(*(_by_agent(statistic, each, frame) for each in (NOISY, EXACT)))
    )


def _share(agent) -> float:
    return float(agent.share.mean())


def _correlation(agent) -> float:
    return estimates.correlation(*agent[["mass_gap", "interactions"]].to_numpy(float).T).value


def _slope_of_repeats(agent) -> float:
    return slope(*agent[["mass_gap", "again"]].to_numpy(float).T)


def _gap_of_repeats(agent) -> float:
    """Returns the mean gap of episodes with a repeated poke less that of the others, NaN without either."""
    again = agent.again > 0
    return agent.mass_gap[again].mean() - agent.mass_gap[~again].mean()


def _draw_noise(frame):
    """Draws repeated pokes, and all pokes, against the mass gap."""
    figure, panels = plots.new(columns=2, width=3.0, height=2.3)
    words = {"again": "pokes of blocks poked before", "interactions": "pokes before the answer"}
    for axes, (column, label) in zip(panels, words.items(), strict=True):
        for number, (readings, its) in enumerate(frame.groupby("player")):
            agents = its.groupby("training_seed")
            lines = [by_gap(agent.mass_gap.to_numpy(), agent[column].to_numpy()) for _, agent in agents]
            curves.draw_spread(axes, _GAPS, lines, number, readings)
        axes.set(xlabel="mass gap", ylabel=label, xlim=(0, 1), ylim=(0, None))
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=len(READINGS))
    figure.suptitle(plots.seeds(frame[frame.player == NOISY]), fontsize=7, x=0.99, ha="right")
    return figure


EXPERIMENTS = {
    "mass_gap": base.Experiment(
        **claims.described("mass_gap"),
        load=load_gaps,
        statistics={"small_gaps": _more_small_gaps},
        draw=_draw_gaps,
    ),
    "individual": base.Experiment(
        **claims.described("individual"),
        conditions=conditions.PATIENT,
        trials=(base.LONG,),
        load=load_individual,
        statistics={
            "longer_if_small": _correlation_of_pokes,
            "no_timeouts": claims.mean_of_agents(lambda rows: rows.label < 0, estimates.mean_share),
            "further_blocks": claims.of_rows(_share_of_blocks),
        },
        draw=_draw_individual,
    ),
    "noise": base.Experiment(
        **claims.described("noise"),
        conditions=READINGS,
        trials=(base.EVALUATION,),
        prepare=prepare_noise,
        load=load_noise,
        statistics={
            "again_if_small": _with_noise(_gap_of_repeats),
            "longer_if_small": _with_noise(_correlation),
            "near_ideal": _with_noise(_share),
            "foresight": _with_noise(_share, FORESEEING),
            "again": _noisy_less_exact(lambda agent: agent.again.mean()),
            "steeper": _noisy_less_exact(_slope_of_repeats),
            "clearer": _noisy_less_exact(_correlation),
        },
        draw=_draw_noise,
    ),
}
