"""The numbers of the paper's tasks, which users' code is written against, through the public interface alone.

Batches, seeds, refused input and leaks are tested for every task in `tests/suite`.
"""

import chance
import dm_env
import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite

# Domain and task, interactions, labels, control steps until an unanswered episode ends.
TASKS = [
    ("which_is_heavier", "features", 4, 4, 100),
    ("which_is_heavier", "pixels", 4, 4, 100),
    ("towers", "direct_features", 20, 5, 26),
    ("towers", "direct_pixels", 20, 5, 26),
    ("towers", "fist_features", 4, 5, 26),
    ("towers", "fist_pixels", 4, 5, 26),
]


@pytest.fixture(params=TASKS, ids=lambda task: "/".join(task[:2]))
def task(request):
    return request.param


def test_actions_rewards_and_limits_are_those_of_the_paper(task):
    domain, name, num_interactions, num_labels, step_limit = task
    assert (domain, name) in suite.ALL_TASKS and name in suite.TASKS_BY_DOMAIN[domain]
    environment = suite.load(domain, name, task_kwargs={"random": fresh_seed()})
    assert isinstance(environment, dm_env.Environment)
    assert environment.action_spec().num_values == num_interactions + num_labels
    assert (environment.task.num_interactions, environment.task.num_labels) == (num_interactions, num_labels)
    for label in range(num_labels):  # The environment starts an episode where one is over.
        environment.reset()
        reward = 1 if label == environment.task.correct_answer else -1
        answered = environment.step(num_interactions + label)
        assert (answered.last(), answered.reward, answered.discount) == (True, reward, 0)
    assert environment.step(0).first()
    steps = [environment.step(step % num_interactions) for step in range(step_limit)]
    assert all((step.reward, step.discount) == (0, 1) for step in steps[:-1])
    assert (steps[-1].last(), steps[-1].reward, steps[-1].discount) == (True, -1, 0)


def test_pixels_are_one_image_that_moves_and_features_are_float32(task):
    domain, name, num_interactions, *_ = task
    suite.load(domain, name).close()  # One environment draws after another was closed.
    environment = suite.load(domain, name, task_kwargs={"random": fresh_seed()})
    observations = [environment.reset().observation]
    observations += [environment.step(step % num_interactions).observation for step in range(12)]
    if name.endswith("pixels"):
        assert {(key, image.shape, image.dtype) for seen in observations for key, image in seen.items()} == {
            ("pixels", (84, 84, 3), np.dtype(np.uint8))
        }
        assert len({seen["pixels"].tobytes() for seen in observations}) >= 8
    else:
        assert all(array.dtype == np.float32 for seen in observations for array in seen.values())


def test_every_answer_is_equally_likely():
    for domain, name, _, num_labels, _ in TASKS[::2]:
        batch = suite.load_batch(domain, name, 600, task_kwargs={"random": fresh_seed()})
        batch.reset()
        chance.assert_drawn(np.bincount(batch.correct_answers, minlength=num_labels), [1 / num_labels] * num_labels)
