"""The agents that come with the package."""

import json
import subprocess
import sys

import numpy as np
import pytest
import torch

from physexp import agents, suite
from physexp.agents import core, environment_loop, networks, pretrained

CARDS = sorted(pretrained.FOLDER.glob("*.json"))


def card_of(path):
    return json.loads(path.read_text())


def test_every_task_has_an_agent_and_which_is_heavier_one_for_each_of_the_papers_difficulties():
    kept = {(card["domain"], card["task"], card["difficulty"]) for card in map(card_of, CARDS)}
    difficulties = {"which_is_heavier": (3.0, 5.0, 10.0), "towers": (None,)}
    assert kept == {(domain, task, d) for domain, task in suite.ALL_TASKS for d in difficulties[domain]}


@pytest.mark.parametrize("path", CARDS, ids=lambda path: path.stem)
def test_an_agent_takes_at_most_three_megabytes_and_says_where_it_comes_from(path):
    assert path.with_name(path.stem + ".safetensors").stat().st_size <= 3_000_000
    card = card_of(path)
    assert card["command"].startswith(f"physexp train {card['domain']} {card['task']}")
    assert {"commit", "seed", "frames", "seconds", "evaluation", "versions"} <= set(card)
    assert card["frames"] > 0 and card["seconds"] > 0
    for figures in (card["evaluation"]["drawn"], card["evaluation"]["greedy"]):
        low, high = figures["success_interval"]
        assert figures["episodes"] >= 1000 and low <= figures["success_rate"] <= high


@pytest.mark.parametrize("path", CARDS, ids=lambda path: path.stem)
def test_an_agent_answers_as_well_as_its_card_says(path):
    card = card_of(path)
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    task_kwargs = {"random": seed} | ({"difficulty": card["difficulty"]} if card["difficulty"] else {})
    environment = suite.load(card["domain"], card["task"], task_kwargs)
    actor = agents.load_pretrained(card["domain"], card["task"], card["difficulty"], seed=seed)
    assert isinstance(actor, core.Actor)
    num_episodes = 60
    episodes = environment_loop.EnvironmentLoop(environment, actor).run(num_episodes)
    environment.close()
    right = np.mean([episode["episode_return"] > 0 for episode in episodes])
    rate = card["evaluation"]["drawn"]["success_rate"]
    # Five standard deviations: fails once in a million runs, if the card is right.
    assert abs(right - rate) <= 5 * np.sqrt(max(rate * (1 - rate), 0.01) / num_episodes)


def test_the_default_difficulty_is_that_of_the_task():
    card = pretrained.load("which_is_heavier", "features").card
    assert card["difficulty"] == suite.load_task("which_is_heavier", "features").options.difficulty


def test_an_agent_that_is_not_there_is_refused_with_a_list_of_those_that_are():
    with pytest.raises(ValueError, match="named towers-nothing; there are: .*towers-fist_features"):
        agents.load_pretrained("towers", "nothing")
    with pytest.raises(ValueError, match="which_is_heavier-features-difficulty4; there are"):
        agents.load_pretrained("which_is_heavier", "features", 4)


def test_what_is_saved_is_what_is_loaded_to_half_precision(tmp_path):
    batch = suite.load_batch("towers", "fist_pixels", 1)
    hyperparameters = {"lstm_units": 8, "observation_scale": 2.0}
    network = networks.RecurrentActorCritic(batch.observation_spec(), 9, **hyperparameters)
    network.calibrate({"pixels": torch.randint(256, (1, 84, 84, 3), dtype=torch.uint8)})
    batch.close()
    card = {"domain": "towers", "task": "fist_pixels", "difficulty": None,
            "network": {"observations": {"pixels": ((84, 84, 3), "uint8")}, "num_actions": 9,
                        "hyperparameters": hyperparameters}}  # fmt: skip
    pretrained.save(network, card, tmp_path)
    loaded = pretrained.load("towers", "fist_pixels", folder=tmp_path)
    expected = pretrained.halved(network).state_dict()
    for name, value in loaded.network.state_dict().items():
        assert value.dtype == expected[name].dtype and torch.equal(value, expected[name]), name


def test_importing_the_agents_package_imports_no_torch():
    code = "import sys; import physexp.agents; assert 'torch' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
