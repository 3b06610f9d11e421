"""A3C's workers share one network and one optimizer, and a learner goes on from its saved variables."""

import functools
import math
import os

from dm_env import specs
import numpy as np
import pytest
import torch
from torch import multiprocessing
import trainers

from physexp import suite
from physexp.agents import core, learning, networks
from physexp.agents.a3c import agent as agent_lib
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c
from physexp.analysis.training import trainer

torch.set_num_threads(1)  # As a worker does; more of them only wait for each other.
CONFIG = config_lib.A3CConfig(num_workers=2, envs_per_worker=8, frames=10**9)


@pytest.fixture
def context():
    return multiprocessing.get_context("spawn")


def make_network():
    torch.manual_seed(0)
    spec = {"heights": specs.Array((4,), np.float32)}
    return networks.RecurrentActorCritic(spec, 8, observation_scale=10.0)


def load(seed, num_environments, num_threads):
    return suite.load_batch("which_is_heavier", "features", num_environments, {"random": seed}, num_threads)


def learn_once(shared, lock, worker, sender):
    torch.set_num_threads(1)
    a3c.A3CLearner(worker, load, CONFIG, shared, lock, sender.send).step()


def run_all(processes):
    for process in processes:
        process.start()
    for process in processes:
        process.join()
        assert process.exitcode == 0


def test_steps_are_those_of_adam():
    shared = learning.Variables(make_network())
    before = [parameter.detach().clone() for parameter in shared.network.parameters()]
    for gradient in (1.0, 2.0):
        shared.apply([torch.full_like(parameter, gradient) for parameter in before], 0.001)
    # Adam, beta1 = 0.9, beta2 = 0.999, learning rate 0.001, gradients 1 then 2:
    # exp_avg = 0.9 * (0.1 * 1) + 0.1 * 2 = 0.29; exp_avg_sq = 0.999 * (0.001 * 1) + 0.001 * 4 = 0.004999; step = 2.
    # First move: both corrected moments are 1: -0.001 * 1 / (1 + eps). Second: moments 0.29 / (1 - 0.81) and
    # 0.004999 / (1 - 0.998001).
    moved = -0.001 * (1 / (1 + 1e-5) + (0.29 / 0.19) / (math.sqrt(0.004999 / 0.001999) + 1e-5))
    kept = shared.tensors()
    for (name, parameter), old in zip(shared.network.named_parameters(), before, strict=True):
        assert kept[f"optimizer/{name}/step"].item() == 2
        torch.testing.assert_close(kept[f"optimizer/{name}/exp_avg"], torch.full_like(parameter, 0.29))
        torch.testing.assert_close(kept[f"optimizer/{name}/exp_avg_sq"], torch.full_like(parameter, 0.004999))
        torch.testing.assert_close(parameter.detach() - old, torch.full_like(parameter, moved), rtol=1e-3, atol=1e-6)


def test_two_learners_at_once_share_weights_statistics_and_counters(context):
    shared, lock = learning.Variables(make_network(), num_workers=2).share_memory(), context.Lock()
    before = {name: value.clone() for name, value in shared.tensors().items()}
    pipes = [context.Pipe(duplex=False) for _ in range(2)]
    run_all(
        [
            context.Process(target=learn_once, args=(shared, lock, worker, sender))
            for worker, (_, sender) in enumerate(pipes)
        ]
    )
    updates = [receiver.recv() for receiver, _ in pipes]
    assert sorted(update.metrics["updates"] for update in updates) == [1, 2], (
        "each saw the other's update, or came first"
    )
    assert int(shared.updates) == 2 and shared.rounds.tolist() == [1, 1]
    assert int(shared.frames) == sum(update.episodes.num_frames for update in updates)
    after = shared.tensors()
    assert {value.item() for name, value in after.items() if name.endswith("/step")} == {2.0}
    for name in after:
        if name.startswith("network/") or name.endswith("/exp_avg"):
            assert not torch.equal(before[name], after[name]), f"{name} has not moved"


def die_with(lock):
    lock.acquire()
    os._exit(0)


def test_variables_are_not_saved_after_a_worker_died_in_an_update(tmp_path, context):
    config = trainers.create(tmp_path / "run").config
    agent = agent_lib.A3C(functools.partial(trainer.make_environment, config), config.agent)
    agent.save()
    run_all([context.Process(target=die_with, args=(agent._lock,))])
    with pytest.raises(core.WorkerError, match="a worker was killed in the middle of an update"):
        agent.save()


def make_environment_of_one(seed, num_environments, num_threads):
    if num_environments > 1:
        raise OSError("no license")
    return load(seed, num_environments, num_threads)


def test_an_error_in_a_worker_ends_training_in_one_line_that_names_it():
    agent = agent_lib.A3C(make_environment_of_one, CONFIG)
    with pytest.raises(core.WorkerError, match=r"^worker [01]: OSError\('no license'\) at .*\.py:\d+$"):
        list(agent.updates())
