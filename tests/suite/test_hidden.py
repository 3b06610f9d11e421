"""Nothing tells of the hidden property before an interaction, and analysis may choose it: of every task."""

import itertools

from every_task import NAMES, every_task, load, load_batch
import numpy as np
import pytest

from physexp import suite


def _drawn(task, seed, count):
    """Hidden properties of some episodes."""
    return task.draw(np.full(count, seed), np.arange(count))


@every_task
def test_the_first_observation_is_the_same_whatever_is_hidden(seed, name):
    """Every reset of a batch in which all answers occur, and after episodes that were played."""
    rng = np.random.default_rng(seed)
    size = 32
    batch = load_batch(name, size, random=seed)
    firsts, answers = set(), set()
    for _ in range(3):
        observation = batch.reset().observation
        firsts |= {tuple(value[i].tobytes() for value in observation.values()) for i in range(size)}
        answers |= set(batch.correct_answers.tolist())
        for _ in range(2):
            batch.step(rng.integers(batch.task.num_interactions, size=size))
    assert len(firsts) == 1
    assert len(answers) > batch.task.num_labels / 2
    batch.close()


@every_task
def test_an_interaction_tells_something_of_what_is_hidden(seed, name):
    """Otherwise it would be no experiment: eight steps of one or two in turn, or all there are, do not look alike."""
    batch = load_batch(name, 32, random=seed)
    most = 0
    for pair in itertools.product(range(batch.task.num_interactions), repeat=2):
        batch.reset()
        for action in (4 * pair)[: batch.task.rules.step_limit - 1]:
            observation = batch.step(np.full(32, action)).observation
        most = max(most, len({tuple(value[i].tobytes() for value in observation.values()) for i in range(32)}))
        if most > 1:
            break
    assert most > 1
    batch.close()


@every_task
def test_an_episode_may_be_started_with_a_given_hidden_property(seed, name):
    batch, single = load_batch(name, 4, random=seed), load(name, random=seed)
    hidden = _drawn(batch.task, seed + 1, 4)
    batch.reset(hidden=hidden)
    np.testing.assert_array_equal(batch.hidden, hidden)
    np.testing.assert_array_equal(batch.correct_answers, batch.task.answers(hidden))
    actions = np.random.default_rng(seed).integers(batch.task.num_interactions, size=(5, 4))
    steps = [batch.step(taken) for taken in actions]
    for i in range(4):
        single.reset(hidden=hidden[i])
        assert single.task.correct_answer == batch.task.answers(hidden)[i]
        for taken, step in zip(actions, steps, strict=True):
            observation = single.step(int(taken[i])).observation
            for key, value in observation.items():
                assert value.tobytes() == step.observation[key][i].tobytes()
    single.reset()  # The next episode is drawn again.
    np.testing.assert_array_equal(single.task.hidden, single.task.draw(np.array([seed]), np.array([4]))[0])
    batch.close(), single.close()


@every_task
def test_a_hidden_property_that_no_episode_could_have_is_refused(seed, name):
    batch = load_batch(name, 2, random=seed)
    batch.reset()
    before, largest = batch.hidden, batch.task.largest_hidden
    assert (_drawn(batch.task, seed, 1000) <= largest).all()
    beyond = [np.full_like(before, value) for value in (-1, largest + 1) if np.isfinite(value)]
    if before.dtype.kind == "f":
        beyond += [np.full_like(before, value) for value in (np.nan, np.inf)]
    for hidden in beyond:
        with pytest.raises(ValueError, match="^hidden is .*; give "):
            batch.reset(hidden=hidden)
    np.testing.assert_array_equal(batch.hidden, before)
    batch.close()


@pytest.mark.parametrize("hidden", [[], np.zeros((7, 9)), None])
def test_a_hidden_property_of_another_shape_is_refused(hidden):
    batch = suite.load_batch("which_is_heavier", "features", 2, {"random": 0})
    if hidden is None:
        assert batch.reset(hidden=None).first().all()
        return
    with pytest.raises(ValueError, match=r"give an array of shape \(2, 4\)"):
        batch.reset(hidden=hidden)


@every_task
def test_what_a_replay_reveals_names_things_of_the_scene(seed, name):
    task = load(name, random=seed).task
    things = {entity.mjcf_model.model for entity in task.root_entity.iter_entities()}
    for hidden in _drawn(task, seed, 20):
        revealed = task.reveal(hidden)
        assert {*revealed.marks, *(thing for pair in (*revealed.joined, *revealed.tied) for thing in pair)} <= things
    revealed = [task.reveal(hidden) for hidden in _drawn(task, seed, 50)]
    assert any(one != revealed[0] for one in revealed), "it reveals nothing"


def test_the_tasks_that_are_tested_are_all_that_are_registered_and_more():
    assert {"/".join(names) for names in suite.ALL_TASKS} < set(NAMES)


@pytest.mark.parametrize("hidden", [3.7, -1, "3"])
def test_a_hidden_property_of_another_kind_is_refused_and_the_episode_stays(hidden):
    environment = suite.load("towers", "direct_features", {"random": 0})
    environment.reset()
    before = environment.task.hidden
    with pytest.raises(ValueError, match="hidden is .*; give "):
        environment.reset(hidden=hidden)
    assert environment.task.hidden == before and environment.task.episode == 0
    assert environment.reset().first() and environment.task.episode == 1


def test_a_refused_reset_of_a_batch_leaves_all_episodes_as_they_were():
    batch = suite.load_batch("which_is_heavier", "features", 2, {"random": 0})
    batch.reset()
    hidden = batch.hidden
    with pytest.raises(ValueError, match=r"give an array of shape \(2, 4\)"):
        batch.reset(episode=7, hidden=np.zeros(3))
    assert batch.episodes.tolist() == [0, 0]
    np.testing.assert_array_equal(batch.hidden, hidden)
    batch.reset()
    assert batch.episodes.tolist() == [1, 1]


def test_a_hidden_property_that_was_given_to_the_task_is_that_of_the_next_episode_alone():
    environment = suite.load("towers", "direct_features", {"random": 0})
    for pattern in (5, 3):
        environment.task.give_hidden(pattern)
        environment.reset()
        assert environment.task.hidden == pattern
    environment.reset()
    assert environment.task.hidden == environment.task.draw(np.array([0]), np.array([2]))[0]
