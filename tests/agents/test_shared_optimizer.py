"""The optimizer that workers share is one optimizer: two processes move the same statistics and the same weights."""

import math

from dm_env import specs
import numpy as np
import pytest
import torch
from torch import multiprocessing
from waiting import wait_until

from physexp import suite
from physexp.agents import acting, learning, networks
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c

torch.set_num_threads(1)  # As a worker does; more of them only wait for each other.
CONFIG = config_lib.A3CConfig(num_workers=2, envs_per_worker=8, frames=10**9)


def make_network():
    torch.manual_seed(0)
    spec = {"heights": specs.Array((4,), np.float32)}
    return networks.RecurrentActorCritic(spec, 8, lstm_units=16, observation_scale=10.0)


def apply_constant_gradient(shared, gradient):
    for parameter in shared.network.parameters():
        parameter.grad = torch.full_like(parameter, gradient)
    shared.optimizer.step()


def learn_once(shared, worker, results):
    torch.set_num_threads(1)
    batch = suite.load_batch("which_is_heavier", "features", CONFIG.envs_per_worker, {"random": worker})
    torch.manual_seed(0)
    network = networks.RecurrentActorCritic(batch.observation_spec(), 8, lstm_units=16, observation_scale=10.0)

    def play(number):
        return acting.play_round(network, batch, number, acting.drawn(np.random.default_rng(worker)), keep_inputs=True)

    learner = a3c.A3CLearner(network, shared, play, worker, CONFIG)
    metrics = learner.step()
    results.put((metrics["updates"], learner.last_round.num_frames))


@pytest.fixture
def context():
    return multiprocessing.get_context("spawn")


def test_two_processes_move_one_set_of_adam_statistics(context):
    shared = learning.Variables(make_network(), num_workers=2).share_memory()
    before = [parameter.detach().clone() for parameter in shared.network.parameters()]
    for gradient in (1.0, 2.0):  # One process after the other, so that the order is known.
        process = context.Process(target=apply_constant_gradient, args=(shared, gradient))
        process.start()
        process.join()
        assert process.exitcode == 0
    # Adam, beta1 = 0.9, beta2 = 0.999, learning rate 0.001, gradients 1 then 2:
    # exp_avg = 0.9 * (0.1 * 1) + 0.1 * 2 = 0.29; exp_avg_sq = 0.999 * (0.001 * 1) + 0.001 * 4 = 0.004999; step = 2.
    # First move: both corrected moments are 1: -0.001 * 1 / (1 + eps). Second: moments 0.29 / (1 - 0.81) and
    # 0.004999 / (1 - 0.998001).
    moved = -0.001 * (1 / (1 + 1e-5) + (0.29 / 0.19) / (math.sqrt(0.004999 / 0.001999) + 1e-5))
    for parameter, old in zip(shared.network.parameters(), before, strict=True):
        statistics = shared.optimizer.state[parameter]
        assert statistics["step"].item() == 2
        torch.testing.assert_close(statistics["exp_avg"], torch.full_like(parameter, 0.29))
        torch.testing.assert_close(statistics["exp_avg_sq"], torch.full_like(parameter, 0.004999))
        torch.testing.assert_close(parameter.detach() - old, torch.full_like(parameter, moved), rtol=1e-3, atol=1e-6)


def test_two_learners_at_once_share_weights_statistics_and_counters(context):
    shared = learning.Variables(make_network(), num_workers=2)
    memory = a3c.SharedMemory(shared, context.Lock(), CONFIG.max_staleness)
    before = {name: value.clone() for name, value in shared.tensors().items()}
    results = context.Queue()
    processes = [context.Process(target=learn_once, args=(memory, worker, results)) for worker in range(2)]
    for process in processes:
        process.start()
    reported = []

    def have_both_reported():
        while not results.empty():
            reported.append(results.get())
        return len(reported) == 2

    wait_until(have_both_reported, "the reports of two learners")
    for process in processes:
        process.join()
        assert process.exitcode == 0
    results.close()
    results.join_thread()
    after = shared.tensors()
    assert sorted(updates for updates, _ in reported) == [1, 2], "each saw the other's update, or came first"
    assert shared.updates.item() == 2
    assert shared.rounds.tolist() == [1, 1]
    assert shared.frames.item() == sum(frames for _, frames in reported)
    steps = [value.item() for name, value in after.items() if name.endswith("/step")]
    assert steps == [2.0] * len(list(shared.network.parameters()))
    for name in after:
        if name.startswith("network/") or name.endswith("/exp_avg"):
            assert not torch.equal(before[name], after[name]), f"{name} has not moved"


def test_a_learner_restores_what_it_saved():
    config = CONFIG.replace(num_workers=1)
    shared = learning.Variables(make_network())
    batch = suite.load_batch("which_is_heavier", "features", 8, {"random": 0})
    network = networks.RecurrentActorCritic(batch.observation_spec(), 8, lstm_units=16, observation_scale=10.0)

    def play(number):
        return acting.play_round(network, batch, number, acting.drawn(np.random.default_rng(number)), keep_inputs=True)

    memory = a3c.SharedMemory(shared, multiprocessing.get_context("spawn").Lock(), config.max_staleness)
    learner = a3c.A3CLearner(network, memory, play, 0, config)
    learner.run(2)
    saved = learner.save()
    learner.run(3)
    once = learner.save()
    learner.restore(saved)
    assert shared.updates.item() == 2
    learner.run(3)
    again = learner.save()
    batch.close()
    assert again["updates"].item() == 5
    for name in once:
        assert torch.equal(once[name], again[name]), f"{name} differs after the same three updates"
