"""What happens to a run's folder under a trainer: it ends with one line, and nothing that was there is lost."""

import functools
import itertools
import os
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
    """What training leaves that nothing has disturbed, and the number of its rows."""
    run = run_lib.Run(tmp_path_factory.mktemp("undisturbed") / "run")
    run.create(subjects.config())
    end = attacks.run(subjects.train, run.path)
    assert end.code == 0, end.said
    return subjects.contents(run)


def train_disturbed(path, number, act):
    """`physexp train --resume`; `act(path)` is called when a number of rows have been written."""
    recorder.ROW_SECONDS = -1.0
    append, counter = run_lib.Run.append_metrics, itertools.count(1)

    def append_and_act(self, row):
        append(self, row)
        if next(counter) == number:
            act(path)

    run_lib.Run.append_metrics = append_and_act
    commands.physexp(*subjects.words(run_lib.Run(path)))


def new_run(path):
    run = run_lib.Run(path)
    run.create(subjects.config())
    return run


def assert_goes_on(run, expected):
    """What is left is resumed, to the same end as if nothing had happened."""
    end = attacks.run(subjects.train, run.path)
    assert end.code == 0, end.said
    assert subjects.contents(run) == expected
    assert attacks.litter(run.path) == []


# The lock.


def let_another_train(path):
    """Removes the lock, and waits until another trainer has had its turn."""
    for name in (".lock", "lock"):
        (path / name).unlink(missing_ok=True)
    (path.parent / "removed").touch()
    while not (path.parent / "had its turn").exists():
        time.sleep(0.01)


def test_two_trainers_never_write_by_turns_when_the_lock_is_removed(expected, tmp_path):
    generator = attacks.generator()
    with attacks.Tally("lock removed") as tally:
        for attack in range(attacks.repetitions(2, share=0.1)):
            folder = tmp_path / str(attack)
            run = new_run(folder / "run")
            number = generator.randint(2, len(expected[0]) - 1)  # There is a checkpoint for the other to go on from.
            first = attacks.Child(train_disturbed, run.path, number, let_another_train)
            while not (folder / "removed").exists():
                assert first.poll() is None, first.end().said
                time.sleep(0.01)
            second = attacks.run(commands.physexp, *subjects.words(run))
            (folder / "had its turn").touch()
            end = first.end()
            ended = [end, second]
            assert sorted(child.code == 0 for child in ended) == [False, True], ended
            next(child for child in ended if child.code).assert_refused(str(run.path))
            assert_goes_on(run, (subjects.contents(run)[0], subjects.contents(run)[1], *expected[2:]))
            tally["the second was refused" if second.code else "the first stopped"] += 1


# The folder.


def move(path):
    path.rename(path.with_name("moved"))


def replace(path):
    """Moves it, and puts another run in its place."""
    move(path)
    new_run(path)


def remove(path):
    shutil.rmtree(path)


def set_mode(path, mode):
    for folder in [path, *(item for item in path.rglob("*") if item.is_dir())]:
        folder.chmod(mode)


@pytest.mark.parametrize("act", [move, replace], ids=lambda act: act.__name__)
def test_a_folder_that_is_moved_stops_training_and_goes_on_where_it_is(act, expected, tmp_path):
    generator = attacks.generator()
    with attacks.Tally(f"{act.__name__} the folder") as tally:
        for attack in range(attacks.repetitions(2, share=0.1)):
            run = new_run(tmp_path / str(attack) / "run")
            end = attacks.run(train_disturbed, run.path, generator.randint(1, len(expected[0]) - 1), act)
            end.assert_refused(str(run.path))
            left = sorted(item.name for item in run.path.glob("*")) if run.path.exists() else []
            assert left == (["config.json"] if act is replace else [])
            assert_goes_on(run_lib.Run(run.path.with_name("moved")), expected)
            tally["one line; resumed where it is now"] += 1


def test_a_folder_that_is_removed_stops_training_and_stays_removed(expected, tmp_path):
    generator = attacks.generator()
    with attacks.Tally("remove the folder") as tally:
        for attack in range(attacks.repetitions(2, share=0.1)):
            run = new_run(tmp_path / str(attack) / "run")
            end = attacks.run(train_disturbed, run.path, generator.randint(1, len(expected[0]) - 1), remove)
            end.assert_refused(str(run.path))
            assert not run.path.exists()
            tally["one line"] += 1


def test_a_folder_that_turns_read_only_stops_training_and_goes_on_once_it_is_not(expected, tmp_path):
    generator = attacks.generator()
    with attacks.Tally("read-only folder") as tally:
        for attack in range(attacks.repetitions(2, share=0.1)):
            run = new_run(tmp_path / str(attack) / "run")
            number = generator.randint(1, len(expected[0]) - 1)
            end = attacks.run(
                train_disturbed, run.path, number, functools.partial(set_mode, mode=0o555), first=commands.bound
            )
            set_mode(run.path, 0o755)
            end.assert_refused(str(run.path))
            assert_goes_on(run, expected)
            tally["one line; resumed"] += 1


# The disk.


@pytest.mark.parametrize("kind", ["EFBIG", "ENOSPC"])
def test_training_on_a_full_disk_ends_in_one_line_and_goes_on_when_there_is_room(kind, expected, tmp_path):
    generator = attacks.generator()
    new_run(tmp_path / "probe")
    assert attacks.run(subjects.train, tmp_path / "probe").code == 0
    sizes = [path.stat().st_size for path in (tmp_path / "probe").rglob("*") if path.is_file()]
    with attacks.Tally(f"full disk, train, {kind}") as tally:
        for attack in range(attacks.repetitions(3, share=0.1)):
            run = new_run(tmp_path / str(attack))
            end = attacks.run(train_disturbed, run.path, 0, None, first=full(kind, generator, run.path, attack, sizes))
            skip_without_mounts(end)
            if end.code:
                end.assert_refused(str(run.path))
            assert_goes_on(run, expected)
            tally["one line; resumed" if end.code else "there was room"] += 1


def full(kind, generator, folder, attack, sizes):
    """A full disk: from the first byte at first, then at a random one."""
    if kind == "EFBIG":
        return attacks.FullAtByte(generator.randrange(max(sizes)) if attack else 0)
    return attacks.SmallDisk(folder, 4096 * generator.randrange(2 + 2 * sum(sizes) // 4096) if attack else 0)


def skip_without_mounts(end):
    if "cannot have mounts of one's own" in end.said:
        pytest.skip("a full disk needs the right to mount a file system (root, or user namespaces)")


@pytest.mark.parametrize("kind", ["EFBIG", "ENOSPC"])
@pytest.mark.parametrize("command", ["publish", "replay"])
def test_a_full_disk_costs_no_agent_and_no_replay(command, kind, expected, tmp_path):
    generator = attacks.generator()
    run = new_run(tmp_path / "run")
    assert attacks.run(subjects.train, run.path).code == 0
    there = tmp_path / "there"
    there.mkdir()
    words = {
        "publish": ["publish", run.path, "--output-dir", there, "--episodes", 2, "--replace"],
        "replay": ["replay", run.path, "--output", there / "replay.rrd", "--episodes", 2],
    }[command]
    assert attacks.run(commands.physexp, *words).code == 0
    names = sorted(os.listdir(there))
    sizes = [path.stat().st_size for path in there.rglob("*") if path.is_file()]
    before = {path.name: path.read_bytes() for path in there.iterdir()}
    with attacks.Tally(f"full disk, {command}, {kind}") as tally:
        for attack in range(attacks.repetitions(2, share=0.1)):
            end = attacks.run(commands.physexp, *words, first=full(kind, generator, there, attack, sizes))
            skip_without_mounts(end)
            if end.code:
                end.assert_refused(str(there))
                if command == "replay":  # The episodes for which there was room may have taken the old ones' place.
                    reading.verify(there / "replay.rrd")
                else:
                    assert {path.name: path.read_bytes() for path in there.iterdir()} == before
            tally["one line" if end.code else "there was room"] += 1
            assert sorted(os.listdir(there)) == names
            before = {path.name: path.read_bytes() for path in there.iterdir()}
