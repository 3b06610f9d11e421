"""Nothing tells of the hidden property before an interaction, and analysis may choose it: of every task."""

from every_task import NAMES, every_feature_task, every_task, load, load_batch
import numpy as np
import pytest

from physexp import suite


def _drawn(task, seed, count):
    """Hidden properties of some episodes."""
    return task.draw(np.full(count, seed), np.arange(count))


@every_task
def test_first_observations_are_the_same_whatever_is_hidden(seed, name):
    """Every reset of a batch in which all answers occur, and after episodes that were played."""
    rng, size = np.random.default_rng(seed), 32
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


@every_feature_task
def test_a_hidden_property_that_no_episode_could_have_is_refused(seed, name):
    batch, single = load_batch(name, 2, random=seed), load(name, random=seed)
    batch.reset(), single.reset()
    before, largest, of_single = batch.hidden, batch.task.largest_hidden, single.task.hidden
    assert (_drawn(batch.task, seed, 1000) <= largest).all()
    beyond = [np.full_like(before, value) for value in (-1, largest + 1) if np.isfinite(value)]
    beyond += [np.zeros((7, 9)), np.full(before.shape, "3")]
    if before.dtype.kind == "f":
        beyond += [np.full_like(before, value) for value in (np.nan, np.inf)]
    for hidden in beyond:
        with pytest.raises(ValueError, match="^hidden is .*; give "):
            batch.reset(hidden=hidden, episode=7)
        with pytest.raises(ValueError, match="^hidden is .*; give "):
            single.reset(hidden=hidden[0])
    np.testing.assert_array_equal(batch.hidden, before)
    np.testing.assert_array_equal(single.task.hidden, of_single)
    assert batch.episodes.tolist() == [0, 0] and single.task.episode == 0
    batch.close()


@every_feature_task
def test_a_replay_reveals_things_of_the_scene(seed, name):
    task = load(name, random=seed).task
    things = {entity.mjcf_model.model for entity in task.root_entity.iter_entities()}
    revealed = [task.reveal(hidden) for hidden in _drawn(task, seed, 50)]
    for each in revealed:
        assert {*each.marks, *(thing for pair in (*each.joined, *each.tied) for thing in pair)} <= things
    assert any(one != revealed[0] for one in revealed), "it reveals nothing"


def test_all_registered_tasks_are_tested_and_have_features_and_pixels():
    assert {"/".join(names) for names in suite.ALL_TASKS} < set(NAMES)
    kinds = {
        kind: {(domain, suite.tags(domain, task) - {kind}) for domain, task in suite.tagged(kind)}
        for kind in ("features", "pixels")
    }
    assert kinds["features"] == kinds["pixels"]
    assert len(suite.tagged("features")) + len(suite.tagged("pixels")) == len(suite.ALL_TASKS)
