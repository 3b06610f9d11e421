"""Watchers of training, which print, log and write replays, see every row and cost nothing when they fail."""

import os

import commands
from tensorboard.backend.event_processing import event_accumulator
import trainers

from physexp.analysis.training import progress, trainer
from physexp.analysis.training import run as run_lib

FRAMES = 700
COMMAND = ["train", "which_is_heavier", "features", "--agent", "ppo", "--num-threads", 1, "--num-environments", 32]
COMMAND += ["--replay-every", 100]


def fail(*_):
    raise RuntimeError("no more room\nfor this")


def logged(run):
    accumulator = event_accumulator.EventAccumulator(str(run.path / "tensorboard"))
    accumulator.Reload()
    return {name: accumulator.Scalars(name) for name in accumulator.Tags()["scalars"]}


def test_watchers_that_fail_are_told_of_once_and_training_ends_well(tmp_path):
    run, lines = trainers.create(tmp_path / "run", "ppo", frames=FRAMES, checkpoint_seconds=0.01), []
    trainer.train(run, fail, tell=lines.append, on_checkpoint=fail)
    ending = "failed and is left out from now on: no more room for this"
    assert lines == [f"{name} {ending}" for name in ("the report of training", "the watcher of checkpoints (replays)")]
    assert run.is_finished and len(run.metrics()) > 1, "there were several checkpoints"


def test_lines_that_cannot_be_printed_do_not_end_training(tmp_path):
    run = trainers.create(tmp_path / "run", "ppo", frames=FRAMES)
    trainer.train(run, report=fail, tell=fail)
    assert run.is_finished


def test_a_checkpoint_is_written_before_its_watchers_and_ends_a_row(tmp_path):
    run, watched = trainers.create(tmp_path / "run", "ppo", frames=FRAMES, checkpoint_seconds=0.01), {}

    def watch(frames, variables):
        watched[frames] = int(run.checkpointer.paths()[-1].stem)

    trainer.train(run, on_checkpoint=watch)
    assert watched and all(newest == frames for frames, newest in watched.items())
    assert watched.keys() <= {row["frames"] for row in run.metrics()}


def test_a_quick_training_has_a_row_for_every_hundredth_of_its_frames(tmp_path):
    run = trainers.create(tmp_path / "run", "ppo", frames=FRAMES)
    trainer.train(run)
    rows = run.metrics()
    assert rows[0]["frames"] > FRAMES / 100, "an update has more frames than that"
    assert [row["updates"] for row in rows] == list(range(1, 1 + len(rows)))


def test_replays_and_tensorboard_that_cannot_be_written_are_a_line_each(tmp_path):
    run = run_lib.Run(tmp_path / "run")
    commands.run(*COMMAND, "--frames", 300, "--run-dir", run.path, check=True)
    assert not (run.path / "tensorboard").exists()
    trainers.set_frames(run, FRAMES)
    (run.path / "tensorboard").touch()
    before = set(run.path.rglob("*.rrd"))
    done = commands.run(*trainers.resumed(run), "--tensorboard", env=os.environ | {"RERUN": "off"}, check=True)
    failures = [line for line in done.stderr.splitlines() if "failed and is left out from now on" in line]
    assert len(failures) == 2 and any("RERUN in the environment" in line for line in failures)
    assert run.is_finished and set(run.path.rglob("*.rrd")) == before


def test_tensorboard_has_every_metric_at_its_steps(tmp_path):
    run = trainers.create(tmp_path / "run", "ppo", frames=FRAMES, checkpoint_seconds=0.01)
    board = progress.TensorBoard(run)
    trainer.train(run, board)
    board.close()
    scalars, rows = logged(run), run.metrics()
    assert set(scalars) == {*run_lib.METRICS, *run.config.agent.metrics} - {"frames"}
    for name, points in scalars.items():
        assert [point.step for point in points] == [row["frames"] for row in rows]
        for point, row in zip(points, rows, strict=True):
            assert abs(point.value - row[name]) <= 1e-4 * abs(row[name]) + 1e-6  # The CSV has six digits.


def test_tensorboard_hides_entries_after_the_checkpoint_of_a_resumed_run(tmp_path):
    run = run_lib.Run(tmp_path)

    def train(*frames):
        log = progress.TensorBoard(run)
        for number in frames:
            row = {**dict.fromkeys(run_lib.METRICS, 0.5), "frames": number}
            run.append_metrics(row)
            log(row)
        log.close()

    train()
    assert not (tmp_path / "tensorboard").exists(), "a start that fails leaves no log"
    train(10, 20, 30)
    run.rewind(20)  # The checkpoint after 30 steps is damaged, say.
    train(25, 35)
    assert [point.step for point in logged(run)["success_rate"]] == [10, 20, 25, 35]
