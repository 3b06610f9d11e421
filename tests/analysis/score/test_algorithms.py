"""Several agents of one configuration are scored together: they play in turns, and the interval is over seeds."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy import stats
import trainers

from physexp.agents import pretrained
from physexp.analysis.score import leaderboard, log, protocol, scoring, targets, verifying

(THRESHOLD,) = protocol.named(["threshold/features"])
SEEDS, COUNT = 3, 11  # Agents, and episodes: not as many for each.


def published(folder, seed, options=(), also=(), **changes):
    """The path of an agent like one of the package, with another seed; its weights are small, so that it errs."""
    agent = pretrained.load_named("threshold-features")
    for values in agent.network.parameters():
        values.data.mul_(0.2)
    card = {**agent.card, "agent": {**agent.card["agent"], "seed": seed, **changes}}
    card |= {"task_kwargs": dict(options), "also": also}
    return str(pretrained.save(agent.network, card, folder))


@pytest.fixture
def agents(tmp_path):
    """The names of three agents, with commas between them."""
    return ",".join(published(tmp_path / str(seed), seed) for seed in range(SEEDS))


def test_agents_of_several_seeds_play_in_turns_with_students_interval(agents, here):
    folder, target = Path("results/scores/seeds"), targets.find(agents)
    written = scoring.score(target, [THRESHOLD], COUNT, folder)
    assert written["agent"]["seeds"] == [0, 1, 2] and written["agent"]["answers_revealed"] is False
    metrics = written["tasks"][THRESHOLD.name]
    returns = [
        its["reward"] @ THRESHOLD.discount ** its["step"].astype(float)
        for its in log.split(log.of_task(log.read(folder), THRESHOLD))
    ]
    shares = (np.array(returns) - metrics["floor"]) / (metrics["ideal"] - metrics["floor"])
    means = [shares[seed::SEEDS].mean() for seed in range(SEEDS)]
    expected = stats.t.interval(0.95, SEEDS - 1, np.mean(means), stats.sem(means))
    assert metrics["raw_interval"] == pytest.approx(expected)
    alone = targets.find(agents.split(",")[1])
    again = scoring.score(alone, [THRESHOLD], 2, Path("alone"))["tasks"][THRESHOLD.name]
    assert again["episodes"] == 2
    played = [log.split(log.of_task(log.read(one), THRESHOLD))[1]["action"].tolist() for one in (folder, Path("alone"))]
    assert played[0] == played[1], "the second agent plays the second episode"
    assert verifying.verify(folder)["episodes"] == COUNT
    written["protocol"]["agents"] = 1
    (folder / scoring.FILE).write_text(json.dumps(written))
    with pytest.raises(ValueError, match="interval is .*, and .* by the log"):
        verifying.verify(folder)


def test_a_row_says_how_many_agents_it_has_and_how_they_were_trained(agents, here, monkeypatch):
    monkeypatch.setattr(protocol, "EPISODES", COUNT)
    scoring.score(targets.find(agents), [THRESHOLD], COUNT, Path("results/scores/seeds"))
    rows, refused = leaderboard.read(Path("results"), verify=lambda folder: None)
    assert not refused
    page = leaderboard.markdown(rows)
    frames = pretrained.card_named("threshold-features")["frames"]
    assert f" | belief | 3 seeds | no | 0.95 | {frames:,} | " in page and "| 1 of 7 |" in page


def test_an_agent_is_not_scored_on_a_held_out_task_that_it_was_trained_on(tmp_path):
    (unseen,) = protocol.named(["threshold/features,difficulty=2"])
    assert targets.find(published(tmp_path / "usual", 0)).choose([], ["unseen"]) == (unseen,)
    for name, options, also in (("seen", {"difficulty": 2.0}, []), ("also", {}, [{"difficulty": 2.0}])):
        seen = targets.find(published(tmp_path / name, 0, options, also))
        with pytest.raises(ValueError, match="was trained on threshold/features,difficulty=2, which its track holds"):
            seen.choose([], ["unseen"])


@pytest.mark.parametrize(
    ("others", "said"),
    [
        (
            "strings/features",
            "has agents: 3 for threshold/features, 1 for strings/features; give one for each task, or",
        ),
        ("threshold-features", "has two agents for threshold/features with equal seeds or of other configurations"),
    ],
)
def test_agents_of_other_configurations_or_numbers_are_refused(agents, others, said):
    with pytest.raises(ValueError, match=said):
        targets.find(f"{agents},{others}")


def test_two_agents_or_two_configurations_are_no_algorithm(tmp_path):
    first, second = published(tmp_path / "0", 0), published(tmp_path / "1", 1)
    with pytest.raises(ValueError, match="has agents: 2 for threshold/features; give .* at least 3"):
        targets.find(f"{first},{second}")
    other = published(tmp_path / "2", 2, frames=7)
    with pytest.raises(ValueError, match="with equal seeds or of other configurations"):
        targets.find(f"{first},{second},{other}")


def test_the_runs_in_a_folder_are_scored_together(tmp_path):
    for seed in range(3):
        trainers.save_first_checkpoint(trainers.create(tmp_path / f"seed{seed}", "belief", seed=seed))
    target = targets.find(str(tmp_path))
    (asked,) = target.choose([], [])
    assert target.num_agents == 3 and asked.name == "which_is_heavier/features,difficulty=10"
    with pytest.raises(ValueError, match="episodes is 2; give at least 3, one for each agent of a task"):
        scoring.score(target, [asked], 2, tmp_path / "score")
