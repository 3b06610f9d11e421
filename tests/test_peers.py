"""Learners of other projects, the examples of docs/how_to.md, train on our tasks and are scored."""

import importlib
import json
from pathlib import Path

import numpy as np
import pytest
from seeds import fresh_seed
import torch

from physexp import suite
from physexp.analysis.score import player, protocol, scoring, targets

EXAMPLES = Path(__file__).parents[1] / "docs" / "examples"
FRAMES = 1024
PEERS = ["recurrent_ppo", "skrl_ppo"]
(STRINGS,) = protocol.named(["strings/features"])


@pytest.fixture(scope="module", autouse=True)
def here(tmp_path_factory):
    """Trains each peer for some hundred steps in a folder, which becomes the current one."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(EXAMPLES))
        patch.chdir(tmp_path_factory.mktemp("peers"))
        for peer in PEERS:
            importlib.import_module(peer).train(STRINGS.name, frames=FRAMES)
        yield


@pytest.mark.parametrize("peer", PEERS)
def test_a_peer_keeps_its_network_and_the_facts_of_its_training(peer):
    facts = json.loads(Path(f"runs/{peer}/strings-features.json").read_text())
    assert facts["frames"] == FRAMES and facts["seconds"] > 0
    assert facts["command"].startswith(f"python {peer}.py strings/features --frames {FRAMES} ")
    assert facts["curve"][-1].items() <= facts.items()
    assert all(-1 <= row["return"] <= 1 for row in facts["curve"])


@pytest.mark.parametrize("peer", PEERS)
def test_a_trained_peer_is_scored_and_other_tasks_say_how_to_train(peer):
    found = scoring.score(targets.find(f"{peer}:make"), [STRINGS], 5, Path(f"scored_{peer}"))
    assert found["complete"] and found["tasks"]["strings/features"]["episodes"] == 5
    with pytest.raises(player.PlayerError, match=rf"balance-features\.\w+ is missing; train it: python {peer}.py b"):
        scoring.score(targets.find(f"{peer}:make"), protocol.named(["balance/features"]), 1, Path(f"none_{peer}"))


@pytest.mark.parametrize("peer", PEERS)
def test_a_policy_remembers_within_one_episode_alone(peer):
    policy = importlib.import_module(peer).make(STRINGS)
    observation = suite.load("strings", "features", task_kwargs={"random": 0}).reset().observation
    _, first = policy(observation, None)
    _, second = policy(observation, first)
    _, again = policy(observation, None)
    np.testing.assert_array_equal(np.asarray(first), np.asarray(again))
    assert not np.array_equal(np.asarray(first), np.asarray(second))


def test_the_network_of_skrl_is_the_same_in_sequences_and_step_by_step():
    torch.manual_seed(fresh_seed())
    length, count = 16, 3
    policy = importlib.import_module("skrl_ppo").Policy(STRINGS, count)
    observed = torch.rand(length, count, policy.num_observations)
    ended = torch.rand(length, count) < 0.3
    states = [torch.rand(1, count, 64)]
    outputs = []
    policy.eval()
    for step in range(length):
        output, more = policy.compute({"observations": observed[step], "rnn": states[-1:]}, "policy")
        outputs.append(output)
        states.append(more["rnn"][0] * ~ended[step, :, None])
    sequences = {  # One environment after another.
        "observations": observed.transpose(0, 1).flatten(0, 1),
        "rnn": [torch.cat(states[:-1]).transpose(0, 1).flatten(0, 1)[None]],
        "terminated": ended.T.reshape(-1, 1),
    }
    policy.train()
    together, _ = policy.compute(sequences, "policy")
    torch.testing.assert_close(together, torch.stack(outputs, dim=1).flatten(0, 1))
