"""Training writes replays of the agent into the run's folder."""

import dataclasses
import subprocess

from rerun.chunk import RrdReader
import trainers

from physexp.analysis.replay import training, writing
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer

SMALL = config_lib.TrainConfig(
    domain="which_is_heavier",
    task="features",
    task_kwargs={"difficulty": 10.0},
    agent=trainers.SMALL["ppo"].replace(frames=3000, checkpoint_seconds=0.05),
)


def trained(path, **changes):
    run = run_lib.Run(path)
    run.create(dataclasses.replace(SMALL, **changes))
    trainer.train(run, on_checkpoint=training.Writer(run, run.config) if run.config.replay_every else None)
    return run


def test_replays_are_written_with_checkpoints_every_so_many_steps(tmp_path):
    run = trained(tmp_path / "run", replay_every=1000)
    replays = sorted((run.path / "replays").glob("*.rrd"))
    frames = [int(path.stem) for path in replays]
    assert 1 <= len(frames) <= 3
    assert all(later - earlier >= 1000 for earlier, later in zip([0, *frames], frames, strict=False))
    for path in replays:
        subprocess.run([writing.PROGRAM, "rrd", "verify", path], check=True, capture_output=True)
        (recording,) = RrdReader(str(path)).recordings()
        assert f"after {int(path.stem):,} steps" in recording.recording_id


def test_every_replay_shows_the_same_instance(tmp_path):
    run = trained(tmp_path / "run", replay_every=500)
    names = {
        RrdReader(str(path)).recordings()[0].recording_id.split("-")[0] for path in (run.path / "replays").iterdir()
    }
    assert names == {str(training.SEED)}


def test_a_run_that_goes_on_counts_steps_from_its_last_replay(tmp_path, monkeypatch):
    run = run_lib.Run(tmp_path / "run")
    (run.path / "replays").mkdir(parents=True)
    for name in ("000000000003000", "000000000009000", "mine"):  # The second comes from frames that were lost.
        (run.path / "replays" / f"{name}.rrd").touch()
    config = dataclasses.replace(SMALL, replay_every=2000)
    network = trainer.make_network(config)
    written = []
    monkeypatch.setattr(writing, "write", lambda path, groups: written.append(path.name))
    for frames in (4999, 5000):
        training.Writer(run, config)(frames, network.state_dict())
    assert written == ["000000000005000.rrd"]
