"""Every registered task keeps dm_env's contract, and pays as the paper says (Section 3)."""

import unittest

from absl.testing import absltest
import dm_env
from dm_env import test_utils
from every_task import every_feature_task, every_task, load
import numpy as np
import pytest

from physexp import suite


@pytest.fixture
def env(name):
    environment = load(name, random=0)
    yield environment
    environment.close()


@every_task
def test_the_contract_of_dm_env_is_kept(name):
    class Contract(test_utils.EnvironmentTestMixin, absltest.TestCase):
        def make_object_under_test(self):
            return load(name, random=0)

        def make_action_sequence(self):
            """Past the time limit, through the first step of the next episode, to an answer and past that as well."""
            rules = self.environment.task.rules
            for t in range(rules.step_limit + 3):
                yield np.int32(t % rules.num_interactions)
            for action in (rules.num_interactions, 0, 0):
                yield np.int32(action)

        def test_two_episodes_end_and_all_values_are_finite(self):
            self.environment.reset()
            steps = [self.environment.step(action) for action in self.make_action_sequence()]
            self.assertEqual(2, sum(step.last() for step in steps))
            for step in steps:
                self.assertTrue(step.first() or np.isfinite([step.reward, step.discount]).all())
                self.assertTrue(all(np.isfinite(value).all() for value in step.observation.values()))

    result = unittest.TestResult()
    unittest.defaultTestLoader.loadTestsFromTestCase(Contract).run(result)
    assert result.testsRun == 5 and result.wasSuccessful(), result.failures + result.errors


@every_task
def test_only_the_right_label_earns_one_and_silence_loses_one(env):
    interactions, labels, step_limit = env.task.num_interactions, env.task.num_labels, env.task.rules.step_limit
    assert env.action_spec().num_values == interactions + labels == len({*env.task.action_names})
    for label in range(labels):
        env.reset()
        step = env.step(np.int32(interactions + label))
        right = label == env.task.correct_answer
        assert (step.last(), step.reward, step.discount) == (True, 1.0 if right else -1.0, 0.0)
    env.reset()
    for t in range(step_limit - 1):
        step = env.step(np.int32(t % interactions))
        assert (step.mid(), step.reward, step.discount) == (True, 0.0, 1.0)
    step = env.step(np.int32(0))
    assert (step.last(), step.reward, step.discount) == (True, -1.0, 0.0)
    assert env.step(np.int32(0)).first()


@pytest.mark.parametrize(
    "domain, kind, num_interactions, num_labels, step_limit",
    [("which_is_heavier", "", 4, 4, 100), ("towers", "direct_", 20, 5, 26), ("towers", "fist_", 4, 5, 26)],
)
def test_the_papers_tasks_have_the_papers_numbers(domain, kind, num_interactions, num_labels, step_limit):
    for observed in ("features", "pixels"):
        assert (domain, f"{kind}{observed}") in suite.ALL_TASKS and f"{kind}{observed}" in suite.TASKS_BY_DOMAIN[domain]
        environment = suite.load(domain, f"{kind}{observed}", task_kwargs={"random": 0})
        assert isinstance(environment, dm_env.Environment)
        task, spec = environment.task, environment.observation_spec()
        assert (task.num_interactions, task.num_labels) == (num_interactions, num_labels)
        assert task.rules.step_limit == step_limit
        if observed == "pixels":
            assert [(key, one.shape, one.dtype) for key, one in spec.items()] == [("pixels", (84, 84, 3), np.uint8)]
        else:
            assert all(one.dtype == np.float32 for one in spec.values())
        environment.close()


@every_feature_task
def test_the_right_label_in_the_last_step_still_earns_one(env):
    env.reset()
    for _ in range(env.task.rules.step_limit - 1):
        before = env.step(np.int32(0)).observation
    last = env.step(np.int32(env.task.num_interactions + env.task.correct_answer))
    assert last.reward == 1.0
    # A label moves nothing.
    assert {name: value.tobytes() for name, value in last.observation.items()} == {
        name: value.tobytes() for name, value in before.items()
    }


@pytest.mark.parametrize("name", ["towers/fist_features", "sealed_box/features", "which_is_heavier/pixels"])
def test_a_flat_observation_is_the_others_in_a_row_sorted_by_name(name):
    """As `dm_control.suite.load` has it with the same argument."""
    flat, named = (load(name, {"flat_observation": flat}, random=0) for flat in (True, False))
    (spec,) = flat.observation_spec().values()
    actions = [0, flat.task.num_interactions, 0, 1]  # The second one ends the episode, the third starts the next.
    for each, expected in zip(
        [flat.reset(), *map(flat.step, actions)], [named.reset(), *map(named.step, actions)], strict=True
    ):
        assert each[:3] == expected[:3] and list(each.observation) == ["observations"] == [spec.name]
        spec.validate(each.observation["observations"])
        row = np.concatenate([value.ravel() for _, value in sorted(expected.observation.items())])
        assert each.observation["observations"].tobytes() == row.tobytes()
    flat.close(), named.close()


# The limit is a time. Towers: 2.6 s / 0.01 s = 260 and 2.6 / 1.0 rounded up = 3. Heavier: 10 s / 0.025 s = 400. Given
# limits are rounded up to whole control steps: 0.25 s / 0.1 s gives 3, and 0.01 s at least 1; but 0.07 / 0.01 is 7,
# though it is 7.000000000000001 in binary.
@pytest.mark.parametrize(
    "domain_name, task_name, task_kwargs, steps",
    [
        ("towers", "fist_features", {"control_timestep": 0.01}, 260),
        ("towers", "fist_features", {"control_timestep": 1.0}, 3),
        ("towers", "fist_features", {"control_timestep": 0.01, "time_limit": 0.07}, 7),
        ("which_is_heavier", "features", {"control_timestep": 0.025}, 400),
        ("which_is_heavier", "features", {"time_limit": 0.25}, 3),
        ("which_is_heavier", "features", {"time_limit": 0.3}, 3),
        ("which_is_heavier", "features", {"time_limit": 0.01}, 1),
    ],
)
def test_the_limit_of_an_episode_is_a_time(domain_name, task_name, task_kwargs, steps):
    assert suite.load_task(domain_name, task_name, task_kwargs).rules.step_limit == steps
