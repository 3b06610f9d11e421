"""A run's agent becomes a file that can be loaded by name, with a card of its provenance."""

import dataclasses
import json
import math
import shlex

import pytest
import torch
import trainers

from physexp.agents import pretrained
from physexp.analysis.data import provenance
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding, playing, publishing, trainer
from physexp.analysis.training import run as run_lib
from physexp.cli import parsing
from physexp.suite.engine import options


@pytest.fixture(scope="module")
def published(tmp_path_factory):
    folder = tmp_path_factory.mktemp("published")
    run = trainers.create(folder / "run", frames=2000, seed=5)
    trainer.train(run)
    return run, publishing.publish(run, folder / "agents", num_episodes=200)


def parsed(command):
    _, *arguments = shlex.split(command)
    train = parsing.parse(arguments)
    return train.domain, train.task, train.task_kwargs, tuple(map(options.parsed, train.also)), train.config


def test_the_card_has_the_provenance_and_the_evaluation(published):
    run, path = published
    agent, last = pretrained.load_file(path), run.metrics()[-1]
    card = agent.card
    assert path.name == "which_is_heavier-features-difficulty10.safetensors"
    assert (card["domain"], card["task"], card["task_kwargs"]) == ("which_is_heavier", "features", {"difficulty": 10.0})
    assert not card["default"], "the task's own difficulty is another"
    assert (card["seed"], card["frames"], card["seconds"]) == (5, int(last["frames"]), round(last["seconds"]))
    assert card["versions"] == provenance.versions()
    again = playing.play(agent.network, run.config, 200).summary(run.config.agent.discount)
    assert json.loads(json.dumps(again)) == card["evaluation"]["drawn"]


def test_the_agent_is_the_runs_rounded_to_half_precision(published):
    run, path = published
    expected = finding.load_network(run).state_dict()
    network, config, provenance_of = finding.find_agent(str(path))
    assert (config.task_name, config.task_kwargs) == (run.config.task_name, run.config.task_kwargs)
    assert provenance_of().items() >= finding.provenance(run).items()
    for name, value in network.state_dict().items():
        assert torch.equal(value, expected[name].half().float()), name
    with pytest.raises(ValueError, match="was trained at difficulty 10, and difficulty is 3"):
        finding.find_agent(str(path), {"difficulty": 3})


@pytest.mark.parametrize("name", pretrained.names())
def test_the_command_of_an_agent_of_the_package_describes_it(name):
    card = pretrained.card_named(name)
    config = finding.config_of(card)
    expected = card["domain"], card["task"], card["task_kwargs"], config.also, config.agent
    assert parsed(card["command"]) == expected


def _another(value):
    """Returns a value of a hyperparameter that differs from this one."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        return {"auto": "cpu", "attention": "lstm"}[value]
    if isinstance(value, tuple):
        return (-1e-05, 0.5)
    return 2 * value or 1 if isinstance(value, int) else value / 2 + 0.001


@pytest.mark.parametrize("algorithm", config_lib.ALGORITHMS)
def test_every_field_of_an_agent_survives_the_command_line(algorithm):
    preset = config_lib.preset("towers", "fist_features", algorithm=algorithm)
    changed = preset.replace(**{field: _another(value) for field, value in dataclasses.asdict(preset).items()})
    for task_kwargs in ({}, {"control_timestep": 0.1 + 2**-30, "variation": 0.5}):
        config = config_lib.TrainConfig(domain="towers", task="fist_features", task_kwargs=task_kwargs, agent=changed)
        assert parsed(finding.command(config)) == ("towers", "fist_features", task_kwargs, (), changed)


HEADER = ",".join(run_lib.METRICS) + "\n"


@pytest.mark.parametrize("metrics", [None, "", HEADER, HEADER + "nan" + ",nan" * 20, "frames,seconds\n-1,2\n"])
def test_a_run_whose_metrics_say_too_little_is_refused(metrics, published, tmp_path):
    run = trainers.copy_of(published[0], tmp_path / "run")
    (run.path / "metrics.csv").unlink() if metrics is None else (run.path / "metrics.csv").write_text(metrics)
    with pytest.raises(ValueError, match=f"^{run.path / 'metrics.csv'} ") as refused:
        publishing.publish(run, tmp_path / "agents", num_episodes=1)
    assert "\n" not in str(refused.value)
    assert not (tmp_path / "agents").exists()


def test_an_agent_is_replaced_only_on_request(published, tmp_path):
    run, path = published
    before = path.read_bytes()
    with pytest.raises(FileExistsError, match=f"{path} is an agent already; give --replace"):
        publishing.publish(run, path.parent, num_episodes=1)
    assert path.read_bytes() == before
    (tmp_path / path.name).write_bytes(b"")
    publishing.publish(run, tmp_path, num_episodes=1, replaces=True)
    assert pretrained.load_named(path.stem, tmp_path).card["seed"] == 5


@pytest.mark.parametrize("worst", [math.nan, 65_520.0])
def test_weights_that_are_not_finite_are_refused(worst, published, tmp_path):
    run = trainers.copy_of(published[0], tmp_path / "run")
    tensors, facts = run.checkpointer.latest()
    tensors["network/policy.bias"][0] = worst
    run.checkpointer.save(tensors, facts)
    where = f"{run.path}/checkpoints" if math.isnan(worst) else "weights are not finite in half precision"
    with pytest.raises(ValueError, match=f"^{where}.*policy.bias"):
        publishing.publish(run, tmp_path / "agents", num_episodes=1)
    assert not (tmp_path / "agents").exists()


def test_an_agent_of_another_network_than_its_task_needs_is_refused(published, tmp_path):
    agent = pretrained.load_file(published[1])
    path = pretrained.save(agent.network, {**agent.card, "domain": "towers", "task": "fist_features"}, tmp_path)
    with pytest.raises(ValueError, match="has a network that cannot play it|difficulty"):
        finding.find_agent(str(path))
