"""Returns and losses as pure functions on tensors with leading axes [T, B] (time, episode)."""

from collections.abc import Sequence

import torch

Losses = tuple[torch.Tensor, torch.Tensor, torch.Tensor]
"""Policy loss, baseline loss and entropy."""


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


def actor_critic_losses(
    logits: torch.Tensor,
    values: torch.Tensor,
    actions: torch.Tensor,
    returns: torch.Tensor,
    advantages: torch.Tensor,
    prior: Sequence[float] = (),
) -> Losses:
    """Computes the three losses of advantage actor-critic (Mnih et al., 2016, Section 4), means over all leading axes.

    Args:
      logits: unnormalised log probabilities of the actions, [..., A].
      values: estimates of the return, [...].
      actions: actions taken, int64 [...].
      returns: returns that followed, the targets of the values, [...].
      advantages: by how much each action was better than expected, [...]; constants.
      prior: logits of a policy, one for each action, which the entropy is relative to; none for the uniform policy.

    Returns:
      Policy loss, -log pi(a) times the advantage; baseline loss, half the squared error of the values; and the mean
      entropy of the policy (nats), to which a prior adds the mean of its logits: it is largest at the prior's policy.
    """
    log_probabilities = torch.log_softmax(logits, dim=-1)
    policy_loss = -(_of_actions(log_probabilities, actions) * advantages.detach()).mean()
    return policy_loss, _baseline_loss(values, returns), _entropy(log_probabilities, prior)


def clipped_losses(
    logits: torch.Tensor,
    values: torch.Tensor,
    actions: torch.Tensor,
    behaviour: torch.Tensor,
    returns: torch.Tensor,
    advantages: torch.Tensor,
    clip: float,
    prior: Sequence[float] = (),
) -> Losses:
    """Computes the three losses of PPO (Schulman et al., 2017, equations 7 and 9), means over all leading axes.

    Args:
      logits, values, actions, returns, advantages, prior: as for `actor_critic_losses`.
      behaviour: log probabilities of the actions under the policy that took them, [...].
      clip: epsilon: past a ratio of 1 - epsilon or 1 + epsilon, an action gains nothing more.

    Returns:
      Policy loss, -min(ratio times the advantage, clipped ratio times the advantage); baseline loss and entropy as of
      `actor_critic_losses`.
    """
    log_probabilities = torch.log_softmax(logits, dim=-1)
    ratios = (_of_actions(log_probabilities, actions) - behaviour).exp()
    gains = torch.minimum(ratios * advantages, ratios.clamp(1 - clip, 1 + clip) * advantages)
    return -gains.mean(), _baseline_loss(values, returns), _entropy(log_probabilities, prior)


def _of_actions(log_probabilities: torch.Tensor, actions: torch.Tensor) -> torch.Tensor:
    return log_probabilities.gather(-1, actions[..., None]).squeeze(-1)


def _baseline_loss(values: torch.Tensor, returns: torch.Tensor) -> torch.Tensor:
    return 0.5 * (returns - values).square().mean()


def _entropy(log_probabilities: torch.Tensor, prior: Sequence[float]) -> torch.Tensor:
    relative = log_probabilities - log_probabilities.new_tensor(prior) if prior else log_probabilities
    return -(log_probabilities.exp() * relative).sum(-1).mean()
