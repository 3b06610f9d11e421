"""A task that reveals its answer: the same to the bit, with the right answer beside what else is observed."""

from every_task import every_feature_task, load, load_batch, load_task
import numpy as np
import pytest

from physexp import suite
from physexp.analysis import domains

SIZE = 6
every_revealing_task = pytest.mark.parametrize("domain, task", [("towers", "fist_features"), ("strike", "features")])


def _played(name, seed, **task_kwargs):
    """Time steps of a batch under drawn actions, over the ends of episodes; and the right answers at each of them."""
    batch = load_batch(name, SIZE, random=seed, **task_kwargs)
    timesteps, answers = [batch.reset()], [batch.correct_answers]
    actions = np.random.default_rng(seed).integers(batch.task.rules.num_actions, size=(12, SIZE))
    for taken in actions:
        timesteps.append(batch.step(taken))
        answers.append(batch.correct_answers)
    batch.close()
    return timesteps, answers


@every_feature_task
def test_the_answer_is_observed_and_all_else_is_the_same(name, seed):
    (plain, answers), (revealing, same) = _played(name, seed), _played(name, seed, reveal=True)
    np.testing.assert_array_equal(answers, same)
    num_labels = load_task(name).num_labels
    for before, after, right in zip(plain, revealing, answers, strict=True):
        answer = dict(after.observation).pop("answer")
        assert answer.dtype == np.float32 and answer.shape == (SIZE, num_labels)
        np.testing.assert_array_equal(answer, right[:, None] == np.arange(num_labels))
        assert set(after.observation) == {*before.observation, "answer"}
        for key, value in before.observation.items():
            assert value.tobytes() == after.observation[key].tobytes()
        for field in ("step_type", "reward", "discount"):
            np.testing.assert_array_equal(getattr(before, field), getattr(after, field))


@every_feature_task
def test_the_specs_have_the_answer_and_its_bounds(name):
    plain, revealing = (load(name, reveal=reveal).observation_spec() for reveal in (False, True))
    answer = dict(revealing)["answer"]
    assert (answer.shape, answer.dtype) == ((load_task(name).num_labels,), np.float32)
    assert (answer.minimum, answer.maximum) == (0, 1)
    assert {key: spec for key, spec in revealing.items() if key != "answer"} == dict(plain)


@every_revealing_task
def test_its_ideal_experimenter_answers_at_once_and_is_never_wrong(domain, task, seed):
    solution = domains.find(domain).ideal(task, {"reveal": True}, 0.9)
    figures = solution.summary()
    assert solution.value == solution.bound == figures["value"] == figures["accuracy"] == 1
    assert figures["mean_interactions"] == 0 and figures["histogram"] == {0: 1.0}
    environment, actor = suite.load(domain, task, {"random": seed, "reveal": True}), solution.actor()
    for _ in range(3):
        first = environment.reset()
        actor.observe_first(first)
        last = environment.step(actor.select_action(first.observation))
        assert last.last() and last.reward == 1


@every_revealing_task
def test_a_wasted_interaction_costs_a_step_s_discount_and_silence_all(domain, task, seed):
    discount = 0.9
    played = suite.load_task(domain, task, {"random": seed})
    (hidden,) = played.draw(np.array([seed]), np.array([0]))
    right = int(played.answers(hidden[None])[0])
    solution = domains.find(domain).ideal(task, {"reveal": True}, discount)
    limit, num_interactions = played.rules.step_limit, played.num_interactions
    judged = solution.judge(hidden, np.zeros(limit, int))
    known = np.eye(played.num_labels)[right]
    np.testing.assert_array_equal(judged.beliefs, np.repeat(known[None], limit + 1, axis=0))
    assert (judged.values[:-1, :num_interactions] == discount).all()
    assert (judged.values[-1, :num_interactions] == -1).all(), "out of time is a wrong answer"
    np.testing.assert_array_equal(judged.values[:, num_interactions:], np.repeat(2 * known[None] - 1, limit, axis=0))
    assert not judged.is_informative.any()
    # Each step but the last costs V - Q = 1 - discount, and the last one 2; in all, the value minus the return.
    costs = judged.values.max(axis=1) - judged.values[:, 0]
    factors = discount ** np.arange(limit)
    assert factors @ costs == pytest.approx(1 + factors[-1])
