"""A batch is its single environments, bit for bit, however many there are and whatever steps them."""

import dm_env
from episodes import random_actions
from every_task import FEATURES, NAMES, NOISY, VARYING, every_feature_task, load, load_batch
import numpy as np
import pytest

from physexp import suite
from physexp.suite.domains import towers

STEPS = 100  # Control steps to compare: some episodes of every task.


def _load_both(name, seed, size, num_threads=1, **task_kwargs):
    batch = load_batch(name, size, num_threads, random=seed, **task_kwargs)
    singles = [load(name, random=suite.environment_seed(seed, i), **task_kwargs) for i in range(size)]
    return batch, singles


def _assert_same(steps: dm_env.TimeStep, singles: list[dm_env.TimeStep]) -> None:
    """Row `i` of a batch's time step is the i-th single time step; on a first step a batch has 0 for None, and 1."""
    for i, single in enumerate(singles):
        assert steps.step_type[i] == single.step_type
        reward, discount = (0.0, 1.0) if single.first() else (single.reward, single.discount)
        assert (steps.reward[i], steps.discount[i]) == (reward, discount)
        assert set(steps.observation) == set(single.observation)
        for name, value in single.observation.items():
            row = steps.observation[name][i]
            assert (row.dtype, row.shape) == (value.dtype, value.shape)
            assert row.tobytes() == value.tobytes(), (name, row, value)


def _assert_same_questions(batch, singles) -> None:
    assert [single.task.correct_answer for single in singles] == batch.correct_answers.tolist()
    assert [single.task.episode for single in singles] == batch.episodes.tolist()
    for hidden, single in zip(batch.hidden, singles, strict=True):
        np.testing.assert_array_equal(hidden, single.task.hidden)


@every_feature_task
def test_a_batch_is_its_single_environments(seed, name):
    rng, size = np.random.default_rng(seed), 3
    batch, singles = _load_both(name, seed, size, num_threads=2)
    _assert_same(batch.reset(), [single.reset() for single in singles])
    for _ in range(STEPS):
        _assert_same_questions(batch, singles)
        actions = random_actions(rng, batch.task, size)
        _assert_same(batch.step(actions), [single.step(a) for single, a in zip(singles, actions, strict=True)])


@every_feature_task
def test_chosen_environments_step_and_reset_without_the_others(seed, name):
    """Some step, some are reset in the middle of an episode, some wait: each is its single environment still."""
    rng = np.random.default_rng(seed)
    size = 3
    batch, singles = _load_both(name, seed, size)
    _assert_same(batch.reset(), [single.reset() for single in singles])
    for _ in range(STEPS // 2):
        chosen = np.flatnonzero(rng.random(size) < 0.6)
        actions = random_actions(rng, batch.task, len(chosen))
        expected = [singles[i].step(a) for i, a in zip(chosen, actions, strict=True)]
        _assert_same(batch.step(actions, environments=chosen), expected)
        if rng.random() < 0.1:
            chosen = np.flatnonzero(rng.random(size) < 0.5)
            expected = [singles[i].reset() for i in chosen]
            _assert_same(batch.reset(environments=chosen), expected)
        _assert_same_questions(batch, singles)


@every_feature_task
def test_a_reset_rebuilds_a_chosen_episode(seed, name):
    rng = np.random.default_rng(seed)
    batch, singles = _load_both(name, seed, 3)
    batch.reset()
    for episode, chosen in ((7, [0, 1, 2]), (2, [1]), (2, [0, 2]), (0, [0, 1])):
        for i in chosen:
            singles[i].task.next_episode = episode
        expected = [singles[i].reset() for i in chosen]
        _assert_same(batch.reset(environments=np.array(chosen), episode=episode), expected)
        assert batch.episodes[chosen].tolist() == [episode] * len(chosen)
        for _ in range(4):
            actions = rng.integers(batch.task.num_interactions, size=len(chosen))
            expected = [singles[i].step(a) for i, a in zip(chosen, actions, strict=True)]
            _assert_same(batch.step(actions, environments=np.array(chosen)), expected)


@pytest.mark.parametrize(
    "name, option",
    [
        *((name, {"noise": 0.01}) for name in NOISY),
        *((name, {"variation": 1.0}) for name in VARYING),
        *((name, {"control_timestep": 0.2, "step_variation": 0.5}) for name in FEATURES),
    ],
)
def test_what_varies_is_the_same_in_a_batch_and_alone(seed, name, option):
    rng = np.random.default_rng(seed)
    batch, singles = _load_both(name, seed, 3, **option)
    for _ in range(3):  # Episodes.
        _assert_same(batch.reset(), [single.reset() for single in singles])
        for _ in range(4):
            actions = rng.integers(batch.task.num_interactions, size=3)
            _assert_same(batch.step(actions), [single.step(a) for single, a in zip(singles, actions, strict=True)])


@pytest.mark.parametrize("task_name", ["direct_features", "fist_features"])
def test_with_fine_control_steps_a_batch_is_still_the_environments_one_by_one(seed, task_name):
    rng = np.random.default_rng(seed)
    batch, singles = _load_both(f"towers/{task_name}", seed, 3, control_timestep=0.01)
    _assert_same(batch.reset(), [single.reset() for single in singles])
    for t in range(80):
        if t % 25 == 0:
            actions = rng.integers(batch.task.num_interactions, size=3)
            actions[0] = 0  # The fist hits the tower.
        _assert_same(batch.step(actions), [single.step(a) for single, a in zip(singles, actions, strict=True)])


@every_feature_task
def test_an_environment_does_not_depend_on_how_many_there_are(seed, name):
    """Batches of 1, 3 and 6 environments, on 1 and 2 threads; the first environments take the same actions."""
    rng = np.random.default_rng(seed)
    shapes = [(1, 1), (3, 2), (6, 1), (6, 2)]
    batches = [load_batch(name, size, num_threads, random=seed) for size, num_threads in shapes]
    steps = [batch.reset() for batch in batches]
    for _ in range(20):
        actions = random_actions(rng, batches[0].task, 6)
        steps = [batch.step(actions[: batch.num_environments]) for batch in batches]
        largest = steps[-1]
        for step in steps[:-1]:
            size = len(step.reward)
            for field in ("step_type", "reward", "discount"):
                np.testing.assert_array_equal(getattr(step, field), getattr(largest, field)[:size])
            for name, value in step.observation.items():
                assert value.tobytes() == largest.observation[name][:size].tobytes()


@every_feature_task
def test_the_specs_are_those_of_the_single_environment(name):
    single = load(name, random=0)
    batch = load_batch(name, 2, random=0)
    assert batch.action_spec() == single.action_spec()
    assert batch.reward_spec() == single.reward_spec()
    assert batch.discount_spec() == single.discount_spec()
    assert dict(batch.observation_spec()) == dict(single.observation_spec())


@every_feature_task
def test_a_time_step_has_arrays_with_a_leading_axis(name):
    batch = load_batch(name, 3, random=0)
    for step in (batch.reset(), batch.step(np.zeros(3, np.int32))):
        assert isinstance(step, dm_env.TimeStep)
        assert step.step_type.shape == step.reward.shape == step.discount.shape == (3,)
        for name, spec in batch.observation_spec().items():
            for row in step.observation[name]:
                spec.validate(row)


@every_feature_task
def test_what_a_batch_returns_is_the_callers_own(name):
    """Writing into returned arrays changes nothing, and later steps do not write into them."""
    batch, twin = (load_batch(name, 2, random=0) for _ in range(2))
    for returned in (batch.reset(), batch.step(np.zeros(2, int))):
        for value in (*returned.observation.values(), returned.reward, returned.discount, returned.step_type):
            value[:] = 77
    for own in (batch.hidden, batch.correct_answers, batch.episodes):
        own[:] = 77
    twin.reset()
    twin.step(np.zeros(2, int))
    step, expected = batch.step(np.ones(2, int)), twin.step(np.ones(2, int))
    kept = {name: value.copy() for name, value in step.observation.items()}
    batch.step(np.ones(2, int))
    for name, value in expected.observation.items():
        np.testing.assert_array_equal(step.observation[name], value)
        np.testing.assert_array_equal(step.observation[name], kept[name])
    np.testing.assert_array_equal(batch.episodes, [0, 0])


def test_environments_of_a_batch_play_different_episodes(seed):
    batch = suite.load_batch("which_is_heavier", "features", 50, {"random": seed})
    batch.reset()
    first = batch.hidden
    batch.reset()
    assert len(np.unique(np.concatenate([first, batch.hidden]), axis=0)) == 100


def test_choosing_no_environment_does_nothing(seed):
    batch = suite.load_batch("towers", "fist_features", 2, {"random": seed})
    batch.reset()
    nobody = np.array([], int)
    for step in (batch.step(nobody, environments=nobody), batch.reset(environments=nobody)):
        assert step.reward.shape == (0,)
        assert step.observation["positions"].shape == (0, 5, 3)
    np.testing.assert_array_equal(batch.episodes, [0, 0])


def test_two_batches_in_one_process_share_nothing(seed):
    """They share the compiled models; masses and states are each one's own."""
    one, alone = (suite.load_batch("which_is_heavier", "features", 4, {"random": seed}) for _ in range(2))
    one.reset()
    alone.reset()
    other = suite.load_batch("which_is_heavier", "features", 4, {"random": seed + 1})
    other.reset()
    for poke in range(4):
        other.step(np.full(4, 3 - poke))
        step, expected = one.step(np.full(4, poke)), alone.step(np.full(4, poke))
        np.testing.assert_array_equal(step.observation["heights"], expected.observation["heights"])


def test_every_pattern_of_glue_is_played_alike_in_a_batch_and_alone(seed):
    """At the first episode with each pattern, two pushes."""
    batch, (single,) = _load_both("towers/direct_features", seed, 1)
    patterns = towers.draw_patterns(np.full(1000, single.task.options.random), np.arange(1000))
    for pattern in range(16):
        single.task.next_episode = int(np.flatnonzero(patterns == pattern)[0])
        _assert_same(batch.reset(episode=single.task.next_episode), [single.reset()])
        assert batch.hidden == [pattern]
        for action in (4, 14):
            _assert_same(batch.step(np.array([action])), [single.step(action)])


@every_feature_task
def test_saved_episodes_go_on_from_there_in_several_ways(seed, name):
    """What follows is, to the bit, what follows in environments that have played the same actions in one go."""
    rng = np.random.default_rng(seed)
    batch, singles = _load_both(name, seed, 3)
    batch.reset()
    begun = rng.integers(batch.task.num_interactions, size=(2, 3))
    for actions in begun:
        batch.step(actions)
    chosen = np.array([0, 2])
    moment = batch.save(chosen)
    for _ in range(3):
        batch.restore(moment)
        for i in chosen:
            singles[i].task.next_episode = 0
            singles[i].reset()
            for actions in begun:
                singles[i].step(actions[i])
        for _ in range(2):
            actions = random_actions(rng, batch.task, 2)
            expected = [singles[i].step(a) for i, a in zip(chosen, actions, strict=True)]
            _assert_same(batch.step(actions, environments=chosen), expected)
            if any(step.last() for step in expected):
                break


def test_what_cannot_be_saved_or_restored_is_refused():
    batch = load_batch("which_is_heavier/features", 2, random=0)
    with pytest.raises(RuntimeError, match="an episode is over"):
        batch.save()
    batch.reset()
    moment = batch.save()
    batch.step(np.array([4, 0]))
    with pytest.raises(RuntimeError, match="an episode is over"):
        batch.save()
    batch.reset()
    with pytest.raises(ValueError, match="other episodes"):
        batch.restore(moment)
    # Nor is another instance of the same episode.
    batch.reset(episode=0)
    batch.restore(moment)
    batch.reset(episode=0, hidden=batch.hidden[::-1].copy())
    with pytest.raises(ValueError, match="other episodes"):
        batch.restore(moment)
    batch.reseed(5)
    batch.reset()
    with pytest.raises(ValueError, match="other episodes"):
        batch.restore(moment)


def test_an_episode_that_differs_in_what_is_not_asked_is_another_one():
    batch = load_batch("towers/direct_features", 2, random=0, variation=1.0)
    batch.reset()
    moment, hidden = batch.save(), batch.hidden
    batch.restore(moment)
    batch.reset(episode=0, hidden=hidden, nuisances=np.zeros((2, batch.task.num_nuisances)))
    with pytest.raises(ValueError, match="other episodes"):
        batch.restore(moment)


def test_a_batch_has_no_floor_to_colour():
    with pytest.raises(ValueError, match="^visualize_reward is True; give False to a batch, or load one environment$"):
        suite.load_batch("which_is_heavier", "features", 2, {"visualize_reward": True})


def test_a_view_is_of_an_environment_that_is_there():
    batch = load_batch("which_is_heavier/features", 2, random=0)
    batch.reset()
    assert batch.view("qpos", 1).shape == batch.view("qpos", 0).shape
    for index in (-1, 2, 0.5):
        with pytest.raises(ValueError, match=f"environment is {index}; give an integer >= 0 and <= 1"):
            batch.view("qpos", index)
    batch.close()
    with pytest.raises(RuntimeError, match="the batch is closed"):
        batch.view("qpos", 0)


@pytest.mark.parametrize("name, variation", [*((name, 0.0) for name in NAMES), *((name, 1.0) for name in VARYING)])
def test_a_batch_draws_for_people_what_its_single_environments_draw(seed, name, variation):
    """After resets, steps, an answer, and a step back to where an episode was saved."""
    rng = np.random.default_rng(seed)
    batch, singles = _load_both(name, seed, 4, variation=variation)
    num_interactions = batch.task.num_interactions

    def draw():
        images = batch.render()
        np.testing.assert_array_equal(images, [single.render() for single in singles])
        return images

    batch.reset()
    for single in singles:
        single.reset()
    drawn = [draw()]
    moments = [batch.save()]
    for actions in np.arange(8).reshape(2, 4) % num_interactions:  # Each environment takes others.
        batch.step(actions)
        for single, action in zip(singles, actions, strict=True):
            single.step(action)
        drawn.append(draw())
        moments.append(batch.save())
    assert all((drawn[0] != images).any(axis=(1, 2, 3)).any() for images in drawn[1:])
    actions = rng.integers(num_interactions, size=4)
    actions[0] = num_interactions
    batch.step(actions)
    for single, action in zip(singles, actions, strict=True):
        single.step(action)
    draw()
    for moment, images in zip(moments, drawn, strict=True):
        batch.restore(moment)
        np.testing.assert_array_equal(batch.render(), images)
    batch.close()
    for single in singles:
        single.close()


@pytest.mark.parametrize("size", [0, -1, 4097, 2.5, "x", None])
def test_images_of_a_size_that_cannot_be_drawn_are_refused(size):
    batch = load_batch("which_is_heavier/features", 1)
    batch.reset()
    with pytest.raises(ValueError, match="size is .*; give an integer >= 1 and <= 4096"):
        batch.render(size)
