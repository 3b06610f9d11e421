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
FEATURES = [name for name in NAMES if "features" in name]
PIXELS = "physexp/threshold-pixels-v0"


@pytest.mark.parametrize("name", [*FEATURES, PIXELS])
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


@pytest.mark.parametrize("version, physics_timestep", [(0, 0.02), (1, 0.004)])
def test_the_first_version_of_sealed_box_has_its_coarse_steps(version, physics_timestep):
    environment = gymnasium.make(f"physexp/sealed_box-features-v{version}")
    assert environment.unwrapped.dm_env.task.options.physics_timestep == physics_timestep


@pytest.mark.parametrize("name", FEATURES)
def test_an_episode_is_that_of_the_environment_behind_it(name, seed):
    domain, task = name.removeprefix("physexp/").rpartition("-v")[0].split("-")
    environment = gymnasium.make(name)
    expected = suite.load(domain, task, task_kwargs={"random": seed})
    generator = np.random.default_rng(seed)
    for episode in range(3):
        observation, info = environment.reset(seed=seed if episode == 0 else None)
        timestep = expected.reset()
        assert info == {"seed": seed, "episode_index": episode}
        interactions = -1
        while not timestep.last():
            interactions += 1
            action = int(generator.integers(environment.action_space.n))
            timestep = expected.step(action)
            observation, reward, terminated, truncated, info = environment.step(action)
            assert reward == timestep.reward and terminated == timestep.last() and not truncated
            for key, value in timestep.observation.items():
                np.testing.assert_array_equal(observation[key], value)
        gamma = 0.98 if domain == "towers" else 0.95
        assert environment.unwrapped.discount == gamma
        assert info == {
            "correct_answer": expected.task.correct_answer,
            "discounted_return": pytest.approx(timestep.reward * gamma**interactions),
            "is_success": timestep.reward == 1,
        }


def test_the_seed_that_is_told_starts_the_same_episode_again():
    for environment in (gymnasium.make(NAMES[0]), gymnasium.make(NAMES[0], random=3)):
        environment.reset()
        _, told = environment.reset()
        assert told == {"seed": environment.np_random_seed, "episode_index": 1}
        hidden = environment.unwrapped.dm_env.task.hidden
        environment.reset()
        environment.reset(seed=told["seed"], options={"episode": told["episode_index"]})
        np.testing.assert_array_equal(environment.unwrapped.dm_env.task.hidden, hidden)
        again = suite.load("which_is_heavier", "features", {"random": told["seed"]})
        again.task.next_episode = told["episode_index"]
        again.reset()
        np.testing.assert_array_equal(again.task.hidden, hidden)


def test_the_seeds_that_a_vector_environment_tells_rebuild_its_episodes():
    vector = gymnasium.make_vec(NAMES[0], num_envs=3)
    vector.reset()
    _, told = vector.reset(options={"episode": 5})
    hidden = vector.unwrapped.batch.hidden
    for seed, episode, of_one in zip(told["seed"], told["episode_index"], hidden, strict=True):
        single = gymnasium.make(NAMES[0])
        single.reset(seed=int(seed), options={"episode": int(episode)})
        np.testing.assert_array_equal(single.unwrapped.dm_env.task.hidden, of_one)
    vector.reset(seed=vector.np_random_seed, options={"episode": 5})
    np.testing.assert_array_equal(vector.unwrapped.batch.hidden, hidden)


def assert_same(ours, theirs):
    """Asserts that observations or infos are equal in structure, types and values."""
    if isinstance(theirs, (tuple, dict)):
        assert len(ours) == len(theirs)
        for key in theirs if isinstance(theirs, dict) else range(len(theirs)):
            assert_same(ours[key], theirs[key])
    elif isinstance(theirs, np.ndarray) and theirs.dtype == object:
        assert_same(tuple(ours), tuple(theirs))
    else:
        assert getattr(ours, "dtype", None) == getattr(theirs, "dtype", None)
        np.testing.assert_array_equal(ours, theirs)


@pytest.mark.parametrize("mode", gymnasium.vector.AutoresetMode)
@pytest.mark.parametrize(
    ("name", "is_flat"), [(NAMES[0], False), ("physexp/sealed_box-features-v1", True), (PIXELS, False)]
)
def test_a_vector_environment_is_gymnasiums_own_of_single_ones(name, is_flat, mode, seed):
    ours = gymnasium.make_vec(name, num_envs=4, flat_observation=is_flat, autoreset_mode=mode)
    singles = [lambda: gymnasium.make(name, flat_observation=is_flat)] * 4
    theirs = gymnasium.vector.SyncVectorEnv(singles, autoreset_mode=mode)
    assert ours.observation_space == theirs.observation_space and ours.action_space == theirs.action_space
    assert ours.metadata == theirs.metadata | {"render_modes": ["rgb_array", "rgb_array_grid"]}
    seeds = [suite.environment_seed(seed, i) for i in range(4)]
    assert_same(ours.reset(seed=seed), theirs.reset(seed=seeds))
    generator, num_ended = np.random.default_rng(seed), 0
    for _ in range(30):
        actions = generator.integers(ours.single_action_space.n, size=4)
        stepped = ours.step(actions)
        assert_same(stepped, theirs.step(actions))
        assert stepped[0] in ours.observation_space
        ended = stepped[2] | stepped[3]
        num_ended += ended.sum()
        if mode is gymnasium.vector.AutoresetMode.DISABLED and ended.any():
            with pytest.raises(gymnasium.error.ResetNeeded, match="reset_mask"):
                ours.step(actions)
            assert_same(*(envs.reset(options={"reset_mask": ended}) for envs in (ours, theirs)))
    assert num_ended > 10
    assert_same(*(envs.reset(options={"episode": 2}) for envs in (ours, theirs)))
    ours.close()
    theirs.close()


@pytest.mark.parametrize("names", [("which_is_heavier", "features"), ("towers", "fist_features")])
def test_flat_observations_have_the_bounds_of_all_arrays(names):
    name = adapter.environment_id(*names)
    flat, apart = gymnasium.make(name, flat_observation=True), gymnasium.make(name)
    assert flat.reset()[0] in flat.observation_space and flat.step(0)[0] in flat.observation_space
    for side in ("low", "high"):
        bounds = [getattr(space, side).ravel() for space in apart.observation_space.values()]
        np.testing.assert_array_equal(getattr(flat.observation_space, side), np.concatenate(bounds))


@pytest.mark.parametrize("make", [gymnasium.make, gymnasium.make_vec])
def test_an_unknown_keyword_is_a_type_error_as_torchrl_expects(make):
    words = r"an unexpected keyword argument 'frameskip'; allowed: (num_envs, num_threads, )?render_mode, .*difficulty"
    with pytest.raises(TypeError, match=words):  # Which is how TorchRL finds out that nothing takes its own.
        make(NAMES[0], frameskip=1)


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
def test_a_bad_seed_or_option_of_a_reset_changes_nothing(make):
    environment = make("which_is_heavier", "features", random=5)
    for seed, options, message in (
        (2**63, None, r"^seed is .*; give an integer >= 0 and < 2\*\*63$"),
        ([1, 2], None, r"^seed is \[1, 2\]; give an integer"),
        (3, {"episodes": 1}, "^options has 'episodes'; allowed: episode(, reset_mask)?$"),
        (3, {"episode": -1}, "^episode is -1; give an integer"),
        (3, 5, r"^options is 5; give a dictionary with episode(, reset_mask)?, or None$"),
    ):
        with pytest.raises(ValueError, match=message):
            environment.reset(seed=seed, options=options)
    assert environment.reset()[1]["episode_index"] == 0 and environment.np_random_seed == 5


def test_a_bad_reset_mask_is_refused():
    environment = adapter.VectorEnvironment("which_is_heavier", "features", 2, random=5)
    part = np.array([True, False])
    with pytest.raises(gymnasium.error.ResetNeeded, match=r"reset\(\)"):
        environment.reset(options={"reset_mask": part})
    environment.reset()
    for mask in ([True], [1, 0], [False, False]):
        with pytest.raises(ValueError, match="^reset_mask is .*; give 2 booleans, one of them true"):
            environment.reset(options={"reset_mask": mask})
    with pytest.raises(ValueError, match="^seed is 3 beside a reset_mask"):
        environment.reset(seed=3, options={"reset_mask": part})


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: adapter.Environment("towers", "features"), "task_name is 'features'"),
        (lambda: adapter.Environment("towers", "fist_features", render_mode="human"), "render_mode is 'human'"),
        (lambda: adapter.VectorEnvironment("towers", "fist_features", 0), "num_envs is 0"),
        (lambda: adapter.VectorEnvironment("towers", "fist_features", 2.0), r"num_envs is 2\.0"),
        (lambda: adapter.VectorEnvironment("towers", "fist_features", 2, render_mode=3), "render_mode is 3"),
        (lambda: adapter.VectorEnvironment("towers", "fist_features", autoreset_mode="never"), "_mode is 'never'; cho"),
        (lambda: adapter.Environment("towers", "fist_features", flat_observation=2), "flat_observation is 2"),
        (lambda: adapter.VectorEnvironment("towers", "fist_features", max_episode_steps=25), "_steps is 25; .*>= 26"),
    ],
)
def test_a_bad_argument_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
