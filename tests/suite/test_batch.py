"""A batch is its single environments, bit for bit, however many there are and whatever steps them."""

import dm_env
from episodes import assert_same, random_actions
from every_task import FEATURES, NOISY, VARYING, every_feature_task, load, load_batch
import numpy as np
import pytest

from physexp import suite
from physexp.suite.engine import snapshots

# One compiled model and many, contacts, and geoms that indicate readings: all that drawing knows.
PIXELS = ["which_is_heavier/pixels", "towers/fist_pixels", "sealed_box/pixels"]
STEPS = 60  # Control steps to compare: some episodes of every task.


def _load_both(name, seed, size, num_threads=1, **task_kwargs):
    batch = load_batch(name, size, num_threads, random=seed, **task_kwargs)
    singles = [load(name, random=suite.environment_seed(seed, i), **task_kwargs) for i in range(size)]
    return batch, singles


def _assert_same_questions(batch, singles) -> None:
    assert [single.task.correct_answer for single in singles] == batch.correct_answers.tolist()
    assert [single.task.episode for single in singles] == batch.episodes.tolist()
    for hidden, single in zip(batch.hidden, singles, strict=True):
        np.testing.assert_array_equal(hidden, single.task.hidden)


@pytest.mark.parametrize("name", [*FEATURES, *PIXELS])
def test_a_batch_is_its_single_environments(seed, name):
    """All step, one until its time is out; then some step, some are reset in an episode's middle, and some wait."""
    rng, size = np.random.default_rng(seed), 3
    batch, singles = _load_both(name, seed, size, num_threads=2, time_limit=2.0)
    assert batch.action_spec() == singles[0].action_spec()
    assert batch.reward_spec() == singles[0].reward_spec() and batch.discount_spec() == singles[0].discount_spec()
    assert dict(batch.observation_spec()) == dict(singles[0].observation_spec())
    assert_same(batch.reset(), [single.reset() for single in singles])
    for step in range(STEPS):
        _assert_same_questions(batch, singles)
        actions = random_actions(rng, batch.task, size)
        if step < batch.task.rules.step_limit:
            actions[0] %= batch.task.num_interactions
        assert_same(batch.step(actions), [single.step(a) for single, a in zip(singles, actions, strict=True)])
    for _ in range(STEPS // 2):
        chosen = np.flatnonzero(rng.random(size) < 0.6)
        actions = random_actions(rng, batch.task, len(chosen))
        expected = [singles[i].step(a) for i, a in zip(chosen, actions, strict=True)]
        assert_same(batch.step(actions, environments=chosen), expected)
        if rng.random() < 0.1:
            chosen = np.flatnonzero(rng.random(size) < 0.5)
            expected = [singles[i].reset() for i in chosen]
            assert_same(batch.reset(environments=chosen), expected)
        _assert_same_questions(batch, singles)
    for each in (batch, *singles):
        each.close()


@every_feature_task
def test_a_reset_rebuilds_a_chosen_episode(seed, name):
    rng = np.random.default_rng(seed)
    batch, singles = _load_both(name, seed, 3)
    batch.reset()
    for episode, chosen in ((7, [0, 1, 2]), (2, [1]), (2, [0, 2]), (0, [0, 1])):
        for i in chosen:
            singles[i].task.next_episode = episode
        expected = [singles[i].reset() for i in chosen]
        assert_same(batch.reset(environments=np.array(chosen), episode=episode), expected)
        assert batch.episodes[chosen].tolist() == [episode] * len(chosen)
        for _ in range(4):
            actions = rng.integers(batch.task.num_interactions, size=len(chosen))
            expected = [singles[i].step(a) for i, a in zip(chosen, actions, strict=True)]
            assert_same(batch.step(actions, environments=np.array(chosen)), expected)


@pytest.mark.parametrize(
    "name, option",
    [
        *((name, {"noise": 0.01}) for name in NOISY),
        *((name, {"variation": 1.0}) for name in VARYING if name in FEATURES or "heavier" in name),
        *((name, {"control_timestep": 0.2, "step_variation": 0.5}) for name in (NOISY[0], "towers/fist_features")),
        ("towers/direct_features", {"control_timestep": 0.01}),
        ("towers/fist_features", {"control_timestep": 0.01}),
    ],
)
def test_variation_and_noise_are_the_same_in_a_batch_and_alone(seed, name, option):
    rng = np.random.default_rng(seed)
    batch, singles = _load_both(name, seed, 3, **option)
    for _ in range(3):  # Episodes.
        assert_same(batch.reset(), [single.reset() for single in singles])
        for _ in range(min(20, batch.task.rules.step_limit - 1)):
            actions = rng.integers(batch.task.num_interactions, size=3)
            actions[0] = 0  # The fist hits the tower.
            assert_same(batch.step(actions), [single.step(a) for single, a in zip(singles, actions, strict=True)])


@every_feature_task
def test_returned_arrays_are_the_callers_own(name):
    """Writing into returned arrays changes nothing, and later steps do not write into them."""
    batch, twin = (load_batch(name, 2, random=0) for _ in range(2))
    for returned in (batch.reset(), batch.step(np.zeros(2, int))):
        assert isinstance(returned, dm_env.TimeStep)
        for key, spec in batch.observation_spec().items():
            for row in returned.observation[key]:
                spec.validate(row)
        for value in (*returned.observation.values(), returned.reward, returned.discount, returned.step_type):
            assert len(value) == 2
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


def test_every_pattern_of_glue_is_played_alike_in_a_batch_and_alone(seed):
    """At the first episode with each pattern, two pushes."""
    batch, (single,) = _load_both("towers/direct_features", seed, 1)
    patterns = single.task.draw(np.full(1000, single.task.options.random), np.arange(1000))
    for pattern in range(16):
        single.task.next_episode = int(np.flatnonzero(patterns == pattern)[0])
        assert_same(batch.reset(episode=single.task.next_episode), [single.reset()])
        assert batch.hidden == [pattern]
        for action in (4, 14):
            assert_same(batch.step(np.array([action])), [single.step(action)])


@every_feature_task
def test_episodes_go_on_from_a_snapshot_in_several_ways(seed, name):
    """They equal, to the bit, environments that have played the same actions in one go."""
    rng = np.random.default_rng(seed)
    batch, singles = _load_both(name, seed, 3)
    batch.reset()
    begun = rng.integers(batch.task.num_interactions, size=(2, 3))
    for actions in begun:
        batch.step(actions)
    chosen = np.array([0, 2])
    snapshot = snapshots.take(batch, chosen)
    for _ in range(3):
        snapshots.restore(batch, snapshot)
        for i in chosen:
            singles[i].task.next_episode = 0
            singles[i].reset()
            for actions in begun:
                singles[i].step(actions[i])
        for _ in range(2):
            actions = random_actions(rng, batch.task, 2)
            expected = [singles[i].step(a) for i, a in zip(chosen, actions, strict=True)]
            assert_same(batch.step(actions, environments=chosen), expected)
            if any(step.last() for step in expected):
                break


def test_a_snapshot_of_another_episode_is_refused():
    batch = load_batch("towers/direct_features", 2, random=0, variation=1.0)
    label = batch.task.num_interactions
    with pytest.raises(RuntimeError, match="an episode is over"):
        snapshots.take(batch)
    batch.reset()
    snapshot, hidden = snapshots.take(batch), batch.hidden
    batch.step(np.array([label, 0]))
    with pytest.raises(RuntimeError, match="an episode is over"):
        snapshots.take(batch)

    def starts_over(**differently):
        batch.reset(**{"episode": 0, **differently})
        with pytest.raises(ValueError, match="other episodes"):
            snapshots.restore(batch, snapshot)

    starts_over(episode=1)
    starts_over(hidden=(hidden + 1) % 16)
    starts_over(hidden=hidden, nuisances=np.zeros((2, batch.task.num_nuisances)))
    batch.reset(episode=0)
    snapshots.restore(batch, snapshot)
    batch.reseed(5)
    starts_over()


@pytest.mark.parametrize(
    "name, variation", [("which_is_heavier/features", 1.0), ("towers/fist_features", 1.0), ("sealed_box/features", 0.0)]
)
def test_a_batch_draws_for_people_the_images_of_its_environments(seed, name, variation):
    """After resets, steps, an answer, and a step back to a snapshot."""
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
    drawn, taken = [draw()], [snapshots.take(batch)]
    for actions in np.arange(8).reshape(2, 4) % num_interactions:  # Each environment takes others.
        batch.step(actions)
        for single, action in zip(singles, actions, strict=True):
            single.step(action)
        drawn.append(draw())
        taken.append(snapshots.take(batch))
    assert all((drawn[0] != images).any(axis=(1, 2, 3)).any() for images in drawn[1:])
    actions = rng.integers(num_interactions, size=4)
    actions[0] = num_interactions
    batch.step(actions)
    for single, action in zip(singles, actions, strict=True):
        single.step(action)
    draw()
    for snapshot, images in zip(taken, drawn, strict=True):
        snapshots.restore(batch, snapshot)
        np.testing.assert_array_equal(batch.render(), images)
    for size in (0, 4097, 2.5, None):
        with pytest.raises(ValueError, match="size is .*; give an integer >= 1 and <= 4096"):
            batch.render(size)
    batch.close()
    for single in singles:
        single.close()
