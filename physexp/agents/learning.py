"""Parts that learners share: variables that Adam moves, targets of whole episodes, clipped gradients."""

from collections.abc import Mapping, Sequence
import functools
from typing import Generic, Self, TypeVar

import numpy as np
import torch
from torch.optim import adamw

from physexp.agents import config as config_lib
from physexp.agents import core, losses, networks, rounds
from physexp.agents import tensors as tensors_lib

MAX_GRADIENT_NORM = 1.0
"""Gradients are clipped to this norm: single batches of whole episodes can have ten times the usual one."""

# As `torch.optim.AdamW`, whose first instance imports torch's compiler, which takes as long as torch itself.
_move = functools.partial(adamw.adamw, beta1=0.9, beta2=0.999, eps=1e-5, amsgrad=False, maximize=False, foreach=False)

Network = TypeVar("Network", bound=networks.RecurrentNetwork)


class Variables(Generic[Network]):
    """All variables that training changes.

    Attributes:
      network: the network.
      frames: environment steps trained on, int64 [].
      updates: updates made, int64 [].
      rounds: rounds played by each worker, int64 [num_workers].
    """

    def __init__(self, network: Network, num_workers: int = 1, weight_decay: float = 0.0):
        """Makes the statistics of Adam for a network, and counters at zero.

        Each step shrinks the weights, but not the biases, by `weight_decay` times the learning rate (Loshchilov &
        Hutter, 2019).
        """
        self.network, self._weight_decay = network, weight_decay
        self._trained: dict[str, torch.Tensor] = {
            name: each for name, each in network.named_parameters() if each.requires_grad
        }
        self._statistics = {
            name: {
                "step": torch.zeros(()),
                "exp_avg": torch.zeros_like(parameter.data),
                "exp_avg_sq": torch.zeros_like(parameter.data),
            }
            for name, parameter in self._trained.items()
        }
        self.frames, self.updates, self.rounds = (
            torch.zeros(shape, dtype=torch.int64) for shape in ((), (), num_workers)
        )

    def share_memory(self) -> Self:
        """Moves everything into memory that other processes can share; returns self."""
        self.network.share_memory()
        for value in self.tensors().values():
            value.share_memory_()
        return self

    def tensors(self) -> dict[str, torch.Tensor]:
        """Returns everything, by name; not copies."""
        named = {f"network/{name}": value for name, value in self.network.state_dict().items()}
        for name, statistics in self._statistics.items():
            for statistic, value in statistics.items():
                named[f"optimizer/{name}/{statistic}"] = value
        return {**named, "frames": self.frames, "updates": self.updates, "rounds": self.rounds}

    def save(self) -> dict[str, torch.Tensor]:
        """Returns copies of everything, by name, on the CPU."""
        return {name: value.to("cpu", copy=True) for name, value in self.tensors().items()}

    def restore(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Restores everything from the result of `save`; raises ValueError, and changes nothing, if it does not fit."""
        own = self.tensors()
        try:
            tensors_lib.check(tensors, own)
        except ValueError as error:
            raise ValueError(f"the checkpoint {error}") from None
        for name, value in own.items():
            value.copy_(tensors[name])

    @torch.no_grad()
    def apply(self, gradients: Sequence[torch.Tensor], learning_rate: float) -> None:
        """Moves the parameters by one step of Adam; the counters stay."""
        for (name, parameter), gradient in zip(self._trained.items(), gradients, strict=True):
            step, average, square = ([each] for each in self._statistics[name].values())
            decay = 0.0 if "bias" in name else self._weight_decay
            moved, along = [parameter], [gradient.to(parameter.device)]
            _move(moved, along, average, square, [], step, lr=learning_rate, weight_decay=decay)

    def count(self, num_frames: int, worker: int = 0) -> dict[str, float]:
        """Counts a worker's round of `num_frames` environment steps and its update; returns both counts by name."""
        self.rounds[worker] += 1
        self.frames += num_frames
        self.updates += 1
        return {"updates": int(self.updates), "frames": int(self.frames)}


def network_variables(tensors: Mapping[str, torch.Tensor]) -> dict[str, torch.Tensor]:
    """Returns the network's variables among the tensors of `Variables.save`, by name."""
    prefix = "network/"
    return {name.removeprefix(prefix): value for name, value in tensors.items() if name.startswith(prefix)}


def targets(
    episodes: rounds.Round, values: torch.Tensor, discount: float, trace: float
) -> tuple[torch.Tensor, torch.Tensor]:
    """Computes returns and advantages of a round's actions, packed, float32 [N] each.

    `values` estimate the return at each action, packed, [N]; `trace` is the lambda of
    `losses.generalized_advantages`.
    """
    rewards, played = torch.from_numpy(episodes.rewards), torch.from_numpy(episodes.played)
    goes_on = episodes.played & ~episodes.is_last
    discounts = torch.from_numpy((discount * goes_on).astype(np.float32))
    returns = losses.discounted_returns(rewards, discounts)
    advantages = losses.generalized_advantages(rewards, discounts, episodes.padded(values), trace)
    return returns[played], advantages[played]


def actor_critic_gradients(
    network: networks.RecurrentActorCritic,
    episodes: rounds.Round,
    config: config_lib.ActorCriticConfig,
    entropy_cost: float,
    policy_loss: losses.PolicyLoss = losses.policy_gradient_loss,
) -> tuple[list[torch.Tensor], dict[str, float]]:
    """Returns the clipped gradient of an actor-critic's loss for each parameter, and the metrics of the loss.

    The network is unrolled over whole episodes, in the order of `Round.select`. Advantages are relative to the values
    that were estimated when they were played, or else to the network's own. Raises as `clipped_gradients`.
    """
    inputs = network.encode(episodes.observation) if episodes.inputs is None else episodes.inputs
    logits, values = network.unroll(inputs, episodes.batch_sizes)
    expected = values.detach().cpu() if episodes.values is None else episodes.values
    returns, advantages = targets(episodes, expected, config.discount, config.gae_lambda)
    actions, returns, advantages = (
        array.to(logits.device) for array in (episodes.packed(episodes.actions), returns, advantages)
    )
    policy, baseline, entropy = losses.actor_critic_losses(
        logits, values, actions, returns, advantages, config.entropy_prior, policy_loss
    )
    loss = policy + config.baseline_cost * baseline - entropy_cost * entropy
    gradients, norm = clipped_gradients(network, loss, episodes)
    means = {"policy_loss": policy.item(), "baseline_loss": baseline.item(), "entropy": entropy.item()}
    return gradients, {**means, "gradient_norm": norm}


def clipped_gradients(
    network: torch.nn.Module, loss: torch.Tensor, episodes: rounds.Round
) -> tuple[list[torch.Tensor], float]:
    """Returns the gradient of a loss for each parameter, clipped to a global norm, and the norm before clipping.

    Raises DivergedError, with the arrays of the episodes, if the loss or the norm is not finite.
    """
    network.zero_grad()
    loss.backward()
    norm = torch.nn.utils.clip_grad_norm_(network.parameters(), MAX_GRADIENT_NORM)
    if not (torch.isfinite(loss) and torch.isfinite(norm)):
        raise core.DivergedError(f"loss {loss.item()} with gradient norm {norm.item()}", episodes.arrays())
    gradients = [parameter.grad for parameter in network.parameters()]
    return [gradient for gradient in gradients if gradient is not None], norm.item()
