"""Values out of range are refused, with the value and the allowed ones."""

import dataclasses
import json
import math
import re

import numpy as np
import pytest

from physexp import checks
from physexp.agents.a3c import config as a3c
from physexp.agents.belief import config as belief
from physexp.agents.ppo import config as ppo

BAD = [
    (a3c.A3CConfig, "discount", 1.5),
    (belief.BeliefConfig, "frames", 0),
    (a3c.A3CConfig, "learning_rate", 0.0),
    (a3c.A3CConfig, "gae_lambda", 1.1),
    (ppo.PPOConfig, "entropy_cost", -0.1),
    (ppo.PPOConfig, "baseline_cost", math.nan),
    (a3c.A3CConfig, "num_workers", 0),
    (belief.BeliefConfig, "frames_per_update", 0),
    (belief.BeliefConfig, "replay_episodes", 15),  # A round has 16.
]


@pytest.mark.parametrize(("config", "name", "value"), BAD)
def test_a_bad_value_is_refused_with_the_allowed_ones(config, name, value):
    with pytest.raises(ValueError, match=rf"^{name} is {re.escape(repr(value))}; give a(n| finite)? ?(integer|number)"):
        config(**{name: value})


@pytest.mark.parametrize("config", [a3c.A3CConfig, belief.BeliefConfig, ppo.PPOConfig])
def test_every_hyperparameter_has_a_help_text_and_a_check(config):
    fields = {field.name for field in dataclasses.fields(config)}
    assert set(checks.help_of(config)) == fields and all(checks.help_of(config).values())
    for name in fields:
        with pytest.raises(ValueError, match=f"^{name} is "):
            config(**{name: object()})


def test_flags_words_and_lists_are_checked():
    with pytest.raises(ValueError, match="^every_step is 1; give True or False"):
        belief.BeliefConfig(every_step=1)
    with pytest.raises(ValueError, match="^memory is 'gru'; choose from attention, lstm$"):
        belief.BeliefConfig(memory="gru")
    assert a3c.A3CConfig(initial_logits=[1, np.float32(0)]) == a3c.A3CConfig(initial_logits=(1.0, 0.0))
    with pytest.raises(ValueError, match="initial_logits is 'ab'; give finite numbers, one for each action"):
        a3c.A3CConfig(initial_logits="ab")
    with pytest.raises(ValueError, match="num_minibatches is 9; give at most num_environments, 8"):
        ppo.PPOConfig(num_environments=8, num_minibatches=9)


def test_numbers_of_numpy_become_pythons_own():
    config = a3c.A3CConfig(frames=np.int64(500), discount=np.float32(0.5), gae_lambda=np.float64(0.25))
    assert config == a3c.A3CConfig(frames=500, discount=0.5, gae_lambda=0.25)
    assert json.loads(json.dumps(dataclasses.asdict(config)))["frames"] == 500


def test_variants_of_a_learner_have_titles_of_their_own():
    assert belief.BeliefConfig().title == "belief"
    assert belief.BeliefConfig(answers_revealed=True, memory="lstm").title == "belief_revealed_lstm"
    assert belief.BeliefConfig(every_step=False).title == "belief_last_step"
    assert belief.BeliefConfig(foresight=True).title == "belief_foresight"
    assert belief.BeliefConfig(replay_episodes=belief.NUM_ENVIRONMENTS).title == "belief_no_replay"


def test_foresight_sets_caps_and_how_often_the_learner_learns_by_rules():
    usual, foresight = (belief.BeliefConfig(foresight=foresight) for foresight in (False, True))
    # Eight interactions, or one for each answer but one, and time for an answer; a step of Adam for four frames, or
    # 75,000 steps.
    limits = [(2, 40), (12, 40), (64, 40), (2, 5), (2, 1)]  # Answers, and the actions that an episode may have.
    assert [usual.longest(*each) for each in limits] == [8, 8, 8, 4, 1]
    assert [foresight.longest(*each) for each in limits] == [8, 11, 39, 4, 1]
    assert [config.replace(frames=600_000).period for config in (usual, foresight)] == [4, 8]
    assert foresight.replace(frames=1000).period == 4


def test_sums_are_learned_at_the_last_step_unless_answers_are_revealed():
    config = belief.BeliefConfig()
    assert config.learns_every_step and not config.replace(every_step=False).learns_every_step
    assert not config.replace(foresight=True).learns_every_step
    assert config.replace(foresight=True, answers_revealed=True).learns_every_step


def test_costs_and_rates_decay_over_training():
    config = a3c.A3CConfig(frames=1000, learning_rate=0.1, entropy_cost=0.1, final_entropy_cost=0.001)
    assert config.at(0) == (0.1, 0.1)
    # Halfway: the rate has lost half, the entropy cost is the geometric mean of 0.1 and 0.001.
    assert config.at(500) == pytest.approx((0.05, 0.01))
    assert config.at(1000) == config.at(1001) == pytest.approx((0.0, 0.001))
    linear, none = (config.replace(final_entropy_cost=0.0, entropy_cost=cost) for cost in (0.1, 0.0))
    assert [linear.at(frames)[1] for frames in (0, 250, 1000)] == pytest.approx([0.1, 0.075, 0.0])
    assert [none.at(frames)[1] for frames in (0, 250, 1000)] == [0.0, 0.0, 0.0]
