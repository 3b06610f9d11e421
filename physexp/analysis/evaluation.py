"""Evaluation: plays episodes with a trained agent and measures how well it answers."""

import dataclasses
import functools

import numpy as np
import torch

from physexp.agents import devices, networks
from physexp.agents.a3c import acting
from physexp.agents.a3c import agent as agent_lib
from physexp.analysis import config as config_lib
from physexp.analysis import run as run_lib
from physexp.analysis import statistics, training

SEED = 1_000_003  # Of the evaluation's environments, apart from those of training.
INTERACTIONS = ("learned", "random")
_BATCH = 256


@dataclasses.dataclass(frozen=True)
class Episodes:
    """What happened in many episodes.

    Attributes:
      rewards: final rewards, float64 [N].
      lengths: actions in each episode, int64 [N].
      interactions: interaction actions in each episode, int64 [N].
    """

    rewards: np.ndarray
    lengths: np.ndarray
    interactions: np.ndarray

    def summary(self, discount: float) -> dict:
        """The figures of `physexp evaluate`; the interval is Wilson's, at 95 %."""
        right = int((self.rewards > 0).sum())
        return {
            "episodes": len(self.rewards),
            "success_rate": right / len(self.rewards),
            "success_interval": list(statistics.wilson_interval(right, len(self.rewards))),
            "mean_return": float((self.rewards * discount ** (self.lengths - 1)).mean()),
            "mean_interactions": float(self.interactions.mean()),
            "median_interactions": float(np.median(self.interactions)),
            "timeouts": int((self.interactions == self.lengths).sum()),
        }


def load_network(run: run_lib.Run) -> networks.RecurrentActorCritic:
    """The network of a run's last checkpoint.

    Raises:
      ValueError: if the folder holds no checkpoint.
    """
    config = run.config
    found = run.checkpointer.latest()
    if found is None:
        raise ValueError(f"{run.path} holds no checkpoint yet; let the training write one")
    network = agent_lib.make_network(training.make_environment(config, 0, 1, 1), config.agent)
    prefix = "network/"
    tensors = {name.removeprefix(prefix): value for name, value in found[0].items() if name.startswith(prefix)}
    network.load_state_dict(tensors)
    return network.eval()


def evaluate(run: run_lib.Run, num_episodes: int, interaction: str = "learned", greedy: bool = False,
             seed: int = SEED, num_threads: int = 2, device: str = "auto") -> Episodes:  # fmt: skip
    """Plays episodes with the agent of a run that has a checkpoint; otherwise as `play`."""
    return play(load_network(run), run.config, num_episodes, interaction, greedy, seed, num_threads, device)


def play(network: networks.RecurrentActorCritic, config: config_lib.TrainConfig, num_episodes: int,
         interaction: str = "learned", greedy: bool = False, seed: int = SEED, num_threads: int = 2,
         device: str = "auto") -> Episodes:  # fmt: skip
    """Plays episodes with a network.

    Args:
      network: the agent's network.
      config: says what it plays.
      num_episodes: how many.
      interaction: `learned`, or `random` for the paper's randomized interaction (Section 5.3): labeling actions pass,
        an interaction action is replaced by one drawn uniformly.
      greedy: take the likeliest action instead of drawing one.
      seed: of the environments and the actions.
      num_threads: threads that simulate.
      device: where convolutions are computed, as in `A3CConfig`.

    Raises:
      ValueError: for an unknown interaction or a number of episodes below one.
    """
    if interaction not in INTERACTIONS:
        raise ValueError(f"interaction is {interaction!r}; choose from {', '.join(INTERACTIONS)}")
    if num_episodes < 1:
        raise ValueError(f"episodes is {num_episodes}; give a number >= 1")
    torch.set_num_threads(1)
    network.to(devices.choose(device, network.sees_images))
    environment = training.make_environment(config, seed, min(num_episodes, _BATCH), num_threads)
    num_interactions = environment.task.num_interactions
    interference = functools.partial(randomize, num_interactions) if interaction == "random" else None
    rewards, lengths, interactions = [], [], []
    for number in range(-(-num_episodes // environment.num_environments)):
        generator = np.random.default_rng([seed, number])
        episodes = acting.play_round(network, environment, number, generator, greedy, interference)
        rewards.append(episodes.rewards.sum(axis=0, dtype=np.float64))
        lengths.append(episodes.lengths)
        interactions.append(training.interaction_counts(episodes, num_interactions))
    environment.close()
    return Episodes(*(np.concatenate(arrays)[:num_episodes] for arrays in (rewards, lengths, interactions)))


def randomize(num_interactions: int, actions: np.ndarray, generator: np.random.Generator) -> np.ndarray:
    """Replaces interaction actions by uniformly drawn ones; labeling actions pass (paper, Section 5.3)."""
    drawn = generator.integers(num_interactions, size=len(actions))
    return np.where(actions < num_interactions, drawn, actions)
