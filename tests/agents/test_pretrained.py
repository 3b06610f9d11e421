"""The agents that come with the package."""

import contextlib
import errno
import functools
import hashlib
import json
import os
import subprocess
import sys

import bits
from chance import P_VALUE
from dm_env import specs
import every_task
import numpy as np
import pytest
from scipy import stats
from seeds import fresh_seed
import torch

from physexp import agents, suite
from physexp.agents import acting, checkpointing, core, environment_loop, files, networks, pretrained

NAMES = pretrained.names()
every_agent = pytest.mark.parametrize("name", NAMES)


def path_of(name):
    return pretrained.FOLDER / f"{name}.json"


def card_of(path):
    return json.loads(path.read_text())


def test_every_task_has_an_agent_and_which_is_heavier_one_for_each_of_the_papers_difficulties():
    cards = [pretrained.load_named(name).card for name in NAMES if "/" not in name]
    assert {(card["domain"], card["task"]) for card in cards} == set(suite.ALL_TASKS) - every_task.UNTRAINED
    kept = sorted(
        (card["task"], card["task_kwargs"]["difficulty"]) for card in cards if card["domain"] == "which_is_heavier"
    )
    assert kept == [(task, difficulty) for task in ("features", "pixels") for difficulty in (3.0, 5.0, 10.0)]


@every_agent
def test_an_agent_takes_at_most_three_megabytes_and_says_where_it_comes_from(name):
    assert path_of(name).with_suffix(".safetensors").stat().st_size <= 3_000_000
    card = pretrained.load_named(name).card
    assert card["command"].startswith(f"physexp train {card['domain']} {card['task']}")
    assert {"commit", "seed", "frames", "seconds", "evaluation", "versions"} <= set(card)
    assert card["frames"] > 0 and card["seconds"] > 0
    for figures in (card["evaluation"]["drawn"], card["evaluation"]["greedy"]):
        low, high = figures["success_interval"]
        assert figures["episodes"] >= 1000 and low <= figures["success_rate"] <= high


@every_agent
def test_an_agent_answers_as_well_as_its_card_says(name):
    agent = pretrained.load_named(name)
    seed = fresh_seed()
    num_episodes = 60
    batch = suite.load_batch(
        agent.card["domain"], agent.card["task"], num_episodes, {"random": seed, **agent.card["task_kwargs"]}
    )
    played = acting.play_round(agent.network, batch, 0, acting.drawn(np.random.default_rng(seed)))
    batch.close()
    right = int((played.rewards.sum(axis=0) > 0).sum())
    told = agent.card["evaluation"]["drawn"]
    known_right = round(told["success_rate"] * told["episodes"])
    # What is likely after the card's own episodes, if all rates were alike before.
    likely = stats.betabinom(num_episodes, known_right + 1, told["episodes"] - known_right + 1)
    assert min(likely.cdf(right), likely.sf(right - 1)) > P_VALUE


@every_agent
def test_an_agent_plays_in_a_loop(name):
    agent = pretrained.load_named(name)
    actor = agent.actor()
    assert isinstance(actor, core.Actor)
    environment = suite.load(agent.card["domain"], agent.card["task"], agent.card["task_kwargs"])
    for episode in environment_loop.EnvironmentLoop(environment, actor).run(2):
        assert 1 <= episode["episode_length"] <= environment.task.rules.step_limit
        assert episode["episode_return"] in (1, -1)
    environment.close()


def test_the_default_difficulty_is_that_of_the_task():
    card = pretrained.load("which_is_heavier", "features").card
    assert card["task_kwargs"]["difficulty"] == suite.load_task("which_is_heavier", "features").options.difficulty


@every_agent
def test_an_agent_is_found_by_the_options_of_its_task_by_position_and_by_name(name):
    agent = pretrained.load_named(name)
    domain, task, options = (agent.card[key] for key in ("domain", "task", "task_kwargs"))
    *learner, stem = name.split("/")
    assert pretrained.name(domain, task, options) == stem
    load = functools.partial(pretrained.load, domain, task, agent=learner[0] if learner else None)
    for found in (load(*options.values()), load(**options)):
        assert found.card == agent.card
    for kind in (np.float32, np.float64):
        options = {name: kind(value) if isinstance(value, float) else value for name, value in options.items()}
        assert load(**options).card == agent.card
    assert pretrained.load(domain, task, None).card["task"] == task, "None is no choice"


def test_an_agent_that_is_not_there_is_refused_with_a_list_of_those_that_are():
    with pytest.raises(ValueError, match="named towers-nothing; there are: .*towers-fist_features"):
        agents.load_pretrained("towers", "nothing")
    for values, options in (((4,), {}), ((), {"difficulty": 4})):
        with pytest.raises(ValueError, match="which_is_heavier-features-difficulty4; there are"):
            agents.load_pretrained("which_is_heavier", "features", *values, **options)
    with pytest.raises(ValueError, match="no trained agent of towers/fist_features has options 3; there are: .*towers"):
        agents.load_pretrained("towers", "fist_features", 3)


@pytest.mark.parametrize(
    ("names", "what"),
    [
        ((None, "features"), "domain is None"),
        (("towers", 3), "task is 3"),
        (("towers", "fist_pixels", 3), "agent is 3"),
    ],
)
def test_what_is_no_name_is_refused(names, what):
    domain, task, *agent = names
    with pytest.raises(ValueError, match=f"{what}; give a name"):
        pretrained.load(domain, task, **({"agent": agent[0]} if agent else {}))


def test_an_option_that_is_given_twice_is_refused():
    with pytest.raises(ValueError, match="difficulty is given twice, 3 and 10; give it once"):
        pretrained.load("which_is_heavier", "features", 3, difficulty=10)


def test_an_agent_is_found_by_its_learner(small, tmp_path):
    network, card = small
    learners = {"belief": tmp_path, "a3c": tmp_path / "a3c", "ppo": tmp_path / "ppo"}
    for learner, folder in learners.items():
        pretrained.save(network, {**card, "agent": {"algorithm": learner}}, folder)
    assert pretrained.names(tmp_path) == ["a3c/towers-some", "ppo/towers-some", "towers-some"]
    for learner in learners:
        found = pretrained.load("towers", "some", agent=learner, folder=tmp_path)
        assert found.card["agent"]["algorithm"] == learner
    assert pretrained.load("towers", "some", folder=tmp_path).card["agent"]["algorithm"] == "belief"
    assert pretrained.load_named("a3c/towers-some", tmp_path).card["agent"]["algorithm"] == "a3c"
    with pytest.raises(
        ValueError, match="no trained agent of towers/some .* is dqn's; there are: a3c/towers-some, ppo"
    ):
        pretrained.load("towers", "some", agent="dqn", folder=tmp_path)
    (tmp_path / "ppo" / "towers-some.safetensors").write_bytes(b"damaged")
    with pytest.raises(ValueError, match="damaged"):
        pretrained.load("towers", "some", agent="ppo", folder=tmp_path)


def test_what_is_saved_is_what_is_loaded_to_half_precision(tmp_path):
    batch = suite.load_batch("towers", "fist_pixels", 1)
    hyperparameters = {"lstm_units": 8, "observation_scale": 2.0}
    network = networks.RecurrentActorCritic(batch.observation_spec(), 9, **hyperparameters)
    network.calibrate({"pixels": torch.randint(256, (1, 84, 84, 3), dtype=torch.uint8)})
    batch.close()
    card = {
        "domain": "towers",
        "task": "fist_pixels",
        "task_kwargs": {},
        "network": {
            "kind": "RecurrentActorCritic",
            "observations": {"pixels": ((84, 84, 3), "uint8")},
            "num_actions": 9,
            "hyperparameters": hyperparameters,
        },
    }
    pretrained.save(network, card, tmp_path)
    loaded = pretrained.load("towers", "fist_pixels", folder=tmp_path)
    expected = pretrained.halved(network).state_dict()
    for name, value in loaded.network.state_dict().items():
        assert value.dtype == expected[name].dtype and torch.equal(value, expected[name]), name


@pytest.fixture
def small():
    """A small network of a task, and the least that a card says."""
    observations = {"features": specs.Array((3,), np.float32, "features")}
    network = networks.RecurrentActorCritic(observations, 4, lstm_units=1, observation_scale=2.0)
    card = {
        "domain": "towers",
        "task": "some",
        "task_kwargs": {},
        "network": {
            "kind": "RecurrentActorCritic",
            "observations": {"features": ((3,), "float32")},
            "num_actions": 4,
            "hyperparameters": {"lstm_units": 1, "observation_scale": 2.0},
        },
    }
    return network, card


def test_files_are_named_after_the_options_of_the_task_whatever_they_are(small, tmp_path):
    network, card = small
    options = {"skew": 2.0, "levels": 8, "is_covered": True, "chosen_by_nobody": None}
    path = pretrained.save(network, {**card, "task_kwargs": options}, tmp_path)
    assert path.name == "towers-some-is_coveredTrue-levels8-skew2.json"
    assert pretrained.load("towers", "some", folder=tmp_path, levels=8, is_covered=True, skew=2).card["task"] == "some"


def test_without_a_choice_the_only_agent_of_a_task_is_taken_or_the_one_that_is_the_default(small, tmp_path):
    network, card = small
    pretrained.save(network, {**card, "task_kwargs": {"skew": 2.5}}, tmp_path)
    assert pretrained.load("towers", "some", folder=tmp_path).card["task_kwargs"] == {"skew": 2.5}
    pretrained.save(network, {**card, "task_kwargs": {"skew": 1e-5}}, tmp_path)
    with pytest.raises(ValueError, match="no trained agent is named towers-some; there are: towers-some-skew1e-05, "):
        pretrained.load("towers", "some", folder=tmp_path)
    pretrained.save(network, {**card, "task_kwargs": {"skew": 3.0}, "default": True}, tmp_path)
    assert pretrained.load("towers", "some", folder=tmp_path).card["task_kwargs"] == {"skew": 3.0}
    pretrained.save(network, card, tmp_path)  # Trained on the task as it is where nothing is chosen.
    assert pretrained.load("towers", "some", folder=tmp_path).card["task_kwargs"] == {}


def test_agents_of_one_task_may_differ_in_different_options(small, tmp_path):
    network, card = small
    for options in ({"noise": 0.01}, {"variation": 1.0, "reveal": True}):
        pretrained.save(network, {**card, "task_kwargs": options}, tmp_path)
    assert pretrained.options_of("towers", "some", tmp_path) == ["noise", "reveal", "variation"]
    load = functools.partial(pretrained.load, "towers", "some", folder=tmp_path)
    assert load(0.01).card["task_kwargs"] == load(noise=0.01).card["task_kwargs"] == {"noise": 0.01}
    assert load(None, True, 1.0).card["task_kwargs"] == load(reveal=True, variation=1).card["task_kwargs"]
    with pytest.raises(ValueError, match="no trained agent is named towers-some-variation1; there are: "):
        load(variation=1)


def test_a_card_of_another_agent_is_refused(small, tmp_path):
    network, card = small
    path = pretrained.save(network, {**card, "task_kwargs": {"skew": 3.0}}, tmp_path)
    path.write_bytes(pretrained.sealed({**card_of(path), "task_kwargs": {"skew": 4.0}}))
    with pytest.raises(ValueError, match="it is of towers-some-skew4; publish the agent again"):
        pretrained.load("towers", "some", folder=tmp_path)


def weights_of(network):
    return {name: value.clone() for name, value in network.state_dict().items()}


def is_same(network, weights):
    return all(torch.equal(value, weights[name].half().float()) for name, value in network.state_dict().items())


@every_agent
def test_an_agent_that_comes_with_the_package_has_checksums(name):
    path = path_of(name)
    card = card_of(path)
    assert card["sha256"] == hashlib.sha256(path.with_suffix(".safetensors").read_bytes()).hexdigest()
    assert pretrained.sealed({**card, "card_sha256": None}) == path.read_bytes()


@pytest.mark.parametrize("stop_at", range(4))
def test_an_agent_that_is_replaced_is_the_old_one_or_the_new_whenever_its_writer_stops(
    stop_at, small, tmp_path, monkeypatch
):
    network, card = small
    pretrained.save(network, {**card, "seed": 1}, tmp_path)
    old = weights_of(network)
    torch.nn.init.uniform_(network.policy.weight)
    new, replace, done = weights_of(network), os.replace, []

    class Killed(BaseException):
        pass

    def count(*args, **kwargs):  # Between any two of these calls, nothing else changes in the folder.
        if len(done) == stop_at:
            raise Killed
        done.append(args)
        return replace(*args, **kwargs)

    monkeypatch.setattr(os, "replace", count)
    try:
        pretrained.save(network, {**card, "seed": 2}, tmp_path)
    except Killed:
        assert stop_at < 3
    found = pretrained.load("towers", "some", folder=tmp_path)
    assert (found.card["seed"], is_same(found.network, old), is_same(found.network, new)) in (
        [(1, True, False)] if stop_at < 2 else [(2, False, True)]
    )
    # The next writer, stopped after its weights, leaves what was there.
    done.clear()
    torch.nn.init.uniform_(network.policy.weight)
    with contextlib.suppress(Killed):
        pretrained.save(network, {**card, "seed": 3}, tmp_path)
    again = pretrained.load("towers", "some", folder=tmp_path)
    if again.card["seed"] == found.card["seed"]:
        assert is_same(again.network, weights_of(found.network))
    else:
        assert again.card["seed"] == 3 and is_same(again.network, weights_of(network))
    monkeypatch.undo()
    pretrained.save(network, {**card, "seed": 4}, tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["towers-some.json", "towers-some.safetensors"]


def test_weights_of_another_card_are_refused(small, tmp_path):
    network, card = small
    pretrained.save(network, card, tmp_path)
    torch.nn.init.uniform_(network.policy.weight)
    checkpointing.write_agent(tmp_path / "towers-some.safetensors", network.state_dict())
    with pytest.raises(ValueError, match=r"towers-some.safetensors is damaged: its checksum differs; put back"):
        pretrained.load("towers", "some", folder=tmp_path)


def test_weights_that_half_precision_does_not_hold_are_not_written(small, tmp_path):
    network, card = small
    network.value.weight.data[0, 0] = 1e5  # Finite, but beyond 65 504.
    with pytest.raises(ValueError, match="not finite in half precision"):
        pretrained.save(network, card, tmp_path / "agents")
    assert not (tmp_path / "agents").exists()


def test_every_bit_of_a_card_counts(small, tmp_path):
    network, card = small
    path = pretrained.save(network, card, tmp_path)
    content, expected = path.read_bytes(), card_of(path)
    for bit in np.random.default_rng(fresh_seed()).choice(8 * len(content), 1000, replace=False):
        path.write_bytes(bits.flipped(content, bit))
        try:
            found = pretrained.load("towers", "some", folder=tmp_path)
        except ValueError as error:
            assert str(tmp_path) in str(error) and "\n" not in str(error)
        else:  # A name that nobody knows is as good as none.
            assert {**found.card, "card_sha256": 0, "sha256": 0}.items() >= {
                **{name: value for name, value in expected.items() if name in card},
                "card_sha256": 0,
                "sha256": 0,
            }.items()
            assert is_same(found.network, weights_of(network))


BAD_CARDS = {
    "no JSON": "{",
    "deep JSON": "[" * 100_000,
    "no object": "[]",
    "no network": {"network": None},
    "no hyperparameters": {"network": {"observations": {}, "num_actions": 4}},
    "options of another agent": {"task_kwargs": {"colour": "red"}},
    "options that are none": {"task_kwargs": 3},
    "another agent": {"task": "other"},
    "no units": ("lstm_units", 0),
    "half a unit": ("lstm_units", 0.5),
    "units without end": ("lstm_units", 10**30),
    "more units than the weights have": ("lstm_units", 65_536),
    "units by another name": ("lstm_units", "many"),
    "an infinite scale": ("observation_scale", 10**400),
    "a scale that is none": ("observation_scale", [2.0]),
    "no actions": ("num_actions", -1),
    "actions without end": ("num_actions", 2**62),
    "an observation without end": ("observations", {"features": ((2**40, 2**40), "float32")}),
    "an observation of no type": ("observations", {"features": ((3,), "float33")}),
    "an observation of no shape": ("observations", {"features": 3}),
    "a picture that is none": ("observations", {"features": ((3,), "uint8")}),
    "no observations": ("observations", {}),
}


@pytest.mark.parametrize("case", BAD_CARDS)
def test_a_card_may_hold_anything_and_what_makes_no_sense_is_one_line(case, small, tmp_path):
    network, card = small
    path, change = pretrained.save(network, card, tmp_path), BAD_CARDS[case]
    if isinstance(change, str):
        path.write_text(change)
    else:
        if isinstance(change, tuple):
            facts, (name, value) = card["network"], change
            inner = facts["hyperparameters"]
            change = {
                "network": facts | ({"hyperparameters": inner | {name: value}} if name in inner else {name: value})
            }
        path.write_bytes(pretrained.sealed({**card_of(path), **change}))
    with pytest.raises(ValueError, match=f"^{tmp_path}") as refused:
        pretrained.load("towers", "some", folder=tmp_path)
    assert "\n" not in str(refused.value) and len(str(refused.value)) < 400


@pytest.mark.parametrize("suffix", [".json", ".safetensors"])
def test_files_of_an_agent_that_are_no_files_are_refused_without_waiting(suffix, small, tmp_path):
    network, card = small
    path = pretrained.save(network, card, tmp_path).with_suffix(suffix)
    for make, kind in ((os.mkfifo, "a pipe"), (os.mkdir, "a folder"), (lambda p: p.symlink_to(p), "a symbolic link")):
        path.rename(tmp_path / "away") if path.is_file() else None
        make(path)
        with pytest.raises(ValueError, match=f"{path.name} is {kind}; put a regular file in its place"):
            pretrained.load("towers", "some", folder=tmp_path)
        path.rmdir() if kind == "a folder" else path.unlink()


def test_a_card_that_has_lost_one_of_its_checksums_is_refused(small, tmp_path):
    network, card = small
    path = pretrained.save(network, card, tmp_path)
    path.write_text(path.read_text().replace('"card_sha256"', '"cqrd_sha256"'))
    with pytest.raises(ValueError, match="lacks 'card_sha256'; publish the agent again"):
        pretrained.load("towers", "some", folder=tmp_path)


def test_an_agent_that_cannot_be_written_leaves_the_old_one_and_nothing_else(small, tmp_path, monkeypatch):
    network, card = small
    path = pretrained.save(network, card, tmp_path)
    before = {item.name: item.read_bytes() for item in tmp_path.iterdir()}
    write = files.write_atomically

    def no_room_for_cards(target, content):
        if target == path:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(target))
        write(target, content)

    monkeypatch.setattr(files, "write_atomically", no_room_for_cards)
    torch.nn.init.uniform_(network.policy.weight)
    with pytest.raises(OSError, match="No space left"):
        pretrained.save(network, card, tmp_path)
    assert {item.name: item.read_bytes() for item in tmp_path.iterdir()} == before


def test_a_pipe_where_weights_wait_keeps_nobody_waiting(small, tmp_path):
    network, card = small
    path = pretrained.save(network, card, tmp_path)
    os.mkfifo(path.with_suffix(".next.safetensors"))
    pretrained.save(network, {**card, "seed": 2}, tmp_path)
    assert pretrained.load("towers", "some", folder=tmp_path).card["seed"] == 2
    assert sorted(item.name for item in tmp_path.iterdir()) == ["towers-some.json", "towers-some.safetensors"]


def test_importing_the_agents_package_imports_no_torch():
    code = "import sys; import physexp.agents; assert 'torch' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
