"""PPO's learner: several epochs of clipped updates on each round of whole episodes (Schulman et al., 2017)."""

from collections.abc import Callable

import numpy as np
import torch

from physexp.agents import learning, losses, networks, rounds, synchronous
from physexp.agents.ppo import config as config_lib

_NUM_EPOCHS = 4  # Passes over the episodes in each update, as usual for PPO.
_CLIP = 0.2  # The probability ratio is clipped to [1 - clip, 1 + clip]; the value of Schulman et al.


class PPOLearner(synchronous.SynchronousLearner):
    """Takes rounds of episodes, moves the variables."""

    def __init__(
        self,
        variables: learning.Variables[networks.RecurrentActorCritic],
        play: Callable[[int], rounds.Round],
        config: config_lib.PPOConfig,
    ):
        """Takes the network with its optimizer, and a function that plays the round of an index with behaviour data."""
        self.variables, self._play, self._config = variables, play, config

    def step(self) -> dict[str, float]:
        """Plays a round, and goes through it several times, in minibatches of whole episodes."""
        config, variables = self._config, self.variables
        episode = self.next_episode
        learning_rate, entropy_cost = config.at(int(variables.frames))
        self.last_round = episodes = self._play(episode)
        generator = np.random.default_rng([config.seed, episode])
        figures = []
        for _ in range(_NUM_EPOCHS):
            for chosen in np.array_split(generator.permutation(len(episodes.lengths)), config.num_minibatches):
                figures.append(self._learn(episodes.select(chosen), learning_rate, entropy_cost))
        variables.rounds += 1
        variables.count(episodes.num_frames)
        means = {name: float(np.mean([each[name] for each in figures])) for name in figures[0]}
        return {
            **means,
            "learning_rate": learning_rate,
            "entropy_cost": entropy_cost,
            "updates": variables.updates.item(),
            "frames": variables.frames.item(),
        }

    def _learn(self, episodes: rounds.Round, learning_rate: float, entropy_cost: float) -> dict[str, float]:
        """Makes one step of Adam on some episodes; returns its metrics."""
        config, network = self._config, self.variables.network
        assert episodes.values is not None and episodes.log_probabilities is not None
        logits, values = network.unroll(network.encode(episodes.observation), episodes.batch_sizes)
        returns, advantages = learning.targets(episodes, episodes.values, config.discount, config.gae_lambda)
        device = logits.device
        parts = losses.clipped_losses(
            logits,
            values,
            episodes.packed(episodes.actions).to(device),
            episodes.log_probabilities.to(device),
            returns.to(device),
            _standardized(advantages).to(device),
            _CLIP,
            config.entropy_prior,
        )
        gradients, metrics = learning.actor_critic_gradients(network, parts, entropy_cost, config, episodes)
        self.variables.apply(gradients, learning_rate)
        return metrics


def _standardized(advantages: torch.Tensor) -> torch.Tensor:
    """Scales advantages to mean 0 and standard deviation 1: steps are as large late in training as at the start."""
    return (advantages - advantages.mean()) / (advantages.std(correction=0) + 1e-8)
