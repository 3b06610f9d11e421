"""Images of a batch are those of its environments, and are drawn when something may have moved, never for a label."""

import dm_env
from episodes import SEED, random_actions
from images import MARKS, assert_same, every_pixel_task, image_of, load_shared, start_both
import numpy as np

pytestmark = MARKS


@every_pixel_task
def test_a_batch_is_its_single_environments(seed, domain_name, task_name):
    """Over episodes that end with labels or when time runs out, and resets in the middle of one."""
    rng = np.random.default_rng(seed)
    size = 3
    batch, singles = start_both(domain_name, task_name, size)
    endings = set()
    for t in range(2 * batch.task.rules.step_limit + 20):
        actions = random_actions(rng, batch.task, size)
        if t < batch.task.rules.step_limit:
            actions[0] %= batch.task.num_interactions  # The first environment's first episode runs out of time.
        steps = batch.step(actions)
        assert_same(steps, [single.step(a) for single, a in zip(singles, actions, strict=True)])
        endings |= set((actions >= batch.task.num_interactions)[steps.step_type == dm_env.StepType.LAST].tolist())
        if rng.random() < 0.05 and t > batch.task.rules.step_limit:
            chosen = np.flatnonzero(rng.random(size) < 0.5)
            assert_same(batch.reset(chosen), [singles[i].reset() for i in chosen])
    assert False in endings, "no episode ran out of time"
    assert not {single.task.episode for single in singles} & {-1, 0}, "an environment played only one episode"


@every_pixel_task
def test_the_image_of_an_environment_that_is_not_stepped_stays(domain_name, task_name):
    """A label shows the image that its environment saw last: the others' steps have not written there."""
    batch = load_shared(domain_name, task_name, SEED, 3)
    batch.reset(episode=0)
    before = image_of(batch.step([0, 0, 0]))
    for action in (0, 1, 2, 3):
        others = image_of(batch.step([action, action], np.array([0, 2])))
    assert (others != before[[0, 2]]).any(axis=(1, 2, 3)).all()
    np.testing.assert_array_equal(image_of(batch.step([batch.task.num_interactions], np.array([1]))), before[[1]])


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
