"""A trainer whose folder or disk fails, or is another's, ends with one line, and training goes on afterwards."""

import functools
import itertools
import shutil
import time

import attacks
import commands
import pytest
import reading
import subjects

from physexp import suite
from physexp.agents import starting
from physexp.analysis.training import recorder
from physexp.analysis.training import run as run_lib

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    """The contents of a run that nothing has disturbed, and the sizes of its files."""
    run = new_run(tmp_path_factory.mktemp("undisturbed") / "run")
    end = attacks.run(subjects.train, run.path)
    assert end.code == 0, end.said
    sizes = [path.stat().st_size for path in run.path.rglob("*") if path.is_file()]
    return subjects.contents(run), sizes


def new_run(path):
    run = run_lib.Run(path)
    run.create(subjects.config())
    return run


def train_disturbed(path, number, act):
    """Runs `physexp train --resume`, and calls `act(path)` when a number of rows have been written."""
    recorder.ROW_SECONDS = -1.0
    append, counter = run_lib.Run.append_metrics, itertools.count(1)

    def append_and_act(self, row):
        append(self, row)
        if next(counter) == number:
            act(path)

    run_lib.Run.append_metrics = append_and_act
    commands.physexp(*subjects.words(run_lib.Run(path)))


def assert_goes_on(run, expected):
    """Asserts that a resumed run ends with the contents of an undisturbed one."""
    end = attacks.run(subjects.train, run.path)
    assert end.code == 0, end.said
    assert subjects.contents(run) == expected
    assert attacks.litter(run.path) == []


def replace(path):
    """Moves the folder, and puts another run in its place."""
    path.rename(path.with_name("moved"))
    new_run(path)


@pytest.mark.parametrize("act", [replace, shutil.rmtree], ids=["replaced", "gone"])
def test_a_folder_that_changes_under_a_trainer_stops_it(act, expected, tmp_path):
    contents, _ = expected
    run = new_run(tmp_path / "run")
    number = attacks.generator().randint(1, len(contents[0]) - 1)
    attacks.run(train_disturbed, run.path, number, act).assert_refused(str(run.path))
    if act is replace:
        assert sorted(item.name for item in run.path.glob("*")) == ["config.json"]
        assert_goes_on(run_lib.Run(run.path.with_name("moved")), contents)
    else:
        assert not run.path.exists()


def full_disk(generator, attack, sizes):
    """Returns a full disk: from the first byte at first, then from a random one."""
    return functools.partial(attacks.fill_disk, generator.randrange(max(sizes)) if attack else 0)


def test_training_on_a_full_disk_goes_on_when_there_is_room(expected, tmp_path):
    contents, sizes = expected
    generator = attacks.generator()
    for attack in range(attacks.repetitions(2, share=0.1)):
        run = new_run(tmp_path / str(attack))
        end = attacks.run(train_disturbed, run.path, 0, None, first=full_disk(generator, attack, sizes))
        end.assert_refused(str(run.path))
        assert_goes_on(run, contents)


@pytest.mark.parametrize("command", ["publish", "replay"])
def test_a_full_disk_costs_no_agent_and_no_replay(command, made, tmp_path):
    generator, run_path, there = attacks.generator(), made / "run", tmp_path / "there"
    there.mkdir()
    words = {
        "publish": ["publish", run_path, "--output-dir", there, "--episodes", 2, "--replace"],
        "replay": ["replay", run_path, "--output", there / "replay.rrd", "--episodes", 2],
    }[command]
    assert attacks.run(commands.physexp, *words).code == 0
    before = {path.name: path.read_bytes() for path in there.iterdir()}
    sizes = [len(content) for content in before.values()]
    for attack in range(attacks.repetitions(1, share=0.1)):
        end = attacks.run(commands.physexp, *words, first=full_disk(generator, attack, sizes))
        end.assert_refused(str(there))
        assert {path.name for path in there.iterdir()} == set(before)
        if command == "replay":  # The episodes for which there was room may have taken the old ones' place.
            reading.verify(there / "replay.rrd")
        else:
            assert {path.name: path.read_bytes() for path in there.iterdir()} == before


def start(go, delay, *words):
    """Runs a command as soon as both are ready, or a moment after that."""
    go.wait()
    time.sleep(delay)
    commands.physexp(*words)


def test_of_two_new_runs_in_one_folder_one_trains_and_one_is_refused(tmp_path):
    generator = attacks.generator()
    for attack in range(attacks.repetitions(2, share=0.25)):
        run = run_lib.Run(tmp_path / str(attack))
        go = commands.context.Barrier(2)
        words = ["train", "which_is_heavier", "features", "--run-dir", run.path, *subjects.OPTIONS, "--seed"]
        children = [
            attacks.Child(start, go, generator.choice([0.0, generator.uniform(0, 0.5)]), *words, seed)
            for seed in (1, 2)
        ]
        ends = [child.end() for child in children]
        assert sorted(end.code for end in ends) == [0, 2], ends
        winner = [end.code for end in ends].index(0)
        ends[1 - winner].assert_refused(str(run.path))
        assert run.config.agent.seed == winner + 1 and run.is_finished
        rows, episodes, _, num_episodes = subjects.contents(run)
        assert num_episodes == rows[-1]["episodes"] and len({row["frames"] for row in rows}) == len(rows)
        seed = starting.worker_seed(run.config.agent.seed, 0)
        assert {row["seed"] for row in episodes} == {suite.environment_seed(seed, index) for index in range(4)}
