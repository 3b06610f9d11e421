"""A short real training run learns to experiment, and its pokes are what it owes its answers to.

That of PPO is the README's, and tested with it.
"""

import pytest
import seeds
import trainers

from physexp.analysis.training import playing, trainer

# Small updates and an entropy cost that stays high: few frames suffice, and the agent does not learn to be silent.
HIGH_ENTROPY = {"entropy_cost": 0.15, "final_entropy_cost": 0.03}
SHORT = {
    "a3c": {"frames": 400_000, "num_workers": 2, "envs_per_worker": 64, **HIGH_ENTROPY},
    "belief": {"frames": 7_000, "frames_per_update": 4, "answers_revealed": True},
}


@pytest.mark.long
@pytest.mark.parametrize("algorithm", SHORT)
def test_a_short_run_finds_the_heaviest_block_far_more_often_than_chance(algorithm, tmp_path):
    run = trainers.create(
        tmp_path / "run",
        algorithm,
        **SHORT[algorithm],
        seed=seeds.fresh_seed(),
        checkpoint_seconds=60.0,
    )
    trainer.train(run)
    learned = playing.evaluate(run, 1000).summary(0.95)
    random = playing.evaluate(run, 1000, "random").summary(0.95)
    print(learned, random)
    # One of four blocks: chance is 0.25, and 1000 guesses stay below 0.25 + 6 * sqrt(0.25 * 0.75 / 1000) = 0.33.
    assert learned["success_rate"] > 0.6
    # Pokes that somebody else chose serve it worse: it needs more of them, or errs more.
    assert learned["mean_return"] > random["mean_return"]
    assert learned["median_interactions"] >= 2
