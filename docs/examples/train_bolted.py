"""Trains an agent of the package on a task that is not."""

import bolted

from physexp import suite
from physexp.agents.ppo import agent, config


def make_environment(seed, num_environments, num_threads):
    """What an agent trains on: a batch, from its seed, its size and its threads."""
    return suite.BatchEnvironment(bolted.features(random=seed), num_environments, num_threads)


def train(frames=20_000):
    """Trains PPO; returns its success in the last round."""
    chosen = config.PPOConfig(frames=frames, num_environments=64, observation_scale=10.0, learning_rate=3e-3)
    ppo = agent.PPO(make_environment, chosen)
    for update in ppo.updates():
        success = (update.episodes.rewards.sum(axis=0) > 0).mean()
        print(f"{update.metrics['frames']:6.0f} frames: {success:.0%} right")
    return success


if __name__ == "__main__":
    train()
