"""Each claim holds if the data say so and fails if they say the opposite: it is tried on made data."""

import math

import ideals
import made_data
from made_data import generator, made
import numpy as np
import pandas
import pytest
from scipy import stats

from physexp import suite
from physexp.analysis.data import episodes, estimates
from physexp.analysis.experiments import EXPERIMENTS, NAMES, claims, curves, efficiency, interactions, strategies
from physexp.suite.domains import strike

HOLDS, FAILS, UNDECIDED = claims.HOLDS, claims.FAILS, claims.UNDECIDED

# Claims that one agent decides: they are about no agent, or about an agent's own episodes.
DECIDED_BY_ONE = {
    ("mass_gap", "small_gaps"),
    ("individual", "longer_if_small"),  # Each agent.
    ("random_heavier", "no_bias"),  # One of each condition is six.
    ("ideal_gap", "none_better"),
    ("data_efficiency", "none_far"),
    ("generalization", "rule"),
    ("population", "short"),  # One of each difficulty is three.
}


def claimed(estimate=None, condition="", id="claim", **limits):
    """A claim with an estimate, by default of one agent."""
    claim = claims.Claim(id=id, text="", on=[condition], statistic="", **limits)
    return claim.tested(condition, estimate or estimates.mean([1.0]))


def between(low, high, **limits):
    return claimed(estimates.Estimate((low + high) / 2, low, high), **limits)


@pytest.mark.parametrize(
    "low, high, verdict",
    [
        (1.1, 1.9, HOLDS),
        (1.0, 1.9, UNDECIDED),  # 1 itself is not in the range: the interval crosses the border.
        (0.5, 2.5, UNDECIDED),
        (0.5, 1.0, FAILS),
        (2.0, 2.5, FAILS),
        (1.0, 1.0, FAILS),
        (1.5, 1.5, HOLDS),
        (-math.inf, math.inf, UNDECIDED),
        (math.nan, math.nan, UNDECIDED),
    ],
)
def test_a_verdict_is_the_place_of_the_interval_in_the_range(low, high, verdict):
    assert between(low, high, above=1, below=2).verdict == verdict


def distant(distance, id="claim", **limits):
    """A claim with its statistic at some standard errors from the border of its range."""
    return claimed(estimates.normal(distance, 1.0), id=id, **(limits or {"above": 0}))


def test_the_p_value_of_a_verdict_is_that_of_the_nearest_border():
    for distance in (-3.0, 1.0, 2.5):
        two_sided = 2 * stats.norm.sf(abs(distance))
        assert distant(distance).p_value == pytest.approx(two_sided)
        assert distant(-distance, below=0).p_value == pytest.approx(two_sided)
    # In a range both ends have to be ruled out: the nearer one is 1 away. Outside of it, the nearer one is enough.
    assert distant(2.0, above=0, below=3).p_value == pytest.approx(2 * stats.norm.sf(1))
    assert distant(5.0, above=0, below=3).p_value == pytest.approx(2 * stats.norm.sf(2))


def test_verdicts_are_corrected_for_the_conditions_of_a_claim():
    # Two-sided p-values: 3 is 0.0027, 2.4 is 0.0164, 2.2 is 0.0278, 2.0 is 0.0455, 1 is 0.32.
    several = [distant(2.4), distant(-3.0), distant(2.2), distant(1.0)]
    # In their order, against 0.05 over 4, 3, 2, 1: 0.0027 < 0.0125, 0.0164 < 0.0167, 0.0278 > 0.025, and no more.
    assert claims.corrected(several) == [HOLDS, FAILS, UNDECIDED, UNDECIDED]
    assert [one.verdict for one in several] == [HOLDS, FAILS, HOLDS, UNDECIDED]
    assert claims.corrected([*several, distant(2.0, "another")])[-1] == HOLDS  # A family of its own.
    # Too few agents are no test: 0.0455 would not be enough were there two.
    assert claims.corrected([claimed(above=0), distant(2.0)]) == [UNDECIDED, HOLDS]
    # But of six agents, three on either side of the border are a test.
    even = claimed(estimates.mean([-1.0, -2, -3, 1, 2, 3]), above=0)
    assert claims.corrected([even, distant(2.0)]) == [UNDECIDED, UNDECIDED]
    assert claims.corrected([]) == []


def test_six_silent_agents_fail_in_one_of_eight_conditions():
    # Six shares of PPO in Balance, whose mean is 1.13 below the range: 11,000 standard errors. Of their order alone the
    # p-value would be 2 / 2^6 = 0.031, and 0.05 / 8 is wanted.
    silent = [-0.1813, -0.1811, -0.1810, -0.1808, -0.1807, -0.1806]
    others = [distant(0.1) for _ in range(7)]
    assert claims.corrected([claimed(estimates.mean(silent), above=0.95), *others]) == [FAILS] + 7 * [UNDECIDED]


@pytest.mark.parametrize("name", NAMES)
def test_the_table_says_all_of_each_claim_once(name):
    experiment = EXPERIMENTS[name]
    assert list(claims.table()) == list(NAMES)
    assert {claim.id for claim in experiment.claims} == set(experiment.statistics)
    assert len({claim.text for claim in experiment.claims}) == len(experiment.claims)
    for claim in experiment.claims:
        assert claim.text and claim.on and claim.statistic and len(set(claim.on)) == len(claim.on)
        for condition in claim.on:
            one = claim.tested(condition, estimates.normal(0, 1))
            assert one.above < one.below and (one.above > -math.inf or one.below < math.inf)
        for verdict, words in claim.plainly.items():
            assert verdict in (HOLDS, FAILS, UNDECIDED) and words.format_map(dict.fromkeys(claim.on, 0.5))


@pytest.mark.parametrize("name", NAMES)
def test_each_claim_is_true_or_false_as_the_world_is(name):
    missed = {}  # The ends of ranges that no world goes beyond.
    for world, false in made_data.WORLDS[name].items():
        found = EXPERIMENTS[name].test(made(name, world))
        verdicts = {(one.id, one.condition, one.estimate): one.verdict for one in found}
        assert verdicts == {key: FAILS if key[0] in false else HOLDS for key in verdicts}, world
        assert {(one.id, one.condition) for one in found} == {
            (claim.id, condition) for claim in EXPERIMENTS[name].claims for condition in claim.on
        }
        for one in found:
            ends = {end for end in (one.above, one.below) if math.isfinite(end)}
            beyond = one.above if one.estimate.value <= one.above else one.below
            missed.setdefault((one.id, one.condition), ends).difference_update(
                {beyond} if one.verdict == FAILS else set()
            )
    assert "paper" in made_data.WORLDS[name] and not any(missed.values()), missed


@pytest.mark.parametrize("name", NAMES)
def test_one_agent_decides_nothing_about_agents(name):
    found = EXPERIMENTS[name].test(made(name, num_agents=1))
    assert found
    assert not [one for one in found if one.verdict != UNDECIDED and (name, one.id) not in DECIDED_BY_ONE]


@pytest.mark.parametrize(
    "name", ["learning_heavier", "individual", "patience", "waiting", "ablations", "generalization"]
)
def test_one_condition_is_tested_without_the_others(name):
    frame, everything = made(name), {(one.id, one.condition): one for one in EXPERIMENTS[name].test(made(name))}
    first = frame.condition.iloc[0]
    found = EXPERIMENTS[name].test(frame[frame.condition == first])
    assert {claims.named(one.condition) for one in found} == {first}
    assert all(one == everything[one.id, one.condition] for one in found)


SOME = [each for each in efficiency.CONDITIONS if each.label in ("10-F", "D-F", "F-F")]


def test_agents_that_never_learn_are_not_taken_for_quick_ones():
    # They stop long before others have learned.
    data = made_data.few_steps(6, generator(), SOME, learned=0.5, fist=0.4, direct=1.2)
    found = [one for one in EXPERIMENTS["data_efficiency"].test(data) if one.id in ("fewer_steps", "fist_is_faster")]
    assert {(one.id, one.condition) for one in found} >= {("fewer_steps", "10-F"), ("fist_is_faster", "features")}
    assert {one.verdict for one in found} == {UNDECIDED}


def test_slow_agents_that_never_arrive_give_the_upper_end_of_a_ratio():
    frame = made_data.few_steps(10, generator(), SOME)
    quick, slow = (claims.rows(frame, condition="10-F", player=learner) for learner in ("belief", "a3c"))
    whole = efficiency.ratio_of_steps(efficiency.reached(quick), slow)
    cut = slow[slow.frames < slow.frames.max() / 4]
    part = efficiency.ratio_of_steps(efficiency.reached(quick), cut)
    assert np.isinf(efficiency.reached(cut)).all() and 0 < whole.low < whole.high < part.high
    assert part.low == 0 and part.p_value(1e-9, "greater") == 1
    assert part.p_value(part.high, "less") == pytest.approx(0.025)


def test_learners_are_compared_where_both_draw_their_actions():
    # Curves of the belief learner are of greedy episodes. With drawn actions it is at the level at the end alone.
    compare = EXPERIMENTS["data_efficiency"].statistics["fewer_steps"]
    frame = made_data.few_steps(6, generator(), SOME)
    belief, a3c = (claims.rows(frame, condition="10-F", player=player) for player in ("belief", "a3c"))
    whole = belief.groupby("training_seed").frames.max()
    ratio = compare(frame, "10-F")
    assert ratio.value == pytest.approx(stats.gmean(whole) / stats.gmean(efficiency.reached(a3c)))
    assert ratio.low < ratio.value / 2  # In greedy episodes it is there in less than half of its training.
    short = compare(frame.assign(final=0.94), "10-F")
    assert short.low == ratio.low and short.high == math.inf


def test_one_agent_unlike_the_others_fails_the_claim_about_each_agent():
    data = made_data.slopes(made_data.NUM_AGENTS, generator(), odd_one=4.0)
    found = [one for one in EXPERIMENTS["individual"].test(data) if one.id == "longer_if_small"]
    assert len(found) == 6
    for one in found:
        # The mean of five times -0.7 and once 0.7 has an interval of t_5 * 0.57 / sqrt(6) = 0.6 about -0.5: undecided.
        assert one.verdict == (FAILS if one.condition.endswith("each agent") else UNDECIDED)


def jumping_run(row: int):
    """Success of 0.2 in 100,000 episodes and 0.9 in another 100,000, of 20 frames each, in rows of `row` episodes."""
    episodes = np.arange(row, 200_001, row)
    success = np.where(episodes <= 100_000, 0.2, 0.9)
    return pandas.DataFrame({"episodes": episodes, "frames": 20 * episodes, "success_rate": success})


@pytest.mark.parametrize("row", [250, 2000])
def test_a_level_is_reached_at_the_crossing_of_the_mean_of_2000_episodes(row):
    run = jumping_run(row)
    # 2000 episodes whose middle is k episodes, of 20 frames each, after the jump have 0.2 + 0.7 * (1000 + k) / 2000.
    for level, frames in ((0.375, 1_990_000), (0.55, 2_000_000), (0.725, 2_010_000), (0.899, 2_020_000)):
        assert curves.first_reached(run, level) == pytest.approx(frames, rel=1e-4)
        assert curves.first_reached(run.sample(frac=1, random_state=0), level) == curves.first_reached(run, level)
    assert curves.first_reached(run, 0.1) == row / 2 * 20  # The middle of the first row.
    assert curves.first_reached(run, 0.95) == math.inf


def test_accuracy_and_interactions_leave_timeouts_out():
    rows = pandas.DataFrame({"label": [0, 1, -1], "reward": [1.0, -1.0, -1.0], "interactions": [2, 4, 99]})
    rows = rows.assign(condition="F-F", training_seed=0, interaction="learned")
    ideals = {"F-F": {"accuracy": 1.0, "mean_interactions": 3.0}}
    (row,) = interactions.per_agent(rows, ideals).to_dict("records")
    assert (row["accuracy"], row["interactions"], row["timeouts"]) == (0.5, 3, pytest.approx(1 / 3))


def test_the_first_weighing_is_the_first_time_that_pans_are_equally_full():
    # Block 0 left, block 1 left, block 2 right, block 0 aside: one against one. Then an answer.
    assert strategies.first_weighing([1, 4, 8, 0, 18]) == 1
    assert strategies.first_weighing([1, 4, 8, 11, 18]) == 2
    assert strategies.first_weighing([1, 5, 8, 10]) == 1
    assert strategies.first_weighing([1, 4, 18]) == strategies.first_weighing([0, 3, 18]) == 0


def test_a_clamp_counts_anywhere_and_is_needed_for_two_or_three_bands():
    assert [strategies.clamps(actions) for actions in ([0, 1, 6], [0, 3, 1, 9], [5, 7], [2])] == [0, 1, 1, 0]
    assert strategies.hangs_together(np.arange(8)).tolist() == [0, 0, 0, 1, 0, 1, 1, 1]


def test_pokes_tell_most_of_the_property_that_the_goal_needs():
    pucks = np.arange(len(strike.PUCKS))
    at_once = strategies.shares_left(pucks, [[3]] * len(pucks))
    assert all(share == pytest.approx(1) for name in at_once for share in at_once[name])
    poked = {name: left.mean() for name, left in strategies.shares_left(pucks, [[1, 2, 1, 3]] * len(pucks)).items()}
    assert poked["asked"] < poked["mass"] < poked["friction"] < 1


def test_steps_end_with_the_first_press_that_crushes_a_can():
    # Presses 4 and 8 leave a can of label 10 whole, and 11 crushes it; 9 comes after that, and 26 is an answer.
    assert strategies.rising([4, 8, 11, 9, 26], 10).tolist() == [5, 4, 3]
    assert strategies.rising([4, 8, 11, 13, 14, 31], 15).tolist() == [5, 4, 3, 2, 1]
    assert strategies.rising([4, 0, 18], 2).tolist() == [5]
    assert strategies.rising([8, 4, 8, 18], 15).tolist() == [9, -4, 4]
    assert strategies.rising([18], 2).tolist() == []


def test_waits_count_after_two_hard_presses():
    assert strategies.waits([1, 1, 2, 0, 2, 4]) == 2
    assert strategies.waits([1, 2, 1, 2, 3]) == strategies.waits([0, 1, 2, 3]) == strategies.waits([1]) == 0


def ideal_plays(domain):
    """Episodes of the ideal experimenter."""
    environment, actor = suite.load(domain, "features", task_kwargs={"random": 0}), ideals.of(domain).actor()
    return [episodes.play(environment, actor, index) for index in range(60)]


def test_the_ideals_steps_shrink_in_crush():
    # If n presses are left at most and the next one crushes a can, the n - 1 others are for as many weaker forces.
    for played in ideal_plays("crush"):
        steps = strategies.rising(played.actions, played.answer)
        assert steps.tolist() == [5, 4, 3, 2, 1][: len(steps)]


def test_the_ideal_presses_a_lump_hard_twice_and_waits_one_to_four_times():
    assert {strategies.waits(played.actions) for played in ideal_plays("lump")} == {1, 2, 3, 4}
