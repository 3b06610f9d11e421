"""Made data for every experiment, as its `load` returns them, from worlds in which the truth is known.

`made(experiment, world)` returns the data of `WORLDS[experiment][world]`. In the world called `paper` every claim is
true; in each of the others the claims that it names are false. Agents of a condition differ from each other by noise.
"""

import functools

import numpy as np
import pandas
from scipy import special
from seeds import fresh_seed

from physexp.analysis.experiments import (
    claims,
    conditions,
    control_steps,
    efficiency,
    few,
    generalization,
    ideal_gap,
    interactions,
    laboratory,
    learning,
    mass_gaps,
    strategies,
)
from physexp.analysis.ideal import mistakes

NUM_AGENTS = 6
_EPISODES = 300  # Of each agent.
_POINTS = 100  # Of a learning curve.
_BUDGET = 4_000_000  # Environment steps of a learning curve.


def of_agents(configs, num_agents, make):
    """The rows that `make(config, seed)` returns for each agent, as values of columns."""
    frames = [
        pandas.DataFrame(
            {"condition": config.label, "task": config.task, "player": config.player, "training_seed": seed}
            | make(config, seed)
        )
        for config in configs
        for seed in range(num_agents)
    ]
    return pandas.concat(frames, ignore_index=True)


def gaps(num_agents, generator, small=(0.4, 0.2, 0.05)):
    """Mass gaps of the three difficulties; `small` are the shares of small ones."""
    frames = []
    for beta, share in zip(conditions.DIFFICULTIES, small, strict=True):
        drawn = np.where(
            np.arange(3000) < 3000 * share, generator.uniform(0, 0.1, 3000), generator.uniform(0.1, 1, 3000)
        )
        frames.append(pandas.DataFrame({"difficulty": beta, "mass_gap": drawn}))
    return pandas.concat(frames, ignore_index=True)


# Learning curves.


def curves(num_agents, generator, configs, plateaus, learned_at, chance=0.2, spread=1.0):
    """Success that rises from chance to its plateau; plateaus and the middle of the rise by condition and learner."""
    frames = np.linspace(_BUDGET / _POINTS, _BUDGET, _POINTS)

    def rows(config, seed):
        key = (config.label, config.player)
        plateau = plateaus[key] + generator.normal(0, 0.004 * spread)
        middle = learned_at[key] * np.exp(generator.normal(0, 0.05))
        rising = chance + (plateau - chance) * special.expit((frames - middle) / 100_000)
        return {
            "frames": frames.astype(int),
            "success_rate": rising + generator.normal(0, 0.003 * spread, _POINTS),
            "seconds": frames / 1000,
            "episodes": frames.astype(int) // 20,
        }

    return of_agents(configs, num_agents, rows)


def learning_heavier(num_agents, generator, plateaus=(0.85, 0.9, 0.95, 0.7, 0.8, 0.9), spread=1.0):
    keys = [(config.label, "a3c") for config in conditions.HEAVIER]
    at = dict.fromkeys(keys, 1e6)
    plateaus = dict(zip(keys, plateaus, strict=True))
    frame = curves(num_agents, generator, conditions.HEAVIER, plateaus, at, 0.25, spread)
    frame.attrs["ideal"] = [0.99, 0.999]
    return frame


def learning_towers(num_agents, generator, plateau=0.985, fist=1e6, direct=2e6):
    at = {(config.label, "a3c"): fist if config.label[0] == "F" else direct for config in conditions.TOWERS}
    return curves(num_agents, generator, conditions.TOWERS, dict.fromkeys(at, plateau), at)


def two_learners(num_agents, generator, ppo=5e5, a3c=2e6, seconds_of_a_ppo_frame=0.001):
    at = {(config.label, config.player): {"ppo": ppo, "a3c": a3c}[config.player] for config in learning.LEARNERS}
    frame = curves(num_agents, generator, learning.LEARNERS, dict.fromkeys(at, 0.97), at)
    return frame.assign(seconds=frame.seconds.where(frame.player == "a3c", seconds_of_a_ppo_frame * frame.frames))


def two_workers(num_agents, generator, steps=1.0, plateau=0.97):
    """A3C with one worker and with two, which end at a plateau; `steps` is the ratio of their steps, two over one."""
    is_alone = {(config.label, config.player): config.agent.num_workers == 1 for config in learning.WORKERS}
    at = {key: 1e6 if alone else 1e6 * steps for key, alone in is_alone.items()}
    ends = {key: 0.97 if alone else plateau for key, alone in is_alone.items()}
    return learning.with_own_apart(curves(num_agents, generator, learning.WORKERS, ends, at))


def scores(num_agents, generator, middles, seconds_of_a_frame=0.0005):
    """Scores that rise from nothing to nearly the ideal's return; the frames of the middle by condition."""

    def rows(config, seed):
        middle = middles[config] * np.exp(generator.normal(0, 0.05))
        frames = np.linspace(middle / 100, 3 * middle, 100).astype(int)
        return {
            "frames": frames,
            "score": 0.98 * special.expit(20 * (frames / middle - 1)),
            "seconds": seconds_of_a_frame * frames,
            "episodes": frames // 3,
        }

    return of_agents(list(middles), num_agents, rows)


def reaching(num_agents, generator, near=0.5, direct=1.0):
    """Actuators; `near` and `direct` are their environment steps in multiples of those of a distant fist."""
    needed = {efficiency.NEAR: near, efficiency.FAR: 1.0, efficiency.DIRECT: direct}
    frame = scores(num_agents, generator, {config: 20_000 * needed[config.player] for config in efficiency.REACHING})
    return frame.assign(condition=frame.task.str.rpartition("_")[2])


def few_steps(
    num_agents,
    generator,
    configs=efficiency.CONDITIONS,
    belief=0.5,
    a3c=20.0,
    papers=10.0,
    fist=0.6,
    direct=1.0,
    frame=0.0005,
    learned=1.0,
    loss=0.5,
    error=0.02,
):
    """All learners in training and afterwards.

    The environment steps of `belief` and `a3c` are in shares of those that the belief learner may need; `papers` are
    multiples of A3C's, and `fist` and `direct` of the belief learner's. `loss` is in shares of the allowed loss.
    """
    table = {claim.id: claim for claim in claims.described("data_efficiency")["claims"]}
    most = {"belief": table["few_steps"].below, "belief_revealed": table["few_steps_revealed"].below}
    factors = {"F": fist, "D": direct}
    learners = {"a3c": a3c, "ppo": a3c, "a3c_paper": a3c * papers}
    middles = {
        config: most.get(config.player, most["belief"])[config.label]
        * learners.get(config.player, belief * factors.get(config.label[0], 1.0))
        for config in configs
    }
    rows = scores(num_agents, generator, middles, frame).assign(calibration_error=error, final=0.98)
    rows.loc[rows.player.str.startswith("belief"), ["score", "final"]] *= learned

    def final(config, seed):
        share = 1 - loss * (1 - table["near_optimum"].above[config.label])
        return {"share": [share + generator.normal(0, 0.001)], "error": 0.001}

    return rows.merge(of_agents(configs, num_agents, final))


def variants(num_agents, generator, **factors):
    """Variants of the belief learner by title: the environment steps of each, in multiples of the whole one's."""
    factors = {"belief_no_replay": 3, "belief_last_step": 2, "belief_lstm": 2, "belief_revealed": 0.7} | factors
    middles = {config: 10_000 * factors.get(config.player, 1) for config in efficiency.ABLATED}
    return scores(num_agents, generator, middles)


# Which is Heavier.


def pokes(num_agents, generator, means=(5.0, 3.0, 2.0), spread=0.5, long=0.0):
    """Interactions by difficulty; `long` is the share of the episodes with 30 or more."""

    def rows(config, seed):
        mean = means[conditions.DIFFICULTIES.index(config.task_kwargs["difficulty"])] + generator.normal(0, 0.02)
        drawn = generator.normal(mean, spread, _EPISODES).round().clip(0, 29).astype(int)
        drawn[: round(long * _EPISODES)] = generator.integers(30, 90, round(long * _EPISODES))
        return {"interactions": drawn}

    frame = of_agents(conditions.FEATURES, num_agents, rows)
    frame.attrs["ideal"] = dict.fromkeys(frame.condition, {2: 0.5, 3: 0.5})
    return frame


def patience(num_agents, generator, patient=1.5):
    """Mean interactions of agents under both discounts; `patient` is the ratio of their means."""
    means = dict(zip(conditions.DIFFICULTIES, (5.0, 3.0, 2.0), strict=True))

    def rows(config, seed):
        factor = patient if config.player == interactions.PATIENT else 1.0
        pokes = factor * means[config.task_kwargs["difficulty"]] + generator.normal(0, 0.02)
        return {"interactions": [pokes], "ideal_interactions": 3.0}

    return of_agents(interactions.PATIENCE, num_agents, rows)


def slopes(num_agents, generator, slope=-4.0, odd_one=None, seen=0.8, lost=1 / _EPISODES):
    """Interactions with a slope on the mass gap, and timeouts that would hide it if they counted.

    `odd_one` is the slope of one agent, and `seen` is the share of the slope that is pokes of other blocks.
    """

    def rows(config, seed):
        gaps = generator.uniform(0, 1, _EPISODES)
        mine = slope if odd_one is None or seed else odd_one
        lengths = 6 + (mine + generator.normal(0, 0.1)) * (gaps - 0.5) + generator.normal(0, 0.5 + gaps)
        count = round(lost * _EPISODES)
        return {
            "mass_gap": np.append(gaps, np.full(count, 1.0 if slope < 0 else 0.0)),
            "interactions": np.append(lengths.round().clip(0), np.full(count, 100)).astype(int),
            "label": np.append(np.zeros(_EPISODES, int), np.full(count, -1)),
        }

    frame = of_agents(conditions.PATIENT, num_agents, rows)
    frame.attrs["ideal"] = dict.fromkeys(frame.condition, np.full(10, 3.0).tolist())
    return frame.assign(blocks=2.5 + seen * slope * (frame.mass_gap - 0.5))


def second_pokes(
    num_agents, generator, noisy=0.6, exact=0.0, widest=0.3, slope=-4.0, exact_slope=-1.0, share=0.98, foreseeing=0.98
):
    """Repeated pokes with noise and without, in these shares of the episodes with gaps up to the widest.

    All pokes have these slopes on the mass gap, with noise and without. Agents earn a share without foresight and with.
    """
    count = 2 * _EPISODES  # Repeated pokes are rare.
    gaps = generator.random((num_agents, count))

    def rows(config, seed):
        again, steep = (exact, exact_slope) if config.player == mass_gaps.EXACT else (noisy, slope)
        earned = foreseeing if config.player == mass_gaps.FORESEEING else share
        repeated = (gaps[seed] < widest) & (generator.random(count) < again - 0.02 * generator.random())
        return {
            "mass_gap": gaps[seed],
            "again": repeated.astype(int),
            "interactions": 4 + steep * (gaps[seed] - 0.5) + generator.normal(0, 1, count),
            "share": earned + generator.normal(0, 0.01, count),
        }

    return of_agents(mass_gaps.READINGS, num_agents, rows)


def randomized(configs, num_agents, generator, gain=0.15, ratio=1.0, lost=0.0, blocks=1.0):
    """Agents with learned and with randomized interaction: a gain, and the ratios of interactions and of blocks."""

    def rows(config, seed):
        accuracy, length = 0.7 + generator.normal(0, 0.03), 6 * np.exp(generator.normal(0, 0.02))
        return {
            "interaction": ["learned", "random"],
            "accuracy": [accuracy + gain + generator.normal(0, 0.01), accuracy],
            "interactions": [length * ratio * np.exp(generator.normal(0, 0.02)), length],
            "blocks": [2 * blocks * np.exp(generator.normal(0, 0.01)), 2.0],
            "timeouts": [1 / 3, lost + 0.001 * generator.random()],
            "ideal_interactions": 4.0,
            "ideal_accuracy": 1.0,
        }

    return of_agents(configs, num_agents, rows)


# Towers.


def waiting_fists(num_agents, generator, slowdown=10.0, gain=0.07, loss=0.0, lost=0.0):
    """Fist agents in smaller and smaller control steps.

    `slowdown` is the ratio of interactions at the finest to the usual step, 10 for equal time; `gain` is that in right
    answers if a step ends at the median time to the answer in training; `loss` grows towards the finest step.
    """
    steps = np.array(list(control_steps.TRIALS))
    fineness = np.log(steps[-1] / steps) / np.log(steps[-1] / steps[0])  # From 1 to 0.

    def rows(config, seed):
        lengths = round(16 * np.exp(generator.normal(0, 0.03))) * slowdown**fineness
        usual = lengths[-1] * steps[-1]
        is_off = abs(usual / steps - (usual / steps).round()) > 1e-3
        return {
            "step": steps,
            "episodes": 100,
            "timeouts": round(100 * lost),
            "right": 0.98 - gain * is_off - loss * fineness + generator.normal(0, 0.01),
            "interactions": lengths,
            "time": lengths * steps,
            "low": 0.9 * lengths * steps,
            "high": 1.1 * lengths * steps,
        }

    return of_agents(control_steps.FISTS, num_agents, rows)


def timed_fists(num_agents, generator, fine=0.99, power=0.0, rule=0.6, too_many=(0.98, 0.02), slippery=(0.95, 0.8)):
    """Fists in control steps of other lengths.

    The time to the answer is proportional to a `power` of the step. The pairs are of the shortest and longest step, and
    of agents trained with many lengths and with one.
    """
    steps = np.array(list(control_steps.STEPS))
    shares = np.select([steps == control_steps.SHORTEST, steps == control_steps.LONGEST], too_many, 0.5)

    def rows(config, seed):
        is_many = config.player == control_steps.MANY
        time = 0.35 * (steps / 0.1) ** power + generator.normal(0, 0.003, len(steps))
        right = np.where(steps == control_steps.SHORTEST, fine, 0.99) if is_many else 0.8
        return {
            "step": steps,
            "right": right + generator.normal(0, 0.003, len(steps)),
            "time": time,
            "interactions": time / steps,
            "too_many": shares + generator.normal(0, 0.003, len(steps)),
            "slippery": slippery[0 if is_many else 1] + generator.normal(0, 0.003),
        }

    rules = {"condition": "F-F", "player": control_steps.WAITS, "training_seed": -1, "step": steps}
    rules |= {"right": np.where(steps < 0.1, rule, 1.0), "interactions": 4, "time": 4 * steps}
    agents = of_agents(control_steps.PLAYERS, num_agents, rows)
    return pandas.concat([agents, pandas.DataFrame(rules)], ignore_index=True)


def other_towers(num_agents, generator, varied=0.985, held_out=0.95, usual=0.5, rule=1.0, share=0.97):
    """Shares of right answers in each test; `share` is that of the rule's return."""
    held = generalization.HELD_OUT
    right = {
        generalization.USUAL: {"as usual": 1.0, "varied": usual, **dict.fromkeys(held, usual)},
        generalization.VARIED: {"as usual": 1.0, "varied": varied, **dict.fromkeys(held, held_out)},
        generalization.RULE: dict.fromkeys(generalization.TRIALS, rule),
        generalization.LOOKUP: {**dict.fromkeys(generalization.TRIALS, 0.4), "as usual": 1.0},
    }
    rows = []
    for config in conditions.TOWERS:
        for player, tests in right.items():
            is_agent = player in (generalization.USUAL, generalization.VARIED)
            if is_agent or config.label[-1] == "F":
                for seed in range(num_agents) if is_agent else [-1]:
                    for test, value in tests.items():
                        noise = generator.normal(0, 0.002) if is_agent else 0.0
                        earned = 0.95 * (share if player == generalization.VARIED else 1.0)
                        rows.append((config.label, player, seed, test, value + noise, earned))
    return pandas.DataFrame(rows, columns=["condition", "player", "training_seed", "test", "right", "return"])


# Strategies, and the other domains.


def strategy(config, columns, num_agents, generator, **values):
    """Episodes of one condition; `columns(generator)` are those of an agent."""
    episodes = of_agents([config], num_agents, lambda config, seed: columns(generator, **values))
    episodes.attrs["ideal"] = {2: 0.5, 3: 0.5}
    return episodes


def _weighings(generator, alone=1.0):
    is_alone = np.arange(_EPISODES) < alone * _EPISODES - generator.integers(0, 3)
    return {"first": np.where(is_alone, 1, 2), "interactions": np.where(is_alone, 5, 7)}


def _clampings(generator, needed=1.0, in_vain=0.0):
    graphs = np.arange(_EPISODES) % 8
    together = np.isin(graphs, (3, 5, 6, 7))
    clamps = generator.random(_EPISODES) < np.where(together, needed, in_vain) - 0.002 * generator.random()
    return {"answer": graphs, "clamps": clamps, "together": together, "interactions": np.where(clamps, 5, 2)}


def _shakings(generator, like_the_ideal=1.0):
    best, contents = np.resize([2, 3, 4, 3, 5], 42), np.arange(_EPISODES) % 42
    own = (like_the_ideal * best + (1 - like_the_ideal) * best.mean())[contents]
    taken = np.maximum(1, own + generator.integers(0, 2, _EPISODES)).astype(int)
    return {"content": contents, "ideal": best[contents], "interactions": taken}


def _aimings(generator, asked=0.01, friction=0.8):
    noise = generator.uniform(0.9, 1.1, (3, _EPISODES))
    left = {"asked": asked * noise[0], "mass": 0.06 * noise[1], "friction": friction * noise[2]}
    return {**left, "interactions": generator.integers(2, 7, _EPISODES)}


def _crushings(generator, shrinking=1.0):
    steps = [np.arange(5, 0, -1) if generator.random() < shrinking else np.arange(1, 6) for _ in range(_EPISODES)]
    return {"steps": [its[: generator.integers(1, 6)] for its in steps], "interactions": 5}


def _pressings(generator, patient=1.0):
    waits = np.where(generator.random(_EPISODES) < patient, generator.integers(1, 5, _EPISODES), 0)
    waits[: generator.integers(0, 3)] = 5
    return {"answer": np.arange(_EPISODES) % 4, "waits": waits, "interactions": 2 + waits}


def shares(num_agents, generator, **of_learners):
    """Shares of the ideal's return in all domains, by the learner's title."""

    def rows(config, seed):
        share = of_learners.get(config.player, 0.98) + generator.normal(0, 0.002)
        return {"share": [share], "frames": config.agent.frames, "minutes": 5.0, **untrained}

    untrained = {"value": 0.8, "at_once": -0.5, "random_value": 0.4}
    return of_agents(laboratory.CONDITIONS, num_agents, rows)


def steps_to_targets(num_agents, generator, **of_learners):
    """Environment steps to shares of the ideal's return, in all domains; hundreds to the first, by learner."""

    def rows(config, seed):
        steps = 100 * of_learners.get(config.player, 1) * 2.0 ** np.arange(len(few.TARGETS)) * generator.uniform(1, 1.2)
        steps[-1] = np.inf
        return {"target": few.TARGETS, "steps": steps}

    return of_agents(few.CONDITIONS, num_agents, rows)


def gap_to_ideal(num_agents, generator, share=0.985):
    """Agents with a share of the ideal's return, and the costs of their mistakes."""

    def rows(config, seed):
        parts = generator.dirichlet(np.ones(len(mistakes.KINDS))) * abs(1 - share)
        costs = dict(zip(mistakes.KINDS, parts, strict=True))
        return {"share": [share + generator.normal(0, 0.0005)], "error": 0.002, **costs}

    resolutions = [
        {"objective": objective, "resolution": resolution, "value": 0.9, "mean_seconds": 0.3 + 20 * resolution}
        for objective in ("time", "return")
        for resolution in (0.0, 0.001, 0.003, 0.01)
    ]
    frame = of_agents(ideal_gap.CONDITIONS, num_agents, rows)
    frame.attrs["towers"] = {"D-F": resolutions, "F-F": resolutions}
    return frame


_weighing = functools.partial(strategy, strategies.WEIGHING, _weighings)
_clamping = functools.partial(strategy, strategies.CLAMPING, _clampings)
_shaking = functools.partial(strategy, strategies.SHAKING, _shakings)
_aiming = functools.partial(strategy, strategies.AIMING, _aimings)
_crushing = functools.partial(strategy, strategies.CRUSHING, _crushings)
_pressing = functools.partial(strategy, strategies.PRESSING, _pressings)

# The maker of an experiment's data, and its worlds: a name, the arguments of the maker, and the claims that are false.
_PAPER = ("paper", {}, set())
_MADE = {
    "mass_gap": (gaps, _PAPER, ("easy is hard", {"small": (0.05, 0.2, 0.4)}, {"small_gaps"})),
    "learning_heavier": (
        learning_heavier,
        _PAPER,
        ("hard is easy", {"plateaus": (0.95, 0.9, 0.85, 0.9, 0.8, 0.7)}, {"harder_is_lower"}),
        ("little more than chance", {"plateaus": (0.3, 0.35, 0.4, 0.25, 0.3, 0.35)}, {"trained"}),
        ("nothing is too hard", {"plateaus": (0.992, 0.995, 0.998) * 2, "spread": 0.1}, {"not_perfect"}),
    ),
    "population": (
        pokes,
        _PAPER,
        ("always all and long", {"means": (6.0, 6.0, 6.0), "long": 0.1}, {"few_if_easy", "short"}),
        ("hardly any", {"means": (0.1, 0.1, 0.1), "spread": 0.2}, {"few_if_easy", "all_if_hard"}),
    ),
    "individual": (
        slopes,
        _PAPER,
        ("hard is quick", {"slope": 4.0}, {"longer_if_small"}),
        ("known blocks again", {"seen": 0.2}, {"further_blocks"}),
        ("many are lost", {"lost": 0.2}, {"no_timeouts"}),
    ),
    "patience": (patience, _PAPER, ("patience is short", {"patient": 0.7}, {"longer_if_patient"})),
    "random_heavier": (
        functools.partial(randomized, conditions.HEAVIER),
        _PAPER,
        ("chance helps and is quick", {"gain": -0.15, "ratio": 2.5}, {"more_accurate", "as_long", "no_bias"}),
        ("chance is slow", {"ratio": 0.4}, {"as_long", "no_bias"}),
        ("chance is lost", {"lost": 0.4}, {"no_timeouts"}),
        ("chance sees more", {"blocks": 0.7}, {"as_many_blocks"}),
        ("chance sees less", {"blocks": 1.4}, {"as_many_blocks"}),
    ),
    "learning_towers": (
        learning_towers,
        _PAPER,
        ("slow fist", {"fist": 2e6, "direct": 1e6}, {"fist_is_faster"}),
        ("good but not perfect", {"plateau": 0.925}, {"solved"}),
    ),
    "waiting": (
        waiting_fists,
        _PAPER,
        ("equal steps", {"slowdown": 1.0}, {"same_time", "not_same_steps"}),
        ("ever more steps", {"slowdown": 40.0}, {"same_time"}),
        ("lost in fine time", {"loss": 0.5}, {"small_drop", "on_time"}),
        ("any frame will do", {"gain": 0.0}, {"on_time"}),
        ("silent in the end", {"lost": 0.04}, {"no_timeouts"}),
    ),
    "random_towers": (
        functools.partial(randomized, conditions.TOWERS),
        ("paper", {"ratio": 0.6}, set()),
        ("chance helps and is quick", {"gain": -0.15, "ratio": 1.6}, {"more_accurate", "quicker"}),
        ("chance is lost", {"ratio": 0.6, "lost": 0.4}, {"no_timeouts"}),
    ),
    "ideal_gap": (
        gap_to_ideal,
        _PAPER,
        ("clumsy", {"share": 0.9}, {"near_ideal_if_hard", "near_ideal"}),
        ("agents that cheat", {"share": 1.05}, {"none_better"}),
    ),
    "learners": (
        two_learners,
        _PAPER,
        ("PPO is slow", {"ppo": 2e6, "a3c": 5e5}, {"fewer_steps", "less_time"}),
        ("PPO computes for long", {"seconds_of_a_ppo_frame": 0.01}, {"less_time"}),
    ),
    "workers": (
        two_workers,
        _PAPER,
        ("stale gradients are slow and end low", {"steps": 1.5, "plateau": 0.93}, {"as_many_steps", "as_right"}),
    ),
    "data_efficiency": (
        few_steps,
        _PAPER,
        ("belief is slow", {"belief": 2.0}, {"few_steps", "few_steps_revealed"}),
        ("A3C is quick", {"a3c": 0.24, "fist": 0.68, "direct": 1.2}, {"fewer_steps"}),
        ("pushes are quick", {"fist": 1.2, "direct": 0.4}, {"fist_is_faster"}),
        (
            "single episodes are best, and agents stop short, too sure, and late",
            {"papers": 0.5, "loss": 4.0, "error": 0.05, "frame": 1.0},
            {"many_episodes", "near_optimum", "none_far", "calibrated", "minutes"},
        ),
    ),
    "reaching": (
        reaching,
        _PAPER,
        ("the way is short", {"near": 1.5, "direct": 2.0}, {"near_over_far"}),
        ("pushes are quick", {"direct": 0.3}, {"near_over_direct"}),
    ),
    "ablations": (
        variants,
        _PAPER,
        ("replay is in the way", {"belief_no_replay": 0.5}, {"replay"}),
        ("the last step is best", {"belief_last_step": 0.5}, {"every_step"}),
        ("LSTMs are quick", {"belief_lstm": 0.5}, {"attention"}),
        ("answers confuse", {"belief_revealed": 2.0}, {"answers"}),
    ),
    "generalization": (
        other_towers,
        _PAPER,
        ("nothing is learned", {"varied": 0.9, "held_out": 0.8}, {"unseen", "held_out"}),
        ("nothing carries over", {"held_out": 0.8}, {"held_out"}),
        ("sixteen are enough", {"usual": 1.0}, {"by_heart"}),
        ("the rule is wrong", {"rule": 0.9}, {"rule"}),
        ("agents dawdle", {"share": 0.8}, {"near_rule"}),
    ),
    "timing": (
        timed_fists,
        _PAPER,
        ("equal steps", {"power": 1.0}, {"same_time", "not_same_steps", "one_same_time"}),
        ("ever more steps", {"power": -1.0}, {"same_time", "one_same_time"}),
        ("lost in fine time", {"fine": 0.5}, {"right", "better_than_rule", "better_than_one"}),
        ("errors of either kind", {"too_many": (0.5, 0.5)}, {"one_counts"}),
        ("friction is unrelated", {"slippery": (0.8, 0.81)}, {"friction"}),
    ),
    "noise": (
        second_pokes,
        _PAPER,
        ("known blocks all the time", {"exact": 0.9, "noisy": 0.3}, {"again", "steeper"}),
        ("whatever the gap", {"widest": 1.0}, {"again_if_small", "steeper"}),
        ("hard is quick", {"slope": 4.0}, {"longer_if_small", "clearer"}),
        ("noise hides the gap", {"exact_slope": -8.0}, {"clearer"}),
        ("clumsy", {"share": 0.9}, {"near_ideal"}),
        ("foresight in vain", {"foreseeing": 0.8}, {"foresight"}),
    ),
    "weighing": (_weighing, _PAPER, ("as with coins", {"alone": 0.5}, {"one_against_one"})),
    "clamping": (
        _clamping,
        _PAPER,
        ("always", {"in_vain": 0.5}, {"only_if_needed"}),
        ("never", {"needed": 0.1}, {"only_if_needed"}),
    ),
    "shaking": (_shaking, _PAPER, ("easy takes longest", {"like_the_ideal": -0.5}, {"longer_if_hard"})),
    "aiming": (
        _aiming,
        _PAPER,
        ("nothing is known", {"asked": 0.5}, {"goal_is_known"}),
        ("all is known", {"friction": 0.1}, {"rest_is_unknown"}),
    ),
    "crushing": (_crushing, _PAPER, ("steps that grow", {"shrinking": 0.0}, {"steps_shrink"})),
    "pressing": (_pressing, _PAPER, ("gentle presses", {"patient": 0.5}, {"hard_first"})),
    "laboratory": (
        shares,
        _PAPER,
        ("A3C is silent", {"a3c": -0.1}, {"a3c"}),
        ("PPO is clumsy", {"ppo": 0.9}, {"ppo"}),
        ("rewards tell too little", {"belief": 0.5}, {"belief"}),
        ("nothing helps", {"belief_revealed": 0.9}, {"belief_revealed"}),
        ("foresight misleads", {"belief_foresight": 0.5}, {"belief_foresight"}),
        ("foresight distracts", {"belief_revealed_foresight": 0.9}, {"belief_revealed_foresight"}),
    ),
    "few": (
        steps_to_targets,
        _PAPER,
        ("slow learners", {"belief": 1000}, {"soon"}),
        ("foresight delays", {"belief_foresight": 1000}, {"soon_foreseeing"}),
    ),
}

WORLDS = {name: {world: false for world, _, false in worlds} for name, (_, *worlds) in _MADE.items()}
"""The claims that are false, by experiment and world."""


@functools.cache
def made(experiment, world="paper", num_agents=NUM_AGENTS):
    """The data of a world; the same for all tests, since they only read them."""
    make, *worlds = _MADE[experiment]
    (arguments,) = (arguments for name, arguments, _ in worlds if name == world)
    return make(num_agents, generator(), **arguments)


def generator():
    return np.random.default_rng(fresh_seed())
