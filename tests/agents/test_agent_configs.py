"""A configuration that makes no sense is refused, with the value and what is allowed."""

import dataclasses
import json
import math
import re

import numpy as np
import pytest

from physexp.agents.a3c import config as a3c
from physexp.agents.belief import config as belief
from physexp.agents.ppo import config as ppo

BAD = [
    ("discount", 0.0),
    ("discount", 1.5),
    ("discount", math.nan),
    ("frames", 0),
    ("frames", 1.5),
    ("frames", True),
    ("seed", -1),
    ("learning_rate", 0.0),
    ("learning_rate", math.inf),
    ("max_gradient_norm", 0.0),
    ("trace", -0.1),
    ("trace", 1.1),
    ("trace", math.nan),
    ("checkpoint_seconds", 0.0),
]
BAD_FOR_ACTOR_CRITICS = [
    ("lstm_units", 0),
    ("entropy_cost", -0.1),
    ("entropy_cost", math.nan),
    ("final_entropy_cost", -1.0),
    ("baseline_cost", math.nan),
    ("observation_scale", -1.0),
]
BAD_FOR = [
    *((config, *bad) for config in (a3c.A3CConfig, belief.BeliefConfig, ppo.PPOConfig) for bad in BAD),
    *((config, *bad) for config in (a3c.A3CConfig, ppo.PPOConfig) for bad in BAD_FOR_ACTOR_CRITICS),
    (a3c.A3CConfig, "num_workers", 0),
    (a3c.A3CConfig, "envs_per_worker", 0),
    (ppo.PPOConfig, "num_environments", 0),
    (ppo.PPOConfig, "num_threads", 0),
    (ppo.PPOConfig, "num_epochs", 0),
    (ppo.PPOConfig, "num_minibatches", 0),
    (ppo.PPOConfig, "clip", 0.0),
    (belief.BeliefConfig, "units", 0),
    (belief.BeliefConfig, "num_members", 1),  # It would judge what it learns from.
    (belief.BeliefConfig, "num_environments", 1),
    (belief.BeliefConfig, "num_threads", 0),
    (belief.BeliefConfig, "most_interactions", 0),
    (belief.BeliefConfig, "frames_per_step", 0),
    (belief.BeliefConfig, "batch_size", 0),
    (belief.BeliefConfig, "replay_episodes", 0),
    (belief.BeliefConfig, "greedy", -1.0),
    (belief.BeliefConfig, "cut", 1.5),
    (belief.BeliefConfig, "exploration", -0.1),
    (belief.BeliefConfig, "dropout", 2.0),
    (belief.BeliefConfig, "dropout", 1.0),  # Nothing would be left to learn from.
    (belief.BeliefConfig, "averaging", 1.0),  # The network that acts would never change.
    (belief.BeliefConfig, "weight_decay", -0.1),
    (belief.BeliefConfig, "averaging", math.nan),
]


@pytest.mark.parametrize(("config", "name", "value"), BAD_FOR)
def test_a_bad_value_is_refused_by_name_with_what_is_allowed(config, name, value):
    with pytest.raises(ValueError, match=rf"^{name} is {re.escape(repr(value))}; give a(n| finite)? ?(integer|number)"):
        config(**{name: value})


@pytest.mark.parametrize("config", [a3c.A3CConfig, belief.BeliefConfig, ppo.PPOConfig])
def test_every_hyperparameter_is_checked(config):
    assert set(config.allowed) == {field.name for field in dataclasses.fields(config)}


def test_numbers_of_numpy_are_taken_and_become_pythons_own():
    config = a3c.A3CConfig(frames=np.int64(500), discount=np.float32(0.5), trace=np.float64(0.25))
    assert config == a3c.A3CConfig(frames=500, discount=0.5, trace=0.25)
    assert json.loads(json.dumps(dataclasses.asdict(config)))["frames"] == 500
    with pytest.raises(ValueError, match=r"frames is np.int32\(0\); give an integer >= 1"):
        a3c.A3CConfig(frames=np.int32(0))


def test_a_prior_may_be_a_list():
    assert a3c.A3CConfig(action_prior=[1, np.float32(0)]) == a3c.A3CConfig(action_prior=(1.0, 0.0))
    with pytest.raises(ValueError, match="action_prior is 'ab'; give finite numbers, one for each action"):
        a3c.A3CConfig(action_prior="ab")


def test_more_parts_than_episodes_are_refused():
    with pytest.raises(ValueError, match="num_minibatches is 9; give at most num_environments, 8"):
        ppo.PPOConfig(num_environments=8, num_minibatches=9)


def test_less_room_than_a_round_takes_is_refused():
    with pytest.raises(ValueError, match="replay_episodes is 15; give at least num_environments, 16"):
        belief.BeliefConfig(replay_episodes=15)


def test_members_without_environments_of_their_own_are_refused():
    with pytest.raises(ValueError, match="num_environments is 3; give at least num_members, 4"):
        belief.BeliefConfig(num_environments=3)


def test_episodes_that_cannot_be_shared_out_equally_are_refused():
    with pytest.raises(ValueError, match="batch_size is 30; give a multiple of num_members, 4"):
        belief.BeliefConfig(batch_size=30)


@pytest.mark.parametrize(
    ("config", "name"),
    [
        (a3c.A3CConfig, "relative_entropy"),
        (a3c.A3CConfig, "relative_pixels"),
        (belief.BeliefConfig, "answers_revealed"),
        (belief.BeliefConfig, "every_step"),
    ],
)
def test_what_is_on_or_off_takes_nothing_else(config, name):
    with pytest.raises(ValueError, match=f"^{name} is 1; give True or False"):
        config(**{name: 1})


@pytest.mark.parametrize(("name", "choices"), [("device", "auto, cpu, cuda"), ("memory", "attention, lstm")])
def test_what_is_chosen_is_one_of_the_choices(name, choices):
    with pytest.raises(ValueError, match=f"^{name} is 'gru'; choose from {choices}$"):
        belief.BeliefConfig(**{name: "gru"})


def test_variants_of_a_learner_have_titles_of_their_own():
    assert belief.BeliefConfig().title == "belief"
    assert belief.BeliefConfig(answers_revealed=True, memory="lstm").title == "belief_revealed_lstm"
    assert belief.BeliefConfig(every_step=False).title == "belief_last_step"
    assert belief.BeliefConfig(num_environments=8, replay_episodes=8).title == "belief_no_replay"


def test_entropy_is_relative_to_the_prior_only_where_that_is_wanted():
    assert a3c.A3CConfig(action_prior=(1.0, 0.0)).entropy_prior == ()
    assert a3c.A3CConfig(action_prior=(1.0, 0.0), relative_entropy=True).entropy_prior == (1.0, 0.0)


def test_costs_and_rates_decay_over_training():
    config = a3c.A3CConfig(frames=1000, learning_rate=0.1, entropy_cost=0.1, final_entropy_cost=0.001)
    assert config.at(0) == (0.1, 0.1)
    # Halfway: the rate has lost half, the entropy cost is the geometric mean of 0.1 and 0.001.
    assert config.at(500) == pytest.approx((0.05, 0.01))
    assert config.at(1000) == pytest.approx((0.0, 0.001))
    assert config.at(1001) == config.at(1000), "the last round may go on for longer"


def test_a_bonus_that_ends_at_0_decays_linearly_and_one_that_is_0_stays_so():
    ending = a3c.A3CConfig(frames=1000, entropy_cost=0.1, final_entropy_cost=0.0)
    without = a3c.A3CConfig(frames=1000, entropy_cost=0.0)
    assert [ending.at(frames)[1] for frames in (0, 250, 1000)] == pytest.approx([0.1, 0.075, 0.0])
    assert [without.at(frames)[1] for frames in (0, 250, 1000)] == [0.0, 0.0, 0.0]


def test_values_at_the_edge_of_what_is_allowed_are_taken():
    config = a3c.A3CConfig(discount=1.0, frames=1, num_workers=1, envs_per_worker=1, entropy_cost=0.0, seed=0)
    assert config.replace(discount=0.5).discount == 0.5
    assert config.discount == 1.0, "replace makes a copy"


def test_replace_checks_too():
    with pytest.raises(ValueError, match="num_workers is -2"):
        a3c.A3CConfig().replace(num_workers=-2)
