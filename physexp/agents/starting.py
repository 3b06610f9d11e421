"""What training starts from: a network for an environment, and the seeds of workers and of rounds."""

from typing import Any

import numpy as np
import torch

from physexp.agents import acting, core, networks
from physexp.agents import config as config_lib


def make_network(environment: core.Batch, config: config_lib.AgentConfig) -> networks.RecurrentActorCritic:
    """Returns a network for an environment's specs, its weights drawn from the configuration's seed."""
    with torch.random.fork_rng():
        torch.manual_seed(config.seed)
        return networks.RecurrentActorCritic(
            environment.observation_spec(), environment.action_spec().num_values, **hyperparameters(config)
        )


def initial_network(environment: core.Batch, config: config_lib.AgentConfig) -> networks.RecurrentActorCritic:
    """Returns the network that training starts from: with the initial policy that is asked for, and calibrated."""
    network = make_network(environment, config)
    network.initialize_policy(config.action_prior)
    if config.relative_pixels:
        network.calibrate(acting.as_tensors(environment.reset().observation))
    return network


def hyperparameters(config: config_lib.AgentConfig) -> dict[str, Any]:
    """Returns what a configuration says of the network, as its keyword arguments."""
    return {"lstm_units": config.lstm_units, "observation_scale": config.observation_scale}


def worker_seed(seed: int, worker: int) -> int:
    """Returns the seed of a worker's environments."""
    return int(np.random.SeedSequence([seed, worker]).generate_state(1, np.uint32)[0])


def round_generator(seed: int, worker: int, episode: int) -> np.random.Generator:
    """Returns the source of the actions in a worker's round of episodes with an index.

    It is a function of these alone, so that a run that is resumed plays the same rounds.
    """
    return np.random.default_rng([seed, worker, episode])
