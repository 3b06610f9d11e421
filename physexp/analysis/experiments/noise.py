"""Noise: whether small mass gaps make agents poke a block again where one poke does not tell all. Ours."""

from collections.abc import Callable
from typing import Any

import numpy as np

from physexp.analysis import domains
from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, blocks, claims, conditions
from physexp.analysis.training import records

EXACT, NOISY = "exact", "noisy"
_NOISE = 0.03  # m, of each reading.
_TASK = conditions.BY_LABEL["5-F"]
CONDITIONS = {
    EXACT: conditions.with_belief(_TASK),
    NOISY: conditions.with_noise(conditions.with_belief(_TASK), _NOISE),
}
"""The agents, by the readings that they were trained with and are tested with."""

# Written down before any agent was trained with noise.
SMALLER, CLEAR, LEAST_SHARE = -0.1, -0.3, 0.95
STEEPER = -0.5  # Pokes. Chosen when the data were known.

_WORDS = {EXACT: "exact readings", NOISY: f"readings with noise of {1000 * _NOISE:g} mm"}


def prepare(results: base.Results, report: Callable[[str], None]) -> None:
    """Lets the experimenter who counts with noise play, where it has not; `report` is told so."""
    path = _path(results)
    if path.exists():
        return
    report("an experimenter who counts with noise plays")
    task = CONDITIONS[NOISY]
    find = domains.find(task.domain).ideal
    assert find is not None
    solution = find(task.task, task.task_kwargs, task.agent.discount)
    base.keep_made(path, {"value": solution.value})


def _path(results: base.Results):
    return results.path / "noise" / f"{CONDITIONS[NOISY].label}.json"


def _is_value(found: Any) -> bool:
    return isinstance(found, dict) and set(found) == {"value"} and isinstance(found["value"], float)


def load(results: base.Results):
    """Episodes with their `readings`, and how often a block was poked `again`.

    `share` is that of the return of the experimenter who counts with noise; NaN where readings are exact.

    Raises:
      ValueError: if no agent has played.
    """
    import pandas

    frames = []
    for readings, config in CONDITIONS.items():
        if not results.has_played(base.EVALUATION, config):
            continue
        columns = ["mass_gap", "interactions", "label", "actions", "reward", "length"]
        frame = blocks.counted(results.episodes([base.EVALUATION], [config], columns))
        share = np.nan
        if readings == NOISY:
            share = records.discounted_return(frame) / base.read_made(_path(results), "noise", _is_value)["value"]
        frames.append(frame.assign(readings=readings, again=frame.interactions - frame.blocks, share=share))
    if not any((frame.readings == NOISY).any() for frame in frames):
        raise results.lacks("episodes")
    return pandas.concat(frames, ignore_index=True)


def find_claims(frame) -> list[claims.Claim]:
    """Noise makes agents poke a block again, above all where the mass gap is small."""
    if not (frame.readings == NOISY).any():
        return []
    common: dict[str, Any] = dict(condition=CONDITIONS[NOISY].label)
    found = [
        claims.Claim(
            **common,
            text="With noise, agents poke a block again where the mass gap is small",
            statistic="mean mass gap of episodes in which a block is poked again less that of others, mean of agents",
            estimate=estimates.mean(_by_agent(frame, NOISY, _gap_of_second_pokes)),
            below=SMALLER,
        ),
        claims.Claim(
            **common,
            text="With noise, the smaller the mass gap, the longer an agent experiments",
            statistic="correlation of pokes and mass gap, mean of agents",
            estimate=estimates.mean(_by_agent(frame, NOISY, _correlation)),
            below=CLEAR,
            words="a clear correlation",
        ),
        claims.Claim(
            **common,
            text="Agents earn nearly what an experimenter earns who knows of the noise",
            statistic="share of its return, median of agents",
            estimate=estimates.median(_by_agent(frame, NOISY, lambda agent: agent.share.mean())),
            above=LEAST_SHARE,
            reason="They read noise worse than Bayes' rule does (docs/belief.md has what one of them loses by that).",
        ),
    ]
    if (frame.readings == EXACT).any():
        found += [
            claims.Claim(
                **common,
                text="Noise makes agents poke blocks again",
                statistic="pokes of blocks that were poked before, in an episode, with noise less without, mean "
                "difference",
                estimate=_difference(frame, lambda agent: agent.again.mean()),
                above=0,
            ),
            claims.Claim(
                **common,
                text="Noise makes a small mass gap cost more pokes of blocks that were poked before",
                statistic="slope of these pokes on mass gap, with noise less without, mean difference; found in these "
                "data",
                estimate=_difference(frame, _slope),
                below=STEEPER,
            ),
            claims.Claim(
                **common,
                text="Noise makes it clearer that agents experiment longer where the mass gap is small",
                statistic="correlation of pokes and mass gap, with noise less without, mean difference; found in these "
                "data",
                estimate=_difference(frame, _correlation),
                below=0,
                reason="A small gap costs more pokes with noise, as is tested above. But agents then poke more often "
                "whatever the gap, by what they happen to read, and that hides it.",
            ),
        ]
    return found


def _by_agent(frame, readings: str, figure: Callable[[Any], float]):
    """Returns a figure of the episodes of each agent with some readings, by seed."""
    import pandas

    agents = frame[frame.readings == readings].groupby("training_seed")
    return pandas.Series({seed: figure(agent) for seed, agent in agents}, dtype=float)


def _difference(frame, figure: Callable[[Any], float]) -> estimates.Estimate:
    """Returns by how much a figure is larger with noise than without, of the seeds that have both."""
    return estimates.difference_of_pairs(*(_by_agent(frame, readings, figure) for readings in (NOISY, EXACT)))


def _correlation(agent) -> float:
    return estimates.correlation(*agent[["mass_gap", "interactions"]].to_numpy(float).T).value


def _slope(agent) -> float:
    return estimates.slope(*agent[["mass_gap", "again"]].to_numpy(float).T).value


def _gap_of_second_pokes(agent) -> float:
    """Returns the mean gap of episodes in which a block is poked again less that of others, NaN without either."""
    again = agent.again > 0
    return agent.mass_gap[again].mean() - agent.mass_gap[~again].mean()


def draw(frame):
    """Pokes of blocks that were poked before, and all pokes, against the mass gap."""
    figure, panels = plots.new(columns=2, width=3.0, height=2.3)
    words = {"again": "pokes of blocks poked before", "interactions": "pokes before the answer"}
    for axes, (column, label) in zip(panels, words.items(), strict=True):
        for number, readings in enumerate(_WORDS):
            lines = [
                blocks.by_gap(agent.mass_gap.to_numpy(), agent[column].to_numpy())
                for _, agent in frame[frame.readings == readings].groupby("training_seed")
            ]
            if not lines:
                continue
            style = dict(color=plots.COLORS[number + 1], marker=plots.MARKERS[number], markersize=3)
            axes.fill_between(
                blocks.GAPS, np.min(lines, axis=0), np.max(lines, axis=0), alpha=0.2, color=style["color"]
            )
            axes.plot(blocks.GAPS, np.median(lines, axis=0), label=_WORDS[readings], **style)
        axes.set(xlabel="mass gap", ylabel=label, xlim=(0, 1), ylim=(0, None))
    panels[0].legend()
    figure.suptitle(plots.seeds(frame[frame.readings == NOISY]), fontsize=7, x=0.99, ha="right")
    return figure


EXPERIMENT = base.Experiment(
    name="noise",
    title="Noise that pays for a second poke",
    section=claims.OURS,
    caption="Which is Heavier where each reading has noise: how often a block is poked that was poked before (left), "
    "and all pokes (right), against the mass gap; agents of the belief learner, actions drawn. Beside them its agents "
    "where readings are exact, to whom a second poke tells nothing. Dark: the median of agents; light: from the least "
    "to the most.",
    conditions=tuple(CONDITIONS.values()),
    trials=(base.EVALUATION,),
    prepare=prepare,
    load=load,
    claims=find_claims,
    draw=draw,
)
