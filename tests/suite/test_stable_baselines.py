"""Our batches under Stable-Baselines3: its conventions, and a learner of sb3-contrib that learns on them."""

import numpy as np
import pytest

from physexp import suite
from physexp.suite import stable_baselines
from physexp.suite.engine import snapshots


def test_an_episode_that_ends_is_followed_by_the_next_in_the_same_step(seed):
    vector = stable_baselines.VecEnv("which_is_heavier", "features", 5, random=seed)
    batch = suite.load_batch("which_is_heavier", "features", 5, {"random": seed})
    observation = vector.reset()
    np.testing.assert_array_equal(observation["heights"], batch.reset().observation["heights"])
    generator = np.random.default_rng(seed)
    for _ in range(40):
        actions, answers = generator.integers(8, size=5), batch.correct_answers
        expected = batch.step(actions)
        observation, rewards, dones, infos = vector.step(actions)
        np.testing.assert_array_equal(rewards, expected.reward)
        np.testing.assert_array_equal(dones, expected.last())
        for row in range(5):
            if dones[row]:
                np.testing.assert_array_equal(
                    infos[row]["terminal_observation"]["heights"], expected.observation["heights"][row]
                )
                assert infos[row]["correct_answer"] == answers[row]
                assert infos[row]["is_success"] is bool(expected.reward[row] > 0)
                assert infos[row]["discounted_return"] == pytest.approx(
                    expected.reward[row] * 0.95 ** (batch.steps[row] - 1)
                )
                assert not observation["heights"][row].any()  # Every block is at rest again.
            else:
                assert infos[row] == {}
                np.testing.assert_array_equal(observation["heights"][row], expected.observation["heights"][row])
        if dones.any():
            batch.reset(np.flatnonzero(dones))


def test_the_seeds_that_are_told_rebuild_the_episodes(seed):
    vector = stable_baselines.VecEnv("which_is_heavier", "features", 3)
    told = vector.seed(seed)
    vector.set_options({"episode": 4})
    vector.reset()
    vector.step(np.array([0, 4, 0]))  # The second one answers, and goes on with episode 5.
    assert vector.reset_infos == [
        {"seed": told[row], "episode_index": episode} for row, episode in enumerate([4, 5, 4])
    ]
    for row, info in enumerate(vector.reset_infos):
        again = suite.load("which_is_heavier", "features", {"random": info["seed"]})
        again.task.next_episode = info["episode_index"]
        again.reset()
        np.testing.assert_array_equal(again.task.hidden, vector.batch.hidden[row])
    vector.reset()
    assert [info["episode_index"] for info in vector.reset_infos] == [5, 6, 5]


def test_keywords_and_options_that_there_are_not_are_refused():
    with pytest.raises(TypeError, match="got an unexpected keyword argument 'frameskip'; allowed: num_envs, "):
        stable_baselines.VecEnv("threshold", "features", 2, frameskip=1)
    vector = stable_baselines.VecEnv("threshold", "features", 2)
    vector.set_options({"episodes": 1})
    with pytest.raises(ValueError, match="^options has 'episodes'; allowed: episode"):
        vector.reset()
    vector.set_options([{"episode": 1}, {"episode": 2}])
    with pytest.raises(ValueError, match="^options differ between environments; give all the same$"):
        vector.reset()


def test_an_episode_whose_simulation_diverges_is_truncated_and_no_other_is(caplog):
    vector = stable_baselines.VecEnv("which_is_heavier", "features", 3, random=0)
    vector.reset()
    snapshots.view(vector.batch, "qvel", 1)[0] = np.nan
    _, rewards, dones, infos = vector.step(np.array([0, 0, 4 + (vector.batch.correct_answers[2] + 1) % 4]))
    assert dones.tolist() == [False, True, True] and rewards.tolist() == [0, 0, -1]
    assert infos[1]["TimeLimit.truncated"] is True and infos[2]["TimeLimit.truncated"] is False
    vector.close()


def test_rendering_lays_the_images_of_all_environments_side_by_side(seed):
    vector = stable_baselines.VecEnv("which_is_heavier", "features", 3, random=seed, render_mode="rgb_array")
    vector.reset()
    vector.step(np.arange(3))
    assert len(vector.get_images()) == 3 and vector.metadata["render_fps"] == 10
    np.testing.assert_array_equal(vector.render()[:480, 480:], vector.batch.render()[1])  # Two by two of 480 pixels.
    vector.close()
