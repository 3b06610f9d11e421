"""Claims hold where the data say so and fail where they say the opposite: each is tried on data we have made."""

import dataclasses
import functools
import math

import ideals
import made_data
import numpy as np
import pandas
import pytest
from scipy import stats
from seeds import fresh_seed

from physexp.analysis.data import estimates
from physexp.analysis.experiments import (
    EXPERIMENTS,
    aiming,
    claims,
    clamping,
    individual,
    learning,
    randomized,
    scores,
    shaking,
    weighing,
)
from physexp.analysis.experiments import ideal_gap as ideal_gap_lib
from physexp.suite.domains import sealed_box, strike

HOLDS, FAILS, UNDECIDED = claims.HOLDS, claims.FAILS, claims.UNDECIDED

# Every claim that our experiments make, and the made worlds in which it is false. In all others it is true.
FALSE_IN = {
    "mass_gap": {
        "Lower values of beta make small mass gaps, hence hard instances, likelier": {"easy ones are hard"},
    },
    "learning_heavier": {
        "Agents are trained successfully from features and from pixels": {"little more than chance"},
        "Agents do not reach perfect performance": {"nothing is too hard"},
        "More difficult problems plateau at progressively lower performance": {"hard ones are easy"},
    },
    "population": {
        "At difficulty 10 agents stop as soon as they find a heavy block": {"always all and long", "hardly any"},
        "At difficulty 3 agents poke all four blocks before answering": {"hardly any"},
        "The vast majority of episodes ends in less than 30 steps": {"always all and long"},
    },
    "individual": {
        "The smaller the mass gap, the longer an agent experiments": {"hard ones are quick"},
        "Hardly any episode ends by timeout": {"many are lost"},
        "Where the mass gap is small, most of the further pokes are of further blocks": {"known blocks again"},
    },
    "patience": {
        "A larger discount leads to longer episodes": {"patience is short"},
    },
    "random_heavier": {
        "Learned interaction leads to more accurate answers than randomized interaction": {"chance helps and is quick"},
        "The effect of randomized interaction on episode length is small": {
            "chance helps and is quick",
            "chance is slow",
        },
        "Randomized interaction makes episodes neither longer nor shorter in all conditions": {
            "chance helps and is quick",
            "chance is slow",
        },
        "Agents look at as many blocks when their pokes are drawn at random": {"chance sees more", "chance sees less"},
        "Few episodes of randomized interaction, which are left out above, end by timeout": {"chance is lost"},
    },
    "learning_towers": {
        "All four conditions are solved nearly perfectly": {"good but not perfect"},
        "The fist leads to faster learning than direct actuation": {"slow fist"},
    },
    "waiting": {
        "With smaller control steps the time to answer stays about the same": {"as many steps", "ever more steps"},
        "Agents wait for information, not for a number of steps": {"as many steps"},
        "Accuracy drops little with the control step": {"lost in fine time"},
        "No test episode ends by timeout": {"silent in the end"},
        "In finer time agents are right more often where a frame falls on the time of their answers in training": {
            "lost in fine time",
            "any frame will do",
        },
    },
    "random_towers": {
        "Learned interaction leads to more accurate answers than randomized interaction": {"chance helps and is quick"},
        "Agents tend to answer more quickly when following their learned interaction": {"chance helps and is quick"},
        "Few episodes of randomized interaction, which are left out above, end by timeout": {"chance is lost"},
    },
    "learners": {
        "PPO learns from fewer environment steps than A3C": {"PPO is slow"},
        "PPO learns in less time than A3C": {"PPO is slow", "PPO computes for long"},
    },
    "data_efficiency": {
        "The belief learner learns from few environment steps, from the reward alone": {"belief is slow"},
        "The belief learner learns from few environment steps, with answers revealed": {"belief is slow"},
        "The belief learner learns in minutes on one core": {"belief computes for long"},
        "The belief learner learns from fewer environment steps than A3C": {"A3C is quick"},
        "Many episodes an update and scaled observations save A3C environment steps": {"single episodes teach most"},
        "The belief learner is as often right as it believes": {"beliefs too sure"},
        "The belief learner comes near the optimum": {"agents who stop short"},
        "No agent of the belief learner is far from the optimum": {"agents who stop short"},
        "The fist leads to faster learning than direct actuation where agents are told nothing": {"pushes are quick"},
    },
    "reaching": {
        "A fist that stands at the tower is learned from fewer environment steps than one that must travel": {
            "the way is short"
        },
        "A fist that stands at the tower leads to faster learning than direct actuation": {"pushes are quick"},
    },
    "ablations": {
        "Replay saves the belief learner environment steps": {"replay is in the way"},
        "A belief learned at every step saves environment steps": {"the last step tells most"},
        "Attention saves environment steps against an LSTM": {"LSTMs are quick"},
        "Revealed answers save environment steps": {"answers confuse"},
    },
    "generalization": {
        "Agents trained with variation are right in episodes that training never saw": {"nothing is learned"},
        "Agents trained with variation are right beyond what they were trained with": {
            "nothing is learned",
            "nothing carries over",
        },
        "Agents trained without variation have learned the towers that they saw": {"sixteen are enough"},
        "A rule of one line is right wherever towers vary": {"nobody has a rule"},
        "Agents trained with variation earn nearly what the rule earns": {"agents who dawdle"},
    },
    "timing": {
        "Who was trained with control steps of many lengths is right at each of them": {"lost in fine time"},
        "Who was trained with control steps of many lengths waits for a time": {"as many steps", "ever more steps"},
        "Who was trained with control steps of many lengths does not wait for a number of them": {"as many steps"},
        "In fine time an agent is right more often than a rule that waits for a number of control steps": {
            "lost in fine time"
        },
        "In fine time, who knows control steps of many lengths is right more often than who knows one": {
            "lost in fine time"
        },
        "Who was trained with control steps of one length waits for a time as well": {
            "as many steps",
            "ever more steps",
        },
        "Who was trained with control steps of one length takes shorter ones for more bodies, and longer ones for "
        "fewer": {"errors of either kind"},
        "Who was trained with control steps of many lengths is right more often where friction is high": {
            "lengths tell nothing of friction"
        },
    },
    "noise": {
        "With noise, agents poke a block again where the mass gap is small": {"whatever the gap"},
        "With noise, the smaller the mass gap, the longer an agent experiments": {"hard ones are quick"},
        "Noise makes agents poke blocks again": {"known blocks all the time"},
        "Noise makes a small mass gap cost more pokes of blocks that were poked before": {
            "known blocks all the time",
            "whatever the gap",
        },
        "Noise makes it clearer that agents experiment longer where the mass gap is small": {
            "hard ones are quick",
            "noise hides the gap",
        },
        "Agents earn nearly what an experimenter earns who knows of the noise": {"clumsy agents"},
    },
    "weighing": {
        "Where each placing costs a step, one block is weighed against one first": {"as with coins"},
        "Agents who are told the answers come near the optimum of Balance": {"clumsy agents"},
    },
    "clamping": {
        "A puck is clamped when, and only when, pulls leave several graphs": {"always", "never"},
        "Agents come near the optimum of Strings from the reward alone": {"clumsy agents"},
    },
    "shaking": {
        "The harder a content is to tell, the longer the box is experimented with": {"easy ones the longest"},
        "Agents come near the optimum of Sealed Box from the reward alone": {"clumsy agents"},
    },
    "aiming": {
        "What the goal asks for is known at the answer": {"nothing is known"},
        "What the goal does not ask for is hardly found out": {"all is known"},
        "Agents come near the optimum of Strike from the reward alone": {"clumsy agents"},
    },
    "laboratory": {
        "A3C learns every domain from the reward alone": {"A3C is silent"},
        "PPO learns every domain from the reward alone": {"PPO is clumsy"},
        "The belief learner learns every domain from the reward alone": {"rewards tell too little"},
        "The belief learner learns every domain where answers are revealed": {"nothing helps"},
    },
    "ideal_gap": {
        "Feature agents reach 95% of the ideal experimenter's return": {"clumsy agents"},
        "Feature agents reach 97% of the ideal experimenter's return": {"clumsy agents"},
        "No agent beats the ideal experimenter": {"agents who cheat"},
    },
}

# What one agent decides: claims that are about no agent, or about an agent's own episodes.
DECIDED_BY_ONE = {
    ("mass_gap", "difference of the shares of mass gaps below 0.1"),
    ("individual", "the same in the agent where it is least sure"),
    ("random_heavier", "pokes before an answer, learned over randomized, geometric mean of the conditions"),
    ("ideal_gap", "share of the ideal's return, the best agent; interval: of its episodes; 1 % allowed for luck"),
    *(
        ("data_efficiency", f"share of the ideal's return, {learner}, the worst; interval: of its episodes")
        for learner in ("belief", "belief, answers revealed")
    ),
    ("generalization", "share of right answers in the worst test; interval: of its episodes"),
    ("population", "share of such episodes, mean of agents"),  # One of each difficulty is three.
}

WORLDS = [(name, world) for name, worlds in made_data.WORLDS.items() for world in worlds]


def generator():
    return np.random.default_rng(fresh_seed())


@functools.cache
def _made(name, world, num_agents):
    seed = fresh_seed()
    frame = made_data.WORLDS[name][world](num_agents, np.random.default_rng(seed))
    return seed, frame, EXPERIMENTS[name].claims(frame)


def made(name, world="paper", num_agents=made_data.NUM_AGENTS):
    """The frame of an experiment in a world, and its claims; the same for all tests, since they only read it."""
    seed, frame, found = _made(name, world, num_agents)
    print("made with seed", seed)
    return frame, found


def claim(low, high, above=-math.inf, below=math.inf):
    return claims.Claim(
        text="",
        section="",
        condition="",
        statistic="",
        above=above,
        below=below,
        estimate=estimates.Estimate((low + high) / 2, low, high),
    )


@pytest.mark.parametrize(
    "low, high, verdict",
    [
        (1.1, 1.9, HOLDS),
        (1.0, 1.9, UNDECIDED),  # 1 itself is not in the range: the interval crosses the border.
        (1.1, 2.0, UNDECIDED),
        (0.5, 2.5, UNDECIDED),
        (0.5, 1.0, FAILS),  # Nothing of it is in the range.
        (2.0, 2.5, FAILS),
        (0.5, 0.9, FAILS),
        (2.1, 2.5, FAILS),
        (1.0, 1.0, FAILS),
        (1.5, 1.5, HOLDS),
        (-math.inf, math.inf, UNDECIDED),
        (math.nan, math.nan, UNDECIDED),
    ],
)
def test_a_claim_holds_where_the_interval_is_in_the_range_and_fails_where_all_of_it_is_outside(low, high, verdict):
    assert claim(low, high, above=1, below=2).verdict == verdict


@pytest.mark.parametrize("limits", [dict(above=0), dict(below=0)])
def test_a_range_with_one_end_has_one_border(limits):
    inside, outside = ((0.1, 9.0), (-9.0, -0.1)) if "above" in limits else ((-9.0, -0.1), (0.1, 9.0))
    assert claim(*inside, **limits).verdict == HOLDS
    assert claim(*outside, **limits).verdict == FAILS
    assert claim(-0.1, 0.1, **limits).verdict == UNDECIDED
    assert claim(0.0, 0.0, **limits).verdict == FAILS
    assert claim(-math.inf, math.inf, **limits).verdict == UNDECIDED


def distant(distance, text="a claim", **wanted):
    """A claim whose statistic is some standard errors from the border of its range."""
    wanted = wanted or {"above": 0}
    return dataclasses.replace(claim(0, 0, **wanted), text=text, estimate=estimates.normal(distance, 1.0))


def test_the_p_value_of_a_verdict_is_that_of_the_border_next_to_it():
    for distance in (-3.0, 1.0, 2.5):
        two_sided = 2 * stats.norm.sf(abs(distance))
        assert distant(distance).p_value == pytest.approx(two_sided)
        assert distant(-distance, below=0).p_value == pytest.approx(two_sided)
    # In a range both ends have to be ruled out: the nearer one is 1 away. Outside of it, the nearer one is enough.
    assert distant(2.0, above=0, below=3).p_value == pytest.approx(2 * stats.norm.sf(1))
    assert distant(5.0, above=0, below=3).p_value == pytest.approx(2 * stats.norm.sf(2))


def test_verdicts_are_corrected_for_the_tests_of_the_same_sentence():
    # Two-sided p-values: 3 is 0.0027, 2.4 is 0.0164, 2.2 is 0.0278, 2.0 is 0.0455, 1 is 0.32.
    several = [distant(2.4), distant(-3.0), distant(2.2), distant(1.0)]
    # In their order, against 0.05 over 4, 3, 2, 1: 0.0027 < 0.0125, 0.0164 < 0.0167, 0.0278 > 0.025, and no more.
    assert claims.corrected(several) == [HOLDS, FAILS, UNDECIDED, UNDECIDED]
    assert [one.verdict for one in several] == [HOLDS, FAILS, HOLDS, UNDECIDED]
    # Another sentence, and one that is tested elsewhere, are families of their own.
    assert claims.corrected([*several, distant(2.0, "another")])[-1] == HOLDS
    assert claims.corrected([*several, dataclasses.replace(distant(2.0), section="6.3")])[-1] == HOLDS
    # What tells nothing is no test: 0.0455 would not be enough were there two.
    unknown = claim(-math.inf, math.inf, above=0)
    few = dataclasses.replace(unknown, estimate=estimates.median([1.0, 2.0, 3.0]))  # Their interval is infinite.
    for one in (unknown, few):
        assert claims.corrected([dataclasses.replace(one, text="a claim"), distant(2.0)]) == [UNDECIDED, HOLDS]
    # But of six agents, three on either side of the border are a test.
    even = dataclasses.replace(unknown, text="a claim", estimate=estimates.median([-1.0, -2, -3, 1, 2, 3]))
    assert claims.corrected([even, distant(2.0)]) == [UNDECIDED, UNDECIDED]
    assert claims.corrected([distant(1.0), distant(2.0)]) == [UNDECIDED, UNDECIDED]
    assert claims.corrected([]) == []


def test_the_range_wanted_is_told_in_words():
    assert claim(0, 1, above=0.5).wanted == "> 0.5"
    assert claim(0, 1, below=0).wanted == "< 0"
    assert claim(0, 1, above=0.67, below=1.5).wanted == "0.67 to 1.5"


def test_every_experiment_has_a_world_that_is_as_the_paper_says_and_others():
    assert set(made_data.WORLDS) == set(EXPERIMENTS) == set(FALSE_IN)
    for worlds in made_data.WORLDS.values():
        assert "paper" in worlds and len(worlds) > 1


@pytest.mark.parametrize("name, world", WORLDS)
def test_each_claim_holds_or_fails_as_the_world_is(name, world):
    _, found = made(name, world)
    assert {one.text for one in found} == set(FALSE_IN[name])  # A claim that is new has to be tried here, too.
    verdicts = {(one.text, one.condition, one.statistic, one.estimate): one.verdict for one in found}
    expected = {key: FAILS if world in FALSE_IN[name][key[0]] else HOLDS for key in verdicts}
    assert verdicts == expected


def test_agents_that_never_learn_are_not_taken_for_quick_ones():
    # They are given up long before others have learned.
    frame = made_data.few_frames(10, generator(), learned=0.5, fist=0.4, direct=1.2)
    comparisons = {
        "The belief learner learns from fewer environment steps than A3C",
        "The fist leads to faster learning than direct actuation where agents are told nothing",
    }
    compared = [one for one in EXPERIMENTS["data_efficiency"].claims(frame) if one.text in comparisons]
    assert {one.text for one in compared} == comparisons
    assert {one.verdict for one in compared} == {UNDECIDED}


def test_where_slow_agents_never_arrive_only_the_upper_end_of_a_ratio_is_known():
    frame = made_data.few_frames(10, generator())
    quick, slow = (scores.runs(frame, "10-F", learner) for learner in ("belief", "a3c"))
    whole = scores.ratio_of_frames(quick, slow)
    cut = [run[run.frames < run.frames.max() / 4] for run in slow]
    part = scores.ratio_of_frames(quick, cut)
    assert np.isinf(scores.reached(cut, "frames")).all() and 0 < whole.low < whole.high < part.high
    assert part.low == 0 and part.p_value(1e-9, "greater") == 1
    assert part.p_value(part.high, "less") == pytest.approx(0.025)


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_every_claim_can_fail_at_either_end_of_its_range(name):
    failed: dict[tuple, set[str]] = {}
    for world in made_data.WORLDS[name]:
        for one in made(name, world)[1]:
            ends = {"above"} if one.above > -math.inf else set()
            ends |= {"below"} if one.below < math.inf else set()
            left = failed.setdefault((one.text, one.condition, one.statistic), ends)
            if one.verdict == FAILS:
                assert world != "paper"
                left.discard("above" if one.estimate.value <= one.above else "below")
    assert failed and not any(failed.values()), failed  # What is left was never gone beyond.


@pytest.mark.parametrize("name, world", WORLDS)
def test_one_agent_decides_nothing_about_agents(name, world):
    _, found = made(name, world, 1)
    assert {one.text for one in found} == set(FALSE_IN[name])
    for one in found:
        if (name, one.statistic) in DECIDED_BY_ONE:
            assert one.verdict == (FAILS if world in FALSE_IN[name][one.text] else HOLDS)
        else:
            assert one.verdict == UNDECIDED, one


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_a_claim_says_what_was_measured_and_where_it_is_from(name):
    _, found = made(name)
    for one in found:
        assert one.text and one.section and one.condition and one.statistic
        assert one.above < one.below
        assert one.estimate.low <= one.estimate.value <= one.estimate.high
    told = [(one.text, one.condition, one.statistic) for one in found]
    assert len(set(told)) == len(told)


OF_SEVERAL_CONDITIONS = {"learners", "mass_gap", "population"}  # All that they claim is of several, or of all.


@pytest.mark.parametrize("name", sorted(set(EXPERIMENTS) - OF_SEVERAL_CONDITIONS))
def test_claims_are_made_of_the_conditions_there_are(name):
    frame, everything = made(name)
    everything = {(one.text, one.condition, one.statistic): one for one in everything}
    claims_of = {
        condition: EXPERIMENTS[name].claims(frame[frame.condition == condition])
        for condition in frame.condition.unique()
    }
    assert any(claims_of.values())
    for condition, found in claims_of.items():
        for one in found:
            assert one.condition.split(",")[0] == condition
            assert one == everything[one.text, one.condition, one.statistic]  # The others make no difference to it.


def test_timeouts_count_neither_for_the_accuracy_nor_for_the_length_of_randomized_interaction():
    frame = made_data.random_heavier(2, generator())
    agents = randomized.per_agent(frame)
    for one in agents.itertuples():
        rows = frame[
            (frame.condition == one.condition)
            & (frame.training_seed == one.training_seed)
            & (frame.interaction == one.interaction)
        ]
        assert (rows.label < 0).any() == (one.interaction == "learned")
        rows = rows[rows.label >= 0]
        assert one.accuracy == (rows.reward > 0).sum() / len(rows)
        assert one.interactions == pytest.approx(rows.interactions.sum() / len(rows))


def test_an_agent_who_answers_only_when_it_chooses_its_pokes_is_left_out():
    frame = made_data.random_towers(4, generator())
    lost = (frame.training_seed == 2) & (frame.interaction == "random")
    silent = frame.assign(label=frame.label.where(~lost, -1))
    without = frame[frame.training_seed != 2]
    found, expected = (
        [one for one in EXPERIMENTS["random_towers"].claims(frame) if "timeout" not in one.text]
        for frame in (silent, without)
    )
    assert found == expected != []


def test_one_agent_who_is_unlike_the_others_makes_the_claim_about_each_agent_fail():
    found = individual.find_claims(made_data.slopes(made_data.NUM_AGENTS, generator(), odd_one=4.0))
    found = [one for one in found if "correlation" in one.statistic or "least sure" in one.statistic]
    assert len(found) == 6
    for one in found:
        # The mean of five times -0.7 and once 0.7 has an interval of t_5 * 0.57 / sqrt(6) = 0.6 about -0.5: undecided.
        assert one.verdict == (FAILS if one.condition.endswith("each agent") else UNDECIDED)


def test_success_at_the_end_is_that_of_the_last_twentieth_of_training():
    frame = made_data.learning_towers(2, generator())
    final = learning.final_success(frame)
    for one in final.itertuples():
        run = frame[(frame.condition == one.condition) & (frame.training_seed == one.training_seed)]
        # 200 rows, the last at 4 M frames: those from 3.8 M on are the last eleven.
        assert one.success_rate == pytest.approx(run.success_rate.to_numpy()[-11:].mean())


@pytest.mark.parametrize("row", [250, 1000, 2000])
def test_a_level_is_reached_where_the_mean_of_2000_episodes_crosses_it(row):
    run = jumping_run(row)
    # 2000 episodes whose middle is k episodes, of 20 frames each, after the jump have 0.2 + 0.7 * (1000 + k) / 2000.
    for level, frames in ((0.375, 1_990_000), (0.55, 2_000_000), (0.725, 2_010_000), (0.899, 2_020_000)):
        assert learning.first_reached(run, level) == pytest.approx(frames, rel=1e-4)
        assert learning.first_reached(run.sample(frac=1, random_state=0), level) == learning.first_reached(run, level)
    assert learning.first_reached(run, 0.1) == row / 2 * 20  # The middle of the first row.
    assert learning.first_reached(run, 0.95) == math.inf


def test_a_level_is_reached_at_the_same_place_when_rows_hold_many_episodes():
    # Each row is its own window: 0.2 in the middle of the last before the jump, 0.9 in that of the first after it.
    assert learning.first_reached(jumping_run(10_000), 0.55) == pytest.approx(2_000_000)
    assert learning.first_reached(jumping_run(10_000), 0.899) == pytest.approx(2_100_000, rel=1e-3)


def jumping_run(row: int):
    """Success of 0.2 in 100 000 episodes and 0.9 in as many, of 20 frames each, in rows of so many episodes."""
    episodes = np.arange(row, 200_001, row)
    success = np.where(episodes <= 100_000, 0.2, 0.9)
    return pandas.DataFrame({"episodes": episodes, "frames": 20 * episodes, "success_rate": success})


def test_curves_are_those_of_the_better_half_from_the_middle_of_the_first_episodes_on():
    worse = jumping_run(5000).assign(success_rate=0.2)
    runs = [worse, jumping_run(5000)]
    frame = pandas.concat([run.assign(condition="F-F", training_seed=seed) for seed, run in enumerate(runs)])
    grid, (line,) = learning.smoothed(frame)["F-F"]
    assert (grid[0], grid[-1]) == (0, 4)  # Millions.
    assert np.isnan(line[grid < 0.05]).all()  # The first row has 100 000 frames.
    assert line[(grid > 0.05) & (grid < 1.95)] == pytest.approx(0.2)
    assert line[grid > 2.05] == pytest.approx(0.9)


def test_agents_who_never_learn_are_given_the_shortest_training_of_all():
    long, short = jumping_run(1000), jumping_run(1000)[:150]
    frame = pandas.concat(
        [
            long.assign(condition="learns", training_seed=0),
            short.assign(condition="learns", training_seed=1),
            long.assign(condition="never", training_seed=0, success_rate=0.2),
        ]
    )
    learns, never, absent = learning.compare_first_reached(frame, ["learns", "never", "absent"], 0.55)
    assert learns == pytest.approx([2_000_000, 2_000_000])
    assert never.tolist() == [150 * 1000 * 20]
    assert len(absent) == 0


@pytest.mark.parametrize("never, verdict", [("direct", HOLDS), ("fist", FAILS)])
def test_an_actuator_with_which_nobody_learns_is_the_slower_one(never, verdict):
    frame = made_data.learning_towers(made_data.NUM_AGENTS, generator(), **{never: 1e9})
    found = [one for one in EXPERIMENTS["learning_towers"].claims(frame) if "faster" in one.text]
    assert [one.verdict for one in found] == [verdict, verdict]


def test_the_first_weighing_is_the_first_time_that_pans_are_equally_full():
    # Block 0 left, block 1 left, block 2 right, block 0 aside: one against one. Then an answer.
    assert weighing.first_weighing([1, 4, 8, 0, 18]) == 1
    assert weighing.first_weighing([1, 4, 8, 11, 18]) == 2
    assert weighing.first_weighing([1, 5, 8, 10]) == 1
    assert weighing.first_weighing([1, 4, 18]) == weighing.first_weighing([0, 3, 18]) == 0


def test_a_clamp_counts_wherever_it_is_put_and_is_needed_where_two_bands_or_three_are():
    assert [clamping.clamps(actions) for actions in ([0, 1, 6], [0, 3, 1, 9], [5, 7], [2])] == [0, 1, 1, 0]
    assert clamping.hangs_together(np.arange(8)).tolist() == [0, 0, 0, 1, 0, 1, 1, 1]


def test_what_the_ideal_takes_with_each_content_adds_up_to_its_mean():
    best = shaking.ideal_interactions()
    summary = ideals.of("sealed_box").summary()
    assert best @ sealed_box.PRIOR == pytest.approx(summary["mean_interactions"])


def test_who_answers_at_once_knows_nothing_and_who_pokes_learns_of_what_is_asked_first():
    pucks = np.arange(len(strike.PUCKS))
    at_once = aiming.shares_left(pucks, [[3]] * len(pucks))
    assert all(share == pytest.approx(1) for name in at_once for share in at_once[name])
    poked = {name: shares.mean() for name, shares in aiming.shares_left(pucks, [[1, 2, 1, 3]] * len(pucks)).items()}
    assert poked["asked"] < poked["mass"] < poked["friction"] < 1


def test_the_better_half_is_the_larger_one_where_the_number_is_odd():
    assert ideal_gap_lib.median_of_top_half(np.array([1.0, 5.0, 3.0, 2.0, 4.0])) == 4  # Of 5, 4, 3.
    assert ideal_gap_lib.median_of_top_half(np.array([1.0, 4.0, 3.0, 2.0])) == 3.5  # Of 4, 3.
    assert ideal_gap_lib.median_of_top_half(np.array([0.7])) == 0.7
