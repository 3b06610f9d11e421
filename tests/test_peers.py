"""The learners of docs/how_to.md, of other projects and in one file, train on our tasks and are scored."""

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
ONE_FILE = {"as_in_one_file": True}
PEERS = {  # By the folder of a training: the learner, its options, and frames enough for a rollout.
    "recurrent_ppo": ("recurrent_ppo", {}, 1024),
    "recurrent_ppo/as_in_one_file": ("recurrent_ppo", ONE_FILE, 4096),
    "recurrent_ppo_in_one_file": ("recurrent_ppo_in_one_file", {}, 4096),
    "skrl_ppo": ("skrl_ppo", {}, 1024),
    "skrl_ppo/as_in_one_file": ("skrl_ppo", ONE_FILE, 4096),
}
(STRINGS,) = protocol.named(["strings/features"])


@pytest.fixture(scope="module", autouse=True)
def here(tmp_path_factory):
    """Trains each peer for some thousand steps in a folder, which becomes the current one."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(EXAMPLES))
        patch.chdir(tmp_path_factory.mktemp("peers"))
        for learner, options, frames in PEERS.values():
            importlib.import_module(learner).train(STRINGS.name, frames=frames, **options)
        yield


def maker(options):
    """The name of the function that makes a policy of a training with these options."""
    return "_".join(["make", *options])


@pytest.mark.parametrize("peer", PEERS)
def test_a_peer_keeps_its_network_and_the_facts_of_its_training(peer):
    learner, options, frames = PEERS[peer]
    facts = json.loads(Path(f"runs/{peer}/strings-features.json").read_text())
    assert facts["frames"] == frames and facts["seconds"] > 0
    assert facts["command"].startswith(f"python {learner}.py strings/features --frames {frames} ")
    assert facts["command"].endswith(" --as-in-one-file") == bool(options)
    assert facts["curve"][-1].items() <= facts.items()
    assert all(-1 <= row["return"] <= 1 for row in facts["curve"])


@pytest.mark.parametrize("peer", PEERS)
def test_a_trained_peer_is_scored_and_other_tasks_say_how_to_train(peer, tmp_path):
    learner, options, _ = PEERS[peer]
    target = targets.find(f"{learner}:{maker(options)}")
    found = scoring.score(target, [STRINGS], 5, tmp_path / "scored")
    assert found["complete"] and found["tasks"]["strings/features"]["episodes"] == 5
    with pytest.raises(player.PlayerError, match=rf"balance-features\.\w+ is missing; train it: python {learner}.py b"):
        scoring.score(target, protocol.named(["balance/features"]), 1, tmp_path / "none")


@pytest.mark.parametrize("peer", PEERS)
def test_a_policy_remembers_within_one_episode_alone(peer):
    learner, options, _ = PEERS[peer]
    policy = getattr(importlib.import_module(learner), maker(options))(STRINGS)
    observation = suite.load("strings", "features", task_kwargs={"random": 0}).reset().observation
    _, first = policy(observation, None)
    _, second = policy(observation, first)
    _, again = policy(observation, None)
    np.testing.assert_array_equal(remembered(first), remembered(again))
    assert not np.array_equal(remembered(first), remembered(second))


def remembered(state):
    """The state of a memory, without the action before that some policies keep beside it."""
    return np.asarray(state[1] if isinstance(state[0], int) else state)


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


@pytest.fixture
def one_file():
    """The learner in one file, as a module."""
    return importlib.import_module("recurrent_ppo_in_one_file")


def test_the_network_in_one_file_forgets_between_episodes(one_file):
    torch.manual_seed(fresh_seed())
    length, count = 12, 3
    network = one_file.Network(one_file.num_features(STRINGS), STRINGS.num_actions)
    seen = torch.rand(length, count, one_file.num_features(STRINGS))
    before = torch.randint(STRINGS.num_actions, (length, count))
    before[torch.rand(length, count) < 0.3] = STRINGS.num_actions
    before[0] = STRINGS.num_actions
    _, together, last = network(seen, before, torch.rand(count, one_file.UNITS))
    for column in range(count):
        starts = (before[:, column] == STRINGS.num_actions).nonzero()[:, 0].tolist()
        for first, end in zip(starts, [*starts[1:], length], strict=True):  # Each episode by itself.
            _, alone, state = network(
                seen[first:end, [column]], before[first:end, [column]], torch.zeros(1, one_file.UNITS)
            )
            torch.testing.assert_close(alone[:, 0], together[first:end, column])
        torch.testing.assert_close(state[0], last[column])


def test_advantages_in_one_file_are_weighted_sums_of_later_errors(one_file):
    torch.manual_seed(fresh_seed())
    length, count, discount = 9, 4, 0.9
    rewards, values, after = torch.randn(length, count), torch.randn(length, count), torch.randn(count)
    ended = torch.rand(length, count) < 0.3
    unused = dict.fromkeys(["seen", "before", "actions", "log_probabilities", "state"])
    found = one_file.advantages(one_file.Steps(**unused, rewards=rewards, values=values, ended=ended), after, discount)
    following = torch.cat([values[1:], after[None]])
    errors = rewards + discount * following * ~ended - values
    for column in range(count):
        for step in range(length):
            expected, weight = 0.0, 1.0
            for later in range(step, length):
                expected += weight * errors[later, column]
                weight *= discount * one_file.GAE_LAMBDA
                if ended[later, column]:
                    break
            torch.testing.assert_close(found[step, column], expected)


def test_the_network_in_one_file_standardizes_by_all_that_was_seen(one_file):
    torch.manual_seed(fresh_seed())
    network, parts = one_file.Network(2, 3), [5 + 2 * torch.randn(count, 2) for count in (4, 30, 7)]
    for part in parts:
        network.standardize(part)
    together = torch.cat(parts)
    torch.testing.assert_close(network.mean, together.mean(dim=0))
    torch.testing.assert_close(network.variance, together.var(dim=0, correction=0))


def test_the_learner_in_one_file_gives_the_same_network_for_the_same_seed(one_file, monkeypatch, tmp_path):
    first = torch.load(one_file.path_of(STRINGS))
    monkeypatch.setattr(one_file, "FOLDER", tmp_path)
    for seed, is_same in [(0, True), (1, False)]:
        one_file.train(STRINGS.name, PEERS["recurrent_ppo_in_one_file"][2], seed)
        again = torch.load(one_file.path_of(STRINGS))
        assert all(torch.equal(first[name], again[name]) for name in first) == is_same
