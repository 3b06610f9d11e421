"""After damage to a run's folder, training goes on from the files that are whole, or says why it does not."""

from pathlib import Path

import commands
import folders
import pytest
from seeds import fresh_seed
import torch
import trainers

from physexp.analysis.training import trainer


@pytest.fixture(scope="module")
def trained(tmp_path_factory):
    """A finished run with two checkpoints, not to be changed; of PPO, whose one process starts no other."""
    path = tmp_path_factory.mktemp("trained") / "run"
    run = trainers.create(path, "ppo", frames=2_000, seed=fresh_seed(), checkpoint_seconds=1e-9)
    trainer.train(run)
    assert len(run.checkpointer.paths()) == 2
    return run


def truncate(path):
    path.write_bytes(path.read_bytes()[:-100])


def test_a_damaged_checkpoint_is_told_and_the_one_before_it_is_used(trained, tmp_path):
    run, told = trainers.copy_of(trained, tmp_path / "run"), []
    before, last = run.checkpointer.paths()
    truncate(last)
    assert int(run.checkpointer.latest()[0]["frames"]) == int(before.stem)
    trainer.train(run, tell=told.append)
    (line,) = told
    assert f"{last} is damaged" in line and "the one before it is used" in line
    tensors, _ = run.checkpointer.latest()  # The same frames again: one process is deterministic.
    for name, value in trained.checkpointer.latest()[0].items():
        assert torch.equal(tensors[name], value), name
    assert run.metrics()[-1]["frames"] == int(tensors["frames"])


def test_a_run_without_a_whole_checkpoint_says_so_and_stays_as_it_is(trained, tmp_path):
    run = trainers.copy_of(trained, tmp_path / "run")
    for path in run.checkpointer.paths():
        truncate(path)
    before = folders.contents(run.path)
    with pytest.raises(ValueError, match=f"^no checkpoint in {run.path / 'checkpoints'} is whole"):
        trainer.train(run)
    assert folders.contents(run.path) == before


def test_a_checkpoint_of_another_task_is_refused_with_both_named(trained, tmp_path):
    run = trainers.copy_of(trained, tmp_path / "run")
    tensors, facts = run.checkpointer.latest()
    tensors["frames"] += 1
    run.checkpointer.save(tensors, {**facts, "task": "towers/fist_features"})
    with pytest.raises(ValueError, match="of towers/fist_features, the run of which_is_heavier/features"):
        trainer.train(run)


def test_a_folder_that_becomes_read_only_ends_training_which_can_go_on(tmp_path):
    run = trainers.create(tmp_path / "run", "ppo", frames=10**9, seed=fresh_seed())
    with trainers.trainer(run, first=commands.bound) as process:
        trainers.wait_for_checkpoint(process, run)
        paths = [run.path, *filter(Path.is_dir, run.path.iterdir())]
        for folder in paths:
            folder.chmod(0o555)
        _, errors = process.communicate()
    reached = int(run.checkpointer.latest()[0]["frames"])
    for folder in paths:
        folder.chmod(0o755)
    line = errors.splitlines()[-1]
    assert process.returncode == 1 and "Traceback" not in errors, errors
    assert f"cannot write to {run.path}: Permission denied" in line
    assert f"the last checkpoint, after {reached:,} frames, is whole, --resume it" in line
    with run.locked():
        run.check_resumable()


def test_a_batch_that_cannot_be_saved_does_not_hide_why_training_stopped(tmp_path):
    run = trainers.create(tmp_path / "run", "ppo")
    trainers.save_first_checkpoint(run, poison=True)
    (run.path / "failed_batch.npz").mkdir()
    with pytest.raises(RuntimeError, match="loss -?(inf|nan).*the batch could not be written to .*failed_batch.npz"):
        trainer.train(run)
