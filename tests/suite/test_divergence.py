"""An episode whose simulation diverges ends without reward, and the next one is played as ever."""

import logging

from every_task import load, load_batch
import numpy as np
import pytest

from physexp.suite.engine import snapshots

VELOCITIES = (np.nan, np.inf, -1e20)  # MuJoCo cannot go on from these.
# One and many compiled models, contacts, bands, and two bodies on one rail.
every_kind = pytest.mark.parametrize(
    "name", ["which_is_heavier/features", "towers/fist_features", "strings/features", "sealed_box/features"]
)


def _assert_same(one, other) -> None:
    for key, value in one.items():
        np.testing.assert_array_equal(value, other[key])


@every_kind
def test_an_episode_that_diverges_ends_without_reward(name, caplog):
    env, healthy = (load(name, random=0) for _ in range(2))
    first, expected = env.reset(), healthy.reset()
    for divergences, velocity in enumerate(VELOCITIES, start=1):
        assert first.first()
        _assert_same(first.observation, expected.observation)
        for t in range(5):
            step, expected = env.step(t % 3), healthy.step(t % 3)
            _assert_same(step.observation, expected.observation)
        env.physics.data.qvel[0] = velocity
        caplog.clear()
        with caplog.at_level(logging.WARNING):
            step = env.step(0)
        assert (step.last(), step.reward, step.discount) == (True, 0, 0)
        assert all(np.isfinite(value).all() for value in step.observation.values())
        assert env.task.num_divergences == divergences
        assert any("invalid" in record.getMessage() for record in caplog.records)
        first, expected = env.step(0), healthy.reset()


@every_kind
def test_an_environment_of_a_batch_diverges_alone(name, caplog):
    batch, healthy = (load_batch(name, 3, random=0) for _ in range(2))
    single = load(name, random=int(batch.seeds[1]))
    for each in (batch, healthy):
        each.reset()
        each.step([0, 1, 2])
    single.reset(), single.step(1)
    snapshots.view(batch, "qvel", 1)[0] = single.physics.data.qvel[0] = np.nan
    with caplog.at_level(logging.WARNING):
        step, expected, alone = batch.step([0, 0, 0]), healthy.step([0, 0, 0]), single.step(0)
    assert alone.last()
    np.testing.assert_array_equal(step.step_type, [1, 2, 1])
    np.testing.assert_array_equal(step.reward, [0, 0, 0])
    np.testing.assert_array_equal(step.discount, [1, 0, 1])
    for key, value in step.observation.items():
        assert np.isfinite(value).all()
        np.testing.assert_array_equal(value[[0, 2]], expected.observation[key][[0, 2]])
        np.testing.assert_array_equal(value[1], alone.observation[key])
    assert any("diverged in environments [1]" in record.getMessage() for record in caplog.records)
    np.testing.assert_array_equal(batch.step([0, 10**6, 0]).step_type, [1, 0, 1])
    healthy.step([0, 0], environments=np.array([0, 2]))
    healthy.reset(environments=np.array([1]))
    for t in range(4):
        _assert_same(batch.step(np.full(3, t % 3)).observation, healthy.step(np.full(3, t % 3)).observation)
    for divergences, velocity in enumerate(VELOCITIES, start=2):  # The same environment diverges again and again.
        batch.reset(episode=0)
        batch.step([0, 0, 0])
        snapshots.view(batch, "qvel", 1)[0] = velocity
        np.testing.assert_array_equal(batch.step([0, 0, 0]).step_type, [1, 2, 1])
        assert batch.num_divergences == divergences


def test_a_divergence_raises_where_the_user_asked_for_it():
    env = load("which_is_heavier/features", {"raise_exception_on_physics_error": True}, random=0)
    env.reset()
    env.physics.data.qvel[0] = np.nan
    with pytest.raises(RuntimeError, match="invalid"):
        env.step(0)
    assert env.task.num_divergences == 1
    assert env.reset().first() and env.step(0).mid()
