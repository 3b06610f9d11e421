"""Returns and losses agree with values derived by hand."""

import math

from dm_env import specs
import numpy as np
import pytest
from seeds import fresh_seed
import torch

from physexp.agents import learning, losses, networks, rounds
from physexp.agents.a3c import config as a3c


def test_advantages_with_a_lambda_of_one_are_returns_minus_values():
    generator = torch.Generator().manual_seed(fresh_seed())
    rewards, values = (torch.randn(6, 4, generator=generator) for _ in range(2))
    lengths = torch.tensor([1, 3, 5, 6])
    discounts = 0.9 * (torch.arange(6)[:, None] < lengths - 1)
    advantages = losses.generalized_advantages(rewards, discounts, values, 1.0)
    expected = losses.discounted_returns(rewards, discounts) - values
    played = torch.arange(6)[:, None] < lengths
    torch.testing.assert_close(advantages[played], expected[played])


def test_advantages_look_as_far_as_their_lambda():
    # Two steps, rewards 0 and 1, values 0.5 and 0.2, discount 0.5, then the end. The errors of one step are
    # 0 + 0.5 * 0.2 - 0.5 = -0.4 and 1 - 0.2 = 0.8; with a lambda of 0.25 the first adds 0.5 * 0.25 * 0.8 = 0.1.
    rewards, values = torch.tensor([[0.0], [1.0]]), torch.tensor([[0.5], [0.2]])
    discounts = torch.tensor([[0.5], [0.0]])
    for lambda_, first in ((0.0, -0.4), (0.25, -0.3)):
        advantages = losses.generalized_advantages(rewards, discounts, values, lambda_)
        torch.testing.assert_close(advantages, torch.tensor([[first], [0.8]]))


def test_the_losses_of_two_steps_are_those_computed_by_hand():
    # Logits (0, 0): pi = 1/2, 1/2; entropy ln 2. Logits (ln 3, 0): pi = 3/4, 1/4;
    # entropy -(3/4 ln 3/4 + 1/4 ln 1/4) = ln 4 - 3/4 ln 3.
    # Actions 0 and 1, returns 1 and -1, values 0.5 and 0: advantages 0.5 and -1.
    # Policy loss: mean(-ln(1/2) * 0.5, -ln(1/4) * -1) = (0.5 ln 2 - 2 ln 2) / 2 = -0.75 ln 2.
    # Baseline loss: 0.5 * mean(0.25, 1) = 0.3125.
    policy_loss, baseline_loss, entropy = losses.actor_critic_losses(
        torch.tensor([[0.0, 0.0], [math.log(3), 0.0]]),
        torch.tensor([0.5, 0.0]),
        torch.tensor([0, 1]),
        torch.tensor([1.0, -1.0]),
        torch.tensor([0.5, -1.0]),
    )
    assert policy_loss.item() == pytest.approx(-0.75 * math.log(2), abs=1e-6)
    assert baseline_loss.item() == pytest.approx(0.3125, abs=1e-6)
    assert entropy.item() == pytest.approx((math.log(2) + math.log(4) - 0.75 * math.log(3)) / 2, abs=1e-6)


def test_entropy_relative_to_a_prior_pulls_the_policy_towards_it():
    # Policy 3/4, 1/4, prior logits 2 and 0: the entropy ln 4 - 3/4 ln 3 and the mean logit 3/4 * 2.
    # Policy gradients vanish where advantages are 0, so the step is the bonus's alone.
    logits, prior = torch.tensor([[math.log(3), 0.0]], requires_grad=True), (2.0, 0.0)
    nothing, action = torch.zeros(1), torch.tensor([0])

    def entropy_of(logits, prior):
        return losses.actor_critic_losses(logits, nothing, action, nothing, nothing, prior)[2]

    entropy = entropy_of(logits, prior)
    assert entropy.item() == pytest.approx(math.log(4) - 0.75 * math.log(3) + 1.5, abs=1e-6)
    towards, towards_uniform = (torch.autograd.grad(entropy_of(logits, each), logits)[0] for each in (prior, ()))
    # ln 3 is less than the prior's 2 and more than the uniform policy's 0.
    assert towards[0, 0] > 0 > towards[0, 1] and towards_uniform[0, 0] < 0 < towards_uniform[0, 1]
    at_prior = entropy_of(torch.tensor([prior]), prior)
    assert at_prior.item() == pytest.approx(math.log(math.exp(2) + 1), abs=1e-6) and at_prior > entropy


def test_gradients_of_each_loss_reach_their_own_inputs_alone():
    logits = torch.tensor([[0.0, 1.0]], requires_grad=True)
    values = torch.tensor([0.5], requires_grad=True)
    policy_loss, baseline_loss, entropy = losses.actor_critic_losses(
        logits, values, torch.tensor([0]), torch.tensor([1.0]), torch.tensor([0.5])
    )
    # The policy loss is -log pi(0) * 0.5; its gradient on the logits is 0.5 * (pi - onehot).
    (gradient,) = torch.autograd.grad(policy_loss, logits, retain_graph=True)
    torch.testing.assert_close(gradient, 0.5 * (torch.softmax(logits, -1) - torch.tensor([[1.0, 0.0]])))
    # 0.5 (G - V)^2 has the gradient V - G = -0.5 on the value.
    assert torch.autograd.grad(baseline_loss, values, retain_graph=True)[0].tolist() == [-0.5]
    for loss, stranger in ((policy_loss, values), (entropy, values), (baseline_loss, logits)):
        assert torch.autograd.grad(loss, stranger, retain_graph=True, allow_unused=True)[0] is None


def test_losses_of_a_round_are_means_over_the_steps_played():
    # Two episodes of 1 and 3 actions with a network whose heads are zero: uniform over 8 actions, values 0, so
    # entropy = ln 8, and with gamma = 0.5 the returns are: a: 1; b: -0.25, -0.5, -1 (rewards 0, 0, -1).
    # Policy loss: ln 8 * mean(1, -0.25, -0.5, -1) = ln 8 * -0.75 / 4.
    # Baseline loss: 0.5 * (1 + 0.0625 + 0.25 + 1) / 4.
    spec = {"heights": specs.Array((4,), np.float32)}
    network = networks.RecurrentActorCritic(spec, 8, observation_scale=10.0)
    with torch.no_grad():
        for head in (network.policy, network.value):
            head.weight.zero_()
            head.bias.zero_()
    inputs = network.encode({"heights": torch.zeros(4, 4)}).detach()
    rewards = np.array([[1, 0], [0, 0], [0, -1]], np.float32)
    episodes = rounds.Round(np.zeros((3, 2), np.int64), rewards, np.array([1, 3]), np.zeros(2, np.int64), inputs)
    config = a3c.A3CConfig(discount=0.5)
    _, metrics = learning.actor_critic_gradients(network, episodes.select(), config, 0.0)
    assert metrics["policy_loss"] == pytest.approx(math.log(8) * -0.75 / 4, abs=1e-6)
    assert metrics["baseline_loss"] == pytest.approx(0.5 * 2.3125 / 4, abs=1e-6)
    assert metrics["entropy"] == pytest.approx(math.log(8), abs=1e-6)


def test_a_likelier_action_gains_up_to_the_clip_and_costs_in_full():
    # Action 0 has probability 1/2 now and was taken with 1/4, twice: the ratio is 2; clip 0.2 leaves 1.2. An advantage
    # of 1 gains min(2, 1.2) = 1.2; one of -1 gains min(-2, -1.2) = -2. Policy loss: -(1.2 - 2) / 2 = 0.4.
    chosen, behaviour = torch.full((2,), math.log(0.5)), torch.full((2,), math.log(0.25))
    policy_loss = losses.clipped_policy_loss(behaviour, clip=0.2)
    assert policy_loss(chosen, torch.tensor([1.0, -1.0])).item() == pytest.approx(0.4, abs=1e-6)


def test_an_action_that_has_gained_its_clip_is_pushed_no_further():
    # Ratios of an action whose advantage is positive: 1 (just played) and 2 (past the clip). Only the first has a
    # gradient, that of the plain policy gradient: pi - onehot, over the mean of two.
    logits = torch.zeros(2, 2, requires_grad=True)
    behaviour = torch.tensor([math.log(0.5), math.log(0.25)])
    ones, policy_loss = torch.ones(2), losses.clipped_policy_loss(behaviour, clip=0.2)
    actions = torch.tensor([0, 0])
    loss, _, _ = losses.actor_critic_losses(logits, ones, actions, ones, ones, policy_loss=policy_loss)
    (gradient,) = torch.autograd.grad(loss, logits)
    torch.testing.assert_close(gradient, torch.tensor([[-0.25, 0.25], [0.0, 0.0]]))
