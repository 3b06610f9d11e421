"""PPO: several epochs of clipped updates on each round of whole episodes, in one process (Schulman et al., 2017)."""

import numpy as np
import torch

from physexp.agents import acting, core, devices, learning, losses, networks, rounds, starting, synchronous
from physexp.agents.ppo import config as config_lib

_NUM_EPOCHS = 4  # Passes over the episodes in each update, as usual for PPO.
_CLIP = 0.2  # The probability ratio is clipped to [1 - clip, 1 + clip]; the value of Schulman et al.


class PPO(synchronous.SynchronousAgent):
    """Synchronous: each round is played with all that was learned from the rounds before."""

    variables: learning.Variables[networks.RecurrentActorCritic]

    def __init__(self, make_environment: core.EnvironmentFactory, config: config_lib.PPOConfig):
        """Makes the environments and the network."""
        super().__init__(make_environment, config.num_environments, config)
        network = starting.initial_network(self._environment, config)
        self.variables = learning.Variables(network.to(devices.choose(config.device, network.sees_images)))
        self._config = config

    def step(self) -> dict[str, float]:
        """Plays a round, and goes through it several times, in minibatches of whole episodes."""
        config, variables, episode = self._config, self.variables, self.next_episode
        learning_rate, entropy_cost = config.at(int(variables.frames))
        choose = acting.drawn(starting.round_generator(config.seed, 0, episode))
        self.last_round = episodes = acting.play_round(
            variables.network, self._environment, episode, choose, keep_behaviour=True
        )
        generator = np.random.default_rng([config.seed, episode])
        figures = []
        for _ in range(_NUM_EPOCHS):
            for chosen in np.array_split(generator.permutation(len(episodes.lengths)), config.num_minibatches):
                figures.append(self._learn(episodes.select(chosen), learning_rate, entropy_cost))
        means = {name: float(np.mean([each[name] for each in figures])) for name in figures[0]}
        rates = {"learning_rate": learning_rate, "entropy_cost": entropy_cost}
        return {**means, **rates, **variables.count(episodes.num_frames)}

    def _learn(self, episodes: rounds.Round, learning_rate: float, entropy_cost: float) -> dict[str, float]:
        """Makes one step of Adam on some episodes; returns its metrics."""
        assert episodes.log_probabilities is not None
        clipped = losses.clipped_policy_loss(episodes.log_probabilities.to(self.variables.network.device), _CLIP)

        def policy_loss(chosen: torch.Tensor, advantages: torch.Tensor) -> torch.Tensor:
            # Steps are as large late in training as at the start.
            return clipped(chosen, (advantages - advantages.mean()) / (advantages.std(correction=0) + 1e-8))

        gradients, metrics = learning.actor_critic_gradients(
            self.variables.network, episodes, self._config, entropy_cost, policy_loss
        )
        self.variables.apply(gradients, learning_rate)
        return metrics
