"""Returns and losses as pure functions on tensors with leading axes [T, B] (time, episode)."""

import torch


def discounted_returns(rewards: torch.Tensor, discounts: torch.Tensor) -> torch.Tensor:
    """Returns of whole episodes, G_t = r_t + d_t G_{t+1}.

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


def actor_critic_losses(logits: torch.Tensor, values: torch.Tensor, actions: torch.Tensor, returns: torch.Tensor):
    """The three losses of advantage actor-critic (Mnih et al., 2016, Section 4), averaged over all leading axes.

    Args:
      logits: unnormalised log probabilities of the actions, [..., A].
      values: estimates of the return, [...].
      actions: actions taken, int64 [...].
      returns: returns that followed, [...].

    Returns:
      Policy loss, -log pi(a) times the advantage; baseline loss, half the squared error of the values; and the mean
      entropy of the policy (nats).
    """
    log_probabilities = torch.log_softmax(logits, dim=-1)
    taken = log_probabilities.gather(-1, actions[..., None]).squeeze(-1)
    advantages = returns - values
    policy_loss = -(taken * advantages.detach()).mean()
    baseline_loss = 0.5 * advantages.square().mean()
    entropy = -(log_probabilities.exp() * log_probabilities).sum(-1).mean()
    return policy_loss, baseline_loss, entropy
