"""The ideal experimenter of Towers: its search in made worlds solved by hand, and in the real environment."""

import json

import ideals
from made_worlds import COUNTS, PATTERNS, MadeWorld
import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.agents import environment_loop
from physexp.analysis import domains
from physexp.analysis.domains import towers
from physexp.analysis.ideal import bounds, histories, hypotheses, search
from physexp.suite.domains.towers import PRIOR
from physexp.suite.engine import declarations

SHORT = {"time_limit": 1.0}  # Ten actions: a wandering fist may stand in fewer places.


def solve(world, objective="return", discount=0.9, resolution=0.5):
    return search.Solution(world, resolution, discount, objective)


def test_a_chain_of_equal_looks_keeps_hypotheses_together():
    def parts(*groups):
        members = np.array(sorted(member for group in groups for member in group))
        home = np.array([[member in group for group in groups].index(True) for member in members])
        indistinguishable = (abs(members[:, None] - members) <= 1) & (home[:, None] == home)
        found = histories.split(groups, indistinguishable, PRIOR)
        return [[part for _, part in found[group]] for group in groups]

    assert parts((0, 1, 2, 5, 6)) == [[(0, 1, 2), (5, 6)]]
    assert parts((0, 2, 4)) == [[(0,), (2,), (4,)]]  # 1 and 3 are impossible.
    assert parts((0, 1, 4), (2, 3, 7)) == [[(0, 1), (4,)], [(2, 3), (7,)]]
    everything = tuple(range(PATTERNS))
    chances = [chance for chance, _ in histories.split([everything], np.eye(PATTERNS, dtype=bool), PRIOR)[everything]]
    np.testing.assert_allclose(chances, PRIOR)


def test_an_action_that_reveals_the_count_is_taken_once():
    # Action 1 shows the count at once, action 0 nothing. Then the answer is right: 0.9 of return, one interaction.
    world = MadeWorld(2, lambda sequence: COUNTS if sequence[-1] == 1 else [0] * PATTERNS)
    for objective, value in (("return", 0.9), ("time", 1.0)):
        solution = solve(world, objective)
        assert solution.value == pytest.approx(value) and solution.bound == pytest.approx(value)
        assert solution.policy.action == 1
        assert solution.figures()["histogram"] == {0: 0.0, 1: 1.0}


def test_an_observation_decides_the_next_action():
    # Action 0 separates 1 or 2 bodies from more. After it, action 1 separates 1 from 2, and action 2 separates 3, 4
    # and 5. So two interactions always suffice, but no fixed pair does.
    def tells(sequence):
        if sequence == (0,):
            return [count > 2 for count in COUNTS]
        if sequence == (0, 1):
            return [min(count, 3) for count in COUNTS]
        if sequence == (0, 2):
            return [max(count, 2) for count in COUNTS]
        return [0] * PATTERNS

    solution = solve(MadeWorld(3, tells), "time")
    assert solution.value == pytest.approx(2.0) and solution.bound == pytest.approx(2.0)
    one, three = COUNTS.index(1), COUNTS.index(3)
    assert solution.policy.action == 0
    assert solution.policy.children[one].action == 1 and solution.policy.children[three].action == 2
    assert solution.figures()["accuracy"] == 1.0
    assert solve(MadeWorld(3, tells)).value == pytest.approx(0.9**2)


def test_it_guesses_if_another_interaction_costs_more(monkeypatch):
    # Action 0 reveals 1, 2 and 3 bodies and leaves 4 and 5 together; after it, action 1 separates those. A guess is
    # worth 0 then, another interaction the discount, which is more. If action 1 is useless, it must guess: right in
    # 3/5 + 2/5 * 1/2 = 0.8, so the value is discount * (0.8 - 0.2) = 0.9 * 0.6.
    def useful(sequence):
        return COUNTS if sequence[-1] == 1 and len(sequence) > 1 else [min(count, 4) for count in COUNTS]

    def useless(sequence):
        return [min(count, 4) for count in COUNTS]

    asking = solve(MadeWorld(2, useful))
    assert asking.value == pytest.approx(0.9 * (3 / 5 + 2 / 5 * 0.9))
    monkeypatch.setattr(search, "_MAX_DEPTH", 3)
    guessing = solve(MadeWorld(2, useless))
    assert guessing.value == pytest.approx(0.9 * 0.6)
    assert guessing.figures()["accuracy"] == pytest.approx(0.8)
    # The search ended after three actions, so the bound is larger.
    assert guessing.bound > guessing.value


def test_a_guess_is_delayed_if_no_action_reveals_anything(monkeypatch):
    monkeypatch.setattr(search, "_MAX_DEPTH", 2)
    solution = solve(MadeWorld(2, lambda sequence: [0] * PATTERNS))
    # Right in one case of five: 2/5 - 1. Interactions discount the loss: 0.9^2 * (-0.6) = -0.486.
    assert solution.value == pytest.approx(0.9**2 * -0.6)


def test_actions_are_judged_by_the_best_return_after_them():
    # Action 0 reveals 1, 2 and 3 bodies and leaves 4 and 5 together; action 1 then separates those.
    def tells(sequence):
        return COUNTS if sequence[-1] == 1 and 0 in sequence else [min(count, 4) * (0 in sequence) for count in COUNTS]

    four, (right, guess, wrong) = COUNTS.index(4), (2 + 3, 2 + 4, 2 + 0)
    solution = solve(MadeWorld(2, tells, step_limit=6))
    first = 0.9 * (3 / 5 + 2 / 5 * 0.9)

    def judged(*actions):
        return solution.judge(four, np.array(actions))

    told = judged(1, 0, 0, 1, right)
    np.testing.assert_array_equal(told.is_informative, [False, True, False, True, False])
    np.testing.assert_allclose(told.values.max(axis=1), [first, first, 0.9, 0.9, 1])
    np.testing.assert_allclose(told.values[range(5), [1, 0, 0, 1, right]], [0.9 * first, first, 0.9 * 0.9, 0.9, 1])
    np.testing.assert_allclose(told.beliefs[[0, 2, 3]], [[0.2] * 5, [0, 0, 0, 0.5, 0.5], [0, 0, 0, 0.5, 0.5]])
    # The guess is right in half of the cases, the other label never.
    np.testing.assert_allclose(judged(0, guess).values[1, [guess, wrong]], [0, -1])
    # An interaction in the last step loses.
    late = judged(1, 1, 1, 1, 0, 0)
    np.testing.assert_allclose(late.values[-1], [-1, -1, -1, -1, -1, 0, 0])
    with pytest.raises(ValueError, match="objective is 'time'; to judge actions, solve for the return"):
        solve(MadeWorld(2, tells), "time").judge(four, np.array([0]))


def test_judged_beliefs_are_exact_after_a_detour():
    wandering = np.array(6), np.array([3, 2, 2, 1, 1, 0, 0, 0, 0])
    solution = ideals.of("towers", "fist_features", **SHORT)
    np.testing.assert_allclose(solution.judge(*wandering).beliefs, solution.beliefs(*wandering))


def test_states_within_the_tolerance_have_nearly_equal_values():
    known = towers.hypotheses("fist_features")
    away = np.array(6), np.array([1])
    exact, near = (search.Solution(known, 0.001, 0.98, tolerance=tolerance).judge(*away) for tolerance in (None, 0.05))
    assert near.values.max() == pytest.approx(exact.values.max(), abs=1e-9)
    assert near.values[0, 1] == pytest.approx(exact.values[0, 1], abs=0.01)


@pytest.fixture(scope="module", params=["direct_features", "fist_features"])
def world(request):
    return request.param, towers.hypotheses(request.param)


def test_with_full_resolution_the_first_touch_reveals_the_count(world):
    task, cache = world
    # Pushes touch at once; the fist needs two steps of 0.1 m to cross the 0.17 m to the tower.
    needed = {"direct_features": 1, "fist_features": 2}[task]
    for objective, value in (("return", 0.98**needed), ("time", needed)):
        solution = search.Solution(cache, 0.0, 0.98, objective)
        assert solution.value == pytest.approx(value) and solution.bound == pytest.approx(value)


def test_a_coarser_resolution_is_never_worth_more(world):
    task, cache = world
    values = []
    for resolution in (0.0, 0.001, 0.003):
        solution = search.Solution(cache, resolution, 0.98)
        assert solution.bound == pytest.approx(solution.value)
        values.append(solution.value)
    assert values == sorted(values, reverse=True)


def test_it_plays_the_environment_as_predicted(world):
    task, cache = world
    solution = search.Solution(cache, 0.003, 0.98)
    seed = fresh_seed()
    environment = suite.load("towers", task, task_kwargs={"random": seed})
    loop = environment_loop.EnvironmentLoop(environment, solution.actor())
    interactions, right, _ = solution.outcomes()
    assert right.all()
    for _ in range(12):
        episode = loop.run_episode()
        assert episode["episode_return"] == 1
        assert episode["episode_length"] == interactions[environment.task.hidden] + 1


def test_the_towers_look_alike_until_they_are_touched():
    known = histories.Histories(towers.hypotheses("fist_features"), 0.0)
    ((_, away),) = known.following(known.start, 1)  # Action 1 moves the fist away.
    for action in range(4):
        ((chance, (_, support)),) = known.following(away, action)
        assert chance == pytest.approx(1) and support == tuple(range(PATTERNS))
    # One action at the start, and four after it, for 16 patterns each.
    assert known.hypotheses.steps == (1 + 4) * PATTERNS


def test_distances_are_the_largest_of_all_readings_or_count_pixels():
    positions = np.zeros((2, 5, 3))
    positions[1, 2] = [0.03, 0.04, 0]
    fist = np.zeros((2, 3))
    fist[1] = [0, 0, 0.01]
    readings = {
        "positions": declarations.Reading([], (5, 3), "", components=("x", "y", "z")),
        "fist_position": declarations.Reading([], (3,), "", components=("x", "y", "z")),
        "angles": declarations.Reading([], (3,), "", unit="rad"),
    }

    def apart(**seen):
        first = {name: values[:1] for name, values in seen.items()}
        found = hypotheses.distances(seen, seen, readings)
        np.testing.assert_array_equal(hypotheses.distances(first, seen, readings), found[:1])
        return found

    np.testing.assert_allclose(apart(positions=positions, fist_position=fist), [[0, 0.05], [0.05, 0]])
    np.testing.assert_allclose(apart(angles=fist * [3, 3, 3]), [[0, 0.03], [0.03, 0]])
    pixels = np.zeros((2, 84, 84, 3), np.uint8)
    pixels[1, 3, 4] = 7
    pixels[1, 9, 9, 2] = 1
    np.testing.assert_array_equal(apart(pixels=pixels), [[0, 2], [2, 0]])


def test_it_plays_as_well_from_pixels():
    solution = ideals.of("towers", "direct_pixels")
    assert solution.value == pytest.approx(solution.bound)
    seed = fresh_seed()
    environment = suite.load("towers", "direct_pixels", task_kwargs={"random": seed})
    episodes = environment_loop.EnvironmentLoop(environment, solution.actor()).run(4)
    assert all(episode["episode_return"] == 1 for episode in episodes)


def test_a_summary_without_a_certain_answer_can_be_written_as_json(monkeypatch):
    monkeypatch.setattr(search, "_MAX_DEPTH", 2)
    summary = solve(MadeWorld(1, lambda sequence: COUNTS)).summary()
    assert json.loads(json.dumps(summary))["mean_seconds"] == pytest.approx(0.1)
    blind = solve(MadeWorld(1, lambda sequence: [0] * PATTERNS), "time")
    assert json.loads(json.dumps(blind.summary(), allow_nan=False))["value"] is None


def test_an_answer_must_come_within_the_time_limit():
    # Two actions are allowed, and the fist needs two to touch. So it guesses, right in one case of five, -0.6, after
    # one interaction, which discounts the loss.
    solution = ideals.of("towers", "fist_features", time_limit=0.2)
    assert solution.value == pytest.approx(0.98 * -0.6) and solution.bound == pytest.approx(solution.value)
    environment = suite.load("towers", "fist_features", task_kwargs={"random": fresh_seed(), "time_limit": 0.2})
    episodes = environment_loop.EnvironmentLoop(environment, solution.actor()).run(5)
    assert all(episode["episode_length"] == 2 for episode in episodes)


def test_beliefs_have_the_hypotheses_that_agree_with_observations(world):
    task, cache = world
    touch = {"direct_features": [0], "fist_features": [0, 0]}[task]
    num_interactions = cache.task.num_interactions
    solution = search.Solution(cache, 0.0, 0.98)
    for pattern in range(PATTERNS):
        actions = np.array([*touch, num_interactions + 2])
        found = solution.beliefs(np.array(pattern), actions)
        before = np.full((len(touch), 5), 0.2)  # Nothing is known before the touch, all after it.
        known = np.eye(5)[COUNTS[pattern] - 1]
        np.testing.assert_allclose(found, [*before, known, known], atol=1e-12)
    # An observer that distinguishes nothing never learns.
    blind = search.Solution(cache, 10.0, 0.98).beliefs(np.array(3), actions)
    np.testing.assert_allclose(blind, 0.2)


def test_an_episode_with_an_unknown_hidden_property_is_refused():
    solution = search.Solution(MadeWorld(1, lambda sequence: COUNTS), 0.5, 0.98)
    with pytest.raises(ValueError, match="hidden is 16, which is none of the hypotheses"):
        solution.beliefs(16, np.zeros(0, int))


def test_the_rule_for_noisy_towers_answers_in_the_last_step(monkeypatch):
    monkeypatch.setattr(bounds, "NUM_EPISODES", 640)
    only_step = {"noise": 0.001, "time_limit": 0.1}
    solution = domains.find("towers").ideal("direct_features", only_step, discount=0.98)
    summary = solution.summary()
    assert summary["mean_interactions"] == 0
    assert abs(solution.value - (2 / 5 - 1)) < 4 * summary["value_error"]  # One of five answers is right.


@pytest.mark.parametrize("control_timestep, moves", [(0.05, 4), (0.1, 2)])
def test_the_best_first_action_is_judged_to_earn_the_ideals_return(control_timestep, moves):
    # The fist stands 0.2 m before it touches the tower, and moves at 1 m/s: it knows the answer after 0.2 s.
    solution = towers.DOMAIN.ideal("fist_features", {"control_timestep": control_timestep, **SHORT}, 0.98)
    judged = solution.judge(0, np.array([suite.load_task("towers", "fist_features").num_interactions]))
    assert judged.values[0].max() == pytest.approx(0.98**moves, abs=1e-9) == solution.value
