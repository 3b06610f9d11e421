"""No observation ever leaves the bounds that the specs state, whatever is done."""

import dm_env
from every_task import FEATURES, load_batch
import numpy as np
import pytest

from physexp import suite

REGISTERED = {"/".join(names) for names in suite.ALL_TASKS}
# With the task's own control steps, and with short ones of the paper's tasks, s.
PLAYS = [(name, {}) for name in FEATURES]
PLAYS += [("which_is_heavier/features", {"control_timestep": 0.025, "time_limit": 5.0})]
PLAYS += [(f"towers/{kind}_features", {"control_timestep": 0.02, "time_limit": 1.5}) for kind in ("direct", "fist")]


def _stubborn(rng, num_actions, size):
    """A player for each environment who keeps to an action, or to four neighbouring ones, for ever shorter times."""
    patience = rng.choice([1, 3, 10, np.inf], size=size)
    own = rng.integers(num_actions, size=size)
    actions = own.copy()
    while True:
        yield actions
        tired = rng.random(size) < 1 / patience
        actions = np.where(tired, np.where(rng.random(size) < 0.5, own, rng.integers(num_actions, size=size)), actions)


@pytest.mark.parametrize("name, options", PLAYS)
def test_no_play_takes_an_observation_out_of_its_bounds(seed, name, options):
    if name == "which_is_heavier/features":
        options = {**options, "difficulty": 1e6}  # One block has all the mass, and the others the least.
    size = 16
    batch = load_batch(name, size, random=seed, **options)
    spec = batch.observation_spec()
    bounds = {key: bounded for key, bounded in spec.items() if isinstance(bounded, dm_env.specs.BoundedArray)}
    assert len(bounds) == len(spec) or name not in REGISTERED
    players = _stubborn(np.random.default_rng(seed), batch.task.num_interactions, size)
    step = batch.reset()
    for _ in range(batch.task.rules.step_limit):
        for key, bounded in bounds.items():
            assert (step.observation[key] >= bounded.minimum).all(), (key, step.observation[key].min())
            assert (step.observation[key] <= bounded.maximum).all(), (key, step.observation[key].max())
        step = batch.step(next(players))
    assert step.last().all()
