"""Whatever happens to a run's folder or its processes, training goes on from what is whole, or says why it does not."""

import json
import os
from pathlib import Path
import pickle
import random
import time

import commands
import numpy as np
import pandas as pd
import pytest
from seeds import fresh_seed
import torch
import trainers

from physexp.agents import checkpointing
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer

KILLS = int(os.environ.get("PHYSEXP_KILLS", 2))
"""How often a trainer is killed; more where somebody waits for it."""


def resume(run, **kwargs):
    """`physexp train --resume`, to its end."""
    with trainers.trainer(run, **kwargs) as process:
        output, errors = process.communicate()
    return process.returncode, output, errors


@pytest.fixture(scope="module")
def trained(tmp_path_factory):
    """A finished run with two checkpoints, not to be changed; of PPO, whose one process starts no other."""
    path = tmp_path_factory.mktemp("trained") / "run"
    run = trainers.create(path, "ppo", frames=2_000, seed=fresh_seed(), checkpoint_seconds=1e-9)
    trainer.train(run)
    assert len(run.checkpointer.paths()) == 2
    return run


def test_kills_in_a_row_cost_no_row_and_no_checkpoint(tmp_path):
    run = trainers.create(tmp_path / "run", frames=10**9, seed=fresh_seed(), checkpoint_seconds=0.05)
    generator = random.Random(fresh_seed())
    reached = -1
    for _ in range(KILLS):
        with trainers.trainer(run) as process:
            trainers.wait_for_checkpoint(process, run, beyond=reached)
            time.sleep(generator.uniform(0, 0.3))
            assert process.poll() is None, process.communicate()[1]
        damaged = []
        tensors, facts = run.checkpointer.latest(damaged.append)
        assert damaged == [] and int(tensors["frames"]) > reached
        reached = int(tensors["frames"])
    trainers.set_frames(run, reached + 1_000)
    code, _, errors = resume(run)
    assert code == 0, errors
    metrics = pd.read_csv(run.path / "metrics.csv")
    tensors, facts = run.checkpointer.latest()
    assert (np.diff(metrics.frames) > 0).all() and metrics.frames.iloc[-1] == int(tensors["frames"])
    assert metrics.updates.iloc[-1] == int(tensors["updates"]) == int(tensors["rounds"].sum())
    assert metrics.episodes.iloc[-1] == facts["episodes"] == 32 * int(tensors["updates"])
    episodes = pd.read_parquet(run.path / "episodes.parquet")
    assert not episodes.duplicated(["seed", "episode"]).any()
    assert sorted(set(episodes.frames)) == list(metrics.frames)


def truncate(path):
    path.write_bytes(path.read_bytes()[:-100])


def flip_a_bit(path):
    content = bytearray(path.read_bytes())
    content[random.Random(fresh_seed()).randrange(len(content))] ^= 1
    path.write_bytes(content)


def lose_the_json(path):
    path.with_suffix(".json").unlink()


def tear_the_json(path):
    path.with_suffix(".json").write_text('{"format": 1, "sha')


@pytest.mark.parametrize("damage", [truncate, flip_a_bit, lose_the_json, tear_the_json])
def test_a_damaged_checkpoint_is_told_and_the_one_before_it_is_used(damage, trained, tmp_path):
    run = trainers.copy_of(trained, tmp_path / "run")
    before, last = run.checkpointer.paths()
    expected = checkpointing.safetensors.load_file(before)
    damage(last)
    told = []
    tensors, _ = run.checkpointer.latest(told.append)
    assert all(torch.equal(tensors[name], value) for name, value in expected.items())
    (line,) = told
    assert str(last) in line and "is damaged" in line and "the one before it is used" in line
    code, _, errors = resume(run)
    assert code == 0 and f"{last} is damaged" in errors
    tensors, _ = run.checkpointer.latest()  # The same frames again: one worker is deterministic.
    for name, value in trained.checkpointer.latest()[0].items():
        assert torch.equal(tensors[name], value), name
    assert [row["frames"] for row in run.metrics()][-1] == int(tensors["frames"])


def test_where_no_checkpoint_is_whole_training_says_so_and_changes_nothing(trained, tmp_path):
    run = trainers.copy_of(trained, tmp_path / "run")
    for path in run.checkpointer.paths():
        truncate(path)
    metrics = (run.path / "metrics.csv").read_bytes()
    code, _, errors = resume(run)
    assert code == 2 and "no checkpoint in" in errors.splitlines()[-1] and "is whole" in errors.splitlines()[-1]
    assert "is used" not in errors and "has had its" not in errors
    assert (run.path / "metrics.csv").read_bytes() == metrics


def test_a_checkpoint_of_another_task_is_refused_with_both_named(trained, tmp_path):
    run = trainers.copy_of(trained, tmp_path / "run")
    tensors, facts = run.checkpointer.latest()
    tensors["frames"] += 1
    run.checkpointer.save(tensors, {**facts, "task": "towers/fist_features"})
    code, _, errors = resume(run)
    assert code == 2
    assert "of towers/fist_features, the run of which_is_heavier/features" in errors.splitlines()[-1]


def test_a_checkpoint_of_another_version_is_refused_with_both_named(trained, tmp_path):
    run = trainers.copy_of(trained, tmp_path / "run")
    card = run.checkpointer.paths()[-1].with_suffix(".json")
    card.write_text(json.dumps({**json.loads(card.read_text()), "format": 7}))
    code, _, errors = resume(run)
    assert code == 2 and "has format 7; this version reads format 1" in errors.splitlines()[-1]


class RunsCode:
    """Makes a file when it is unpickled."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return (open, (str(self.path), "w"))


def with_checksum(path, content):
    """Puts content in the place of a checkpoint as somebody would who knows about checksums."""
    path.write_bytes(content)
    card = json.loads(path.with_suffix(".json").read_text())
    card["sha256"] = checkpointing.hashlib.sha256(content).hexdigest()
    path.with_suffix(".json").write_text(json.dumps(card))


@pytest.mark.parametrize("kind", ["pickle", "zip of torch", "huge header", "nested header", "noise"])
def test_a_hostile_checkpoint_runs_no_code_and_is_refused_in_one_line(kind, trained, tmp_path):
    run, proof = trainers.copy_of(trained, tmp_path / "run"), tmp_path / "proof"
    torch.save(RunsCode(proof), tmp_path / "saved")
    hostile = {
        "pickle": pickle.dumps(RunsCode(proof)),
        "zip of torch": (tmp_path / "saved").read_bytes(),
        "huge header": (2**62).to_bytes(8, "little") + b"{}",
        "nested header": (200_000).to_bytes(8, "little") + b"[" * 200_000,
        "noise": random.Random(0).randbytes(5_000),
    }[kind]
    for path in run.checkpointer.paths():
        with_checksum(path, hostile)
    code, _, errors = resume(run)
    assert code == 2 and "Traceback" not in errors and "no checkpoint in" in errors.splitlines()[-1], errors
    done = commands.run("evaluate", run.path)
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
    assert not proof.exists()


def test_a_second_trainer_in_one_folder_is_refused_and_the_first_goes_on(tmp_path):
    run = trainers.create(tmp_path / "run", frames=10**9)
    with trainers.trainer(run) as first:
        trainers.wait_for_checkpoint(first, run)
        code, _, errors = resume(run)
        assert code == 2 and "another process is training in" in errors.splitlines()[-1]
        reached = int(run.checkpointer.paths()[-1].stem)
        trainers.wait_for_checkpoint(first, run, beyond=reached)


def test_a_folder_that_may_not_be_written_is_one_readable_line(trained, tmp_path):
    run = trainers.copy_of(trained, tmp_path / "run")
    run.path.chmod(0o555)
    code, _, errors = resume(run, first=commands.bound)
    run.path.chmod(0o755)
    assert code == 2, errors
    assert errors.count("\n") == 1 and "Permission denied" in errors and str(run.path) in errors


def test_a_folder_that_may_not_be_written_any_more_ends_training_in_one_line_after_which_it_can_go_on(tmp_path):
    run = trainers.create(tmp_path / "run", "ppo", frames=10**9, seed=fresh_seed())
    with trainers.trainer(run, first=commands.bound) as process:
        trainers.wait_for_checkpoint(process, run)
        folders = [run.path, *filter(Path.is_dir, run.path.iterdir())]
        for folder in folders:
            folder.chmod(0o555)
        _, errors = process.communicate()
    reached = int(run.checkpointer.latest()[0]["frames"])
    for folder in folders:
        folder.chmod(0o755)
    line = errors.splitlines()[-1]
    assert process.returncode == 1 and "Traceback" not in errors, errors
    assert f"cannot write to {run.path}: Permission denied" in line
    assert f"the last checkpoint, after {reached:,} frames, is whole, --resume it" in line
    with run.locked():
        run.check_resumable()


def trained_until(path, happens):
    """Returns a run during which something happens to its folder after its second checkpoint, and the error."""
    run = trainers.create(path, "ppo", frames=10**9, checkpoint_seconds=0.01, seed=fresh_seed())

    def report(row):
        if len(run.metrics()) == 2:
            happens(run)

    with pytest.raises(RuntimeError) as caught:
        trainer.train(run, report)
    assert "\n" not in str(caught.value)
    return run, str(caught.value)


def test_a_trainer_whose_lock_file_is_removed_stops_before_it_writes_into_the_next_ones_records(tmp_path):
    seen = {}

    def remove(run):
        (run.path / ".lock").unlink()
        seen.update((path, path.read_bytes()) for path in run.path.rglob("*") if path.is_file())

    run, message = trained_until(tmp_path / "run", remove)
    assert ".lock was removed, or the folder moved; its last checkpoint is as it was" in message
    assert {path: path.read_bytes() for path in run.path.rglob("*") if path.is_file()} == seen
    assert int(run.checkpointer.latest()[0]["frames"]) == run.metrics()[-1]["frames"]
    assert len(run.metrics()) == 2


def test_a_trainer_whose_folder_is_moved_stops_and_the_run_can_be_resumed_where_it_is(tmp_path):
    run, message = trained_until(tmp_path / "run", lambda run: run.path.rename(tmp_path / "moved"))
    assert "or the folder moved" in message
    assert os.listdir(tmp_path) == ["moved"], "nothing is made where it was"
    moved = run_lib.Run(tmp_path / "moved")
    moved.check_resumable()
    assert int(moved.checkpointer.latest()[0]["frames"]) == moved.metrics()[1]["frames"]


def test_a_batch_that_cannot_be_saved_does_not_hide_why_training_stopped(tmp_path):
    run = trainers.create(tmp_path / "run", "ppo")
    trainers.save_first_checkpoint(run, poison=True)
    (run.path / "failed_batch.npz").mkdir()
    with pytest.raises(RuntimeError, match="loss -?(inf|nan).*the batch could not be written to .*failed_batch.npz"):
        trainer.train(run)


def test_a_clock_that_goes_backwards_changes_nothing(tmp_path, monkeypatch):
    run = trainers.create(tmp_path / "run", frames=8_000, seed=fresh_seed())
    now = iter(np.linspace(2e9, 1e9, 1_000_000))
    monkeypatch.setattr(time, "time", lambda: float(next(now)))
    trainer.train(run)
    seconds = [row["seconds"] for row in run.metrics()]
    assert seconds == sorted(seconds) and run.is_finished
