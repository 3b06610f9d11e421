"""A trainer whose folder or disk fails ends with one line, and goes on afterwards as if nothing had happened."""

import functools
import itertools
import shutil
import time

import attacks
import commands
import pytest
import reading
import subjects

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


def let_another_train(path):
    """Removes the lock, and waits until another trainer has tried."""
    (path / ".lock").unlink()
    (path.parent / "removed").touch()
    while not (path.parent / "tried").exists():
        time.sleep(0.01)


def test_two_trainers_never_write_in_turns_when_the_lock_is_removed(expected, tmp_path):
    rows, episodes, *variables = expected[0]
    run = new_run(tmp_path / "run")
    # A row in the middle: there is a checkpoint for the other to go on from.
    first = attacks.Child(train_disturbed, run.path, len(rows) // 2, let_another_train)
    while not (tmp_path / "removed").exists():
        assert first.poll() is None, first.end().said
        time.sleep(0.01)
    second = attacks.run(commands.physexp, *subjects.words(run))
    (tmp_path / "tried").touch()
    ends = [first.end(), second]
    assert sorted(end.code == 0 for end in ends) == [False, True], ends
    next(end for end in ends if end.code).assert_refused(str(run.path))
    contents = subjects.contents(run)
    assert list(contents[2:]) == variables
    assert_goes_on(run, contents)


def move(path):
    path.rename(path.with_name("moved"))


def replace(path):
    """Moves the folder, and puts another run in its place."""
    move(path)
    new_run(path)


def set_mode(path, mode):
    for folder in [path, *(item for item in path.rglob("*") if item.is_dir())]:
        folder.chmod(mode)


make_read_only = functools.partial(set_mode, mode=0o555)


@pytest.mark.parametrize(
    "act", [move, replace, shutil.rmtree, make_read_only], ids=["moved", "replaced", "gone", "shut"]
)
def test_a_folder_that_changes_under_a_trainer_stops_it(act, expected, tmp_path):
    contents, _ = expected
    run = new_run(tmp_path / "run")
    number = attacks.generator().randint(1, len(contents[0]) - 1)
    end = attacks.run(train_disturbed, run.path, number, act, first=commands.bound)
    if act is make_read_only:
        set_mode(run.path, 0o755)
    end.assert_refused(str(run.path))
    left = sorted(item.name for item in run.path.glob("*")) if run.path.exists() else []
    if act is make_read_only:
        assert_goes_on(run, contents)
    else:
        assert left == (["config.json"] if act is replace else [])
    if act in (move, replace):
        assert_goes_on(run_lib.Run(run.path.with_name("moved")), contents)


def full(kind, generator, folder, attack, sizes):
    """Returns a full disk: from the first byte at first, then from a random one."""
    if kind == "EFBIG":
        return attacks.FullAtByte(generator.randrange(max(sizes)) if attack else 0)
    return attacks.SmallDisk(folder, 4096 * generator.randrange(2 + 2 * sum(sizes) // 4096) if attack else 0)


def skip_without_mounts(end):
    if "cannot have mounts of one's own" in end.said:
        pytest.skip("a full disk needs the right to mount a file system (root, or user namespaces)")


@pytest.mark.parametrize("kind", ["EFBIG", "ENOSPC"])
def test_training_on_a_full_disk_goes_on_when_there_is_room(kind, expected, tmp_path):
    generator = attacks.generator()
    with attacks.Tally(f"full disk, train, {kind}") as tally:
        for attack in range(attacks.repetitions(2, share=0.1)):
            run = new_run(tmp_path / str(attack))
            disk = full(kind, generator, run.path, attack, expected[1])
            end = attacks.run(train_disturbed, run.path, 0, None, first=disk)
            skip_without_mounts(end)
            if end.code:
                end.assert_refused(str(run.path))
            assert_goes_on(run, expected[0])
            tally["one line; resumed" if end.code else "there was room"] += 1


@pytest.mark.parametrize("kind", ["EFBIG", "ENOSPC"])
@pytest.mark.parametrize("command", ["publish", "replay"])
def test_a_full_disk_costs_no_agent_and_no_replay(command, kind, made, tmp_path):
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
        end = attacks.run(commands.physexp, *words, first=full(kind, generator, there, attack, sizes))
        skip_without_mounts(end)
        after = {path.name: path.read_bytes() for path in there.iterdir()}
        assert set(after) == set(before)
        if end.code:
            end.assert_refused(str(there))
            if command == "replay":  # The episodes for which there was room may have taken the old ones' place.
                reading.verify(there / "replay.rrd")
            else:
                assert after == before
        before = after
