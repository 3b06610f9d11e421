"""Training writes replays of the agent into the run's folder."""

import dataclasses
import functools

import recordings
from rerun.chunk import RrdReader
import trainers

from physexp.analysis.replay import training, writing
from physexp.analysis.training import trainer


def test_replays_of_one_instance_are_written_every_so_many_steps(tmp_path):
    run = trainers.create(tmp_path / "run", "ppo", frames=3000, checkpoint_seconds=0.2)
    config = dataclasses.replace(run.config, replay_every=1000)
    trainer.train(run, on_checkpoint=functools.partial(training.write, run, config))
    frames = sorted(int(path.stem) for path in (run.path / "replays").iterdir())
    assert 1 <= len(frames) <= 3
    assert all(later - earlier >= 1000 for earlier, later in zip([0, *frames], frames, strict=False))
    for path in (run.path / "replays").iterdir():
        recordings.verify(path)
        (recording,) = RrdReader(str(path)).recordings()
        assert recording.recording_id.startswith(f"{training.SEED}-0-")
        assert recording.recording_id.endswith(f"after {int(path.stem):,} steps")


def test_a_run_that_goes_on_counts_steps_from_its_last_replay(tmp_path, monkeypatch):
    run = trainers.create(tmp_path / "run", "ppo")
    (run.path / "replays").mkdir()
    for name in ("000000000003000", "000000000009000", "mine"):  # The second comes from frames that were lost.
        (run.path / "replays" / f"{name}.rrd").touch()
    config = dataclasses.replace(run.config, replay_every=2000)
    network = trainer.make_network(config)
    written = []
    monkeypatch.setattr(writing, "write", lambda path, groups: written.append(path.name))
    for frames in (4999, 5000):
        training.write(run, config, frames, network.state_dict())
    assert written == ["000000000005000.rrd"]
