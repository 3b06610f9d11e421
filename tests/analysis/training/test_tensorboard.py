"""Metrics for TensorBoard are those of the CSV."""

import contextlib

import commands
from tensorboard.backend.event_processing import event_accumulator

from physexp.analysis.training import metrics as metrics_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import tensorboard

COMMAND = ["train", "which_is_heavier", "features", "--agent", "ppo", "--num-threads", 1, "--num-environments", 32]


def logged(run):
    accumulator = event_accumulator.EventAccumulator(str(run.path / "tensorboard"))
    accumulator.Reload()
    return {name: accumulator.Scalars(name) for name in accumulator.Tags()["scalars"]}


def test_every_metric_is_logged_at_its_steps(tmp_path):
    run = run_lib.Run(tmp_path / "run")
    commands.run(*COMMAND, "--frames", 3000, "--run-dir", run.path, "--tensorboard", check=True)
    scalars, rows = logged(run), run.metrics()
    assert set(scalars) == {*metrics_lib.METRICS, *run.config.agent.metrics} - {"frames"}
    for name, points in scalars.items():
        assert [point.step for point in points] == [row["frames"] for row in rows]
        for point, row in zip(points, rows, strict=True):
            assert abs(point.value - row[name]) <= 1e-4 * abs(row[name]) + 1e-6  # The CSV has six digits.


def test_without_the_option_there_is_no_log(tmp_path):
    run = run_lib.Run(tmp_path / "run")
    commands.run(*COMMAND, "--frames", 1000, "--run-dir", run.path, check=True)
    assert not (run.path / "tensorboard").exists() and run.metrics()


def test_a_resumed_run_hides_what_was_logged_after_the_checkpoint_that_it_goes_on_from(tmp_path):
    run = run_lib.Run(tmp_path)

    def train(*frames):
        with contextlib.closing(tensorboard.TensorBoard(run)) as log:
            for number in frames:
                row = {**dict.fromkeys(metrics_lib.METRICS, 0.5), "frames": number}
                run.append_metrics(row)
                log(row)

    train()
    assert not (tmp_path / "tensorboard").exists(), "a start that fails leaves no log"
    train(10, 20, 30)
    run.rewind(20)  # The checkpoint after 30 steps is damaged, say.
    train(25, 35)
    assert [point.step for point in logged(run)["success_rate"]] == [10, 20, 25, 35]
