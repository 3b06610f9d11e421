"""A run's agent becomes one that can be loaded by name, with a card that tells where it comes from."""

import dataclasses
import json
import math
import shlex

import pytest
from safetensors import torch as safetensors
import torch
import trainers

from physexp import suite
from physexp.agents import pretrained
from physexp.analysis.data import provenance
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding, playing, publishing, trainer
from physexp.analysis.training import metrics as metrics_lib
from physexp.analysis.training import run as run_lib
from physexp.cli import options, parsing


@pytest.fixture(scope="module")
def published(tmp_path_factory):
    folder = tmp_path_factory.mktemp("published")
    run = trainers.create(folder / "run", frames=2000, seed=5)
    trainer.train(run)
    return run, publishing.publish(run, folder / "agents", num_episodes=200)


def test_the_card_says_what_was_done_and_what_came_of_it(published):
    run, path = published
    card = json.loads(path.read_text())
    last = run.metrics()[-1]
    assert path.name == "which_is_heavier-features-difficulty10.json"
    assert (card["domain"], card["task"], card["task_kwargs"]) == ("which_is_heavier", "features", {"difficulty": 10.0})
    assert not card["default"], "the task's own difficulty is another"
    assert (card["seed"], card["frames"], card["seconds"]) == (5, int(last["frames"]), round(last["seconds"]))
    assert card["evaluation"]["drawn"]["episodes"] == card["evaluation"]["greedy"]["episodes"] == 200
    assert card["versions"] == provenance.versions()


def test_the_command_on_the_card_describes_the_same_run(published):
    run, path = published
    _, *arguments = shlex.split(json.loads(path.read_text())["command"])
    train = parsing.parse(arguments)
    assert (train.domain, train.task, options.chosen(train.options)) == (
        "which_is_heavier",
        "features",
        {"difficulty": 10.0},
    )
    assert train.config == run.config.agent


@pytest.mark.parametrize("name", pretrained.names())
def test_the_commands_of_the_agents_that_come_with_the_package_describe_them_still(name):
    said = json.loads((pretrained.FOLDER / f"{name}.json").read_text())
    _, *arguments = shlex.split(said["command"])
    train = parsing.parse(arguments)
    keys = ("domain", "task", "difficulty", "task_kwargs", "agent")  # Earlier cards have a difficulty.
    config = config_lib.TrainConfig.from_json({key: said[key] for key in keys if key in said})
    assert (train.domain, train.task, options.chosen(train.options)) == (
        said["domain"],
        said["task"],
        config.task_kwargs,
    )
    assert train.config == config.agent


def _another(value):
    """A value of a hyperparameter that differs from this one."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        return {"auto": "cpu", "attention": "lstm"}[value]
    if isinstance(value, tuple):
        return (0.5, -1.0)
    return 2 * value or 1 if isinstance(value, int) else value / 2 + 0.001


@pytest.mark.parametrize("algorithm", config_lib.ALGORITHMS)
@pytest.mark.parametrize("task", suite.ALL_TASKS, ids=["/".join(names) for names in suite.ALL_TASKS])
def test_every_field_of_an_agent_survives_the_way_over_the_command_line(task, algorithm):
    domain, name = task
    preset = config_lib.preset(domain, name, algorithm=algorithm)
    changed = preset.replace(**{field: _another(value) for field, value in dataclasses.asdict(preset).items()})
    config = config_lib.TrainConfig(domain=domain, task=name, agent=changed)
    _, *arguments = shlex.split(publishing.command(config))
    assert parsing.parse(arguments).config == changed


@pytest.mark.parametrize(
    "domain, task, task_kwargs",
    [
        ("threshold", "features", {"reveal": True}),
        ("towers", "fist_features", {"control_timestep": 0.1 + 2**-30, "variation": 0.5}),
        ("which_is_heavier", "features", {"difficulty": 10}),
    ],
)
def test_every_option_of_a_task_survives_the_way_over_the_command_line(domain, task, task_kwargs):
    agent = config_lib.preset(domain, task)
    config = config_lib.TrainConfig(domain=domain, task=task, task_kwargs=task_kwargs, agent=agent)
    _, *arguments = shlex.split(publishing.command(config))
    assert options.chosen(parsing.parse(arguments).options) == task_kwargs


def test_the_agent_is_the_runs_rounded_to_half_precision(published):
    run, path = published
    agent = pretrained.load("which_is_heavier", "features", 10, folder=path.parent)
    expected = finding.load_network(run).state_dict()
    for name, value in agent.network.state_dict().items():
        assert torch.equal(value, expected[name].half().float()), name


def test_what_the_card_evaluates_is_what_is_loaded(published):
    run, path = published
    agent = pretrained.load("which_is_heavier", "features", 10, folder=path.parent)
    again = playing.play(agent.network, run.config, 200).summary(run.config.agent.discount)
    assert json.loads(json.dumps(again)) == agent.card["evaluation"]["drawn"]


def test_a_published_agent_is_found_by_its_card_wherever_it_is(published):
    run, path = published
    network, config = finding.find_agent(str(path))
    assert (config.task_name, config.task_kwargs) == (run.config.task_name, run.config.task_kwargs)
    there = pretrained.load_named(path.stem, path.parent).network.state_dict()
    assert all(torch.equal(value, there[name]) for name, value in network.state_dict().items())
    with pytest.raises(ValueError, match="was trained at difficulty 10, and difficulty is 3"):
        finding.find_agent(str(path), {"difficulty": 3})


HEADER = ",".join(metrics_lib.METRICS) + "\n"


@pytest.mark.parametrize(
    "metrics",
    [
        None,
        "",
        HEADER,
        HEADER[:20],
        HEADER + "12,3",
        HEADER + "nan" + ",nan" * 20,
        "frames,seconds\n-1,2\n",
        "noise\n\0\n",
    ],
)
def test_a_run_whose_metrics_say_too_little_is_refused_in_one_line(metrics, published, tmp_path):
    run = trainers.copy_of(published[0], tmp_path / "run")
    (run.path / "metrics.csv").unlink() if metrics is None else (run.path / "metrics.csv").write_text(metrics)
    with pytest.raises(ValueError, match=f"^{run.path / 'metrics.csv'} ") as refused:
        publishing.publish(run, tmp_path / "agents", num_episodes=1)
    assert "\n" not in str(refused.value)
    assert not (tmp_path / "agents").exists()


def test_an_agent_that_is_there_is_replaced_only_where_that_is_asked_for(published):
    run, path = published
    before = path.read_bytes()
    with pytest.raises(FileExistsError, match=f"{path} is an agent already; give --replace"):
        publishing.publish(run, path.parent, num_episodes=1)
    assert path.read_bytes() == before


def test_a_run_of_another_format_is_not_published(published, tmp_path):
    run = trainers.copy_of(published[0], tmp_path / "run")
    (run.path / "config.json").write_text(json.dumps({**run.facts, "format": 99}))
    with pytest.raises(ValueError, match="has format 99; this version reads format 1"):
        publishing.publish(run, tmp_path / "agents", num_episodes=1)


@pytest.mark.parametrize("worst", [math.nan, math.inf])
def test_weights_that_are_not_finite_are_refused_wherever_they_are_read(worst, published, tmp_path):
    run = trainers.copy_of(published[0], tmp_path / "run")
    tensors, facts = run.checkpointer.latest()
    tensors["network/policy.bias"][0] = worst
    path = run.checkpointer.save(tensors, facts)
    for use in (
        lambda: finding.find_agent(str(run.path)),
        lambda: publishing.publish(run, tmp_path / "agents", num_episodes=1),
        lambda: trainer.train(run),
    ):
        with pytest.raises(ValueError, match=f"^{path}: .*not finite in .*policy.bias") as refused:
            use()
        assert "\n" not in str(refused.value)
    assert not (tmp_path / "agents").exists()


@pytest.mark.parametrize(
    "facts",
    [
        {},
        {"episodes": -1},
        {"episodes": 1.5},
        {"episodes": True},
        {"episodes": 2**63},
        {"seconds": -1.0},
        {"seconds": "1"},
        {"seconds": 10**400},
        {"task": ["\n"]},
    ],
)
def test_facts_that_make_no_sense_stop_a_run_from_being_resumed(facts, published, tmp_path):
    run = trainers.copy_of(published[0], tmp_path / "run")
    tensors, good = run.checkpointer.latest()
    path = run.checkpointer.save(tensors, {**good, **facts} if facts else {})
    metrics = (run.path / "metrics.csv").read_bytes()
    with pytest.raises(ValueError, match=str(tmp_path)) as refused:
        trainer.train(run)
    assert path.name in str(refused.value) and "\n" not in str(refused.value)
    assert (run.path / "metrics.csv").read_bytes() == metrics


def test_an_agent_kept_alone_that_is_damaged_is_refused_by_its_file(published, tmp_path):
    run = trainers.copy_of(published[0], tmp_path / "run")
    run.keep_agent_only()
    assert finding.find_agent(str(run.path))
    content = run.agent_path.read_bytes()
    for damaged in (content[:-1], b"", content[:-1] + bytes([content[-1] ^ 1])):
        run.agent_path.write_bytes(damaged)
        with pytest.raises(ValueError, match=f"^{run.agent_path} is damaged: .*; put back the agent's own$"):
            finding.find_agent(str(run.path))
    weights = finding.load_network(published[0]).half().state_dict()
    weights["policy.bias"][1] = math.inf
    run.agent_path.write_bytes(safetensors.save(weights))  # As files were before they had checksums.
    with pytest.raises(ValueError, match=f"^{run.agent_path} holds numbers that are not finite in policy.bias"):
        finding.find_agent(str(run.path))


def test_a_configuration_of_a_larger_network_than_the_weights_have_is_refused_before_it_is_made(published, tmp_path):
    run = trainers.copy_of(published[0], tmp_path / "run")
    run.keep_agent_only()
    fields = run.facts
    fields["train"]["agent"]["lstm_units"] = 65_536  # Would take 70 GB.
    (run.path / "config.json").write_text(json.dumps(fields))
    with pytest.raises(ValueError, match=f"^{run.agent_path} does not fit the configuration"):
        finding.find_agent(str(run.path))


def test_a_run_names_its_commit_and_what_draws_its_images(tmp_path):
    trainers.create(tmp_path / "features")
    created = json.loads((tmp_path / "features" / "config.json").read_text())
    assert created["renderer"] == "none is needed" and created["commit"]

    pixels = config_lib.preset("towers", "fist_pixels")
    config = config_lib.TrainConfig(domain="towers", task="fist_pixels", agent=dataclasses.replace(pixels, frames=1))
    run_lib.Run(tmp_path / "pixels").create(config)
    renderer = json.loads((tmp_path / "pixels" / "config.json").read_text())["renderer"]
    assert renderer and not renderer.startswith("none")
