"""A short real training run learns to experiment; an action prior holds as long as the entropy bonus says so.

That the belief learner learns is tested with the README.
"""

import numpy as np
import pytest
import seeds
import torch
import trainers

from physexp.analysis.training import finding, playing, trainer

pytestmark = pytest.mark.long

# Small updates and an entropy cost that stays high: few frames suffice, and the agent does not learn to be silent.
HIGH_ENTROPY = {"entropy_cost": 0.15, "final_entropy_cost": 0.03}
SHORT = {
    "a3c": {"frames": 300_000, "num_workers": 2, "envs_per_worker": 64, **HIGH_ENTROPY},
    "ppo": {"frames": 60_000, "num_environments": 64, "num_minibatches": 2, **HIGH_ENTROPY},
}
LARGE_BONUS = {
    "a3c": {"frames": 20_000},
    "ppo": {"frames": 40_000, "num_environments": 256, "num_minibatches": 4},
}
PRIOR = (2.0, 0.0, 0.0, 0.0, -2.0, -2.0, -2.0, -2.0)


@pytest.mark.parametrize("algorithm", SHORT)
def test_a_short_run_finds_the_heaviest_block_far_more_often_than_chance(algorithm, tmp_path):
    run = trainers.create(
        tmp_path / "run", algorithm, **SHORT[algorithm], seed=seeds.fresh_seed(), checkpoint_seconds=60.0
    )
    trainer.train(run)
    learned, random = (playing.evaluate(run, 500, kind).summary(0.95) for kind in playing.INTERACTIONS)
    print(learned, random)
    # One of four blocks: chance is 0.25, and 500 guesses stay below 0.25 + 6 * sqrt(0.25 * 0.75 / 500) = 0.37.
    assert learned["success_rate"] > 0.6
    # Random pokes serve it worse: it needs more of them, or errs more.
    assert learned["mean_return"] > random["mean_return"]
    assert learned["median_interactions"] >= 2


def first_policy(run):
    """Probabilities of the actions at an episode's start."""
    network = finding.load_network(run)
    heights = torch.full((1, 4), 0.1)
    with torch.no_grad():
        output, _ = network.step(network.encode({"heights": heights}), network.initial_state(1))
    return torch.softmax(output.logits[0], 0).numpy()


@pytest.mark.parametrize(("algorithm", "kl_to_prior"), [("a3c", True), ("ppo", False)])
def test_a_large_bonus_makes_the_policy_the_priors_or_uniform(algorithm, kl_to_prior, tmp_path):
    # A bonus of 100 outweighs rewards of 1, so the policy goes to where the bonus is largest.
    run = trainers.create(
        tmp_path / "run",
        algorithm,
        seed=seeds.fresh_seed(),
        learning_rate=0.02,
        entropy_cost=100.0,
        final_entropy_cost=100.0,
        initial_logits=PRIOR,
        kl_to_prior=kl_to_prior,
        **LARGE_BONUS[algorithm],
    )
    trainer.train(run)
    expected = np.exp(PRIOR) / np.exp(PRIOR).sum() if kl_to_prior else np.full(8, 1 / 8)
    np.testing.assert_allclose(first_policy(run), expected, atol=0.05)
