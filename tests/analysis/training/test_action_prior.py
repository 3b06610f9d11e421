"""An agent that is told which actions to prefer keeps to them as long as its entropy bonus says so."""

import numpy as np
import pytest
import seeds
import torch
import trainers

from physexp.analysis.training import finding, trainer

PRIOR = (2.0, 0.0, 0.0, 0.0, -2.0, -2.0, -2.0, -2.0)


def _first_policy(run):
    """Probabilities of the actions at an episode's start."""
    network = finding.load_network(run)
    heights = torch.full((1, 4), 0.1)
    with torch.no_grad():
        output, _ = network.step(network.encode({"heights": heights}), network.initial_state(1))
    return torch.softmax(output.logits[0], 0).numpy()


@pytest.mark.long
@pytest.mark.parametrize("algorithm", ["a3c", "ppo"])
@pytest.mark.parametrize("relative", [True, False])
def test_a_large_bonus_makes_the_policy_the_priors_or_uniform(algorithm, relative, tmp_path):
    # A bonus of 100 leaves rewards of 1 no say, so what is left is where the bonus is largest.
    # Several steps in each update: fewer are needed.
    several_steps = {"num_environments": 256, "num_minibatches": 4} if algorithm == "ppo" else {}
    run = trainers.create(
        tmp_path / "run",
        algorithm,
        seed=seeds.fresh_seed(),
        frames=40_000,
        learning_rate=0.02,
        entropy_cost=100.0,
        final_entropy_cost=100.0,
        initial_logits=PRIOR,
        kl_to_prior=relative,
        **several_steps,
    )
    trainer.train(run)
    expected = np.exp(PRIOR) / np.exp(PRIOR).sum() if relative else np.full(8, 1 / 8)
    np.testing.assert_allclose(_first_policy(run), expected, atol=0.05)
