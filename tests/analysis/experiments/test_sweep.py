"""Sweeps: whole runs, of which nothing is lost or done twice."""

from concurrent import futures
import multiprocessing
import os
import shutil
import signal
import threading

import commands
import pytest
from trainers import group
from waiting import wait_until

from physexp.analysis.experiments import EXPERIMENTS, base, conditions, pools, sweep
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import stopping

TASK = "which_is_heavier/features"


def grid(num_seeds=2, frames=300, num_episodes=50):
    return sweep.grid([TASK], ["ppo"], range(num_seeds), frames, num_episodes)


class Here:
    """Does jobs at once in this process; `work` may be that of another machine."""

    def __init__(self, work=sweep.work):
        self.work, self.done = work, []

    def submit(self, job, results):
        future = futures.Future()
        self.done.append(job.config.name)
        try:
            future.set_result(self.work(job, results))
        except Exception as error:
            future.set_exception(error)
        return future

    def stop(self):
        """Nothing runs meanwhile."""


def elsewhere(job, _):
    return sweep.work_elsewhere(job)


def never(job, _):
    pytest.fail(f"{job.config.name} was trained again")


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*.parquet")}


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """Results of two seeds."""
    results, lines = base.Results(tmp_path_factory.mktemp("results")), []
    sweep.run(grid(), results, Here(), 1, lines.append)
    return results, lines


@pytest.fixture
def copied(swept, tmp_path):
    """The same results, to be changed."""
    return base.Results(shutil.copytree(swept[0].path, tmp_path / "results"))


def test_a_sweep_leaves_rows_that_agree_with_one_another(swept):
    results, lines = swept
    assert lines[0] == "0 of 2 agents are done" and sum(line.startswith("done: ") for line in lines) == 2
    runs = results.load("runs", ["run", "condition", "training_seed", "frames", "learner"])
    assert runs.run.tolist() == [job.config.name for job in grid()]
    assert (runs.frames >= 300).all() and set(runs.learner) == {"ppo"}
    curves = results.load("curves", ["training_seed", "frames"]).groupby("training_seed").frames.max()
    assert curves.tolist() == runs.frames.tolist()
    evaluations = results.load("evaluations", ["trial", "training_seed", "episodes", "success_rate"])
    assert evaluations.episodes.tolist() == [50, 50]
    episodes = results.load("episodes", ["training_seed", "seed", "episode"])
    assert len(episodes) == 100 and not episodes.duplicated().any()
    for job in grid():
        run = results.run(job.config)
        assert run.agent_path.exists() and not (run.path / "checkpoints").exists()
        assert not list(run.path.glob("*.parquet"))


def test_finished_runs_are_skipped(swept):
    results, _ = swept
    before, lines = contents(results.path), []
    sweep.run(grid(), results, Here(never), 1, lines.append)
    assert lines == ["2 of 2 agents are done"] and contents(results.path) == before


def test_a_table_has_a_row_for_each_run(swept):
    rows = sweep.table(grid(3), swept[0])
    assert [(row["task"], row["learner"], row["seed"]) for row in rows] == [(TASK, "ppo", 0), (TASK, "ppo", 1)]
    for row in rows:
        assert row["mean_return"] / row["share_of_ideal"] == pytest.approx(0.8693, abs=2e-3)


def test_a_trained_agent_plays_new_trials_and_lost_ones(swept, copied):
    agents = [copied.run(job.config).agent_path for job in grid()]
    before = [path.stat().st_mtime_ns for path in agents]
    sweep.run(grid(num_episodes=20), copied, Here(), 1, print)
    played = copied.load("evaluations", ["trial", "episodes"])
    assert sorted(played.itertuples(index=False, name=None)) == [("evaluation20", 20)] * 2 + [("evaluation50", 50)] * 2
    shutil.rmtree(copied.path / "tables")
    sweep.run(grid(), copied, Here(), 1, print)
    assert [path.stat().st_mtime_ns for path in agents] == before
    for table in ("curves", "episodes"):
        assert contents(copied.path / "tables" / table) == contents(swept[0].path / "tables" / table)


def test_a_run_on_another_machine_leaves_the_same_rows(swept, tmp_path):
    results = base.Results(tmp_path)
    sweep.run(grid(), results, Here(elsewhere), 1, print)
    here, there = (folder / "tables" / "episodes" for folder in (swept[0].path, tmp_path))
    assert contents(there) == contents(here)
    assert all(results.run(job.config).agent_path.exists() for job in grid())


def test_another_configuration_is_refused(swept, copied):
    message = (
        "ppo-discount0.95-seed0 in .* has another configuration; move its run away or choose another --results-dir"
    )
    with pytest.raises(ValueError, match=message):
        sweep.to_do(grid(frames=400), swept[0])
    shutil.rmtree(copied.path / "runs")
    with pytest.raises(ValueError, match=message):
        sweep.to_do(grid(frames=400), copied)


def test_a_stored_run_without_weights_cannot_play_more(copied):
    shutil.rmtree(copied.path / "runs")
    assert sweep.to_do(grid(), copied) == []
    with pytest.raises(ValueError, match="without its weights, so it cannot play evaluation20; choose another"):
        sweep.to_do(grid(num_episodes=20), copied)


def test_a_failure_is_named_and_the_others_go_on(tmp_path):
    results, lines = base.Results(tmp_path), []
    blocked = results.run(grid()[0].config).path
    blocked.parent.mkdir(parents=True)
    blocked.write_text("a file in place of the folder of the run")
    with pytest.raises(RuntimeError, match=f"1 of 2 agents could not be trained: {blocked.name}"):
        sweep.run(grid(), results, Here(), 1, lines.append)
    assert any(line.startswith(f"FAILED {blocked.name}") for line in lines)
    assert results.load("runs", ["training_seed"]).training_seed.tolist() == [1]


def test_the_time_left_follows_from_the_speed_of_runs(tmp_path):
    results, jobs = base.Results(tmp_path), grid(frames=4000)
    assert sweep.outlook(jobs, results, 1, 2) == "2 agents to go, 0.00 of 0.01 million frames"
    run = results.run(jobs[0].config)
    run.create(jobs[0].config)
    run.append_metrics({**dict.fromkeys(run_lib.METRICS, 0.0), "frames": 1000, "seconds": 30.0})
    # The 7000 frames that are left take 30 s for each thousand.
    left = "1 agent to go, 0.00 of 0.01 million frames, time left 0:03:30"
    assert sweep.outlook(jobs, results, 1, 1) == left


def test_experiments_that_need_the_same_agent_train_it_once():
    jobs = sweep.jobs(list(EXPERIMENTS.values()), conditions.OBSERVATIONS, lambda kind: 2)
    names = [job.config.name for job in jobs]
    # Of each of the paper's ten tasks and of seven others: A3C, PPO, and the belief learner in both tracks; the paper's
    # own learner; three patient A3C, eleven of one worker; three ablations in two tasks; five with variation; two near
    # the tower; two with noise; and foresight in both tracks in ten tasks.
    count = (10 + 7) * 4 + 1 + 3 + 11 + 3 * 2 + 5 + 2 + 2 + 10 * 2
    assert len(names) == len(set(names)) == 2 * count
    assert [job.config.agent.seed for job in jobs] == [0] * count + [1] * count
    fist = next(job for job in jobs if job.config.task == "fist_features")
    assert {"learned", "random", "evaluation", "timestep0.01", "timestep0.1"} <= {trial.name for trial in fist.trials}


def test_a_command_is_printed_for_each_run_to_do(swept):
    words = ["sweep", TASK, "--learners", "ppo", "--frames", 300, "--episodes", 50, "--results-dir", swept[0].path]
    done = commands.run(*words, "--seeds", 3, "--print", check=True)
    (line,) = done.stdout.splitlines()
    assert line.startswith(f"physexp sweep {TASK} --learners ppo --seeds 1 --first-seed 2 ")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["sweep", TASK, "--seeds", "0"], "seeds is 0; give an integer >= 1"),
        (["sweep", TASK, "--learners", "dqn"], "learners has 'dqn'; choose from a3c, belief, ppo"),
        (["sweep", "towers/waving"], "task_name is 'waving'; tasks of towers"),
        (["reproduce", "waving"], "experiment is 'waving'; choose from all, mass_gap"),
        (["reproduce", "mass_gap", "--jobs", "-1"], "jobs is -1; give an integer >= 1"),
    ],
)
def test_what_cannot_be_done_is_one_readable_line(words, message, tmp_path):
    done = commands.run(*words, "--results-dir", tmp_path / "results")
    assert done.returncode == 2
    assert message in done.stderr and done.stderr.count("\n") == 1
    assert not (tmp_path / "results").exists()


@pytest.mark.long
def test_a_killed_sweep_goes_on_where_it_was(tmp_path):
    jobs, results = grid(1, frames=5_000), base.Results(tmp_path)
    words = ["sweep", TASK, "--learners", "ppo", "--seeds", 1, "--frames", 5_000, "--episodes", 50]
    with commands.start(*words, "--results-dir", tmp_path, "--jobs", 1) as process:
        wait_until((results.run(jobs[0].config).path / "config.json").exists, "the begin of training")
        process.kill()
        process.wait()
        wait_until(lambda: not group(process.pid), "the end of the processes of the sweep")
    assert not results.played()
    sweep.run(jobs, results, Here(), 1, print)
    assert len(results.played()) == len(sweep.table(jobs, results)) == 1
    assert results.load("curves", ["frames"]).frames.is_unique


@pytest.mark.long
def test_a_killed_job_fails_alone(tmp_path):
    jobs, results = grid(), base.Results(tmp_path)
    with pools.Processes(2) as pool:
        pending = [pool.submit(job, results) for job in jobs]
        (killed, *_) = wait_until(multiprocessing.active_children, "a process")
        killed.kill()
        futures.wait(pending)
    failed = [future.exception() for future in pending if future.exception()]
    assert [str(error) for error in failed] == [
        "its process was killed; run the sweep again to go on from its checkpoint"
    ]


@pytest.mark.long
def test_a_job_whose_process_has_just_started_ends_when_asked_to(tmp_path):
    (job,) = grid(1, frames=10**8)
    with pools.Processes(1) as pool:
        pending = pool.submit(job, base.Results(tmp_path))
        wait_until(multiprocessing.active_children, "a process")
        wait_until(lambda: pool.stop() or pending.done(), "the end of the job")
    assert "run the sweep again to go on" in str(pending.exception())


@pytest.mark.long
def test_jobs_write_checkpoints_when_the_sweep_is_asked_to_end(tmp_path):
    jobs, results = grid(1, frames=10**8), base.Results(tmp_path)
    run = results.run(jobs[0].config)

    def ask():
        wait_until(run.metrics, "a row of metrics")
        os.kill(os.getpid(), signal.SIGTERM)

    asking = threading.Thread(target=ask)
    with pools.Processes(1) as pool, pytest.raises(stopping.Interrupted):
        asking.start()
        sweep.run(jobs, results, pool, 1, print)
    asking.join()
    assert run.checkpointer.paths() and run.metrics()[-1]["frames"] < 10**8
    assert not results.played()
