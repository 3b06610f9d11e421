"""A process that is killed while it writes leaves the old file or the new one, and the next process goes on."""

import functools
import subprocess

import attacks
import pyarrow
import pytest
import reading
import subjects
import torch

from physexp.agents import checkpointing
from physexp.analysis.data import tables
from physexp.analysis.experiments import base, sweep
from physexp.analysis.replay import recording, writing
from physexp.analysis.score import log, playing, protocol, scoring, targets
from physexp.analysis.training import finding, recorder, records
from physexp.analysis.training import run as run_lib

pytestmark = pytest.mark.long


def write_checkpoint(folder, number):
    tensors = {"frames": torch.tensor(number), "network/w": torch.full((100, 100), float(number))}
    checkpointing.Checkpointer(folder).save(tensors, {"number": number})


def read_checkpoint(folder):
    damaged = []
    tensors, facts = checkpointing.Checkpointer(folder).latest(damaged.append)
    assert damaged == []
    assert (tensors["network/w"] == facts["number"]).all() and int(tensors["frames"]) == facts["number"]
    return facts["number"]


def write_table(folder, number):
    columns = {name: [0] * (number + 1) for name in run_lib.EPISODES.names} | {"actions": [[0, 1]] * (number + 1)}
    tables.write(folder / "episodes.parquet", pyarrow.table(columns, run_lib.EPISODES))


def read_table(folder):
    return len(tables.read(folder / "episodes.parquet", run_lib.EPISODES)) - 1


WRITES = {
    "checkpoint": (write_checkpoint, read_checkpoint),
    "table": (write_table, read_table),
    "published agent": (subjects.publish, subjects.published),
}
"""Kinds of writes: a function that writes a number, and one that reads it back."""


def write_on_and_on(folder):
    for number in range(1_000_000):
        write_checkpoint(folder, number)


def test_each_way_to_die_is_deadly(tmp_path):
    for death in (attacks.AtCall(100), attacks.AtByte(100), attacks.AtMoment(0.05)):
        assert attacks.run(write_on_and_on, tmp_path, first=death).was_killed, death


@pytest.mark.parametrize("kind", WRITES)
def test_a_killed_writer_leaves_the_old_file_or_the_new_one(kind, tmp_path):
    write, read = WRITES[kind]
    write(tmp_path, 0)
    extent = attacks.measure(write, tmp_path, 1)
    generator, done = attacks.generator(), 1
    with attacks.Tally(f"kill, {kind}") as tally:
        for _ in range(attacks.repetitions(8, share=0.2)):
            death = extent.draw(generator)
            end = attacks.run(write, tmp_path, done + 1, first=death)
            assert end.was_killed or end.code == 0, (death, end.said)
            found = read(tmp_path)
            assert found in (done, done + 1), (death, found)
            tally["not killed" if not end.was_killed else "old" if found == done else "new"] += 1
            write(tmp_path, found + 1)
            done = read(tmp_path)
            assert done == found + 1, death
            assert attacks.litter(tmp_path) == [], death


# A replay: of several episodes, so that recordings are merged.


@functools.cache
def recorded():
    return [
        recording.reenact(subjects.network(0.0), subjects.config(), 0, number, None, "an agent") for number in range(3)
    ]


def write_replay(folder, number):
    writing.write(
        folder / "replay.rrd", [lambda episode=episode: [episode] for episode in recorded()[: 1 + number % 3]]
    )


def test_a_killed_replay_leaves_a_whole_file(tmp_path):
    write_replay(tmp_path, 2)
    reading.verify(tmp_path / "replay.rrd")
    extent = attacks.measure(write_replay, tmp_path, 2)
    generator = attacks.generator()
    with attacks.Tally("kill, replay") as tally:
        for _ in range(attacks.repetitions(3, share=0.1)):
            death = extent.draw(generator)
            end = attacks.run(write_replay, tmp_path, 2, first=death)
            assert end.was_killed or end.code == 0, (death, end.said)
            reading.verify(tmp_path / "replay.rrd")
            tally["whole" if end.was_killed else "not killed"] += 1
            write_replay(tmp_path, 0)
            assert attacks.litter(tmp_path) == [], death


# Training.


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    """A run that nothing has disturbed, and how much there was to disturb."""
    run = run_lib.Run(tmp_path_factory.mktemp("uninterrupted") / "run")
    run.create(subjects.config())
    return run, attacks.measure(subjects.train, run.path)


def test_killed_training_goes_on_to_the_same_variables(uninterrupted, tmp_path):
    whole, extent = uninterrupted
    expected = subjects.contents(whole)
    generator = attacks.generator()
    with attacks.Tally("kill, training") as tally:
        for attack in range(attacks.repetitions(3, share=0.1)):
            run = run_lib.Run(tmp_path / str(attack))
            run.create(subjects.config())
            death = extent.draw(generator)
            end = attacks.run(subjects.train, run.path, first=death)
            assert end.was_killed or end.code == 0, (death, end.said)
            reached = len(run.checkpointer.paths())
            resumed = attacks.run(subjects.train, run.path)
            assert resumed.code == 0, (death, resumed.said)
            assert subjects.contents(run) == expected, death
            assert attacks.litter(run.path) == [], death
            tally["not killed" if not end.was_killed else "from a checkpoint" if reached else "from the start"] += 1


# A score: playing, judging and writing.


def score(folder):
    scoring.score(targets.find("random"), protocol.named(["threshold/features", "strings/features"]), 6, folder)


def test_a_killed_score_goes_on_to_the_same_log(tmp_path):
    extent = attacks.measure(score, tmp_path / "whole")
    expected = log.read(tmp_path / "whole")
    generator = attacks.generator()
    with attacks.Tally("kill, score") as tally:
        for attack in range(attacks.repetitions(4, share=0.1)):
            folder = tmp_path / str(attack)
            death = extent.draw(generator)
            end = attacks.run(score, folder, first=death)
            assert end.was_killed or end.code == 0, (death, end.said)
            is_complete = (folder / scoring.FILE).exists() and not (folder / playing.FILE).exists()
            if not is_complete:
                resumed = attacks.run(score, folder)
                assert resumed.code == 0, (death, resumed.said)
            assert log.read(folder).equals(expected), death
            assert attacks.litter(folder) == [], death
            tally["complete" if is_complete else "gone on with"] += 1


# A sweep's agent: training, keeping the network alone, playing.

JOB = sweep.Job(
    subjects.config(frames=30),
    (base.Trial(name="learned", num_steps=10), base.Trial(name="random", interaction="random", num_steps=10)),
)


def sweep_one(folder):
    recorder.ROW_SECONDS = -1.0  # A row for each update, however long they take.
    sweep._work(print, JOB, base.Results(folder))


def swept(folder):
    """The files, rows and tables that a sweep leaves of an agent, without times."""
    run = base.Results(folder).run(JOB.config)
    kept = sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.name != ".lock")
    rows = [{name: row[name] for name in ("frames", "success_rate", "entropy")} for row in run.metrics()]
    tables = [records.read([path]).to_json() for path in sorted(folder.glob("episodes/*/*.parquet"))]
    return kept, rows, variables(run), tables


def test_a_killed_sweep_goes_on_to_the_same_agent_and_episodes(tmp_path):
    (tmp_path / "whole").mkdir()
    extent = attacks.measure(sweep_one, tmp_path / "whole")
    expected = swept(tmp_path / "whole")
    generator = attacks.generator()
    with attacks.Tally("kill, sweep") as tally:
        for attack in range(attacks.repetitions(3, share=0.1)):
            folder = tmp_path / str(attack)
            death = extent.draw(generator)
            end = attacks.run(sweep_one, folder, first=death)
            assert end.was_killed or end.code == 0, (death, end.said)
            resumed = attacks.run(sweep_one, folder)
            assert resumed.code == 0, (death, resumed.said)
            assert swept(folder)[1:] == expected[1:], death
            assert swept(folder)[0] == expected[0], death
            tally["as if nothing had happened" if end.was_killed else "not killed"] += 1


def test_a_network_that_is_kept_alone_is_never_missing(uninterrupted, tmp_path):
    """Between a checkpoint and `agent.safetensors` there is always one of them."""
    whole, _ = uninterrupted
    expected = variables(whole)
    generator = attacks.generator()

    def fresh(name):
        subprocess.run(["cp", "-r", whole.path, tmp_path / name], check=True)
        return run_lib.Run(tmp_path / name)

    extent = attacks.measure(keep, fresh("measured").path)
    with attacks.Tally("kill, keep_agent_only") as tally:
        for attack in range(attacks.repetitions(3, share=0.1)):
            run = fresh(str(attack))
            death = extent.draw(generator)
            end = attacks.run(keep, run.path, first=death)
            assert end.was_killed or end.code == 0, (death, end.said)
            found = variables(run)
            assert found == expected, death
            tally["kept alone" if run.agent_path.exists() else "still in a checkpoint"] += 1
            run.keep_agent_only()
            assert attacks.litter(run.path) == [], death


def variables(run):
    """The variables of a run's network, in half precision."""
    return {name: value.half().numpy().tobytes() for name, value in finding.load_network(run).state_dict().items()}


def keep(path):
    run_lib.Run(path).keep_agent_only()
