"""A3C's learner: gradients of whole episodes, applied to variables that all workers share."""

from collections.abc import Callable, Sequence
from multiprocessing import synchronize

import torch

from physexp.agents import learning, losses, networks, rounds
from physexp.agents.a3c import config as config_lib

Record = Callable[[int, dict[str, float], rounds.Round], None]
"""Receives an update: the index of its episodes, its metrics, and the round that it was made from."""


class A3CLearner(learning.Learner):
    """One worker's learner: reads the shared parameters, plays a round, and applies its gradient to them.

    Attributes:
      variables: the variables that all workers share.
    """

    def __init__(
        self,
        network: networks.RecurrentActorCritic,
        variables: learning.Variables[networks.RecurrentActorCritic],
        lock: synchronize.Lock,
        play: Callable[[int], rounds.Round],
        record: Record,
        worker: int,
        config: config_lib.A3CConfig,
    ):
        """Joins a worker's own network to the shared variables.

        Args:
          network: the worker's copy of the network.
          variables: the shared variables.
          lock: held while the shared variables are read or written.
          play: plays a round, from the index of its episodes, with the worker's network.
          record: called with each update while the lock is held: an update is in the variables and in the records, or
            in neither, whenever the worker is killed.
          worker: index of the worker.
          config: the agent's configuration.
        """
        self._network, self.variables, self._lock = network, variables, lock
        self._play, self._record, self._worker, self._config = play, record, worker, config

    def step(self) -> dict[str, float]:
        """Makes one update; returns its metrics."""
        config, variables = self._config, self.variables
        with self._lock:
            self._network.load_state_dict(variables.network.state_dict())
            frames, updates = int(variables.frames), int(variables.updates)
            episode = int(variables.rounds[self._worker])
        learning_rate, entropy_cost = config.at(frames)
        episodes = self._play(episode)
        parts = round_losses(self._network, episodes, config.discount, config.gae_lambda, config.entropy_prior)
        gradients, metrics = learning.actor_critic_gradients(
            self._network, parts, entropy_cost, config, episodes.arrays
        )
        with self._lock:
            staleness = int(variables.updates) - updates
            variables.rounds[self._worker] += 1
            variables.apply(gradients, learning_rate)
            variables.count(episodes.num_frames)
            metrics |= {
                "learning_rate": learning_rate,
                "entropy_cost": entropy_cost,
                "updates": int(variables.updates),
                "frames": int(variables.frames),
                "staleness": staleness,
            }
            self._record(episode, metrics, episodes.record())
        return metrics


def round_losses(
    network: networks.RecurrentActorCritic,
    episodes: rounds.Round,
    discount: float,
    trace: float = 1.0,
    prior: Sequence[float] = (),
) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    """Computes the losses of a round (see `losses.actor_critic_losses`), the network unrolled over whole episodes."""
    episodes = episodes.select()
    assert isinstance(episodes.inputs, torch.Tensor)
    logits, values = network.unroll(episodes.inputs, episodes.batch_sizes)
    returns, advantages = learning.targets(episodes, values.detach().cpu(), discount, trace)
    actions, returns, advantages = (
        array.to(logits.device) for array in (episodes.packed(episodes.actions), returns, advantages)
    )
    return losses.actor_critic_losses(logits, values, actions, returns, advantages, prior)
