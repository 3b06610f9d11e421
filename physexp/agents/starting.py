"""The start of training: the network for an environment, and the seeds of workers and of rounds."""

from typing import TypeVar

import numpy as np
import torch

from physexp.agents import acting, core, devices, networks
from physexp.agents import config as config_lib

Network = TypeVar("Network", bound=networks.RecurrentNetwork)


def make_network(kind: type[Network], task: core.Specs, config: config_lib.AgentConfig) -> Network:
    """Returns a network of a kind for a task's specs, its weights drawn from the configuration's seed."""
    with devices.own_torch():
        torch.default_generator.manual_seed(config.seed)
        num_actions = task.action_spec().num_values
        return kind(task.observation_spec(), num_actions, **kind.hyperparameters(task, config))


def initial_network(environment: core.Batch, config: config_lib.ActorCriticConfig) -> networks.RecurrentActorCritic:
    """Returns an untrained network with the initial policy of the configuration, calibrated to the first images."""
    network = make_network(networks.RecurrentActorCritic, environment, config)
    network.initialize_policy(config.initial_logits)
    if config.relative_pixels:
        network.calibrate(acting.as_tensors(environment.reset().observation))
    return network


def worker_seed(seed: int, worker: int) -> int:
    """Returns the seed of a worker's environments."""
    return int(np.random.SeedSequence([seed, worker]).generate_state(1, np.uint32)[0])


def round_generator(seed: int, worker: int, episode: int) -> np.random.Generator:
    """Returns the random generator of the actions in a worker's round of episodes.

    It is a function of the arguments alone, so that a run that is resumed plays the same rounds.
    """
    return np.random.default_rng([seed, worker, episode])
