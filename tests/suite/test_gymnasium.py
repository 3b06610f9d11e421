"""The environments under Gymnasium's interface, as Gymnasium and Stable-Baselines3 check it."""

import subprocess
import sys
import warnings

import gymnasium
from gymnasium.utils import env_checker
import numpy as np
import pytest
from stable_baselines3.common import env_checker as sb3_checker

from physexp import suite
from physexp.suite import gymnasium as adapter

NAMES = [adapter.environment_id(*names) for names in suite.ALL_TASKS]


@pytest.mark.parametrize("name", NAMES)
def test_gymnasium_and_stable_baselines_accept_every_task(name):
    environment = gymnasium.make(name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Both advise on style, such as bounds of observations.
        env_checker.check_env(environment.unwrapped, skip_render_check=True)
        sb3_checker.check_env(environment.unwrapped)
    environment.close()


def test_a_name_with_its_module_needs_no_import_of_ours():
    program = """
import gymnasium, sys
assert not any(name.startswith("physexp") for name in sys.modules)
name = "physexp.suite.gymnasium:physexp/towers-fist_features-v0"
assert gymnasium.make(name, random=3).unwrapped.dm_env.task.options.random == 3
batch = gymnasium.make_vec(name, num_envs=5, vectorization_mode="vector_entry_point")
assert batch.reset(seed=0)[0]["positions"].shape == (5, 5, 3)
"""
    subprocess.run([sys.executable, "-c", program], check=True)


@pytest.mark.parametrize("name", [name for name in NAMES if "features" in name])
def test_an_episode_is_that_of_the_environment_behind_it(name, seed):
    domain, task = name.removeprefix("physexp/").removesuffix("-v0").split("-")
    environment = gymnasium.make(name)
    expected = suite.load(domain, task, task_kwargs={"random": seed})
    generator = np.random.default_rng(seed)
    for episode in range(3):
        observation, info = environment.reset(seed=seed if episode == 0 else None)
        timestep = expected.reset()
        assert info == {}
        while not timestep.last():
            action = int(generator.integers(environment.action_space.n))
            timestep = expected.step(action)
            observation, reward, terminated, truncated, info = environment.step(action)
            assert reward == timestep.reward and terminated == timestep.last() and not truncated
            for key, value in timestep.observation.items():
                np.testing.assert_array_equal(observation[key], value)
        assert info == {"correct_answer": expected.task.correct_answer}


def test_running_out_of_time_terminates_with_a_wrong_answer():
    environment = gymnasium.make(NAMES[0], random=1)
    environment.reset()
    steps = 0
    while True:
        _, reward, terminated, truncated, _ = environment.step(0)
        steps += 1
        if terminated or truncated:
            break
    assert (steps, reward, terminated, truncated) == (100, -1.0, True, False)


def test_a_seed_makes_the_same_episodes_again_and_none_goes_on_with_others(seed):
    environment = gymnasium.make(NAMES[0])

    def hidden(**kwargs):
        environment.reset(**kwargs)
        return environment.unwrapped.dm_env.task.hidden

    first, second = hidden(seed=seed), hidden()
    assert not np.array_equal(first, second)
    np.testing.assert_array_equal(hidden(seed=seed), first)
    np.testing.assert_array_equal(hidden(), second)
    assert not np.array_equal(hidden(seed=seed + 1), first)


def test_a_vector_environment_is_the_batch_and_starts_episodes_with_the_next_step(seed):
    name = "physexp/which_is_heavier-features-v0"
    vector = gymnasium.make_vec(name, num_envs=6, vectorization_mode="vector_entry_point")
    assert vector.metadata["autoreset_mode"] == gymnasium.vector.AutoresetMode.NEXT_STEP
    batch = suite.load_batch("which_is_heavier", "features", 6, {"random": seed})
    observation, info = vector.reset(seed=seed)
    assert info == {} and observation in vector.observation_space
    batch.reset()
    generator = np.random.default_rng(seed)
    ended_before = np.zeros(6, bool)
    for _ in range(60):
        actions = generator.integers(8, size=6)
        answers = batch.correct_answers
        expected = batch.step(actions)
        observation, rewards, terminated, truncated, info = vector.step(actions)
        np.testing.assert_array_equal(observation["heights"], expected.observation["heights"])
        np.testing.assert_array_equal(rewards, expected.reward)
        np.testing.assert_array_equal(terminated, expected.last())
        assert not truncated.any() and not (terminated & ended_before).any()
        assert not rewards[ended_before].any()  # Where an episode starts, nothing is earned.
        if terminated.any():
            np.testing.assert_array_equal(info["_correct_answer"], terminated)
            np.testing.assert_array_equal(info["correct_answer"][terminated], answers[terminated])
            assert not info["correct_answer"][~terminated].any()
        else:
            assert info == {}
        ended_before = terminated


def test_an_image_for_people_is_larger_than_what_agents_see():
    environment = gymnasium.make("physexp/towers-direct_features-v0", render_mode="rgb_array")
    environment.reset(seed=0)
    image = environment.render()
    assert image.shape == (480, 480, 3) and len(np.unique(image.reshape(-1, 3), axis=0)) > 10


@pytest.mark.parametrize("name", ["physexp/towers-fist_features-v0", "physexp/which_is_heavier-pixels-v0"])
def test_a_vector_environment_draws_what_each_environment_behind_it_draws(name, seed):
    vector = gymnasium.make_vec(name, num_envs=3, vectorization_mode="vector_entry_point", render_mode="rgb_array")
    singles = [
        gymnasium.make(name, random=suite.environment_seed(seed, i), render_mode="rgb_array").unwrapped
        for i in range(3)
    ]
    vector.reset(seed=seed)
    for single in singles:
        single.reset()
    for step in range(4):
        actions = np.array([0, 1, single.dm_env.task.num_interactions if step == 1 else 3])
        vector.step(actions)
        for single, action in zip(singles, actions, strict=True):
            if single._playing:
                single.step(int(action))
            else:
                single.reset()
        images = vector.render()
        assert isinstance(images, tuple) and len(images) == vector.num_envs
        for image, single in zip(images, singles, strict=True):
            np.testing.assert_array_equal(image, single.render())
    assert vector.metadata["render_fps"] == singles[0].metadata["render_fps"] == 10
    vector.close()
    for single in singles:
        single.close()


def test_images_of_many_environments_fit_into_a_square_of_1920_pixels():
    vector = adapter.VectorEnvironment("which_is_heavier", "features", 65, render_mode="rgb_array")
    vector.reset(seed=0)
    images = vector.render()
    assert len(images) == 65 and images[0].shape == (213, 213, 3)  # 9 by 9 of them: 1920 / 9 = 213.3.
    vector.close()


def test_a_grid_has_the_images_row_by_row_and_black_where_there_is_none():
    vector = adapter.VectorEnvironment("which_is_heavier", "features", 3, random=0, render_mode="rgb_array_grid")
    vector.reset()
    vector.step(np.array([0, 1, 2]))
    grid = vector.render()
    one, two, three = vector.batch.render(480)
    assert grid.shape == (960, 960, 3) and grid.dtype == np.uint8
    np.testing.assert_array_equal(grid, np.block([[[one], [two]], [[three], [np.zeros_like(one)]]]))
    assert not np.array_equal(one, two)
    vector.close()


def test_without_a_render_mode_nothing_is_drawn():
    assert adapter.VectorEnvironment("towers", "fist_features", 2).render() is None
    assert adapter.Environment("towers", "fist_features").render() is None


@pytest.mark.parametrize("size", [None, 2])
def test_a_step_without_an_episode_says_that_a_reset_is_needed(size):
    kwargs = {} if size is None else {"num_envs": size}
    environment = (adapter.VectorEnvironment if size else adapter.Environment)("which_is_heavier", "features", **kwargs)
    action = 4 if size is None else np.full(2, 4)
    with pytest.raises(gymnasium.error.ResetNeeded, match=r"reset\(\)"):
        environment.step(action)
    environment.reset()
    assert np.all(environment.step(action)[2])
    if size is None:  # A vector environment starts the next episode by itself.
        with pytest.raises(gymnasium.error.ResetNeeded, match=r"reset\(\)"):
            environment.step(action)
        environment.reset()
    environment.step(action)


@pytest.mark.parametrize("make", [adapter.Environment, adapter.VectorEnvironment])
def test_a_closed_environment_says_so_and_is_closed_twice(make):
    environment = make("which_is_heavier", "features", render_mode="rgb_array")
    environment.reset(seed=0, options={"unknown": 1})
    environment.close()
    environment.close()
    action = 0 if make is adapter.Environment else [0]
    for use in (environment.reset, environment.render, lambda: environment.step(action)):
        with pytest.raises(RuntimeError, match=r"^the (environment|batch) is closed; load another$"):
            use()


@pytest.mark.parametrize("make", [adapter.Environment, adapter.VectorEnvironment])
@pytest.mark.parametrize("seed", [-1, 2**63, 1.5, "1", True, [1, 2], np.float64(1)])
def test_a_seed_that_is_none_is_refused_and_changes_nothing(make, seed):
    environment = make("which_is_heavier", "features", random=5)
    with pytest.raises(ValueError, match=r"^seed is .*; give an integer >= 0 and < 2\*\*63$"):
        environment.reset(seed=seed)
    environment.reset(seed=np.int64(3))


def test_a_part_of_a_vector_environment_is_not_reset():
    environment = adapter.VectorEnvironment("which_is_heavier", "features", 2, random=5)
    with pytest.raises(ValueError, match="^options has a reset_mask; reset all"):
        environment.reset(options={"reset_mask": np.array([True, False])})


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: adapter.Environment("towers", "features"), "task_name is 'features'"),
        (lambda: adapter.Environment("towers", "fist_features", render_mode="human"), "render_mode is 'human'"),
        (lambda: adapter.VectorEnvironment("towers", "fist_features", 0), "num_envs is 0"),
        (lambda: adapter.VectorEnvironment("towers", "fist_features", 2.0), r"num_envs is 2\.0"),
        (lambda: adapter.VectorEnvironment("towers", "fist_features", 2, render_mode=3), "render_mode is 3"),
    ],
)
def test_what_makes_no_sense_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
