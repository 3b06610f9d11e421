"""Learning: gradients of whole episodes, applied to variables that all workers share."""

from collections.abc import Callable, Mapping
from typing import Protocol

import torch

from physexp.agents import acting, core, learning, losses, networks
from physexp.agents.a3c import config as config_lib


class Shared(Protocol):
    """Variables that many workers share, wherever they are kept."""

    def count_frames(self) -> int:
        """Environment steps trained on."""

    def pull(self, network: networks.RecurrentActorCritic, worker: int) -> tuple[int, int]:
        """Copies the parameters into a worker's network; returns frames trained on, and rounds the worker has had."""

    def push(self, gradients: list[torch.Tensor], learning_rate: float, num_frames: int, worker: int) -> dict:
        """Applies a worker's gradients; returns the counters `updates` and `frames`."""

    def save(self) -> dict[str, torch.Tensor]:
        """Copies of all variables, by name."""

    def restore(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Takes up what `save` returned."""


class SharedMemory(Shared):
    """Variables in memory that the workers of one machine share.

    Attributes:
      variables: themselves.
      lock: held while they are read or written.
    """

    def __init__(self, variables: learning.Variables, lock):
        self.variables, self.lock = variables.share_memory(), lock

    def count_frames(self):
        return int(self.variables.frames)

    def pull(self, network, worker):
        with self.lock:
            network.load_state_dict(self.variables.network.state_dict())
            return int(self.variables.frames), int(self.variables.rounds[worker])

    def push(self, gradients, learning_rate, num_frames, worker):
        with self.lock:
            self.variables.apply(gradients, learning_rate)
            self.variables.count(num_frames, worker)
            return {"updates": self.variables.updates.item(), "frames": self.variables.frames.item()}

    def save(self):
        with self.lock:
            return self.variables.save()

    def restore(self, tensors):
        with self.lock:
            self.variables.restore(tensors)


class A3CLearner(core.Learner):
    """One worker's learner: takes rounds of episodes, moves the shared variables.

    Attributes:
      last_round: what the last update learned from.
    """

    last_round: acting.Round

    def __init__(self, network: networks.RecurrentActorCritic, shared: Shared,
                 play: Callable[[int], acting.Round], worker: int, config: config_lib.A3CConfig):  # fmt: skip
        """Joins a worker's own network to the shared variables.

        Args:
          network: the worker's own copy of the network.
          shared: what all workers share.
          play: plays a round, from its number, with the network as it is.
          worker: index of the worker.
          config: the agent's configuration.
        """
        self._network, self._shared, self._play = network, shared, play
        self._worker, self._config = worker, config

    def step(self) -> dict[str, float]:
        """Takes the shared parameters, plays a round, and applies its gradient to the shared variables."""
        config = self._config
        frames, number = self._shared.pull(self._network, self._worker)
        learning_rate, entropy_cost = config.at(min(1.0, frames / config.frames))
        self.last_round = episodes = self._play(number)
        policy_loss, baseline_loss, entropy = round_losses(self._network, episodes, config.discount, config.trace)
        loss = policy_loss + config.baseline_cost * baseline_loss - entropy_cost * entropy
        gradients, norm = learning.clipped_gradients(self._network, loss, config.max_gradient_norm, episodes)
        counters = self._shared.push(gradients, learning_rate, episodes.num_frames, self._worker)
        return {
            "policy_loss": policy_loss.item(),
            "baseline_loss": baseline_loss.item(),
            "entropy": entropy.item(),
            "gradient_norm": norm,
            "learning_rate": learning_rate,
            "entropy_cost": entropy_cost,
            "rounds": number,
            **counters,
        }

    def get_variables(self):
        return learning.network_variables(self.save())

    def save(self):
        return self._shared.save()

    def restore(self, state):
        self._shared.restore(state)


def round_losses(network: networks.RecurrentActorCritic, episodes: acting.Round, discount: float, trace: float = 1.0):
    """The losses of a round (see `losses.actor_critic_losses`), the network unrolled over whole episodes."""
    episodes = episodes.select()
    assert isinstance(episodes.inputs, torch.Tensor)
    logits, values = network.unroll(episodes.inputs, episodes.batch_sizes)
    returns, advantages = learning.targets(episodes, values.detach().cpu(), discount, trace)
    packed = (array.to(logits.device) for array in (episodes.packed(episodes.actions), returns, advantages))
    return losses.actor_critic_losses(logits, values, *packed)
