"""A worker process of A3C, which acts and learns on the shared variables until training ends."""

from multiprocessing import connection, synchronize
import traceback

import torch

from physexp.agents import core, learning, networks, processes
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
    """Trains in a process of its own until all frames are done; sends each update, and the error that ends it."""
    processes.begin()
    torch.set_num_threads(1)
    try:
        learner = a3c_learning.A3CLearner(index, make_environment, config, variables, lock, sender.send)
        while int(variables.frames) < config.frames:
            learner.step()
    except core.DivergedError as error:
        sender.send(core.WorkerError(f"worker {index}: {error}", error.batch))
    except Exception as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        sender.send(core.WorkerError(f"worker {index}: {error!r} at {place.filename}:{place.lineno}"))
