"""The images of a batch are those of its single environments, and the caller's own."""

import dm_env
from episodes import SEED, random_actions
from images import MARKS, assert_same, every_pixel_task, image_of, load_shared, load_single, start_both
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
def test_images_do_not_depend_on_numbers_of_environments_and_threads(load, seed, domain_name, task_name):
    rng = np.random.default_rng(seed)
    batches = [load(domain_name, task_name, seed, 1), load_shared(domain_name, task_name, seed, 3)]
    batches.append(load(domain_name, task_name, seed, 5, num_threads=2))
    first, changed = [image_of(batch.reset(episode=0)) for batch in batches], False
    for t in range(20):
        actions = random_actions(rng, batches[0].task, 5)
        images = [image_of(batch.step(actions[: batch.num_environments])) for batch in batches]
        for image in images:
            assert image.tobytes() == images[-1][: len(image)].tobytes(), f"step {t}"
        changed |= (images[-1] != first[-1]).any()
    assert changed


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
def test_images_that_were_returned_are_the_callers_own(domain_name, task_name):
    """Later steps do not write into them, and writing into them changes nothing that is seen later."""
    batch, (single, *_) = start_both(domain_name, task_name, 3)
    label = batch.task.num_interactions
    plays = [
        (lambda: load_single(domain_name, task_name).reset(), single.step, [0, 1, label, 2, 3]),
        (lambda: batch.reset(episode=0), batch.step, [[0, 0, 1], [1, label, 0], [label, 0, 2]]),
    ]
    for start, step, actions in plays:
        steps, kept = [start()], []
        for action in actions:
            kept.append(image_of(steps[-1]).copy())
            steps.append(step(action))
        again = start()
        for action, earlier, copy in zip(actions, steps, kept, strict=False):
            np.testing.assert_array_equal(image_of(earlier), copy)
            np.testing.assert_array_equal(image_of(again), copy)
            image_of(again)[:] = 77
            again = step(action)
