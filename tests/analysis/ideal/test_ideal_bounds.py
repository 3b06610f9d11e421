"""Lower and upper bounds on the ideal return with noise or variation."""

import ideals
import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.analysis.domains import towers
from physexp.analysis.ideal import bounds
from physexp.suite.engine import seeding


@pytest.fixture
def few_episodes(monkeypatch):
    monkeypatch.setattr(bounds, "NUM_EPISODES", 160)
    monkeypatch.setattr(towers, "_NUM_NUISANCES", 2)


@pytest.mark.long
def test_the_bounds_are_close_to_each_other(few_episodes):
    for domain, task, task_kwargs in (
        ("which_is_heavier", "features", {"variation": 1.0}),
        ("which_is_heavier", "features", {"noise": 0.003}),
        ("towers", "direct_features", {"variation": 1.0}),
    ):
        found = ideals.of(domain, task, **task_kwargs).summary()
        error = np.hypot(found["value_error"], found["bound_error"])
        assert -5 * error < found["bound"] - found["value"] < 0.03 + 5 * error
        assert sum(found["histogram"].values()) == pytest.approx(1)
        assert domain == "towers" or found["bound"] == ideals.of(domain, task).value


@pytest.mark.parametrize("task", ["direct_features", "fist_features"])
def test_a_rule_reaches_the_upper_bound_if_towers_vary(few_episodes, task):
    """One push reveals all; the fist touches the tower with its second or third move."""
    found = ideals.of("towers", task, variation=1.0).summary()
    most, least = {"direct_features": (0.98, 0.98), "fist_features": (0.98**2, 0.98**3)}[task]
    assert least - 1e-9 < found["value"] < most + 1e-9
    assert found["bound"] == pytest.approx(found["value"], abs=1e-9)


def test_without_noise_and_variation_the_value_is_exact():
    for kwargs in ({}, {"noise": 0.0}, {"variation": 0.0}):
        solution = ideals.of("which_is_heavier", "features", **kwargs)
        assert solution.value == solution.bound == ideals.of("which_is_heavier", "features").value


def test_the_policy_plays_but_its_beliefs_are_unknown():
    solution = ideals.of("towers", "fist_features", noise=0.001)
    actor = solution.actor()
    environment = suite.load("towers", "fist_features", {"noise": 0.001})
    timestep = environment.reset()
    actor.observe_first(timestep)
    while not timestep.last():
        action = actor.select_action(timestep.observation)
        timestep = environment.step(action)
        actor.observe(action, timestep)
    assert timestep.reward == 1
    with pytest.raises(ValueError, match="only known without noise and variation"):
        solution.beliefs(np.array(0), np.array([0]))


@pytest.mark.parametrize("task", ["which_is_heavier features", "towers fist_features"])
def test_given_variation_makes_the_episode_that_draws_it(task):
    domain, task = task.split()
    seed = fresh_seed()
    drawn, given = (suite.load_batch(domain, task, 8, {"variation": 0.5, "random": seed}) for _ in range(2))
    expected = drawn.reset(episode=3)
    count = drawn.task.num_nuisances
    nuisances = 0.5 * seeding.variations(drawn.seeds, np.full(8, 3), count)
    found = given.reset(episode=5, hidden=drawn.hidden, nuisances=nuisances)
    for _ in range(3):
        for name, value in expected.observation.items():
            np.testing.assert_array_equal(found.observation[name], value)
        expected, found = (batch.step(np.zeros(8, np.int64)) for batch in (drawn, given))
    with pytest.raises(ValueError, match=r"nuisances is .*; give an array of shape \(8, "):
        given.reset(nuisances=nuisances[:, :-1])
    with pytest.raises(ValueError, match=r"nuisances is .*; give values from -1 to 1"):
        given.reset(nuisances=nuisances + 2)
