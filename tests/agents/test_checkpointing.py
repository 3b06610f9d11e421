"""The two latest checkpoints are kept; a damaged one falls back to the one before."""

import math

from dm_env import specs
import numpy as np
import pytest
import torch

from physexp.agents import checkpointing, learning, networks


def tensors(frames):
    return {"frames": torch.tensor(frames), "network/w": torch.arange(6.0).reshape(2, 3) + frames}


def test_only_the_latest_two_are_kept_and_the_newest_is_read(tmp_path):
    checkpointer = checkpointing.Checkpointer(tmp_path / "checkpoints")
    assert checkpointer.latest() is None
    for frames in (5, 90, 100, 2_000):  # As text, 5 and 90 would sort behind 100.
        checkpointer.save(tensors(frames), {"episodes": frames})
    assert [int(path.stem) for path in checkpointer.paths()] == [100, 2_000]
    assert len(list((tmp_path / "checkpoints").iterdir())) == 2
    found, facts = checkpointer.latest()
    assert facts == {"episodes": 2_000}
    assert all(torch.equal(found[name], value) for name, value in tensors(2_000).items())


@pytest.fixture
def small():
    """Variables of a small network that has learned a little."""
    observations = {"features": specs.Array((3,), np.float32, "features")}
    made = learning.Variables(networks.RecurrentActorCritic(observations, 4, observation_scale=1.0), 2)
    made.frames += 10
    made.updates += 2
    made.rounds += 1
    return made


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("network/policy.weight", torch.full((4, 100), math.nan), "not finite in network/policy.weight"),
        ("network/policy.weight", torch.zeros(100, 4), r"weight is floating \[100, 4\], not floating \[4, 100\]"),
        ("frames", torch.tensor(1.5), r"frames is floating \[\], not integer"),
        ("more\nlines", torch.zeros(1), r"only one of them has 'more\\nlines'"),
    ],
)
def test_a_checkpoint_that_makes_no_sense_changes_nothing(name, value, message, small, tmp_path):
    before = small.save()
    checkpointer = checkpointing.Checkpointer(tmp_path)
    path = checkpointer.save({**before, name: value}, {})
    with pytest.raises(ValueError, match=message) as refused:
        checkpointer.latest(accept=lambda tensors, facts: small.restore(tensors))
    assert str(refused.value).startswith(f"{path}: the checkpoint") and "\n" not in str(refused.value)
    assert all(torch.equal(value, before[name]) for name, value in small.save().items())
