"""A3C's workers: gradients of whole episodes, applied to variables that all workers share."""

from collections.abc import Callable
from multiprocessing import connection, synchronize
import traceback

import torch

from physexp.agents import acting, core, devices, learning, networks, processes, starting
from physexp.agents.a3c import config as config_lib

Variables = learning.Variables[networks.RecurrentActorCritic]


class A3CLearner(core.Learner):
    """One worker's learner: reads the shared parameters, plays a round, and applies its gradient to them.

    The lock is held while the shared variables are read or written, and while an update is sent: an update is in the
    variables and in the records, or in neither, whenever the worker is killed.
    """

    def __init__(
        self,
        worker: int,
        make_environment: core.EnvironmentFactory,
        config: config_lib.A3CConfig,
        variables: Variables,
        lock: synchronize.Lock,
        send: Callable[[core.Update], None],
    ):
        """Makes the environments of the worker of an index, and its copy of the shared network."""
        self._worker, self._config, self.variables, self._lock, self._send = worker, config, variables, lock, send
        self._seed = starting.worker_seed(config.seed, worker)
        self._environment = make_environment(self._seed, config.envs_per_worker, 1)
        network = starting.make_network(networks.RecurrentActorCritic, self._environment, config)
        self._network = network.to(devices.choose(config.device, network.sees_images))

    def step(self) -> dict[str, float]:
        """Makes one update; returns its metrics."""
        config, variables, worker = self._config, self.variables, self._worker
        with self._lock:
            self._network.load_state_dict(variables.network.state_dict())
            frames, updates, episode = int(variables.frames), int(variables.updates), int(variables.rounds[worker])
        learning_rate, entropy_cost = config.at(frames)
        choose = acting.drawn(starting.round_generator(config.seed, worker, episode))
        episodes = acting.play_round(self._network, self._environment, episode, choose, keep_inputs=True)
        gradients, metrics = learning.actor_critic_gradients(self._network, episodes.select(), config, entropy_cost)
        with self._lock:
            staleness = int(variables.updates) - updates
            variables.apply(gradients, learning_rate)
            metrics |= {"learning_rate": learning_rate, "entropy_cost": entropy_cost, "staleness": staleness}
            metrics |= variables.count(episodes.num_frames, worker)
            self._send(core.Update(self._seed, episode, metrics, episodes.record()))
        return metrics


def run(
    index: int,
    make_environment: core.EnvironmentFactory,
    config: config_lib.A3CConfig,
    variables: Variables,
    lock: synchronize.Lock,
    sender: "connection.Connection[core.Update | core.WorkerError, None]",
) -> None:
    """Trains in a process of its own until all frames are done; sends each update, and the error that ends it."""
    processes.begin()
    torch.set_num_threads(1)
    try:
        learner = A3CLearner(index, make_environment, config, variables, lock, sender.send)
        while int(variables.frames) < config.frames:
            learner.step()
    except core.DivergedError as error:
        sender.send(core.WorkerError(f"worker {index}: {error}", error.batch))
    except Exception as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        sender.send(core.WorkerError(f"worker {index}: {error!r} at {place.filename}:{place.lineno}"))
