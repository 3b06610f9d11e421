"""No observation ever leaves the bounds that the specs state, whatever is done."""

import dm_env
import gymnasium
import numpy as np
import pytest

from physexp import suite
from physexp.suite import gymnasium as adapter

FEATURE_TASKS = [(domain, task) for domain, task in suite.ALL_TASKS if task.endswith("features")]
TIMESTEPS = {"which_is_heavier": (0.025, 0.1, 1.0), "towers": (0.02, 0.1, 1.0)}  # s
SECONDS = {"which_is_heavier": 10.0, "towers": 2.0}


def _stubborn(rng, num_actions, size):
    """A player for each environment who keeps to an action, or to four neighbouring ones, for ever shorter times."""
    patience = rng.choice([1, 3, 10, np.inf], size=size)
    own = rng.integers(num_actions, size=size)
    actions = own.copy()
    while True:
        yield actions
        tired = rng.random(size) < 1 / patience
        actions = np.where(tired, np.where(rng.random(size) < 0.5, own, rng.integers(num_actions, size=size)), actions)


@pytest.mark.parametrize("domain_name, task_name", FEATURE_TASKS)
@pytest.mark.parametrize("which", range(3))
def test_no_play_takes_an_observation_out_of_its_bounds(seed, domain_name, task_name, which):
    timestep = TIMESTEPS[domain_name][which]
    options = {"random": seed, "control_timestep": timestep, "time_limit": SECONDS[domain_name]}
    if domain_name == "which_is_heavier":
        options["difficulty"] = 1e6  # One block has all the mass, and the others the least.
    size = 16
    batch = suite.load_batch(domain_name, task_name, size, options)
    spec = batch.observation_spec()
    assert all(isinstance(bounded, dm_env.specs.BoundedArray) for bounded in spec.values())
    players = _stubborn(np.random.default_rng(seed), batch.task.num_interactions, size)
    step = batch.reset()
    for _ in range(batch.task.rules.step_limit):
        for name, bounded in spec.items():
            assert (step.observation[name] >= bounded.minimum).all(), (name, step.observation[name].min())
            assert (step.observation[name] <= bounded.maximum).all(), (name, step.observation[name].max())
        step = batch.step(next(players))
    assert step.last().all()


def test_the_bounds_of_heights_are_not_far_from_what_is_reached(seed):
    """A block of 0.2 kg that is poked on and on passes the end of its rail, at 0.4 m, before it feels it."""
    batch = suite.load_batch("which_is_heavier", "features", 16, {"random": seed, "difficulty": 1e6})
    batch.reset()
    heights = [batch.step(np.full(16, 0)).observation["heights"] for _ in range(5)]
    (bounded,) = batch.observation_spec().values()
    assert np.max(heights) > 0.75 * bounded.maximum


@pytest.mark.parametrize("domain_name, task_name", FEATURE_TASKS)
def test_gymnasium_has_the_bounds_of_the_specs(domain_name, task_name):
    environment = gymnasium.make(adapter.environment_id(domain_name, task_name))
    spec = suite.load(domain_name, task_name).observation_spec()
    for name, box in environment.observation_space.items():
        assert box.is_bounded() and box.dtype == np.float32
        np.testing.assert_array_equal(box.low, np.broadcast_to(spec[name].minimum, box.shape).astype(np.float32))
        np.testing.assert_array_equal(box.high, np.broadcast_to(spec[name].maximum, box.shape).astype(np.float32))
    environment.close()
