"""Evaluation: numbers derived by hand, the paper's randomized interaction, seeds, and how agents are found."""

import dataclasses

from chance import P_VALUE
import evaluation_figures
import numpy as np
import pytest
from scipy import stats
from seeds import fresh_seed
import torch
import trainers

from physexp.analysis.data import episodes
from physexp.analysis.training import finding, playing, trainer
from physexp.analysis.training import run as run_lib


def test_the_summary_of_four_episodes_is_the_one_computed_by_hand():
    # Right at once; wrong after two pokes; out of time after 100 pokes; right after one poke.
    actions = np.full((4, 100), -1)
    for row, taken in zip(actions, ([4], [0, 1, 6], [0] * 100, [3, 7]), strict=True):
        row[: len(taken)] = taken
    played = episodes.Episodes(
        seed=np.arange(4),
        episode=np.zeros(4, int),
        hidden=np.zeros((4, 4)),
        answer=np.array([0, 1, 2, 3]),
        label=np.array([0, 2, -1, 3]),
        reward=np.array([1.0, -1.0, -1.0, 1.0]),
        length=np.array([1, 3, 100, 2]),
        interactions=np.array([0, 2, 100, 1]),
        num_questions=np.ones(4, int),
        actions=actions,
        rewards=np.where(np.arange(100) == np.array([[0], [2], [99], [1]]), [[1.0], [-1.0], [-1.0], [1.0]], 0.0),
    )
    summary = played.summary(0.9)
    assert list(summary) == evaluation_figures.NAMES
    assert summary["episodes"] == 4
    assert summary["success_rate"] == 0.5
    # The reward of an episode of n actions is discounted n - 1 times: (1 - 0.9^2 - 0.9^99 + 0.9) / 4.
    assert summary["mean_return"] == pytest.approx((1 - 0.81 - 0.9**99 + 0.9) / 4)
    assert summary["mean_interactions"] == 25.75  # 103 / 4
    assert summary["median_interactions"] == 1.5  # Between 1 and 2.
    assert summary["timeouts"] == 1  # The only one that consists of pokes alone.
    # Wilson's interval for 2 of 4 is centred on 1/2; its half width is z / (1 + z^2/4) * sqrt(1/16 + z^2/64)
    # = z / (2 sqrt(4 + z^2)) with z = 1.959964: 0.349951.
    assert summary["success_interval"] == pytest.approx([0.150049, 0.849951], abs=2e-5)


def test_randomized_interaction_passes_labels_and_draws_every_poke_anew():
    seed = fresh_seed()
    generator = np.random.default_rng(seed)
    actions = generator.integers(0, 8, 40_000)
    actions[:8_000] = 2  # One block is wanted most of all.
    choose = playing.randomized(lambda logits, environments, step: actions, 4, generator)
    replaced = choose(torch.zeros(len(actions), 8), np.arange(len(actions)), 0)
    labels = actions >= 4
    np.testing.assert_array_equal(replaced[labels], actions[labels])
    for wanted in range(4):  # Uniform over 0 to 3, given any poke that was wanted.
        counts = np.bincount(replaced[actions == wanted], minlength=4)
        assert len(counts) == 4
        assert stats.chisquare(counts).pvalue > P_VALUE


def test_evaluation_repeats_with_its_seed_and_differs_with_another(untrained):
    seed = fresh_seed()
    first, again, other = (playing.evaluate(untrained, 300, seed=s) for s in (seed, seed, seed + 1))
    for field in dataclasses.fields(episodes.Episodes):
        values, repeated = getattr(first, field.name), getattr(again, field.name)
        assert len(values) == len(repeated) == 300
        for value, same in zip(values, repeated, strict=True):
            np.testing.assert_array_equal(value, same)
    assert not (np.array_equal(first.length, other.length) and np.array_equal(first.reward, other.reward))


def test_evaluation_refuses_what_makes_no_sense(untrained, tmp_path):
    with pytest.raises(ValueError, match="interaction is 'guessed'; choose from learned, random"):
        playing.evaluate(untrained, 10, "guessed")
    with pytest.raises(ValueError, match="episodes is 0; give a number >= 1"):
        playing.evaluate(untrained, 0)
    for path in untrained.checkpointer.paths():
        path.unlink()
    with pytest.raises(ValueError, match="holds no checkpoint yet"):
        playing.evaluate(untrained, 10)
    with pytest.raises(ValueError, match="holds no run"):
        playing.evaluate(run_lib.Run(tmp_path / "nothing"), 10)


def test_the_evaluated_network_is_that_of_the_last_checkpoint(untrained):
    tensors, facts = untrained.checkpointer.latest()
    # A policy that always says label 3 (action 7) at once is right exactly where the answer is 3.
    tensors["network/policy.weight"].zero_()
    tensors["network/policy.bias"].copy_(torch.tensor([0.0] * 7 + [100.0]))
    tensors["frames"] += 1
    untrained.checkpointer.save(tensors, facts)
    played = playing.evaluate(untrained, 200, seed=fresh_seed())
    assert (played.length == 1).all() and not played.interactions.any()
    assert 0 < (played.reward > 0).sum() < 200


@pytest.mark.parametrize(
    ("target", "options", "message"),
    [
        ("which_is_heavier/features", {"difficulty": 4}, "features-difficulty4; .*features-difficulty3"),
        ("towers/fist_features", {"difficulty": 3}, "towers/fist_features has no difficulty, and difficulty is 3"),
        ("towers/fist_features", {"control_timestep": 0.05}, "trained at control_timestep 0.1, and control_timestep"),
        ("towres/fist_features", None, "or a trained agent: towers/fist_features, towers-fist_features"),
        ("fly", None, "holds no run .* or a trained agent: DOMAIN/TASK, as `physexp tasks` lists them$"),
    ],
)
def test_a_missing_agent_is_refused_with_a_list_of_others(target, options, message):
    with pytest.raises(ValueError, match=message) as refused:
        finding.find_agent(target, options)
    assert "\n" not in str(refused.value)


def test_a_run_is_found_with_the_options_it_was_trained_with(untrained):
    own = {"difficulty": 10, "control_timestep": 0.1}  # The second is the task's, which the run has not changed.
    assert finding.find_agent(str(untrained.path), own).config == untrained.config
    with pytest.raises(ValueError, match="was trained at difficulty 10, and difficulty is 5"):
        finding.find_agent(str(untrained.path), {"difficulty": 5})


def test_a_belief_learner_with_other_hyperparameters_is_found(tmp_path):
    run = trainers.create(tmp_path / "run", "belief", frames=100, memory="lstm", max_interactions=39)
    trainer.train(run)
    network = finding.load_network(run)
    assert len(playing.play(network, run.config, 20)) == 20


def test_an_agent_kept_alone_plays_as_before_to_half_precision(untrained):
    before = finding.load_network(untrained).state_dict()
    untrained.keep_agent_only()
    after = finding.load_network(untrained).state_dict()
    for name, value in before.items():
        # Half precision has 11 significant bits, and steps of 2^-24 below 2^-14.
        torch.testing.assert_close(after[name], value, rtol=2**-11, atol=2**-25)
    assert not untrained.checkpointer.paths()
