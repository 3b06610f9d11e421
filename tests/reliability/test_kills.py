"""A process that is killed while it writes leaves what was there before or what it wrote, and the next one goes on."""

import functools
import subprocess

import attacks
import commands
import pyarrow
import pytest
import reading
import subjects
import torch

from physexp.agents import checkpointing
from physexp.analysis.experiments import base, sweep
from physexp.analysis.replay import recording, writing
from physexp.analysis.score import log, playing, protocol, scoring, targets
from physexp.analysis.training import finding, recorder, records
from physexp.analysis.training import metrics as metrics_lib
from physexp.analysis.training import run as run_lib

pytestmark = pytest.mark.long

# Each kind of write: a function that writes a number, and one that reads it back or says why it cannot be.


def write_checkpoint(folder, number):
    tensors = {"frames": torch.tensor(number), "network/w": torch.full((100, 100), float(number))}
    checkpointing.Checkpointer(folder).save(tensors, {"number": number})


def read_checkpoint(folder):
    damaged = []
    tensors, facts = checkpointing.Checkpointer(folder).latest(damaged.append)
    assert damaged == []
    assert (tensors["network/w"] == facts["number"]).all() and int(tensors["frames"]) == facts["number"]
    return facts["number"]


def write_episodes(folder, number):
    run = run_lib.Run(folder)
    run.rewind(number - 1)
    size = 50
    columns = {name: [0] * size for name in run_lib.EPISODES.names}
    columns |= {"frames": [number] * size, "actions": [[number % 100] * 20] * size}
    run.append_episodes(number, pyarrow.table(columns, run_lib.EPISODES))


def read_episodes(folder):
    rows = subjects.parquet.read_table(folder / "episodes.parquet").to_pylist()
    numbers = sorted({row["frames"] for row in rows})
    assert numbers == list(range(len(numbers))) and len(rows) == 50 * len(numbers)
    assert all(row["actions"] == [row["frames"] % 100] * 20 for row in rows)
    return numbers[-1]


def write_metrics(folder, number):
    run = run_lib.Run(folder)
    run.rewind(number - 1)  # As a trainer does that goes on.
    run.append_metrics({name: number if name == "frames" else number + 0.25 for name in metrics_lib.METRICS})


def read_metrics(folder):
    rows = run_lib.Run(folder).metrics()
    assert [row["frames"] for row in rows] == list(range(len(rows)))
    assert all(set(row) == set(metrics_lib.METRICS) and row["timeouts"] == row["frames"] + 0.25 for row in rows)
    return len(rows) - 1


def write_config(folder, number):
    run_lib.Run(folder / str(number)).create(subjects.config(seed=number))


def read_config(folder):
    """The last run whose configuration is there."""
    there = sorted(int(path.parent.name) for path in folder.glob("*/config.json"))
    assert [run_lib.Run(folder / str(number)).config.agent.seed for number in there] == there
    assert there == list(range(len(there)))
    return there[-1]


def write_records(folder, number):
    records.write(folder / "records.parquet", subjects.rows(number))


def read_records(folder):
    frame = records.read([folder / "records.parquet"])
    assert list(frame.episode) == list(range(len(frame)))
    return len(frame) - 1


WRITES = {
    "checkpoint": (write_checkpoint, read_checkpoint),
    "episodes.parquet": (write_episodes, read_episodes),
    "metrics.csv": (write_metrics, read_metrics),
    "config.json": (write_config, read_config),
    "records": (write_records, read_records),
    "published agent": (subjects.publish, subjects.published),
}


def write_on_and_on(folder):
    for number in range(1_000_000):
        write_checkpoint(folder, number)


@pytest.mark.parametrize("death", [attacks.AtCall(100), attacks.AtByte(100), attacks.AtMoment(0.05)])
def test_each_way_to_die_is_deadly(death, tmp_path):
    assert attacks.run(write_on_and_on, tmp_path, first=death).was_killed


@pytest.mark.parametrize("kind", WRITES)
def test_a_killed_writer_leaves_the_old_or_the_new_and_the_next_one_cleans_up(kind, tmp_path):
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


def test_a_killed_replay_leaves_a_whole_file_and_the_next_one_cleans_up(tmp_path):
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


def test_training_that_was_killed_goes_on_to_the_same_variables_bit_for_bit(uninterrupted, tmp_path):
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


def test_a_score_that_was_killed_goes_on_to_the_same_log(tmp_path):
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
    """What a sweep leaves of an agent, without what depends on time."""
    run = base.Results(folder).run(JOB.config)
    names = [str(path.relative_to(folder)) for path in folder.rglob("*") if path.name != ".lock"]
    kept = sorted(name for name in names if "superseded" not in name)  # What was recorded after a checkpoint.
    rows = [{name: row[name] for name in ("frames", "success_rate", "entropy")} for row in run.metrics()]
    tables = [records.read([path]).to_json() for path in sorted(folder.glob("episodes/*/*.parquet"))]
    return kept, rows, variables(run), tables


def test_a_sweep_that_was_killed_goes_on_to_the_same_agent_and_the_same_episodes(tmp_path):
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


def test_reproducing_that_was_killed_goes_on_to_the_same_figure_of_the_same_agents(tmp_path):
    """The whole command, with its processes; those that it has started are killed with it."""
    count = attacks.repetitions(0, share=0.02)
    if not count:
        pytest.skip("takes two minutes: set PHYSEXP_ATTACKS")
    generator = attacks.generator()

    def reproduce(folder, **kwargs):
        words = ["reproduce", "learners", "--observations", "features", "--seeds", 1, "--frames", 60, "--jobs", 2]
        return attacks.run(commands.physexp, *words, "--results-dir", folder, **kwargs)

    attacks.run(print)  # The server has its imports behind it.
    whole = reproduce(tmp_path / "whole")
    assert whole.code == 0, whole.said
    with attacks.Tally("kill, reproduce") as tally:
        for attack in range(count):
            folder = tmp_path / str(attack)
            death = attacks.AtMoment(generator.uniform(0, 0.7 * whole.seconds))
            end = reproduce(folder, first=death)
            assert end.was_killed or end.code == 0, (death, end.said)
            resumed = reproduce(folder)
            assert resumed.code == 0, (death, resumed.said)
            assert reproduced(folder) == reproduced(tmp_path / "whole"), death
            assert attacks.litter(folder) == [], death
            tally["as if nothing had happened" if end.was_killed else "not killed"] += 1


def reproduced(folder):
    """What `reproduce` leaves, without what depends on time: names, and the agents' weights."""
    names = sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if "superseded" not in str(path))
    return names, [path.read_bytes() for path in sorted(folder.glob("runs/*/agent.safetensors"))]


def test_a_network_that_is_kept_alone_is_there_at_every_moment(uninterrupted, tmp_path):
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
    """Those of a run's network, to half precision."""
    return {name: value.half().numpy().tobytes() for name, value in finding.load_network(run).state_dict().items()}


def keep(path):
    run_lib.Run(path).keep_agent_only()
