"""Returns and losses as pure functions on tensors with leading axes [T, B] (time, episode)."""

from collections.abc import Callable, Sequence

import torch

PolicyLoss = Callable[[torch.Tensor, torch.Tensor], torch.Tensor]
"""Maps log probabilities of the actions taken and their advantages, [...], to a loss."""


def discounted_returns(rewards: torch.Tensor, discounts: torch.Tensor) -> torch.Tensor:
    """Returns G_t = r_t + d_t G_{t+1} at each action of whole episodes, [T, B].

    Rewards and discounts, [T, B], follow action t. Rewards are zero after an episode's end, and discounts, gamma times
    the environment's, from its last action on, so that nothing is bootstrapped.
    """
    returns = torch.zeros_like(rewards)
    following = torch.zeros_like(rewards[0])
    for t in reversed(range(len(rewards))):
        following = rewards[t] + discounts[t] * following
        returns[t] = following
    return returns


def generalized_advantages(
    rewards: torch.Tensor, discounts: torch.Tensor, values: torch.Tensor, lambda_: float
) -> torch.Tensor:
    """Returns the advantages of whole episodes, [T, B] (Schulman et al., 2016, equation 16).

    A_t = delta_t + d_t lambda A_{t+1}, where delta_t = r_t + d_t V_{t+1} - V_t. With a lambda of 1 they are
    `discounted_returns` minus the values: without bias, but every action pays for the luck of the answer at the end.
    Values, [T, B], are estimates of the return at each action, and anything where an episode is over.
    """
    advantages = torch.zeros_like(rewards)
    following, next_value = torch.zeros_like(rewards[0]), torch.zeros_like(rewards[0])
    for t in reversed(range(len(rewards))):
        delta = rewards[t] + discounts[t] * next_value - values[t]
        advantages[t] = following = delta + discounts[t] * lambda_ * following
        next_value = values[t]
    return advantages


def policy_gradient_loss(chosen: torch.Tensor, advantages: torch.Tensor) -> torch.Tensor:
    """Returns the mean of -log pi(a) times the advantage; see `PolicyLoss`."""
    return -(chosen * advantages.detach()).mean()


def clipped_policy_loss(behaviour: torch.Tensor, clip: float) -> PolicyLoss:
    """Returns the policy loss of PPO (Schulman et al., 2017, equation 7).

    It is the mean of -min(ratio times the advantage, clipped ratio times the advantage), with the ratio of the policy's
    probability of an action to that under the policy that took it. Past a ratio of 1 - epsilon or 1 + epsilon an action
    gains nothing more. `behaviour` has log probabilities of the actions under that policy, [...]; `clip` is epsilon.
    """

    def loss(chosen: torch.Tensor, advantages: torch.Tensor) -> torch.Tensor:
        ratios = (chosen - behaviour).exp()
        return -torch.minimum(ratios * advantages, ratios.clamp(1 - clip, 1 + clip) * advantages).mean()

    return loss


def actor_critic_losses(
    logits: torch.Tensor,
    values: torch.Tensor,
    actions: torch.Tensor,
    returns: torch.Tensor,
    advantages: torch.Tensor,
    prior: Sequence[float] = (),
    policy_loss: PolicyLoss = policy_gradient_loss,
) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    """Returns the three losses of advantage actor-critic (Mnih et al., 2016, Section 4), means over all leading axes.

    They are the policy loss; the baseline loss, half the squared error of the values; and the mean entropy of the
    policy (nats), to which a prior, logits for each action, adds the mean of its logits: it is largest at the prior's
    policy. Logits are [..., A], actions int64 [...], and the others [...]; advantages are constants.
    """
    log_probabilities = torch.log_softmax(logits, dim=-1)
    chosen = log_probabilities.gather(-1, actions[..., None]).squeeze(-1)
    relative = log_probabilities - log_probabilities.new_tensor(prior) if prior else log_probabilities
    entropy = -(log_probabilities.exp() * relative).sum(-1).mean()
    return policy_loss(chosen, advantages), 0.5 * (returns - values).square().mean(), entropy
