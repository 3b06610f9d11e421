"""Learning: gradients of whole episodes, applied to parameters and optimizer statistics that all workers share."""

from collections.abc import Iterator

import numpy as np
import torch

from physexp.agents import core, losses, networks
from physexp.agents.a3c import acting
from physexp.agents.a3c import config as config_lib


class DivergedError(RuntimeError):
    """The loss or its gradient is not finite; `round` holds the episodes that made it so."""

    def __init__(self, message: str, episodes: acting.Round):
        super().__init__(message)
        self.round = episodes


class SharedVariables:
    """What the workers share: parameters, Adam's statistics, and counters, all in shared memory.

    Attributes:
      network: the shared network.
      optimizer: Adam on its parameters.
      frames: environment steps trained on, int64 [].
      updates: updates made, int64 [].
      rounds: rounds played by each worker, int64 [num_workers].
    """

    def __init__(self, network: networks.RecurrentActorCritic, num_workers: int):
        """Moves a network into shared memory and gives it an optimizer."""
        self.network = network.share_memory()
        self.optimizer = torch.optim.Adam(network.parameters(), eps=1e-5, foreach=False)
        for parameter in network.parameters():  # Before the workers start, or each would make its own.
            self.optimizer.state[parameter] = {
                "step": torch.zeros(()).share_memory_(),
                "exp_avg": torch.zeros_like(parameter.data).share_memory_(),
                "exp_avg_sq": torch.zeros_like(parameter.data).share_memory_(),
            }
        self.frames, self.updates, self.rounds = (
            torch.zeros(shape, dtype=torch.int64).share_memory_() for shape in ((), (), num_workers)
        )

    def tensors(self) -> dict[str, torch.Tensor]:
        """Everything shared, by name; not copies."""
        named = {f"network/{name}": value for name, value in self.network.state_dict().items()}
        for name, parameter in self.network.named_parameters():
            for statistic, value in self.optimizer.state[parameter].items():
                named[f"optimizer/{name}/{statistic}"] = value
        return {**named, "frames": self.frames, "updates": self.updates, "rounds": self.rounds}


class A3CLearner(core.Learner):
    """One worker's learner: takes rounds of episodes, moves the shared variables."""

    def __init__(self, network: networks.RecurrentActorCritic, shared: SharedVariables, lock,
                 rounds: Iterator[acting.Round], worker: int, config: config_lib.A3CConfig):  # fmt: skip
        """Joins a worker's own network to the shared variables.

        Args:
          network: the worker's own copy of the network.
          shared: what all workers share.
          lock: held while the shared variables are read or written.
          rounds: episodes to learn from, each played with the network as it is at that moment.
          worker: index of the worker.
          config: the agent's configuration.
        """
        self._network, self._shared, self._lock = network, shared, lock
        self._rounds, self._worker, self._config = rounds, worker, config

    def step(self) -> dict[str, float]:
        """Takes the shared parameters, plays a round, and applies its gradient to the shared variables."""
        with self._lock:
            self._network.load_state_dict(self._shared.network.state_dict())
            progress = min(1.0, self._shared.frames.item() / self._config.frames)
        number = self._shared.rounds[self._worker].item()
        self.last_round = episodes = next(self._rounds)
        metrics = self._compute_gradients(episodes, progress)
        with self._lock:
            self._apply_gradients(episodes.num_frames, progress)
            metrics |= {"rounds": number, "updates": self._shared.updates.item(), "frames": self._shared.frames.item()}
        return metrics

    def _compute_gradients(self, episodes: acting.Round, progress: float) -> dict[str, float]:
        config = self._config
        entropy_cost = config.entropy_cost ** (1 - progress) * config.final_entropy_cost**progress
        policy_loss, baseline_loss, entropy = round_losses(self._network, episodes, config.discount, config.trace)
        loss = policy_loss + config.baseline_cost * baseline_loss - entropy_cost * entropy
        self._network.zero_grad()
        loss.backward()
        norm = torch.nn.utils.clip_grad_norm_(self._network.parameters(), config.max_gradient_norm)
        if not (torch.isfinite(loss) and torch.isfinite(norm)):
            raise DivergedError(f"loss {loss.item()} with gradient norm {norm.item()}", episodes.detached())
        return {
            "policy_loss": policy_loss.item(),
            "baseline_loss": baseline_loss.item(),
            "entropy": entropy.item(),
            "gradient_norm": norm.item(),
            "learning_rate": config.learning_rate * (1 - progress),
            "entropy_cost": entropy_cost,
        }

    def _apply_gradients(self, num_frames: int, progress: float) -> None:
        shared = self._shared
        for target, own in zip(shared.network.parameters(), self._network.parameters(), strict=True):
            assert own.grad is not None  # Every parameter takes part in the loss.
            target.grad = own.grad.to(target.device)
        for group in shared.optimizer.param_groups:
            group["lr"] = self._config.learning_rate * (1 - progress)
        shared.optimizer.step()
        shared.frames += num_frames
        shared.updates += 1
        shared.rounds[self._worker] += 1

    def get_variables(self):
        with self._lock:
            return {name: value.clone() for name, value in self._shared.network.state_dict().items()}

    def save(self):
        with self._lock:
            return {name: value.clone() for name, value in self._shared.tensors().items()}

    def restore(self, state):
        with self._lock:
            for name, value in self._shared.tensors().items():
                value.copy_(state[name])


def round_losses(network: networks.RecurrentActorCritic, episodes: acting.Round, discount: float, trace: float = 1.0):
    """The losses of a round (see `losses.actor_critic_losses`), the network unrolled over whole episodes."""
    order = np.argsort(-episodes.lengths, kind="stable")
    lengths = episodes.lengths[order]
    times = np.arange(len(episodes.actions))[:, None]
    played = times < lengths
    logits, values = network.unroll(episodes.packed_inputs(order), torch.from_numpy(played.sum(axis=1)))
    rewards = torch.from_numpy(episodes.rewards[:, order])
    discounts = torch.from_numpy((discount * (times < lengths - 1)).astype(np.float32))
    returns = losses.discounted_returns(rewards, discounts)
    mask = torch.from_numpy(played)
    padded_values = torch.zeros_like(rewards).masked_scatter_(mask, values.detach().cpu())
    advantages = losses.generalized_advantages(rewards, discounts, padded_values, trace)
    actions = episodes.packed(episodes.actions, order)
    packed = (array.to(logits.device) for array in (actions, returns[mask], advantages[mask]))
    return losses.actor_critic_losses(logits, values, *packed)
