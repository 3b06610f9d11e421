"""PPO's agent: plays a round of whole episodes, learns from it, and so on, in one process."""

from physexp.agents import acting, core, devices, learning, rounds, starting, synchronous
from physexp.agents.ppo import config as config_lib
from physexp.agents.ppo import learning as ppo_learning


class PPO(synchronous.SynchronousAgent):
    """Synchronous: each round is played with all that was learned from the rounds before."""

    def __init__(self, make_environment: core.EnvironmentFactory, config: config_lib.PPOConfig):
        """Makes the environments and the network."""
        seed = starting.worker_seed(config.seed, 0)
        environment = make_environment(seed, config.num_environments, config.num_threads)
        network = starting.initial_network(environment, config)
        network.to(devices.choose(config.device, network.sees_images))

        def play(episode: int) -> rounds.Round:
            choose = acting.drawn(starting.round_generator(config.seed, 0, episode))
            return acting.play_round(network, environment, episode, choose, keep_behaviour=True)

        learner = ppo_learning.PPOLearner(learning.Variables(network), play, config)
        super().__init__(learner, config.frames, seed, config.num_threads)
