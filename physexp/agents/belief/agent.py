"""The belief learner's agent: plays a round of whole episodes, learns from all that it has kept, and so on."""

import numpy as np

from physexp.agents import acting, core, devices, rounds, starting, synchronous
from physexp.agents.belief import config as config_lib
from physexp.agents.belief import learning, networks, replay


class Belief(synchronous.SynchronousAgent):
    """Keeps a belief about the answer, and estimates the value of each interaction; one process."""

    def __init__(self, make_environment: core.EnvironmentFactory, config: config_lib.BeliefConfig):
        """Makes the environments, the network, and the replay; raises ValueError if that is larger than memory."""
        seed, num_environments = starting.worker_seed(config.seed, 0), config_lib.NUM_ENVIRONMENTS
        environment = make_environment(seed, num_environments, config.num_threads)
        network = starting.make_network(networks.BeliefNetwork, environment, config)
        network.calibrate(acting.as_tensors(environment.reset().observation))
        network.to(devices.choose(config.device, network.sees_images))
        num_rounds = config.replay_episodes // num_environments
        dtype = np.float16 if network.sees_images else np.float32
        episodes = replay.Replay(num_rounds, config.max_interactions + 1, num_environments, network.num_inputs, dtype)
        variables = learning.Variables(network, episodes)

        def play(number: int, choose: acting.Choose) -> rounds.Round:
            return acting.play_round(variables.averaged, environment, number, choose, keep_inputs=True)

        learner = learning.BeliefLearner(variables, play, config)
        super().__init__(learner, config.frames, seed, config.num_threads)
