"""The ideal experimenter of Towers: its search on made-up worlds solved by hand, and in the real environment."""

import json
import math
import types

import numpy as np
import pytest
from trainers import fresh_seed

from physexp import suite
from physexp.agents import environment_loop
from physexp.analysis.ideal import towers, trajectories
from physexp.suite.parts import tower

PATTERNS = trajectories.NUM_PATTERNS
COUNTS = [tower.num_bodies(pattern) for pattern in tower.PATTERNS]


class MadeWorld:
    """Trajectories in which each action tells a label of the patterns, and after which others may be told apart.

    `tells` maps a sequence of actions to what it makes visible: a number for each pattern.
    """

    def __init__(self, num_actions, tells):
        rules = types.SimpleNamespace(step_limit=26)
        self.task = types.SimpleNamespace(num_interactions=num_actions, control_timestep=0.1, rules=rules)
        self.steps, self._tells, self._expanded = 0, tells, {()}
        self._num_actions = num_actions

    def is_expanded(self, sequence):
        return (*sequence, 0) in self._expanded

    def expand(self, sequences):
        for sequence in sequences:
            self._expanded |= {(*sequence, action) for action in range(self._num_actions)}
        self.steps += len(sequences)

    def apart(self, sequence):
        assert sequence in self._expanded
        total = np.zeros((PATTERNS, PATTERNS))
        for end in range(1, len(sequence) + 1):
            values = np.array(self._tells(sequence[:end]), float)
            total = np.maximum(total, abs(values[:, None] - values))
        return total

    def observe(self, sequences):
        return [{"positions": np.zeros((PATTERNS, 5, 3), np.float32)} for _ in sequences]


def solve(world, objective="return", discount=0.9, resolution=0.5):
    return towers.solve("fist_features", resolution, discount, objective, trajectories=world)


def test_counts_are_uniform_and_patterns_uniform_given_the_count():
    np.testing.assert_allclose(np.bincount(COUNTS, towers._PRIOR)[1:], 0.2)
    assert len({round(weight, 12) for weight, count in zip(towers._PRIOR, COUNTS, strict=True) if count == 3}) == 1


def test_patterns_are_linked_through_others():
    apart = np.abs(np.arange(PATTERNS)[:, None] - np.arange(PATTERNS)).astype(float)
    assert [group for _, group in towers.split((0, 1, 2, 5, 6), apart, 1.0)] == [(0, 1, 2), (5, 6)]
    assert [group for _, group in towers.split((0, 2, 4), apart, 1.0)] == [
        (0,),
        (2,),
        (4,),
    ]  # 1 and 3 are known not to be.
    chances = [chance for chance, _ in towers.split(tuple(range(PATTERNS)), apart, 0.0)]
    np.testing.assert_allclose(chances, towers._PRIOR)


def test_an_action_that_tells_the_count_is_taken_once():
    # Action 1 shows the count at once, action 0 nothing. Then the answer is right: 0.9 of return, one interaction.
    world = MadeWorld(2, lambda sequence: COUNTS if sequence[-1] == 1 else [0] * PATTERNS)
    for objective, value in (("return", 0.9), ("time", 1.0)):
        solution = solve(world, objective)
        assert solution.value == pytest.approx(value) and solution.bound == pytest.approx(value)
        assert solution.policy.action == 1
        assert solution.summary()["histogram"] == {0: 0.0, 1: 1.0}


def test_what_is_seen_decides_what_is_done_next():
    # Action 0 tells whether there are 1 or 2 bodies, or more. Only after it, action 1 tells 1 from 2, and action 2
    # tells 3, 4 and 5 apart. So two interactions always do, and no fixed sequence of two would.
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
    assert solution.summary()["accuracy"] == 1.0
    assert solve(MadeWorld(3, tells)).value == pytest.approx(0.9**2)


def test_a_guess_is_made_when_asking_on_costs_more():
    # Action 0 tells 1, 2 and 3 bodies and leaves 4 and 5 together; after it, action 1 tells those two apart. With 4 and
    # 5 equally likely a guess is worth 0, asking on the discount: always more. With action 1 useless, guessing is all
    # there is: right in 3/5 + 2/5 * 1/2 = 0.8, so the value is discount * (0.8 - 0.2) = 0.9 * 0.6.
    def useful(sequence):
        return COUNTS if sequence[-1] == 1 and len(sequence) > 1 else [min(count, 4) for count in COUNTS]

    def useless(sequence):
        return [min(count, 4) for count in COUNTS]

    asking = solve(MadeWorld(2, useful))
    assert asking.value == pytest.approx(0.9 * (3 / 5 + 2 / 5 * 0.9))
    guessing = towers.solve("fist_features", 0.5, 0.9, max_depth=3, trajectories=MadeWorld(2, useless))
    assert guessing.value == pytest.approx(0.9 * 0.6)
    assert guessing.summary()["accuracy"] == pytest.approx(0.8)
    # Nobody has looked further than three actions, so more might be possible, and that is said.
    assert guessing.bound > guessing.value


def test_without_any_use_of_acting_the_answer_is_a_guess_at_once():
    solution = towers.solve(
        "fist_features", 0.5, 0.9, max_depth=2, trajectories=MadeWorld(2, lambda sequence: [0] * PATTERNS)
    )
    # Right in one case of five: 2/5 - 1. Acting only discounts it, which for a loss is better: 0.9^2 * (-0.6) = -0.486.
    assert solution.value == pytest.approx(0.9**2 * -0.6)


@pytest.fixture(scope="module", params=["direct_features", "fist_features"])
def world(request):
    return request.param, trajectories.Trajectories(request.param)


def test_who_sees_every_bit_knows_the_count_with_the_first_touch(world):
    task, cache = world
    # Pushes touch at once; the fist needs two steps of 0.1 m to cross the 0.17 m to the tower.
    needed = {"direct_features": 1, "fist_features": 2}[task]
    for objective, value in (("return", 0.98**needed), ("time", needed)):
        solution = towers.solve(task, 0.0, 0.98, objective, trajectories=cache)
        assert solution.value == pytest.approx(value) and solution.bound == pytest.approx(value)


def test_a_coarser_eye_never_sees_more(world):
    task, cache = world
    values = []
    for resolution in (0.0, 0.001, 0.003):
        solution = towers.solve(task, resolution, 0.98, trajectories=cache)
        assert solution.bound == pytest.approx(solution.value)
        values.append(solution.value)
    assert values == sorted(values, reverse=True)


def test_in_the_real_environment_it_is_always_right_and_takes_as_long_as_predicted(world):
    task, cache = world
    solution = towers.solve(task, 0.003, 0.98, trajectories=cache)
    seed = fresh_seed()
    environment = suite.load("towers", task, task_kwargs={"random": seed})
    loop = environment_loop.EnvironmentLoop(environment, towers.IdealExperimenter(solution))
    outcomes = solution.outcomes()
    for _ in range(25):
        episode = loop.run_episode()
        interactions, right = outcomes[environment.task.hidden]
        assert right and episode["episode_return"] == 1
        assert episode["episode_length"] == interactions + 1


def test_the_towers_look_alike_until_they_are_touched():
    cache = trajectories.Trajectories("fist_features")
    cache.expand([(), (1,)])  # Action 1 moves the fist away.
    assert not cache.apart((1, 1)).any()
    # Four sequences of one action and four of two, replayed from the start, for 16 patterns each.
    assert cache.steps == (4 * 1 + 4 * 2) * PATTERNS


def test_distances_are_the_largest_of_positions_or_the_number_of_pixels():
    positions = np.zeros((2, 5, 3))
    positions[1, 2] = [0.03, 0.04, 0]
    fist = np.zeros((2, 3))
    fist[1] = [0, 0, 0.01]
    np.testing.assert_allclose(
        trajectories.distances({"positions": positions, "fist_position": fist}), [[0, 0.05], [0.05, 0]]
    )
    pixels = np.zeros((2, 84, 84, 3), np.uint8)
    pixels[1, 3, 4] = 7
    pixels[1, 9, 9, 2] = 1
    np.testing.assert_array_equal(trajectories.distances({"pixels": pixels}), [[0, 2], [2, 0]])


def test_from_pixels_the_first_touch_tells_as_well():
    solution = towers.solve("direct_pixels", 0.0, 0.98)
    assert solution.value == pytest.approx(solution.bound)
    seed = fresh_seed()
    environment = suite.load("towers", "direct_pixels", task_kwargs={"random": seed})
    episodes = environment_loop.EnvironmentLoop(environment, towers.IdealExperimenter(solution)).run(10)
    assert all(episode["episode_return"] == 1 for episode in episodes)


def test_the_summary_can_be_written_as_json_even_where_the_count_cannot_be_known():
    summary = solve(MadeWorld(1, lambda sequence: COUNTS)).summary()
    assert json.loads(json.dumps(summary))["mean_seconds"] == pytest.approx(0.1)
    blind = towers.solve(
        "fist_features", 0.5, objective="time", max_depth=2, trajectories=MadeWorld(1, lambda sequence: [0] * PATTERNS)
    )
    assert json.loads(json.dumps(blind.summary(), allow_nan=False))["value"] is None


def test_an_answer_must_come_within_the_time_limit():
    # Two actions are allowed and the fist needs two to touch: only one is left for it, then a guess. It is right in one
    # case of five, -0.6; acting before it discounts the loss.
    solution = towers.solve("fist_features", 0.0, 0.98, task_kwargs={"time_limit": 0.2})
    assert solution.value == pytest.approx(0.98 * -0.6) and solution.bound == pytest.approx(solution.value)
    environment = suite.load("towers", "fist_features", task_kwargs={"random": fresh_seed(), "time_limit": 0.2})
    episodes = environment_loop.EnvironmentLoop(environment, towers.IdealExperimenter(solution)).run(5)
    assert all(episode["episode_length"] == 2 for episode in episodes)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("features",), "task is 'features'; choose from direct_features"),
        (("fist_features", -1.0), "resolution is -1.0; give a finite number >= 0"),
        (("fist_features", math.inf), "resolution is inf; give a finite number >= 0"),
        (("fist_features", 0.0, 0.0), "discount is 0.0; give a number in"),
        (("fist_features", 0.0, 0.9, "fame"), "objective is 'fame'; choose from return, time"),
    ],
)
def test_what_makes_no_sense_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        towers.solve(*arguments)
