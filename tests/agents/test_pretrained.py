"""The agents that come with the package, and others in files like theirs."""

import functools

from chance import P_VALUE
from dm_env import specs
import every_task
import numpy as np
import pytest
from scipy import stats
from seeds import fresh_seed
import torch

from physexp import agents, suite
from physexp.agents import acting, environment_loop, networks, pretrained, starting, tensors
from physexp.agents.belief import config as belief
from physexp.agents.belief import networks as belief_networks

NAMES = pretrained.names()


def test_every_task_has_an_agent():
    cards = [pretrained.card_named(name) for name in NAMES if "/" not in name]
    assert {(card["domain"], card["task"]) for card in cards} == set(suite.ALL_TASKS) - every_task.UNTRAINED
    kept = sorted(
        (card["task"], card["task_kwargs"]["difficulty"]) for card in cards if card["domain"] == "which_is_heavier"
    )
    assert kept == [(task, difficulty) for task in ("features", "pixels") for difficulty in (3.0, 5.0, 10.0)]
    assert sum(path.stat().st_size for path in pretrained.FOLDER.rglob("*.safetensors")) < 12e6


@pytest.mark.parametrize("name", NAMES)
def test_an_agent_is_found_and_answers_as_well_as_its_card_says(name):
    card = pretrained.card_named(name)
    domain, task, options = (card[key] for key in ("domain", "task", "task_kwargs"))
    *_, stem = name.split("/")
    assert pretrained.name(domain, task, options) == stem
    options = {option: np.float32(value) for option, value in options.items()}  # As a user's script may have them.
    agent = pretrained.load(domain, task, agent=card["agent"]["algorithm"], **options)
    assert agent.card == card
    seed, num_episodes = fresh_seed(), 60
    assert card["command"].startswith(f"physexp train {card['domain']} {card['task']}")
    assert {"commit", "seed", "frames", "seconds", "evaluation", "versions"} <= set(card)
    batch = suite.load_batch(domain, task, num_episodes, {"random": seed, **card["task_kwargs"]})
    played = acting.play_round(agent.network, batch, 0, acting.drawn(np.random.default_rng(seed)))
    batch.close()
    right = int((played.rewards.sum(axis=0) > 0).sum())
    told = card["evaluation"]["drawn"]
    known_right = round(told["success_rate"] * told["episodes"])
    # The probabilities after the card's own episodes, if all rates were alike before.
    likely = stats.betabinom(num_episodes, known_right + 1, told["episodes"] - known_right + 1)
    assert min(likely.cdf(right), likely.sf(right - 1)) > P_VALUE


def test_an_agent_plays_in_a_loop_and_its_default_is_the_tasks():
    actor = agents.load_pretrained("which_is_heavier", "features", seed=1)
    environment = suite.load("which_is_heavier", "features")
    for episode in environment_loop.EnvironmentLoop(environment, actor).run(2):
        assert episode["episode_return"] in (1, -1)
    environment.close()
    card = pretrained.load("which_is_heavier", "features").card
    assert card["task_kwargs"]["difficulty"] == suite.load_task("which_is_heavier", "features").options.difficulty


def test_a_missing_agent_is_refused_with_a_list_of_those_that_are_there():
    with pytest.raises(ValueError, match="named towers-nothing; there are: .*towers-fist_features"):
        agents.load_pretrained("towers", "nothing")
    with pytest.raises(ValueError, match="which_is_heavier-features-difficulty4; there are"):
        agents.load_pretrained("which_is_heavier", "features", difficulty=4)
    with pytest.raises(ValueError, match="no trained agent of dqn is named towers-fist_features; there are"):
        agents.load_pretrained("towers", "fist_features", agent="dqn")


# Agents of one's own.


@pytest.fixture
def small():
    """A small network, and the least that a card says."""
    network = networks.RecurrentActorCritic({"a": specs.Array((3,), np.float32)}, 4, observation_scale=2.0)
    facts = {
        "kind": "RecurrentActorCritic",
        "observations": {"a": ((3,), "float32")},
        "num_actions": 4,
        "hyperparameters": {"observation_scale": 2.0},
    }
    card = {"domain": "towers", "task": "some", "task_kwargs": {}, "seed": 3, "network": facts}
    return network, {**card, "agent": {"algorithm": "belief"}}


def test_a_saved_agent_is_loaded_to_half_precision(small, tmp_path):
    network, card = small
    path = pretrained.save(network, {**card, "task_kwargs": {"skew": 2.0, "is_covered": True, "none": None}}, tmp_path)
    assert path.name == "towers-some-is_coveredTrue-skew2.safetensors"
    loaded = pretrained.load("towers", "some", folder=tmp_path, is_covered=True, skew=2)
    expected = pretrained.halve(network).state_dict()
    assert all(torch.equal(value, expected[name]) for name, value in loaded.network.state_dict().items())
    assert [item.name for item in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("follows", [True, False])
def test_frozen_convolutions_are_drawn_from_the_seed_again(follows, small, tmp_path):
    config = belief.BeliefConfig(seed=fresh_seed())
    batch = suite.load_batch("strike", "pixels", 1)
    network = starting.make_network(belief_networks.BeliefNetwork, batch, config)
    network.calibrate(acting.as_tensors(batch.reset().observation))
    if not follows:
        network.torso.convolutions[0].weight.data[0, 0, 0, 0] += 1.0
    facts = {
        "kind": "BeliefNetwork",
        "observations": {"pixels": ((84, 84, 3), "uint8")},
        "num_actions": batch.action_spec().num_values,
        "hyperparameters": network.hyperparameters(batch, config),
    }
    batch.close()
    path = pretrained.save(network, {**small[1], "seed": config.seed, "network": facts}, tmp_path)
    assert any("convolutions" in name for name in tensors.read(path)[0]) == (not follows)
    expected, found = pretrained.halve(network).state_dict(), pretrained.load_file(path).network.state_dict()
    assert all(torch.equal(value, expected[name]) for name, value in found.items())
    weights, card = tensors.read(path)
    if follows:  # As another version of torch would draw them.
        card["network"]["frozen"]["seed"] += 1
        tensors.write(path, weights, card)
        with pytest.raises(ValueError, match="draws other convolutions from seed"):
            pretrained.load_file(path)


def test_without_options_the_only_agent_or_the_default_is_taken(small, tmp_path):
    network, card = small
    load = functools.partial(pretrained.load, "towers", "some", folder=tmp_path)
    pretrained.save(network, {**card, "task_kwargs": {"skew": 2.5}}, tmp_path)
    assert load().card["task_kwargs"] == {"skew": 2.5}
    pretrained.save(network, {**card, "task_kwargs": {"skew": 1e-5}}, tmp_path)
    with pytest.raises(ValueError, match="no trained agent is named towers-some; there are: towers-some-skew1e-05, "):
        load()
    pretrained.save(network, {**card, "task_kwargs": {"noise": 3.0}, "default": True}, tmp_path)
    assert load().card["task_kwargs"] == {"noise": 3.0}
    assert pretrained.options_of("towers", "some", tmp_path) == {"skew", "noise"}
    pretrained.save(network, card, tmp_path)  # Trained on the task without options.
    assert load().card["task_kwargs"] == {}


def test_weights_beyond_half_precision_are_not_written(small, tmp_path):
    network, card = small
    network.value.weight.data[0, 0] = 1e5  # Finite, but beyond 65,504.
    with pytest.raises(ValueError, match="not finite in half precision"):
        pretrained.save(network, card, tmp_path / "agents")
    assert not (tmp_path / "agents").exists()


@pytest.mark.parametrize(
    "changes",
    [
        {"kind": "Nothing"},
        {"num_actions": 10**12},
        {"num_actions": -1},
        {"observations": {"a": ((10**9, 10**9), "float64")}},
        {"observations": {"a": "b"}},
        {"hyperparameters": {}},
        {"hyperparameters": {"observation_scale": [1]}},
        {"frozen": {"names": ["policy.bias"]}},
    ],
)
def test_a_card_of_another_network_is_refused_in_one_line(changes, small, tmp_path):
    network, card = small
    path = pretrained.save(network, card, tmp_path)
    weights, card = tensors.read(path)
    for wrong in ({**card, "network": {**card["network"], **changes}}, {**card, "network": None}, {}):
        tensors.write(path, weights, wrong)
        with pytest.raises(ValueError, match=f"^{path} holds no agent of this version .*; publish the agent again$"):
            pretrained.load_file(path)
