"""A run's agent becomes one that can be loaded by name, with a card that tells where it comes from."""

import dataclasses
import json
import shlex

import pytest
import torch
import trainers

from physexp import cli
from physexp.agents import pretrained
from physexp.analysis import config as config_lib
from physexp.analysis import evaluation, publishing, training
from physexp.analysis import run as run_lib


@pytest.fixture(scope="module")
def published(tmp_path_factory):
    folder = tmp_path_factory.mktemp("published")
    run = trainers.create(folder / "run", frames=2000, seed=5)
    training.train(run)
    return run, publishing.publish(run, folder / "agents", num_episodes=200)


def test_the_card_says_what_was_done_and_what_came_of_it(published):
    run, path = published
    card = json.loads(path.read_text())
    last = run.metrics()[-1]
    assert path.name == "which_is_heavier-features-difficulty10.json"
    assert (card["domain"], card["task"], card["difficulty"]) == ("which_is_heavier", "features", 10.0)
    assert (card["seed"], card["frames"], card["seconds"]) == (5, int(last["frames"]), round(last["seconds"]))
    assert card["evaluation"]["drawn"]["episodes"] == card["evaluation"]["greedy"]["episodes"] == 200
    assert card["versions"] == run_lib.versions()


def test_the_command_on_the_card_describes_the_same_run(published):
    run, path = published
    _, *arguments = shlex.split(json.loads(path.read_text())["command"])
    train = cli._parse(arguments)
    assert (train.domain, train.task, train.difficulty) == ("which_is_heavier", "features", 10.0)
    assert train.config == run.config.agent


@pytest.mark.parametrize("card", sorted(pretrained.FOLDER.glob("*.json")), ids=lambda path: path.stem)
def test_the_commands_of_the_agents_that_come_with_the_package_describe_them_still(card):
    said = json.loads(card.read_text())
    _, *arguments = shlex.split(said["command"])
    train = cli._parse(arguments)
    assert (train.domain, train.task, train.difficulty) == (said["domain"], said["task"], said["difficulty"])
    fields = {name: said[name] for name in ("domain", "task", "agent")}
    assert train.config == config_lib.TrainConfig.from_json(fields).agent


@pytest.mark.parametrize("algorithm", config_lib.ALGORITHMS)
@pytest.mark.parametrize("task", config_lib.A3C)
def test_every_field_of_an_agent_survives_the_way_over_the_command_line(task, algorithm):
    domain, name = task
    changed = config_lib.preset(domain, name, algorithm=algorithm).replace(
        seed=3, relative_pixels=False, device="cpu", trace=0.25, action_prior=(0.5, -1.0)
    )
    config = config_lib.TrainConfig(domain=domain, task=name, agent=changed)
    _, *arguments = shlex.split(publishing.command(config))
    assert cli._parse(arguments).config == changed


def test_the_agent_is_the_runs_rounded_to_half_precision(published):
    run, path = published
    agent = pretrained.load("which_is_heavier", "features", 10, folder=path.parent)
    expected = evaluation.load_network(run).state_dict()
    for name, value in agent.network.state_dict().items():
        assert torch.equal(value, expected[name].half().float()), name


def test_what_the_card_evaluates_is_what_is_loaded(published):
    run, path = published
    agent = pretrained.load("which_is_heavier", "features", 10, folder=path.parent)
    again = evaluation.play(agent.network, run.config, 200).summary(run.config.agent.discount)
    assert json.loads(json.dumps(again)) == agent.card["evaluation"]["drawn"]


def test_a_run_names_its_commit_and_what_draws_its_images(tmp_path):
    trainers.create(tmp_path / "features")
    created = json.loads((tmp_path / "features" / "config.json").read_text())
    assert created["renderer"] == "none is needed" and created["commit"]

    pixels = config_lib.preset("towers", "fist_pixels")
    config = config_lib.TrainConfig(domain="towers", task="fist_pixels", agent=dataclasses.replace(pixels, frames=1))
    run_lib.Run(tmp_path / "pixels").create(config)
    renderer = json.loads((tmp_path / "pixels" / "config.json").read_text())["renderer"]
    assert renderer and not renderer.startswith("none")
