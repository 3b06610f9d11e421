"""One worker, or process, is deterministic, and a killed and resumed run ends as if nothing had happened."""

import time

import numpy as np
import pandas as pd
import pytest
import torch
import trainers

from physexp import suite
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer

FRAMES = 24_000  # Some seconds, with several checkpoints in each.


@pytest.fixture(scope="module", params=trainers.SMALL)
def uninterrupted(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("uninterrupted") / "run"
    run = trainers.create(path, request.param, frames=FRAMES, seed=trainers.fresh_seed())
    trainer.train(run)
    return run


def assert_same_weights(run, other):
    tensors, expected = run.checkpointer.latest()[0], other.checkpointer.latest()[0]
    assert set(tensors) == set(expected)
    assert int(tensors["frames"]) >= FRAMES
    for name, value in expected.items():
        assert torch.equal(tensors[name], value), f"{name} differs"


def assert_whole_records(run):
    """The records have every frame once, in order, up to the last checkpoint, and each episode can be rebuilt."""
    metrics = pd.read_csv(run.path / "metrics.csv")
    assert list(metrics.columns) == [*run_lib.METRICS, *run.config.agent.metrics]
    frames = metrics["frames"].to_numpy()
    tensors, facts = run.checkpointer.latest()
    assert (np.diff(frames) > 0).all()
    assert frames[-1] == int(tensors["frames"])
    assert metrics["updates"].iloc[-1] == int(tensors["updates"]) == int(tensors["rounds"].sum())
    # Every update is one round of 32 episodes.
    assert metrics["episodes"].iloc[-1] == facts["episodes"] == 32 * int(tensors["updates"])
    assert (np.diff(metrics["seconds"]) > 0).all()

    episodes = pd.read_parquet(run.path / "episodes.parquet")
    assert list(episodes.columns) == run_lib.EPISODES.names
    assert sorted(set(episodes["frames"])) == list(frames), "each row of metrics has the episodes of one update"
    assert not episodes.duplicated(["seed", "episode"]).any()
    generator = np.random.default_rng(trainers.fresh_seed())
    for row in episodes.iloc[generator.choice(len(episodes), 5, replace=False)].itertuples():
        assert_rebuildable(row, run.config)


def assert_rebuildable(row, config):
    task_kwargs = {**config.task_kwargs, "random": int(row.seed)}
    environment = suite.load(config.domain, config.task, task_kwargs)
    environment.task.next_episode = row.episode
    timestep = environment.reset()
    for action in row.actions:
        assert not timestep.last()
        timestep = environment.step(int(action))
    assert timestep.last() and timestep.reward == row.reward
    assert environment.task.correct_answer == row.answer
    assert len(row.actions) == row.length
    # Labels are actions 4 to 7; -1 stands for none.
    assert row.label == (row.actions[-1] - 4 if row.actions[-1] >= 4 else -1)
    assert row.reward == (1 if row.label == row.answer else -1)
    environment.close()


def test_training_records_everything_once_and_every_episode_can_be_rebuilt(uninterrupted):
    assert_whole_records(uninterrupted)


def test_the_same_seed_gives_the_same_weights_to_the_last_bit(uninterrupted, tmp_path):
    agent = uninterrupted.config.agent
    again = trainers.create(
        tmp_path / "run", agent.algorithm, frames=FRAMES, seed=agent.seed, checkpoint_seconds=1000.0
    )
    trainer.train(again)
    assert_same_weights(again, uninterrupted)


def test_a_run_killed_at_any_moment_resumes_to_the_same_weights(uninterrupted, tmp_path):
    agent = uninterrupted.config.agent
    run = trainers.create(tmp_path / "run", agent.algorithm, frames=FRAMES, seed=agent.seed)
    with trainers.trainer(run) as process:
        generator = np.random.default_rng(trainers.fresh_seed())
        beyond, delay = generator.integers(FRAMES // 3), generator.uniform(0, agent.checkpoint_seconds)
        trainers.wait_for_checkpoint(process, run, beyond)
        print("killed", delay, "s after the first checkpoint beyond frame", beyond)
        time.sleep(delay)
        assert process.poll() is None, "it has to be killed before it is done; give it more frames"
    reached = int(run.checkpointer.latest()[0]["frames"])
    assert 0 < reached < FRAMES
    with trainers.trainer(run) as process:
        _, errors = process.communicate(timeout=90)
    assert process.returncode == 0, errors
    assert_same_weights(run, uninterrupted)
    assert_whole_records(run)
