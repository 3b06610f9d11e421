"""Where readings are noisy or episodes differ in what cannot be seen, the ideal is bounded from both sides."""

import types

import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.analysis import domains
from physexp.analysis.domains import towers
from physexp.analysis.ideal import bounds
from physexp.suite.engine import seeding

_DISCOUNT = 0.95


def _ideal(domain, task, **task_kwargs):
    known = domains.find(domain)
    return known.ideal(task, task_kwargs, known.discount)


@pytest.fixture
def few_episodes(monkeypatch):
    """As many as a test has time for."""
    monkeypatch.setattr(bounds, "NUM_EPISODES", 160)
    monkeypatch.setattr(towers, "_NUM_NUISANCES", 2)


@pytest.mark.long
def test_bounds_with_noise_or_variation_are_near_each_other(few_episodes):
    for domain, task, task_kwargs in (
        ("which_is_heavier", "features", {"variation": 1.0}),
        ("which_is_heavier", "features", {"noise": 0.003}),
        ("towers", "direct_features", {"variation": 1.0}),
    ):
        found = _ideal(domain, task, **task_kwargs).summary()
        error = np.hypot(found["value_error"], found["bound_error"])
        assert -5 * error < found["bound"] - found["value"] < 0.03 + 5 * error
        assert sum(found["histogram"].values()) == pytest.approx(1)


@pytest.mark.parametrize("task", ["direct_features", "fist_features"])
def test_a_rule_earns_as_much_as_anybody_where_towers_vary(few_episodes, task):
    """One push tells all; the fist touches the tower with its second or third move, wherever both of them start."""
    found = _ideal("towers", task, variation=1.0).summary()
    most, least = {"direct_features": (0.98, 0.98), "fist_features": (0.98**2, 0.98**3)}[task]
    assert least - 1e-9 < found["value"] < most + 1e-9
    assert found["bound"] == pytest.approx(found["value"], abs=1e-9)


def test_without_noise_and_variation_the_value_is_exact():
    for kwargs in ({}, {"noise": 0.0}, {"variation": 0.0}):
        solution = _ideal("which_is_heavier", "features", **kwargs)
        assert solution.value == solution.bound == _ideal("which_is_heavier", "features").value


def test_the_policy_plays_and_what_it_believes_is_not_known():
    solution = _ideal("towers", "fist_features", noise=0.001)
    actor = solution.actor()
    environment = suite.load("towers", "fist_features", {"noise": 0.001})
    timestep = environment.reset()
    actor.observe_first(timestep)
    while not timestep.last():
        action = actor.select_action(timestep.observation)
        timestep = environment.step(action)
        actor.observe(action, timestep)
    assert timestep.reward == 1
    with pytest.raises(ValueError, match="where there is neither noise nor variation"):
        solution.beliefs(types.SimpleNamespace())


def test_what_cannot_be_bounded_is_refused_in_one_line():
    with pytest.raises(ValueError, match="blocks is 3; give none where there is noise or variation"):
        domains.find("which_is_heavier").ideal("features", {"noise": 0.001}, _DISCOUNT, blocks=3)
    with pytest.raises(ValueError, match="task is 'fist_pixels'; with noise or variation, choose from direct_features"):
        _ideal("towers", "fist_pixels", variation=1.0)


@pytest.mark.parametrize("task", ["which_is_heavier features", "towers fist_features"])
def test_circumstances_that_are_given_are_those_of_the_episode_that_draws_them(task):
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
