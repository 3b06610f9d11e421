"""Images are drawn when something may have moved, and never for a label."""

import dm_env
from images import MARKS, every_pixel_task
import numpy as np

pytestmark = MARKS


@every_pixel_task
def test_an_environment_draws_once_a_step_and_never_for_a_label(load, drawn, domain_name, task_name):
    env = load(domain_name, task_name, 0)
    assert drawn == []
    expected = 0
    for _ in range(2):
        env.reset()
        expected += 1
        assert drawn == [1] * expected
        for t in range(3):
            env.step(t)
            expected += 1
            assert drawn == [1] * expected
        assert env.step(env.task.num_interactions).last()
        assert drawn == [1] * expected
        assert env.step(0).first()  # With any action.
        expected += 1
        assert drawn == [1] * expected


@every_pixel_task
def test_a_batch_draws_one_image_for_each_interaction(load, drawn, domain_name, task_name):
    size = 6
    batch = load(domain_name, task_name, 3, size)
    batch.reset(episode=0)
    num_structures = len(np.unique(batch.task.structures(batch.hidden)))
    assert drawn == [1] * num_structures
    drawn.clear()
    label = batch.task.num_interactions
    for labeling in ([], [1], [0, 2, 3, 4, 5]):
        actions = np.zeros(size, int)
        actions[labeling] = label
        steps = batch.step(actions)
        assert sum(drawn) == size - len(labeling) - (steps.step_type == dm_env.StepType.FIRST).sum()
        assert len(drawn) <= num_structures
        drawn.clear()
        batch.reset(np.array(labeling, int), episode=0)
        assert drawn == []  # Their first images have been drawn.
    batch.step(np.full(size, label))
    batch.reset(episode=0)
    nobody = np.array([], int)
    batch.step(nobody, nobody)
    assert drawn == []
