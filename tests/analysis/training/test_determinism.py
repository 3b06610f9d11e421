"""An agent of one process is deterministic, and a killed and resumed run ends as an undisturbed one.

For PPO that is tested among the kills of `tests/reliability`.
"""

import signal

import commands
import numpy as np
import pandas as pd
import pytest
import seeds
import torch
import trainers

from physexp import suite
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer

CHECKPOINT_SECONDS = 0.1
FRAMES = 3_000  # Some seconds, with several checkpoints in each.


@pytest.fixture(scope="module", params=["a3c", "belief"])
def uninterrupted(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("uninterrupted") / "run"
    seed = seeds.fresh_seed()
    run = trainers.create(path, request.param, frames=FRAMES, seed=seed, checkpoint_seconds=CHECKPOINT_SECONDS)
    trainer.train(run)
    return run


def assert_same_weights(run, other):
    tensors, expected = run.checkpointer.latest()[0], other.checkpointer.latest()[0]
    assert set(tensors) == set(expected)
    assert int(tensors["frames"]) >= FRAMES
    for name, value in expected.items():
        assert torch.equal(tensors[name], value), f"{name} differs"


def assert_whole_records(run):
    """The records have every frame once and in order up to the last checkpoint, and episodes can be rebuilt."""
    metrics = pd.read_csv(run.path / "metrics.csv")
    assert list(metrics.columns) == [*run_lib.METRICS, *run.config.agent.metrics]
    frames = metrics["frames"].to_numpy()
    tensors, facts = run.checkpointer.latest()
    assert (np.diff(frames) > 0).all()
    assert frames[-1] == int(tensors["frames"])
    assert metrics["updates"].iloc[-1] == int(tensors["updates"]) == int(tensors["rounds"].sum())
    # Every update is one round of episodes.
    assert metrics["episodes"].iloc[-1] == facts["episodes"] == trainers.NUM_ENVIRONMENTS * int(tensors["updates"])
    assert (np.diff(metrics["seconds"]) > 0).all()

    episodes = pd.read_parquet(run.path / "episodes.parquet")
    assert list(episodes.columns) == run_lib.EPISODES.names
    assert sorted(set(episodes["frames"])) == list(frames), "each row of metrics has the episodes of one update"
    assert not episodes.duplicated(["seed", "episode"]).any()
    generator = np.random.default_rng(seeds.fresh_seed())
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


def train_until_killed(path, beyond, seconds):
    """Trains on, and is killed some time after the first checkpoint beyond some frames."""

    def watch(frames, variables):
        if frames > beyond and not signal.getitimer(signal.ITIMER_REAL)[0]:
            signal.setitimer(signal.ITIMER_REAL, seconds)

    signal.signal(signal.SIGALRM, signal.SIG_DFL)  # Ends the process as SIGKILL does.
    trainer.train(run_lib.Run(path), on_checkpoint=watch)


def test_a_run_killed_at_any_moment_resumes_to_the_same_weights(uninterrupted, tmp_path):
    agent, generator = uninterrupted.config.agent, np.random.default_rng(seeds.fresh_seed())
    run = trainers.create(
        tmp_path / "run", agent.algorithm, frames=FRAMES, seed=agent.seed, checkpoint_seconds=CHECKPOINT_SECONDS
    )
    beyond, seconds = int(generator.integers(FRAMES // 3)), generator.uniform(1e-6, CHECKPOINT_SECONDS / 2)
    with commands.Process(train_until_killed, run.path, beyond, seconds) as process:
        _, errors = process.communicate()
    assert process.returncode in (0, -signal.SIGALRM), errors
    with trainers.trainer(run) as process:
        _, errors = process.communicate()
    assert process.returncode == 0, errors
    assert_same_weights(run, uninterrupted)
    assert_whole_records(run)
