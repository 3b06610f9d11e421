"""A process that is killed while it writes leaves the old file or the new one, and the next process goes on."""

import functools
import itertools
import shutil

import attacks
import pytest
import reading
import subjects
import torch

from physexp.agents import checkpointing
from physexp.analysis.replay import recording, writing
from physexp.analysis.score import log, playing, protocol, scoring, targets
from physexp.analysis.training import finding
from physexp.analysis.training import run as run_lib

pytestmark = pytest.mark.long


def killed(kind, function, extent, folders, repetitions, share, *args):
    """Yields each folder after `function(folder, *args)` was killed at some moment, or has ended before."""
    generator = attacks.generator()
    with attacks.Tally(f"kill, {kind}") as tally:
        for _, folder in zip(range(attacks.repetitions(repetitions, share)), folders, strict=False):
            death = extent.draw(generator)
            print(death)
            end = attacks.run(function, folder, *args, first=death)
            assert end.was_killed or end.code == 0, (death, end.said)
            tally["killed" if end.was_killed else "not killed"] += 1
            yield folder


def go_on(function, folder):
    end = attacks.run(function, folder)
    assert end.code == 0, end.said


def new_folders(path):
    return (path / f"attack-{number}" for number in itertools.count())


# One file.


def write_checkpoint(folder, number):
    tensors = {"frames": torch.tensor(number), "network/w": torch.full((100, 100), float(number))}
    checkpointing.Checkpointer(folder).save(tensors, {"number": number})


def read_checkpoint(folder):
    tensors, facts = checkpointing.Checkpointer(folder).latest(pytest.fail)
    assert (tensors["network/w"] == facts["number"]).all() and int(tensors["frames"]) == facts["number"]
    return facts["number"]


def test_a_killed_writer_leaves_the_old_file_or_the_new_one(tmp_path):
    def folders():
        for folder in new_folders(tmp_path):
            write_checkpoint(folder, 0)
            yield folder

    extent = attacks.measure(write_checkpoint, next(folders()), 1)
    for folder in killed("checkpoint", write_checkpoint, extent, folders(), 6, 0.2, 1):
        assert read_checkpoint(folder) in (0, 1)
        write_checkpoint(folder, 2)
        assert read_checkpoint(folder) == 2
        assert attacks.litter(folder) == []


@functools.cache
def recorded():
    return [
        recording.reenact(subjects.network(0.0), subjects.config(), 0, number, None, "an agent") for number in range(3)
    ]


def write_replay(folder, number=3):
    writing.write(folder / "replay.rrd", [lambda episode=episode: [episode] for episode in recorded()[:number]])


def test_a_killed_replay_leaves_a_whole_file(tmp_path):
    write_replay(tmp_path)
    extent = attacks.measure(write_replay, tmp_path)
    for folder in killed("replay", write_replay, extent, iter(lambda: tmp_path, None), 2, share=0.1):
        reading.verify(folder / "replay.rrd")
        write_replay(folder, 1)


# Training.


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    """An undisturbed run, and its extent."""
    run = run_lib.Run(tmp_path_factory.mktemp("uninterrupted") / "run")
    return run, attacks.measure(subjects.train, run.path)


def test_killed_training_goes_on_to_the_same_variables(uninterrupted, tmp_path):
    whole, extent = uninterrupted
    for folder in killed("training", subjects.train, extent, new_folders(tmp_path), 3, share=0.1):
        go_on(subjects.train, folder)
        assert subjects.contents(run_lib.Run(folder)) == subjects.contents(whole)
        assert attacks.litter(folder) == []


def variables(run):
    """The variables of a run's network, in half precision."""
    return {name: value.half().numpy().tobytes() for name, value in finding.load_network(run).state_dict().items()}


def keep(path):
    run_lib.Run(path).keep_agent_only()


def test_a_network_that_is_kept_alone_is_never_missing(uninterrupted, tmp_path):
    whole, _ = uninterrupted
    copies = (shutil.copytree(whole.path, folder) for folder in new_folders(tmp_path))
    extent = attacks.measure(keep, next(copies))
    for folder in killed("keep_agent_only", keep, extent, copies, 2, share=0.1):
        assert variables(run_lib.Run(folder)) == variables(whole)
        keep(folder)
        assert attacks.litter(folder) == []


def score(folder):
    scoring.score(targets.find("random"), protocol.named(["threshold/features", "strings/features"]), 6, folder)


def test_a_killed_score_goes_on_to_the_same_log(tmp_path):
    extent = attacks.measure(score, tmp_path / "whole")
    for folder in killed("score", score, extent, new_folders(tmp_path), 2, share=0.1):
        if not (folder / scoring.FILE).exists() or (folder / playing.FILE).exists():
            go_on(score, folder)
        assert log.read(folder).equals(log.read(tmp_path / "whole"))
