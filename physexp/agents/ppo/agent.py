"""PPO's agent: plays a round of whole episodes, learns from it, and so on, in one process."""

from collections.abc import Callable

import torch

from physexp.agents import acting, core, devices, learning, rounds, starting
from physexp.agents.ppo import config as config_lib
from physexp.agents.ppo import learning as ppo_learning


class PPO(core.Agent):
    """Synchronous: each round is played with all that was learned from the rounds before."""

    def __init__(
        self,
        make_environment: core.EnvironmentFactory,
        config: config_lib.PPOConfig,
        tell: Callable[[str], None] = lambda line: None,
    ):
        """Makes the environments and the network.

        Args:
          make_environment: makes the batch.
          config: the configuration.
          tell: never called: nothing can go wrong that training survives.
        """
        self._config = config
        self._seed = starting.worker_seed(config.seed, 0)
        self._environment = make_environment(self._seed, config.num_environments, config.num_threads)
        network = starting.initial_network(self._environment, config)
        network.to(devices.choose(config.device, network.sees_images))
        self._learner = ppo_learning.PPOLearner(learning.Variables(network), self._play, config)
        self._stopping = False

    @property
    def frames(self):
        return self._learner.variables.frames.item()

    def updates(self, poll_seconds=0.5):
        # More of them than the images' convolutions can use only wait for each other.
        torch.set_num_threads(self._config.num_threads if self._learner.variables.network.sees_images else 1)
        while not self._stopping and self.frames < self._config.frames:
            episode = self._learner.next_episode
            metrics = self._learner.step()
            yield core.Update(self._seed, episode, metrics, self._learner.last_round.record())

    def stop(self):
        self._stopping = True

    def save(self):
        return self._learner.save()

    def restore(self, tensors):
        self._learner.restore(tensors)

    def _play(self, episode: int) -> rounds.Round:
        generator = starting.round_generator(self._config.seed, 0, episode)
        network = self._learner.variables.network
        return acting.play_round(network, self._environment, episode, generator, keep_behaviour=True)
