"""A worker process of A3C, which acts and learns on the shared variables until training ends."""

from multiprocessing import connection, synchronize
import traceback

import torch

from physexp.agents import acting, core, devices, learning, networks, processes, rounds, starting
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c_learning


def run(
    index: int,
    make_environment: core.EnvironmentFactory,
    config: config_lib.A3CConfig,
    variables: learning.Variables[networks.RecurrentActorCritic],
    lock: synchronize.Lock,
    sender: "connection.Connection[core.Update | core.WorkerError, None]",
) -> None:
    """Trains in a process of its own until all frames are done.

    Args:
      index: of the worker.
      make_environment: makes its batch of environments.
      config: the agent's configuration.
      variables: the variables that all workers share.
      lock: held while they are read or written.
      sender: receives each update, and the error that ends the worker.
    """
    processes.begin()
    torch.set_num_threads(1)
    seed = starting.worker_seed(config.seed, index)

    def play(episode: int) -> rounds.Round:
        generator = starting.round_generator(config.seed, index, episode)
        return acting.play_round(network, environment, episode, acting.drawn(generator), keep_inputs=True)

    def record(episode: int, metrics: dict[str, float], episodes: rounds.Round) -> None:
        sender.send(core.Update(seed, episode, metrics, episodes))

    try:
        environment = make_environment(seed, config.envs_per_worker, 1)
        network = starting.make_network(networks.RecurrentActorCritic, environment, config)
        network.to(devices.choose(config.device, network.sees_images))
        learner = a3c_learning.A3CLearner(network, variables, lock, play, record, index, config)
        while int(variables.frames) < config.frames:
            learner.step()
    except core.DivergedError as error:
        sender.send(core.WorkerError(f"worker {index}: {error}", error.batch))
    except Exception as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        sender.send(core.WorkerError(f"worker {index}: {error!r} at {place.filename}:{place.lineno}"))
