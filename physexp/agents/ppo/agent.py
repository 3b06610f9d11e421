"""PPO's agent: plays a round of whole episodes, learns from it, and so on, in one process."""

from physexp.agents import acting, core, devices, learning, rounds, starting, synchronous
from physexp.agents.ppo import config as config_lib
from physexp.agents.ppo import learning as ppo_learning


class PPO(synchronous.SynchronousAgent):
    """Synchronous: each round is played with all that was learned from the rounds before."""

    def __init__(self, make_environment: core.EnvironmentFactory, config: config_lib.PPOConfig):
        """Makes the environments and the network."""
        self._config = config
        seed = starting.worker_seed(config.seed, 0)
        self._environment = make_environment(seed, config.num_environments, config.num_threads)
        self._network = starting.initial_network(self._environment, config)
        self._network.to(devices.choose(config.device, self._network.sees_images))
        learner = ppo_learning.PPOLearner(learning.Variables(self._network), self._play, config)
        super().__init__(learner, config.frames, seed, config.num_threads)

    def _play(self, episode: int) -> rounds.Round:
        generator = starting.round_generator(self._config.seed, 0, episode)
        choose = acting.drawn(generator)
        return acting.play_round(self._network, self._environment, episode, choose, keep_behaviour=True)
