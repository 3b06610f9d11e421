"""A run's folder: one trainer at a time, nothing written or removed outside of it, and no record lost."""

import json
import math
import multiprocessing
import os
from pathlib import Path
import resource
import signal

import folders
import pytest
import torch
from waiting import wait_until

from physexp.agents.a3c import config as a3c
from physexp.agents.ppo import config as ppo
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import metrics as metrics_lib
from physexp.analysis.training import run as run_lib

ROUNDS = 50
FOLDERS = ("checkpoints", "episodes.parquet", "replays", "tensorboard")


def make_config(seed=0):
    return config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=a3c.A3CConfig(seed=seed))


COLUMNS = [*metrics_lib.METRICS, *a3c.A3CConfig.metrics]


def row(frames):
    return {**dict.fromkeys(COLUMNS, 0.5), "frames": frames}


def checkpoint(run, frames=10):
    return run.checkpointer.save({"frames": torch.tensor(frames), "network/w": torch.ones(2)}, {})


@pytest.fixture
def run(tmp_path):
    made = run_lib.Run(tmp_path / "run")
    made.create(make_config())
    return made


# Starting together.


def _race(folder, number, barrier, both_have_tried):
    """Starts a run in each round, as `training.train` does; exits with 1 where a round went wrong."""
    wrong = 0
    for round_ in range(ROUNDS):
        run = run_lib.Run(folder / "new" / str(round_))
        barrier.wait()
        try:
            with run.locked():
                run.create(make_config(seed=number))
                both_have_tried.wait()
                run.append_metrics(row(frames=number))
        except ValueError:
            both_have_tried.wait()
            continue
        content = (run.path / "metrics.csv").read_text().splitlines()
        wrong += run.config.agent.seed != number or len(content) != 2 or not content[1].startswith(f"{number},")
    os._exit(min(1, wrong))


def _all_end(racers) -> list[int]:
    """Starts processes and returns their exit codes; a fork of this one might wait for a thread that it lacks."""
    for racer in racers:
        racer.start()
    wait_until(lambda: not any(racer.is_alive() for racer in racers), "the end of the race")
    return [racer.exitcode for racer in racers]


def test_of_two_that_start_together_in_one_new_folder_one_is_refused_before_it_writes(tmp_path):
    context = multiprocessing.get_context("spawn")
    barriers = context.Barrier(2), context.Barrier(2)
    racers = [context.Process(target=_race, args=(tmp_path, number, *barriers)) for number in (1, 2)]
    assert _all_end(racers) == [0, 0]
    for round_ in range(ROUNDS):
        run = run_lib.Run(tmp_path / "new" / str(round_))
        assert [entry["frames"] for entry in run.metrics()] == [run.config.agent.seed], "one has won, wholly"
        assert not (run.path / ".lock").exists()


def _take_turns(path, inside, twice):
    """Takes a run's lock 200 times; notes where somebody else has it meanwhile."""
    run, turns = run_lib.Run(path), 0
    while turns < 200:
        try:
            with run.locked():
                with inside.get_lock():
                    inside.value += 1
                    twice.value |= inside.value > 1
                with inside.get_lock():
                    inside.value -= 1
                turns += 1
        except ValueError as error:
            assert "another process is training" in str(error)


def test_one_that_ends_while_another_starts_never_lets_two_in(tmp_path):
    """The lock file is removed by its owner: who has opened it meanwhile must not take that for the lock."""
    context = multiprocessing.get_context("spawn")
    inside = context.Value("i", 0)
    twice = context.Value("i", 0)
    racers = [context.Process(target=_take_turns, args=(tmp_path / "run", inside, twice)) for _ in range(3)]
    assert _all_end(racers) == [0, 0, 0] and twice.value == 0
    assert folders.contents(tmp_path).keys() <= {"run"}, "no lock is left, nor anything else in the folder"


def test_a_start_that_fails_takes_back_the_folders_that_it_made_and_no_other(tmp_path):
    (tmp_path / "mine").mkdir()
    run = run_lib.Run(tmp_path / "mine" / "deep" / "run")
    with pytest.raises(RuntimeError, match="no GPU"), run.locked():
        run.create(make_config())
        try:
            raise RuntimeError("no GPU")
        finally:
            run.discard()
    assert list(tmp_path.iterdir()) == [tmp_path / "mine"] and list((tmp_path / "mine").iterdir()) == []


def test_a_disk_that_is_full_from_the_start_leaves_nothing(tmp_path):
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))  # Less than a configuration has bytes.
    try:
        with pytest.raises(OSError, match="config.json"):
            run_lib.Run(tmp_path / "run").create(make_config())
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("place", ["file", "file/below/it"])
def test_a_run_has_no_place_where_a_file_is(place, tmp_path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(ValueError, match="is a file or lies below one; choose another folder"):
        run_lib.Run(tmp_path / place).create(make_config())
    assert folders.contents(tmp_path) == {"file": b"mine"}


def test_a_run_whose_folder_cannot_be_made_says_so():
    with pytest.raises(FileNotFoundError, match="^/proc/there/is/none cannot be made; choose another folder$"):
        run_lib.Run(Path("/proc/there/is/none")).create(make_config())


# An earlier attempt.


def test_an_attempt_without_a_checkpoint_is_started_anew_and_its_records_are_moved_aside(run):
    run.append_metrics(row(10))
    run.append_episodes(10, run_lib.EPISODES.empty_table())
    before = folders.contents(run.path)
    moved = run.create(make_config(seed=1))
    assert moved == run.path / "superseded-1" and folders.contents(moved) == before
    assert run.config.agent.seed == 1 and run.metrics() == []
    run.append_metrics(row(20))
    assert run.create(make_config(seed=2)) == run.path / "superseded-2"
    assert folders.contents(moved) == before


def test_an_attempt_without_any_record_is_replaced(run):
    assert run.create(make_config(seed=1)) is None
    assert os.listdir(run.path) == ["config.json"] and run.config.agent.seed == 1


@pytest.mark.parametrize("what", ["a checkpoint", "an agent"])
def test_a_run_that_came_to_something_is_not_started_anew(what, run):
    checkpoint(run)
    if what == "an agent":
        run.keep_agent_only()
    before = folders.contents(run.path)
    with pytest.raises(ValueError, match="already holds a run; add --resume"):
        run.create(make_config(seed=1))
    assert folders.contents(run.path) == before


def test_records_without_a_checkpoint_are_not_resumed_over(run):
    run.check_resumable()  # Nothing is lost where nothing is.
    run.append_metrics(row(10))
    with pytest.raises(ValueError, match="no checkpoint to resume from; leave out --resume to start anew"):
        run.check_resumable()
    checkpoint(run)
    run.check_resumable()


def test_a_run_that_has_kept_its_agent_alone_is_not_resumed(run):
    checkpoint(run)
    run.append_metrics(row(10))
    run.keep_agent_only()
    with pytest.raises(ValueError, match="is finished and has kept its agent alone; evaluate it"):
        run.check_resumable()


def test_rewinding_moves_later_records_aside_and_drops_a_torn_row(run):
    for frames in (10, 20, 30):
        run.append_metrics(row(frames))
        run.append_episodes(frames, run_lib.EPISODES.empty_table())
    with open(run.path / "metrics.csv", "a") as file:
        file.write("1,7")  # Torn by a crash: a part of a row, whose frames look small.
    run.rewind(30)
    assert sorted(os.listdir(run.path)) == ["config.json", "episodes.parquet", "metrics.csv"]
    run.rewind(20)
    assert [entry["frames"] for entry in run.metrics()] == [10, 20]
    run.append_metrics(row(25))
    assert [entry["frames"] for entry in run.metrics()] == [10, 20, 25]
    assert sorted(os.listdir(run.path / "episodes.parquet")) == [f"part-{frames:015d}.parquet" for frames in (10, 20)]
    aside = run_lib.Run(run.path / "superseded-1")
    assert [entry["frames"] for entry in aside.metrics()] == [30]
    assert os.listdir(aside.path / "episodes.parquet") == [f"part-{30:015d}.parquet"]
    run.rewind(-1)
    assert run.metrics() == []
    assert [entry["frames"] for entry in run_lib.Run(run.path / "superseded-2").metrics()] == [10, 20, 25]


def test_keeping_the_agent_goes_on_where_a_kill_has_left_it(run):
    checkpoint(run)
    checkpoints = folders.contents(run.path / "checkpoints")
    run.keep_agent_only()
    assert not (run.path / "checkpoints").exists()
    agent = run.agent_path.read_bytes()
    for name, content in checkpoints.items():
        (run.path / "checkpoints").mkdir(exist_ok=True)
        (run.path / "checkpoints" / name).write_bytes(content)
    run.keep_agent_only()
    assert (
        folders.contents(run.path).keys() == {"config.json", "agent.safetensors"}
        and run.agent_path.read_bytes() == agent
    )


# metrics.csv.


def test_wherever_a_kill_tears_the_metrics_whole_rows_are_read_and_a_resumed_run_writes_on(tmp_path):
    whole = run_lib.Run(tmp_path)
    whole.append_metrics(row(10))
    whole.append_metrics(row(20))
    content = (tmp_path / "metrics.csv").read_bytes()
    assert content.count(b"\n") == 3 and content.startswith(b"frames,updates,")
    ends = [end + near for end in range(len(content)) if content[end : end + 1] == b"\n" for near in (0, 1)]
    for size in sorted({*range(0, len(content), 11), *ends}):
        (tmp_path / "metrics.csv").write_bytes(content[:size])
        num_rows = max(0, content[:size].count(b"\n") - 1)
        expected = [10.0, 20.0][:num_rows]
        assert [entry["frames"] for entry in whole.metrics()] == expected
        whole.rewind(20)
        whole.append_metrics(row(30))
        assert [entry["frames"] for entry in whole.metrics()] == [*expected, 30.0]
        assert (tmp_path / "metrics.csv").read_bytes().startswith(content[: content.index(b"\n") + 1])


def test_a_run_has_the_columns_of_all_runs_and_those_of_its_learner(run):
    run.append_metrics(row(10))
    assert (run.path / "metrics.csv").read_text().splitlines()[0] == (
        "frames,updates,episodes,seconds,frames_per_second,success_rate,episode_return,interactions,timeouts,"
        "entropy,policy_loss,baseline_loss,gradient_norm,learning_rate,entropy_cost,staleness"
    )
    assert "staleness" not in ppo.PPOConfig.metrics


def test_a_run_that_an_earlier_version_has_begun_with_more_columns_goes_on_under_them(tmp_path):
    run = run_lib.Run(tmp_path)
    run.create(config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=ppo.PPOConfig()))
    run.append_metrics({**row(10), "staleness": 0})  # PPO's rows had one.
    run.append_metrics({**row(20), "staleness": 0})
    checkpoint(run)
    run.check_resumable()
    run.rewind(10)
    now = {name: value for name, value in row(30).items() if name != "staleness"}
    run.append_metrics(now)
    before, after = run.metrics()
    assert list(before) == list(after) == COLUMNS
    assert before["staleness"] == 0 and math.isnan(after.pop("staleness")) and after == now


def test_a_run_that_an_earlier_version_has_begun_with_fewer_columns_is_read_but_not_resumed(run):
    fewer = {name: value for name, value in row(10).items() if name != "entropy_cost"}
    run.append_metrics(fewer)
    checkpoint(run)
    assert run.metrics() == [fewer]
    with pytest.raises(ValueError, match=r"metrics\.csv has the columns of an earlier version; resume it with that"):
        run.check_resumable()


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("frames,{rest}\n1,2\n", "metrics.csv is damaged: line 2 is no row of 16 numbers"),
        ("frames,{rest}\n{row}\n{word}\n", "metrics.csv is damaged: line 3 is no row of 16 numbers"),
        ("frames,{rest},colour\n", "metrics.csv is damaged: its first line names no metrics"),
        ("{row}\n", "metrics.csv is damaged: its first line names no metrics"),
        ("\0\0\0\0\n", "metrics.csv is damaged: its first line names no metrics"),
        ("\xff\n", "metrics.csv is damaged: its first line names no metrics"),
    ],
)
def test_damaged_metrics_are_named_in_one_line_and_left_alone(content, words, run):
    first, *rest = COLUMNS
    fields = {"rest": ",".join(rest), "row": "1" + ",1" * len(rest), "word": "a" + ",1" * len(rest)}
    damaged = content.format(**fields).encode("latin-1")
    (run.path / "metrics.csv").write_bytes(damaged)
    for read in (run.metrics, lambda: run.rewind(-1)):
        with pytest.raises(ValueError, match=words) as caught:
            read()
        assert str(caught.value).startswith(str(run.path)) and "\n" not in str(caught.value)
    assert (run.path / "metrics.csv").read_bytes() == damaged


def test_metrics_that_are_too_large_for_any_run_are_refused_before_they_are_read(run):
    with open(run.path / "metrics.csv", "wb") as file:
        file.truncate(2**40)  # A terabyte of zeros that takes no room.
    with pytest.raises(ValueError, match=r"metrics\.csv is larger than"):
        run.metrics()


def test_a_configuration_that_makes_no_sense_is_refused_with_its_file_named(run):
    path = run.path / "config.json"
    path.write_text(path.read_text().replace('"num_workers": 1', '"num_workers": -1'))
    with pytest.raises(ValueError, match=r"config\.json is not what was written: num_workers is -1") as caught:
        _ = run.config
    assert str(caught.value).startswith(str(run.path)) and "\n" not in str(caught.value)


def test_what_a_killed_writer_left_is_not_moved_aside(run):
    (run.path / "checkpoints").mkdir()
    (run.path / "checkpoints" / "000000000000001.json").write_text("{}")
    (run.path / "checkpoints" / f".000000000000001.safetensors.{'0' * 16}.tmp").write_bytes(b"half")
    moved = run.create(make_config())
    assert [path.name for path in (moved / "checkpoints").iterdir()] == ["000000000000001.json"]


# Links.


def test_an_agent_that_is_a_link_to_nowhere_is_refused_as_a_link(run):
    (run.path / "agent.safetensors").symlink_to("nowhere")
    with pytest.raises(ValueError, match=r"agent\.safetensors is a symbolic link"):
        run.variables({})


@pytest.mark.parametrize("name", FOLDERS)
def test_a_folder_of_a_run_that_is_a_link_is_refused_and_what_it_points_to_stays(name, run, tmp_path):
    elsewhere = tmp_path / "elsewhere"
    (elsewhere / ".replay-x").mkdir(parents=True)
    (elsewhere / "part-000000000000099.parquet").write_text("mine")
    (run.path / name).symlink_to(elsewhere)
    for use in (lambda: run.create(make_config()), run.keep_agent_only):
        with pytest.raises(ValueError, match=f"{name} is a symbolic link") as caught:
            use()
        assert "\n" not in str(caught.value)
    assert sorted(os.listdir(elsewhere)) == [".replay-x", "part-000000000000099.parquet"]
    assert sorted(os.listdir(run.path)) == sorted(["config.json", name])


def test_a_lock_that_is_a_link_is_refused_and_its_target_stays_as_it_was(run, tmp_path):
    (tmp_path / "precious").write_text("mine")
    (run.path / ".lock").symlink_to(tmp_path / "precious")
    with pytest.raises(OSError, match=r"symbolic links: .*\.lock'"), run.locked():
        pass
    assert (tmp_path / "precious").read_text() == "mine"


@pytest.mark.parametrize("name", ["config.json", "metrics.csv"])
def test_a_file_of_a_run_that_is_a_link_is_neither_read_nor_written_through(name, run, tmp_path):
    run.append_metrics(row(10))
    (run.path / name).rename(tmp_path / "precious")
    before = (tmp_path / "precious").read_bytes()
    (run.path / name).symlink_to(tmp_path / "precious")
    uses = {
        "config.json": (lambda: run.config,),
        "metrics.csv": (run.metrics, lambda: run.append_metrics(row(20)), lambda: run.rewind(0)),
    }[name]
    for use in uses:
        with pytest.raises(ValueError, match=f"{name} is a symbolic link"):
            use()
    assert (tmp_path / "precious").read_bytes() == before


def test_the_folder_itself_may_be_a_link(tmp_path):
    (tmp_path / "large disk").mkdir()
    (tmp_path / "latest").symlink_to(tmp_path / "large disk")
    run = run_lib.Run(tmp_path / "latest")
    with run.locked():
        run.create(make_config())
        run.append_metrics(row(10))
    assert sorted(folders.contents(tmp_path / "large disk")) == ["config.json", "metrics.csv"]
    assert (tmp_path / "latest").is_symlink()


# The lock.


def test_a_trainer_whose_lock_file_is_removed_notices_and_does_not_remove_the_next_ones(run):
    with run.locked():
        run.check_lock()
        (run.path / ".lock").unlink()
        with pytest.raises(RuntimeError, match=r"\.lock was removed, or the folder moved"):
            run.check_lock()
        other = run_lib.Run(run.path)
        with other.locked():
            with pytest.raises(RuntimeError, match="was removed"):
                run.check_lock()
            run.discard()
            assert run.config == make_config(), "what is there now is the other's"
            other.check_lock()
        assert not (run.path / ".lock").exists()
        other_lock = run.path / ".lock"
        other_lock.write_text("")
    assert other_lock.exists()


def test_a_trainer_whose_folder_is_moved_notices(run):
    with run.locked():
        run.path.rename(run.path.with_name("moved"))
        with pytest.raises(RuntimeError, match="or the folder moved"):
            run.check_lock()
    assert os.listdir(run.path.parent) == ["moved"]


def test_what_killed_trainers_have_left_of_replays_is_removed_by_the_next(run):
    (run.path / "replays" / ".replay-abc").mkdir(parents=True)
    (run.path / "replays" / ".replay-abc" / "000000.rrd").write_text("half")
    (run.path / "replays" / "000000000001000.rrd").write_text("whole")
    with run.locked():
        assert os.listdir(run.path / "replays") == ["000000000001000.rrd"]


def test_a_damaged_agent_is_one_line_that_names_it(run):
    checkpoint(run)
    run.keep_agent_only()
    run.agent_path.write_bytes(run.agent_path.read_bytes()[:-1])
    with pytest.raises(ValueError, match=r"agent\.safetensors is damaged") as caught:
        run.variables({"w": torch.ones(2)})
    assert "\n" not in str(caught.value)


def test_a_configuration_that_is_no_json_is_named(run):
    (run.path / "config.json").write_text(json.dumps({"format": 1})[:-1])
    with pytest.raises(ValueError, match=r"run/config\.json is no JSON"):
        _ = run.config
