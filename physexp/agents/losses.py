"""Returns and losses as pure functions on tensors with leading axes [T, B] (time, episode)."""

from collections.abc import Callable, Sequence

import torch

PolicyLoss = Callable[[torch.Tensor, torch.Tensor], torch.Tensor]
"""Maps log probabilities of the actions taken and their advantages, [...], to a loss."""


def discounted_returns(rewards: torch.Tensor, discounts: torch.Tensor) -> torch.Tensor:
    """Computes returns of whole episodes, G_t = r_t + d_t G_{t+1}.

    Args:
      rewards: reward that follows action t, [T, B]; zero after an episode's end.
      discounts: discount that follows action t, gamma times the environment's, [T, B]; zero from an episode's last
        action on, so that nothing is bootstrapped.

    Returns:
      Returns at each action, [T, B].
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
    """Computes advantages of whole episodes (Schulman et al., 2016, equation 16).

    A_t = delta_t + d_t lambda A_{t+1}, where delta_t = r_t + d_t V_{t+1} - V_t. With a lambda of 1 they are
    `discounted_returns` minus the values: without bias, but every action pays for the luck of the answer at the end.

    Args:
      rewards, discounts: as for `discounted_returns`, [T, B].
      values: estimates of the return at each action, [T, B]; anything where an episode is over.
      lambda_: weight of later errors, in [0, 1].

    Returns:
      Advantages, [T, B].
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
    gains nothing more.

    Args:
      behaviour: log probabilities of the actions under the policy that took them, [...].
      clip: epsilon.
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
    """Computes the three losses of advantage actor-critic (Mnih et al., 2016, Section 4), means over all leading axes.

    Args:
      logits: unnormalised log probabilities of the actions, [..., A].
      values: estimates of the return, [...].
      actions: actions taken, int64 [...].
      returns: returns that followed, the targets of the values, [...].
      advantages: by how much each action was better than expected, [...]; constants.
      prior: logits of a policy, one for each action, which the entropy is relative to; none for the uniform policy.
      policy_loss: the loss of the actions taken.

    Returns:
      Policy loss; baseline loss, half the squared error of the values; and the mean entropy of the policy (nats), to
      which a prior adds the mean of its logits: it is largest at the prior's policy.
    """
    log_probabilities = torch.log_softmax(logits, dim=-1)
    chosen = log_probabilities.gather(-1, actions[..., None]).squeeze(-1)
    relative = log_probabilities - log_probabilities.new_tensor(prior) if prior else log_probabilities
    entropy = -(log_probabilities.exp() * relative).sum(-1).mean()
    return policy_loss(chosen, advantages), 0.5 * (returns - values).square().mean(), entropy
