"""A worker, which acts, learns and shares what it has learned until training ends, and its process."""

from collections.abc import Callable
import contextlib
import queue
import threading
import traceback
from typing import Any

import torch

from physexp.agents import acting, core, devices, networks, processes, rounds, starting
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c_learning


def work(
    index: int,
    make_environment: core.EnvironmentFactory,
    config: config_lib.A3CConfig,
    shared: a3c_learning.Shared,
    is_stopped: Callable[[], bool],
) -> None:
    """Updates the shared variables, until all frames are done or the worker is stopped."""
    environment = make_environment(starting.worker_seed(config.seed, index), config.envs_per_worker, 1)
    network = starting.make_network(networks.RecurrentActorCritic, environment, config)
    network.to(devices.choose(config.device, network.sees_images))

    def play(episode: int) -> rounds.Round:
        generator = starting.round_generator(config.seed, index, episode)
        return acting.play_round(network, environment, episode, acting.drawn(generator), keep_inputs=True)

    learner = a3c_learning.A3CLearner(network, shared, play, index, config)
    frames = shared.pull(network, index).frames
    while frames < config.frames and not is_stopped():
        frames = int(learner.step()["frames"])


class Worker:
    """A worker's process, and the thread that receives what it sends.

    Each has its own pipe: in one that they share, what is sent by one that was stopped blocks all others.

    Attributes:
      index: of the worker.
      process: its process, once it was started.
      is_killed: whether it was killed because it did not end.
    """

    def __init__(self, index: int):
        """Starts nothing yet."""
        self.index, self.is_killed = index, False
        self.process: Any = None
        self._listener = threading.Thread(target=self._listen, daemon=True)

    @property
    def name(self) -> str:
        """Returns its name in messages."""
        return f"worker {self.index} (process {self.process.pid})"

    def start(self, context, received: queue.SimpleQueue, *arguments) -> None:
        """Starts the process.

        Args:
          context: of multiprocessing.
          received: where its updates and errors are put.
          arguments: of `_run`, but for the index and the pipe.
        """
        self._receiver, sender = context.Pipe(duplex=False)
        self._received = received
        self.process = context.Process(
            target=_run, args=(self.index, *arguments, sender), name=f"physexp worker {self.index}", daemon=True
        )
        self.process.start()
        sender.close()  # So that the pipe ends with the worker.
        self._listener.start()

    def is_heard(self) -> bool:
        """Returns whether it runs, or has sent what was not received yet."""
        return self._listener.is_alive()

    def end(self) -> None:
        """Kills the process, if it runs."""
        if self.process is not None:
            processes.kill(self.process)

    def _listen(self) -> None:
        with self._receiver, contextlib.suppress(EOFError, OSError):  # It was killed, perhaps while it was sending.
            while True:
                self._received.put(self._receiver.recv())


def _run(index, make_environment, config, shared: a3c_learning.SharedMemory, stopping, sender) -> None:
    """Works in a process of its own, and sends updates and errors."""
    processes.begin()
    torch.set_num_threads(1)
    seed = starting.worker_seed(config.seed, index)
    shared.record = lambda contribution, counters: sender.send(contribution.update(seed, counters))
    try:
        work(index, make_environment, config, shared, lambda: stopping.value)
    except core.DivergedError as error:
        sender.send(core.WorkerError(f"worker {index}: {error}", error.batch))
    except Exception as error:
        sender.send(core.WorkerError(f"worker {index}: {error!r}\n{traceback.format_exc()}"))
