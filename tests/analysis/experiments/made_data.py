"""Made data for every experiment: frames as its `load` gives them, from worlds in which we know what is true.

`WORLDS[experiment][world](num_agents, generator)` makes a frame. The world called `paper` is as the paper says; in each
of the others some claims are false. Agents of a condition differ from each other by noise.
"""

from collections.abc import Callable
import functools
import math

import numpy as np
import pandas
import pyarrow
from scipy import special

from physexp.analysis.experiments import (
    ablations,
    aiming,
    clamping,
    conditions,
    data_efficiency,
    generalization,
    laboratory,
    learners,
    noise,
    population,
    reaching,
    shaking,
    timing,
    waiting,
    weighing,
)
from physexp.analysis.experiments import patience as patience_lib
from physexp.analysis.ideal import mistakes

NUM_AGENTS = 6
_EPISODES = 300  # Of each agent.
_CURVE_POINTS = 200
_BUDGET = 4_000_000  # Environment steps of a learning curve.


def label(config) -> str:
    """The name of a condition."""
    return config.label


def episodes(
    config,
    training_seed: int,
    columns: dict[str, np.ndarray],
    interaction: str = "learned",
    control_timestep: float = 0.1,
) -> dict[str, np.ndarray]:
    """The columns of one agent's episodes."""
    told = {
        "domain": config.domain,
        "task": config.task,
        "discount": config.agent.discount,
        "interaction": interaction,
        "difficulty": config.task_kwargs.get("difficulty", math.nan),
        "training_seed": training_seed,
        "control_timestep": control_timestep,
        "condition": label(config),
    }
    count = len(next(iter(columns.values())))
    return {name: np.full(count, value) for name, value in told.items()} | columns


def table(agents: list[dict[str, np.ndarray]]) -> pandas.DataFrame:
    """The episodes of all agents, with the types they have when read from files."""
    columns = {name: np.concatenate([agent[name] for agent in agents]) for name in agents[0]}
    conditions_of_rows = columns.pop("condition")
    single = dict.fromkeys(("difficulty", "discount", "control_timestep", "reward", "time"), pyarrow.float32())
    whole = dict.fromkeys(("answer", "label", "length", "interactions"), pyarrow.int32())
    types = {**single, **whole, "training_seed": pyarrow.int32(), "actions": pyarrow.list_(pyarrow.int32())}
    rows = pyarrow.table({name: pyarrow.array(values, types.get(name)) for name, values in columns.items()})
    return rows.to_pandas().assign(condition=conditions_of_rows)


def answers(success: float, count: int) -> dict[str, np.ndarray]:
    """Labels and rewards of episodes, so many of which are right that the share is exact to one episode."""
    right = np.arange(count) < round(success * count)
    return {"label": np.zeros(count, int), "reward": np.where(right, 1.0, -1.0)}


def with_timeouts(columns: dict[str, np.ndarray], share: float, **values: float) -> dict[str, np.ndarray]:
    """Adds episodes that ended unanswered; `values` of their other columns."""
    count = round(share * len(columns["label"]))
    added = {"label": -1, "reward": -1.0, "interactions": 100, **values}
    return {name: np.concatenate([column, np.full(count, added[name])]) for name, column in columns.items()}


# How the masses turn out: the share of small gaps for the difficulties 3, 5 and 10.


def mass_gaps(num_agents, generator, small=(0.4, 0.2, 0.05)):
    """Mass gaps, which are drawn by no agent."""
    frames = []
    for beta, share in zip(conditions.DIFFICULTIES, small, strict=True):
        is_small = np.arange(3000) < 3000 * share
        gaps = np.where(is_small, generator.uniform(0, 0.1, 3000), generator.uniform(0.1, 1, 3000))
        frames.append(pandas.DataFrame({"difficulty": beta, "mass_gap": gaps}))
    return pandas.concat(frames, ignore_index=True)


# Learning curves: success rises from chance to its plateau.


def curves(
    num_agents,
    generator,
    plateaus: dict[str, float],
    chance: float,
    learned_at: dict[str, float],
    configs=(*conditions.HEAVIER, *conditions.TOWERS),
    name_of=label,
    spread=1.0,
) -> pandas.DataFrame:
    """Rows of metrics, as `Results.curves` gives them.

    Args:
      plateaus: success at the end, by the name of a condition.
      chance: success at the beginning.
      learned_at: environment steps after which a curve is half way, by the name of a condition.
      configs: the conditions that there are.
      name_of: the name of a condition, from its configuration.
      spread: of agents, and of the rows of each, times what it usually is.
    """
    frames = np.linspace(_BUDGET / _CURVE_POINTS, _BUDGET, _CURVE_POINTS)
    found = []
    for config in configs:
        name = name_of(config)
        if name not in plateaus:
            continue
        for seed in range(num_agents):
            plateau = plateaus[name] + generator.normal(0, 0.004 * spread)
            middle = learned_at[name] * np.exp(generator.normal(0, 0.05))
            rising = chance + (plateau - chance) * special.expit((frames - middle) / 100_000)
            found.append(
                pandas.DataFrame(
                    {
                        "frames": frames.astype(int),
                        "success_rate": rising + generator.normal(0, 0.003 * spread, len(frames)),
                        "domain": config.domain,
                        "task": config.task,
                        "difficulty": config.task_kwargs.get("difficulty"),
                        "discount": config.agent.discount,
                        "training_seed": seed,
                        "condition": name,
                        "algorithm": config.agent.algorithm,
                        "seconds": frames / 1000,
                        "episodes": frames.astype(int) // 20,
                    }
                )
            )
    return pandas.concat(found, ignore_index=True)


def learning_heavier(num_agents, generator, features=(0.85, 0.9, 0.95), pixels=(0.7, 0.8, 0.9), spread=1.0):
    names = [label(config) for config in conditions.HEAVIER]
    plateaus = dict(zip(names, (*features, *pixels), strict=True))
    return curves(num_agents, generator, plateaus, 0.25, dict.fromkeys(names, 1e6), spread=spread)


def learning_towers(num_agents, generator, plateau=0.985, fist=1e6, direct=2e6):
    names = [label(config) for config in conditions.TOWERS]
    learned_at = {name: fist if name.startswith("F") else direct for name in names}
    return curves(num_agents, generator, dict.fromkeys(names, plateau), 0.2, learned_at)


def two_learners(num_agents, generator, ppo=5e5, a3c=2e6, seconds_of_a_ppo_frame=0.001):
    def name_of(config):
        return f"{label(config)} {config.agent.algorithm.upper()}"

    learned_at = {name_of(config): {"ppo": ppo, "a3c": a3c}[config.agent.algorithm] for config in learners.CONDITIONS}
    frame = curves(
        num_agents, generator, dict.fromkeys(learned_at, 0.97), 0.2, learned_at, learners.CONDITIONS, name_of
    )
    return frame.assign(seconds=frame.seconds.where(frame.algorithm == "a3c", seconds_of_a_ppo_frame * frame.frames))


def reaching_fists(num_agents, generator, near=0.5, direct=1.0):
    """Learning curves of fists at the tower and away from it, and of direct pushes.

    Args:
      near, direct: how many times as many environment steps these need as a fist that is away.
    """
    needed = {reaching.NEAR: near, reaching.FAR: 1.0, reaching.DIRECT: direct}
    frames = []
    for kind, players in reaching.CONDITIONS.items():
        for player, config in players.items():
            frame = scores(num_agents, generator, {config: 20_000 * needed[player]})
            frames.append(frame.assign(condition=kind, player=player))
    return pandas.concat(frames, ignore_index=True)


def few_frames(
    num_agents,
    generator,
    belief=0.5,
    a3c=20.0,
    papers=10.0,
    fist=0.6,
    direct=1.0,
    seconds_of_a_frame=0.0005,
    learned=1.0,
    loss=0.5,
    calibration_error=0.02,
):
    """Learning curves of all learners.

    Args:
      belief, a3c: where the belief learner in either track and the others are half way, in shares of the environment
        steps that the belief learner is to need at most.
      papers: how many times as many as the others the paper's own learner needs.
      fist, direct: how many times as many the belief learner needs with an actuator.
      seconds_of_a_frame: how long a learner takes for an environment step.
      learned: how much of what it could learn the belief learner learns.
      loss: what agents lack of the ideal's return at the end, in shares of what they may lack.
      calibration_error: of all of them.
    """
    most = data_efficiency.MOST_FRAMES
    of_actuators = {"F": fist, "D": direct}
    of_learners = {"a3c": a3c, "ppo": a3c, "a3c_paper": a3c * papers}
    middles = {
        config: most.get(config.agent.title, most["belief"])[label(config)]
        * of_learners.get(config.agent.title, belief * of_actuators.get(label(config)[0], 1.0))
        for config in data_efficiency.CONDITIONS
    }
    frame = scores(num_agents, generator, middles, seconds_of_a_frame).assign(calibration_error=calibration_error)
    frame.loc[frame.algorithm.str.startswith("belief"), "score"] *= learned
    frame.attrs["final"] = pandas.DataFrame(
        [
            {
                "condition": label(config),
                "algorithm": config.agent.title,
                "training_seed": seed,
                "share": 1 - loss * (1 - data_efficiency.LEAST_SHARE[label(config)]) + generator.normal(0, 0.001),
                "error": 0.001,
            }
            for config in data_efficiency.CONDITIONS
            for seed in range(num_agents)
        ]
    )
    return frame


def variants(num_agents, generator, **factors):
    """Learning curves of the belief learner's variants, by title: how many times as many frames each needs."""
    factors = {"belief_no_replay": 3, "belief_last_step": 2, "belief_lstm": 2, "belief_revealed": 0.7} | factors
    middles = {config: 10_000 * factors.get(config.agent.title, 1) for config in ablations.CONDITIONS}
    return scores(num_agents, generator, middles)


def scores(num_agents, generator, middles, seconds_of_a_frame=0.0005):
    """Learning curves from nothing to nearly the ideal's return, half way after so many frames by condition."""
    found = []
    for config, of_condition in middles.items():
        title, name = config.agent.title, label(config)
        for seed in range(num_agents):
            middle = of_condition * np.exp(generator.normal(0, 0.05))
            frames = np.linspace(middle / 100, 3 * middle, 300).astype(int)
            found.append(
                pandas.DataFrame(
                    {
                        "frames": frames,
                        "score": 0.98 * special.expit(20 * (frames / middle - 1)),
                        "condition": name,
                        "training_seed": seed,
                        "algorithm": title,
                        "seconds": seconds_of_a_frame * frames,
                        "episodes": frames // 3,
                    }
                )
            )
    return pandas.concat(found, ignore_index=True)


def other_towers(num_agents, generator, varied=0.985, held_out=0.95, usual=0.5, rule=1.0, share=0.97):
    """What agents are right in, where towers vary and beyond; and the share of the rule's return that they earn."""
    right = {
        generalization.USUAL: {"as usual": 1.0, "varied": usual, **dict.fromkeys(generalization.HELD_OUT, usual)},
        generalization.VARIED: {"as usual": 1.0, "varied": varied, **dict.fromkeys(generalization.HELD_OUT, held_out)},
        generalization.RULE: dict.fromkeys(generalization.TRIALS, rule),
        generalization.LOOKUP: {**dict.fromkeys(generalization.TRIALS, 0.4), "as usual": 1.0},
    }
    return pandas.DataFrame(
        [
            {
                "condition": label(config),
                "player": player,
                "training_seed": seed,
                "test": test,
                "right": value + (generator.normal(0, 0.002) if seed >= 0 else 0.0),
                "return": 0.95 * (share if player == generalization.VARIED else 1.0),
            }
            for config in conditions.TOWERS
            for player, tests in right.items()
            if player in generalization.CONDITIONS or conditions.observations(config) == "features"
            for seed in (range(num_agents) if player in generalization.CONDITIONS else [-1])
            for test, value in tests.items()
        ]
    )


def timed_fists(num_agents, generator, fine=0.99, power=0.0, rule=0.6, too_many=(0.98, 0.02), slippery=(0.95, 0.8)):
    """What fists make of control steps of other lengths.

    Args:
      fine: the share of right answers, at the shortest control step, of agents who know many.
      power: their time to the answer is in proportion to this power of the control step.
      rule: the share of right answers of the rule that waits for a number of control steps, below 0.1 s.
      too_many: the share of wrong answers that count too many, of agents who know one, at the shortest and longest.
      slippery: the shares of right answers where friction is high, of those who know many and one.
    """
    shortest, *_, longest = timing.STEPS
    rows = []
    for seed in range(num_agents):
        for player, friction_right in zip((timing.MANY, timing.ONE), slippery, strict=True):
            for step in timing.STEPS:
                right = fine if player == timing.MANY and step == shortest else 0.99 if player == timing.MANY else 0.8
                time = 0.35 * (step / 0.1) ** power
                share = {shortest: too_many[0], longest: too_many[1]}.get(step, 0.5)
                rows.append((player, seed, step, False, right, time, share))
            rows.append((player, seed, 0.1, True, friction_right, 0.35, 0.5))
    frame = pandas.DataFrame(rows, columns=["player", "training_seed", "step", "friction", "right", "time", "too_many"])
    for name in ("right", "time", "too_many"):
        frame[name] += generator.normal(0, 0.003, len(frame))
    rules = pandas.DataFrame(
        {
            "player": timing.WAITS,
            "training_seed": -1,
            "step": list(timing.STEPS),
            "friction": False,
            "right": [rule if step < 0.1 else 1.0 for step in timing.STEPS],
            "time": [4 * step for step in timing.STEPS],
        }
    )
    frame = pandas.concat([frame, rules], ignore_index=True)
    return frame.assign(interactions=frame.time / frame.step, condition=label(timing.CONDITIONS[timing.ONE]))


# Episodes of Which is Heavier.


def pokes(num_agents, generator, means=(5.0, 3.0, 2.0), spread=0.5, long=0.0):
    """Interactions of feature agents.

    Args:
      means: for the difficulties 3, 5 and 10.
      spread: standard deviation over episodes.
      long: share of the episodes that last 30 interactions or more.
    """
    agents = []
    for config, mean in zip(population.CONDITIONS, means, strict=True):
        for seed in range(num_agents):
            interactions = generator.normal(mean + generator.normal(0, 0.02), spread, _EPISODES)
            interactions = interactions.round().clip(0, 29).astype(int)
            interactions[: round(long * _EPISODES)] = generator.integers(30, 90, round(long * _EPISODES))
            agents.append(episodes(config, seed, {"interactions": interactions}))
    return table(agents)


def patience(num_agents, generator, patient=1.5):
    """Interactions of agents under both discounts; those who are patient have so many times as many."""
    means = (5.0, 3.0, 2.0)
    agents = []
    for config, mean in zip(patience_lib.CONDITIONS, (*means, *(patient * mean for mean in means)), strict=True):
        for seed in range(num_agents):
            drawn = generator.normal(mean + generator.normal(0, 0.02), 0.5, _EPISODES)
            agents.append(episodes(config, seed, {"interactions": drawn.round().clip(0).astype(int)}))
    frame = table(agents)
    return frame.assign(discount=frame.discount.astype(float).round(3))


def slopes(num_agents, generator, slope=-4.0, odd_one=None, seen=0.8, lost=1 / _EPISODES):
    """Interactions that depend on the mass gap, and timeouts that would hide it if they counted.

    Args:
      slope: of interactions on the gap.
      odd_one: another slope, of one agent only.
      seen: share of the slope that is pokes of other blocks.
      lost: share of episodes that end by timeout, beside the others.
    """
    agents = []
    for config in conditions.PATIENT:
        for seed in range(num_agents):
            gaps = generator.uniform(0, 1, _EPISODES)
            mine = slope if odd_one is None or seed else odd_one
            lengths = 6 + (mine + generator.normal(0, 0.1)) * (gaps - 0.5) + generator.normal(0, 0.5 + gaps)
            columns = {
                "mass_gap": gaps,
                "interactions": lengths.round().clip(0).astype(int),
                "label": np.zeros(_EPISODES, int),
            }
            columns = with_timeouts(columns, lost, mass_gap=1.0 if slope < 0 else 0.0)
            agents.append(episodes(config, seed, columns))
    frame = table(agents)
    return frame.assign(blocks=2.5 + seen * slope * (frame.mass_gap - 0.5))


def _interactions(mean, count, generator):
    """Interactions with this very mean but for rounding, at least 0."""
    drawn = generator.poisson(mean, count)
    drawn[0] += max(0, round(mean * count) - drawn.sum())
    return drawn


def learned_and_random(configs, num_agents, generator, gain: float, ratio: float, lost: float) -> pandas.DataFrame:
    """Episodes with learned and with randomized interaction; a third of the learned ones more run out of time.

    Args:
      configs: the conditions.
      gain: by how much the share of right answers is higher with learned interaction.
      ratio: of the interactions, learned over randomized.
      lost: share of the randomized ones, beside the others, that run out of time.
    """
    agents = []
    for config in configs:
        for seed in range(num_agents):
            random, length = 0.7 + generator.normal(0, 0.03), 6 * np.exp(generator.normal(0, 0.02))
            learned = random + gain + generator.normal(0, 0.01)
            for interaction, success, mean in (("learned", learned, length * ratio), ("random", random, length)):
                columns = answers(success, _EPISODES)
                columns["interactions"] = _interactions(mean, _EPISODES, generator)
                columns = with_timeouts(columns, 1 / 3 if interaction == "learned" else lost)
                columns["time"] = 0.1 * columns["interactions"]
                agents.append(episodes(config, seed, columns, interaction))
    return table(agents)


def random_heavier(num_agents, generator, gain=0.15, ratio=1.0, lost=0.0, blocks=1.0):
    """The same of Which is Heavier; `blocks` is the ratio of those that were looked at."""
    frame = learned_and_random(conditions.HEAVIER, num_agents, generator, gain, ratio, lost)
    seen = 2.0 * np.where(frame.interaction == "learned", blocks, 1.0) + generator.normal(0, 0.1, len(frame))
    return frame.assign(blocks=seen)


def random_towers(num_agents, generator, gain=0.15, ratio=0.6, lost=0.0):
    frame = learned_and_random(conditions.TOWERS, num_agents, generator, gain, ratio, lost)
    frame.attrs["ideal"] = {label(config): {"mean_interactions": 4.0, "accuracy": 1.0} for config in conditions.TOWERS}
    return frame


# Episodes of the towers.


def waiting_fists(num_agents, generator, slowdown=10.0, gain=0.07, loss=0.0, lost=0.0):
    """Fist agents in slower and slower time.

    Args:
      slowdown: how many times as many interactions come before the answer at the finest control step as at the one of
        training; 10 is as many seconds.
      gain: of right answers where a control step ends at the median time to the answer in training.
      loss: of right answers from the control step of training, where it is 0.98, to the finest.
      lost: share of episodes that end by timeout, beside the others.
    """
    agents = []
    steps = np.array(waiting.CONTROL_TIMESTEPS)
    for config in waiting.CONDITIONS:
        for seed in range(num_agents):
            base = 16 * np.exp(generator.normal(0, 0.03))
            offset = generator.normal(0, 0.01)
            for step in steps[::-1]:
                fineness = np.log(steps[-1] / step) / np.log(steps[-1] / steps[0])  # From 0 to 1.
                lengths = base * slowdown**fineness * np.exp(generator.normal(0, 0.1, 101))
                columns = answers(1.0, 101) | {"interactions": lengths.round().astype(int)}
                columns = with_timeouts(columns, lost)
                columns["time"] = columns["interactions"] * step
                if step == steps[-1]:
                    usual = np.median(columns["time"])
                is_off = abs(usual / step - round(usual / step)) > 1e-3
                success = 0.98 - gain * is_off - loss * fineness + offset
                columns["reward"][:101] = answers(success, 101)["reward"]
                agents.append(episodes(config, seed, columns, control_timestep=step))
    return table(agents)


# Episodes of Which is Heavier with noise.


def second_pokes(num_agents, generator, noisy=0.6, exact=0.0, widest=0.3, slope=-4.0, exact_slope=-1.0, share=0.98):
    """Pokes of blocks again, with noise and without, in these shares of the episodes with gaps of up to the widest.

    All pokes have these slopes on the mass gap, with noise and without; and what is earned.
    """
    agents, count = [], 2 * _EPISODES  # Few blocks are poked again.
    for seed in range(num_agents):
        gaps = generator.random(count)
        for readings, again, steep in ((noise.EXACT, exact, exact_slope), (noise.NOISY, noisy, slope)):
            pokes = (gaps < widest) & (generator.random(count) < again - 0.02 * generator.random())
            agents.append(
                pandas.DataFrame(
                    {
                        "condition": label(noise.CONDITIONS[readings]),
                        "training_seed": seed,
                        "readings": readings,
                        "mass_gap": gaps,
                        "again": pokes.astype(int),
                        "interactions": 4 + steep * (gaps - 0.5) + generator.normal(0, 1, count),
                        "share": share + generator.normal(0, 0.01, count) if readings == noise.NOISY else np.nan,
                    }
                )
            )
    return pandas.concat(agents, ignore_index=True)


# Episodes of Balance.


def weighings(num_agents, generator, alone=1.0, share=0.98):
    """First weighings: one against one in this share of the episodes, else two against two; and what is earned."""
    agents = []
    for seed in range(num_agents):
        is_alone = np.arange(_EPISODES) < alone * _EPISODES - generator.integers(0, 3)
        agents.append(
            pandas.DataFrame(
                {
                    "condition": label(weighing.STRATEGY.condition),
                    "training_seed": seed,
                    "first": np.where(is_alone, 1, 2),
                    "interactions": np.where(is_alone, 5, 7),
                    "share": share + generator.normal(0, 0.01, _EPISODES),
                }
            )
        )
    return pandas.concat(agents, ignore_index=True)


# Episodes of Strings and of Sealed Box.


def clampings(num_agents, generator, needed=1.0, in_vain=0.0, share=0.98):
    """Whether the clamp is moved, where it is needed and where it is in vain, in these shares; and what is earned."""
    agents = []
    for seed in range(num_agents):
        graphs = np.arange(_EPISODES) % 8
        together = np.isin(graphs, (3, 5, 6, 7))
        clamps = generator.random(_EPISODES) < np.where(together, needed, in_vain) - 0.002 * generator.random()
        agents.append(
            pandas.DataFrame(
                {
                    "condition": label(clamping.STRATEGY.condition),
                    "training_seed": seed,
                    "answer": graphs,
                    "clamps": clamps,
                    "together": together,
                    "interactions": np.where(clamps, 5, 2),
                    "share": share + generator.normal(0, 0.01, _EPISODES),
                }
            )
        )
    return pandas.concat(agents, ignore_index=True)


def shakings(num_agents, generator, like_the_ideal=1.0, share=0.98):
    """Interactions that depend on the ideal's so much, or the other way round; and what is earned."""
    best = np.resize([2, 3, 4, 3, 5], 42)
    agents = []
    for seed in range(num_agents):
        contents = np.arange(_EPISODES) % len(best)
        own = like_the_ideal * best + (1 - like_the_ideal) * best.mean()
        agents.append(
            pandas.DataFrame(
                {
                    "condition": label(shaking.STRATEGY.condition),
                    "training_seed": seed,
                    "content": contents,
                    "ideal": best[contents],
                    "interactions": np.maximum(1, own[contents] + generator.integers(0, 2, _EPISODES)).astype(int),
                    "share": share + generator.normal(0, 0.01, _EPISODES),
                }
            )
        )
    return pandas.concat(agents, ignore_index=True)


def aimings(num_agents, generator, asked=0.01, friction=0.8, share=0.98):
    """Shares of the prior's variance that are left, and what is earned."""
    agents = []
    for seed in range(num_agents):
        noise = generator.uniform(0.9, 1.1, (3, _EPISODES))
        agents.append(
            pandas.DataFrame(
                {
                    "condition": label(aiming.STRATEGY.condition),
                    "training_seed": seed,
                    "asked": asked * noise[0],
                    "mass": 0.06 * noise[1],
                    "friction": friction * noise[2],
                    "interactions": generator.integers(2, 7, _EPISODES),
                    "share": share + generator.normal(0, 0.01, _EPISODES),
                }
            )
        )
    return pandas.concat(agents, ignore_index=True)


# Agents against the ideal experimenter.


def shares(num_agents, generator, **of_learners):
    """Shares of the ideal's return in all domains, by the learner's title."""
    rows = [
        {
            "condition": label(config),
            "algorithm": config.agent.title,
            "training_seed": seed,
            "share": of_learners.get(config.agent.title, 0.98) + generator.normal(0, 0.002),
            "error": 0.002,
            "frames": config.agent.frames,
            "minutes": 5.0,
        }
        for config in laboratory.CONDITIONS
        for seed in range(num_agents)
    ]
    frame = pandas.DataFrame(rows)
    untrained = {"value": 0.8, "at_once": -0.5, "random_value": 0.4}
    frame.attrs["untrained"] = {task.label: untrained for task in laboratory.TASKS}
    return frame


def ideal_gap(num_agents, generator, share=0.985):
    """A row for each agent; `share` of the ideal's return is what it has."""
    rows = []
    for config in (*conditions.HEAVIER, *conditions.TOWERS):
        ideal_return = 0.8
        for seed in range(num_agents):
            agent_return = ideal_return * (share + generator.normal(0, 0.0005))
            row = {
                "condition": label(config),
                "domain": config.domain,
                "difficulty": config.task_kwargs.get("difficulty"),
                "training_seed": seed,
                "agent_return": agent_return,
                "return_error": 0.002,
                "accuracy": 0.9,
                "interactions": 3.0,
                "ideal_return": ideal_return,
                "ideal_accuracy": 0.95,
                "ideal_interactions": 2.5,
            }
            if config.domain == "which_is_heavier":
                parts = generator.dirichlet(np.ones(len(mistakes.KINDS))) * abs(ideal_return - agent_return)
                row |= dict(zip(mistakes.KINDS, parts, strict=True))
            rows.append(row)
    frame = pandas.DataFrame(rows)
    frame.attrs["towers"] = {config.task: list(_resolutions()) for config in conditions.TOWERS}
    return frame


def _resolutions():
    for objective in ("time", "return"):
        for number, resolution in enumerate((0.0, 0.001, 0.003, 0.01)):
            yield {
                "objective": objective,
                "resolution": resolution,
                "value": 0.9,
                "accuracy": 1.0,
                "mean_interactions": 3.0 + number,
                "mean_seconds": 0.3 + 0.1 * number,
            }


_World = Callable[[int, np.random.Generator], pandas.DataFrame]

WORLDS: dict[str, dict[str, _World]] = {
    "mass_gap": {
        "paper": mass_gaps,
        "easy ones are hard": functools.partial(mass_gaps, small=(0.05, 0.2, 0.4)),
    },
    "learning_heavier": {
        "paper": learning_heavier,
        "hard ones are easy": functools.partial(learning_heavier, features=(0.95, 0.9, 0.85), pixels=(0.9, 0.8, 0.7)),
        "little more than chance": functools.partial(
            learning_heavier, features=(0.3, 0.35, 0.4), pixels=(0.25, 0.3, 0.35)
        ),
        "nothing is too hard": functools.partial(
            learning_heavier, features=(0.992, 0.995, 0.998), pixels=(0.992, 0.995, 0.998), spread=0.1
        ),
    },
    "population": {
        "paper": pokes,
        "always all and long": functools.partial(pokes, means=(6.0, 6.0, 6.0), long=0.1),
        "hardly any": functools.partial(pokes, means=(0.1, 0.1, 0.1), spread=0.2),
    },
    "individual": {
        "paper": slopes,
        "hard ones are quick": functools.partial(slopes, slope=4.0),
        "known blocks again": functools.partial(slopes, seen=0.2),
        "many are lost": functools.partial(slopes, lost=0.2),
    },
    "patience": {
        "paper": patience,
        "patience is short": functools.partial(patience, patient=0.7),
    },
    "random_heavier": {
        "paper": random_heavier,
        "chance helps and is quick": functools.partial(random_heavier, gain=-0.15, ratio=2.5),
        "chance is slow": functools.partial(random_heavier, ratio=0.4),
        "chance is lost": functools.partial(random_heavier, lost=0.4),
        "chance sees more": functools.partial(random_heavier, blocks=0.7),
        "chance sees less": functools.partial(random_heavier, blocks=1.4),
    },
    "learning_towers": {
        "paper": learning_towers,
        "slow fist": functools.partial(learning_towers, fist=2e6, direct=1e6),
        "good but not perfect": functools.partial(learning_towers, plateau=0.925),
    },
    "waiting": {
        "paper": waiting_fists,
        "as many steps": functools.partial(waiting_fists, slowdown=1.0),
        "ever more steps": functools.partial(waiting_fists, slowdown=40.0),
        "lost in fine time": functools.partial(waiting_fists, loss=0.5),
        "any frame will do": functools.partial(waiting_fists, gain=0.0),
        "silent in the end": functools.partial(waiting_fists, lost=0.04),
    },
    "random_towers": {
        "paper": random_towers,
        "chance helps and is quick": functools.partial(random_towers, gain=-0.15, ratio=1.6),
        "chance is lost": functools.partial(random_towers, lost=0.4),
    },
    "learners": {
        "paper": two_learners,
        "PPO is slow": functools.partial(two_learners, ppo=2e6, a3c=5e5),
        "PPO computes for long": functools.partial(two_learners, seconds_of_a_ppo_frame=0.01),
    },
    "data_efficiency": {
        "paper": few_frames,
        "belief is slow": functools.partial(few_frames, belief=2.0),
        "belief computes for long": functools.partial(few_frames, seconds_of_a_frame=1.0),
        "A3C is quick": functools.partial(few_frames, a3c=0.24, belief=0.5, fist=0.68, direct=1.2),
        "single episodes teach most": functools.partial(few_frames, papers=0.5),
        "pushes are quick": functools.partial(few_frames, fist=1.2, direct=0.4),
        "agents who stop short": functools.partial(few_frames, loss=4.0),
        "beliefs too sure": functools.partial(few_frames, calibration_error=0.05),
    },
    "reaching": {
        "paper": reaching_fists,
        "the way is short": functools.partial(reaching_fists, near=1.5, direct=2.0),
        "pushes are quick": functools.partial(reaching_fists, direct=0.3),
    },
    "ablations": {
        "paper": variants,
        "replay is in the way": functools.partial(variants, belief_no_replay=0.5),
        "the last step tells most": functools.partial(variants, belief_last_step=0.5),
        "LSTMs are quick": functools.partial(variants, belief_lstm=0.5),
        "answers confuse": functools.partial(variants, belief_revealed=2.0),
    },
    "generalization": {
        "paper": other_towers,
        "nothing is learned": functools.partial(other_towers, varied=0.9, held_out=0.8),
        "nothing carries over": functools.partial(other_towers, held_out=0.8),
        "sixteen are enough": functools.partial(other_towers, usual=1.0),
        "nobody has a rule": functools.partial(other_towers, rule=0.9),
        "agents who dawdle": functools.partial(other_towers, share=0.8),
    },
    "timing": {
        "paper": timed_fists,
        "as many steps": functools.partial(timed_fists, power=1.0),
        "ever more steps": functools.partial(timed_fists, power=-1.0),
        "lost in fine time": functools.partial(timed_fists, fine=0.5),
        "errors of either kind": functools.partial(timed_fists, too_many=(0.5, 0.5)),
        "lengths tell nothing of friction": functools.partial(timed_fists, slippery=(0.8, 0.81)),
    },
    "noise": {
        "paper": second_pokes,
        "known blocks all the time": functools.partial(second_pokes, exact=0.9, noisy=0.3),
        "whatever the gap": functools.partial(second_pokes, widest=1.0),
        "hard ones are quick": functools.partial(second_pokes, slope=4.0),
        "noise hides the gap": functools.partial(second_pokes, exact_slope=-8.0),
        "clumsy agents": functools.partial(second_pokes, share=0.9),
    },
    "weighing": {
        "paper": weighings,
        "as with coins": functools.partial(weighings, alone=0.5),
        "clumsy agents": functools.partial(weighings, share=0.9),
    },
    "clamping": {
        "paper": clampings,
        "always": functools.partial(clampings, in_vain=0.5),
        "never": functools.partial(clampings, needed=0.1),
        "clumsy agents": functools.partial(clampings, share=0.9),
    },
    "shaking": {
        "paper": shakings,
        "easy ones the longest": functools.partial(shakings, like_the_ideal=-0.5),
        "clumsy agents": functools.partial(shakings, share=0.9),
    },
    "aiming": {
        "paper": aimings,
        "nothing is known": functools.partial(aimings, asked=0.5),
        "all is known": functools.partial(aimings, friction=0.1),
        "clumsy agents": functools.partial(aimings, share=0.9),
    },
    "laboratory": {
        "paper": shares,
        "A3C is silent": functools.partial(shares, a3c=-0.1),
        "PPO is clumsy": functools.partial(shares, ppo=0.9),
        "rewards tell too little": functools.partial(shares, belief=0.5),
        "nothing helps": functools.partial(shares, belief_revealed=0.9),
    },
    "ideal_gap": {
        "paper": ideal_gap,
        "clumsy agents": functools.partial(ideal_gap, share=0.9),
        "agents who cheat": functools.partial(ideal_gap, share=1.05),
    },
}
