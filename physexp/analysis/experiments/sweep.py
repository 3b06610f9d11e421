"""Sweeps: trains runs, several at a time, lets them play, and adds their rows to the stored tables.

A run works in a folder of its own, `runs/NAME`, from whose last checkpoint it goes on after an interruption. Everything
that is in the tables already is skipped.
"""

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from concurrent import futures
import dataclasses
import io
import itertools
import json
from pathlib import Path
import sys
import tempfile
import time
from typing import Any, Protocol

import pandas
import pyarrow
from pyarrow import parquet

from physexp import suite
from physexp.agents import files
from physexp.analysis.data import results as results_lib
from physexp.analysis.experiments import base
from physexp.analysis.training import callbacks, finding, playing, progress, records, stopping, trainer, verdict
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

_POLL_SECONDS = 5.0
_REPORT_SECONDS = 60.0


@dataclasses.dataclass(frozen=True)
class Job:
    """One run: its configuration, and the trials that its agent plays afterwards."""

    config: config_lib.TrainConfig
    trials: tuple[base.Trial, ...]


class Pool(Protocol):
    """Does jobs on this machine or on others."""

    def submit(self, job: Job, results: base.Results) -> futures.Future[Mapping[str, bytes]]:
        """Does a job as soon as there is room; its result are files by path that belong into the results."""

    def stop(self) -> None:
        """Asks all jobs to end. A job on this machine writes a checkpoint first."""


def jobs(
    experiments: Sequence[base.Experiment],
    observations: Sequence[str],
    num_seeds: Callable[[str], int],
    frames: int | None = None,
) -> list[Job]:
    """Returns the runs that experiments need, each once, the first seed of all before the second of any.

    Only agents with some kinds of observations are trained, of each condition as many as `num_seeds` returns for the
    kind; `frames` replaces each condition's budget.
    """
    trials: dict[config_lib.TrainConfig, dict[base.Trial, None]] = defaultdict(dict)
    for experiment in experiments:
        for condition in experiment.conditions:
            kind = condition.observations
            for seed in range(num_seeds(kind) if kind in observations else 0):
                trials[condition.run(seed, frames)] |= dict.fromkeys(experiment.trials)
    return [Job(config, tuple(trials[config])) for config in sorted(trials, key=lambda config: config.agent.seed)]


def grid(
    tasks: Sequence[str], learners: Sequence[str], seeds: Sequence[int], frames: int | None, num_episodes: int
) -> list[Job]:
    """Returns a run with the preset of each task, as `domain/task`, and learner, for each seed, and its evaluation.

    The first seed of all is before the second of any; `frames` replaces those of the presets.

    Raises:
      ValueError: for an unknown task.
    """
    is_usual = num_episodes == base.EVALUATION.num_episodes
    name = base.EVALUATION.name if is_usual else f"{base.EVALUATION.name}{num_episodes}"
    trial = base.Trial(name=name, num_episodes=num_episodes)
    found = []
    for seed, chosen, learner in itertools.product(seeds, tasks, learners):
        domain, _, task = chosen.partition("/")
        suite.load_task(domain, task)  # Refuses an unknown name.
        agent = config_lib.preset(domain, task, algorithm=learner)
        agent = agent.replace(seed=seed, frames=frames or agent.frames)
        found.append(Job(config_lib.TrainConfig(domain=domain, task=task, agent=agent), (trial,)))
    return found


def table(jobs: Sequence[Job], results: base.Results) -> list[dict[str, Any]]:
    """Returns a row for each job that is done, with the share of the ideal's return where the ideal is known."""
    runs = results.load("runs", ["run", "frames", "seconds"]).set_index("run")
    keys = ["condition", "trial", "training_seed"]
    metrics = ["success_rate", "mean_return", "mean_interactions", "timeouts"]
    evaluations = results.load("evaluations", [*keys, *metrics]).set_index(keys)
    rows = []
    for job in jobs:
        config, (trial,) = job.config, job.trials
        key = (records.condition_id(config), trial.name, config.agent.seed)
        if key in evaluations.index:
            found, ideal = evaluations.loc[key], playing.ideal_return(config)
            row = {"task": config.task_name, "learner": config.agent.title, "seed": config.agent.seed}
            row |= {"frames": int(runs.frames[config.name])}
            row |= {"minutes": round(float(runs.seconds[config.name]) / 60, 2)}
            row |= {name: round(float(found[name]), 4) for name in metrics}
            rows.append(row | {"share_of_ideal": ideal and round(float(found.mean_return) / ideal, 4)})
    return sorted(rows, key=lambda row: (row["task"], row["learner"], row["seed"]))


def run(jobs: Sequence[Job], results: base.Results, pool: Pool, num_processes: int, tell: callbacks.Tell) -> None:
    """Does the jobs that are not done yet.

    `num_processes` jobs at a time are assumed for the estimate of the time left, which is told now and then.

    Raises:
      RuntimeError: if some agents could not be trained; all others are done by then.
      stopping.Interrupted: after a request to end, when the jobs on this machine have written their checkpoints.
      ValueError: if the results hold a run of the same name with another configuration, or one that has to play more
        and whose weights are not there.
    """
    todo = to_do(jobs, results)
    tell(f"{len(jobs) - len(todo)} of {len(jobs)} agents are done")
    if not todo:
        return
    reported, failures = time.monotonic(), []
    with stopping.deferred(pool.stop) as requests:
        pending = {pool.submit(job, results): job for job in todo}
        while pending:
            finished, _ = futures.wait(pending, timeout=_POLL_SECONDS, return_when=futures.FIRST_COMPLETED)
            if requests:
                pool.stop()  # Also jobs that have just begun.
            for future in finished:
                job = pending.pop(future)
                try:
                    _take(future.result(), results)
                except BaseException as error:  # Also a cancelled job, and one that was asked to end.
                    if not requests:
                        failures.append(f"{job.config.name}: {error}")
                        tell(f"FAILED {failures[-1]}")
                    continue
                problem = verdict.of_run(results.run(job.config))
                tell(f"done: {job.config.name}" + (f", but {problem}" if problem else ""))
            if pending and not requests and (finished or time.monotonic() - reported > _REPORT_SECONDS):
                tell(outlook(jobs, results, num_processes, len(pending)))
                reported = time.monotonic()
    if failures:
        raise RuntimeError(f"{len(failures)} of {len(todo)} agents could not be trained: {'; '.join(failures)}")


def to_do(jobs: Sequence[Job], results: base.Results) -> list[Job]:
    """Returns the jobs that are not done.

    Raises:
      ValueError: as `run`.
    """
    rows = results.load("runs", ["run", "config"])
    stored, played = dict(zip(rows.run, rows.config, strict=True)), results.played()
    left = []
    for job in jobs:
        run, missing, known = results.run(job.config), _missing(job, played), job.config
        is_stored = job.config.name in stored
        if (run.path / "config.json").exists():
            known = run.config
        elif is_stored:
            known = config_lib.TrainConfig.from_json(json.loads(stored[job.config.name]))
        if known != job.config:
            raise ValueError(
                f"{job.config.name} in {results.path} has another configuration; move its run away or choose another "
                "--results-dir"
            )
        if is_stored and missing and not run.agent_path.exists():
            raise ValueError(
                f"{job.config.name} is stored in {results.path} without its weights, so it cannot play "
                f"{', '.join(trial.name for trial in missing)}; choose another --results-dir"
            )
        if missing or not is_stored:
            left.append(job)
    return left


def _missing(job: Job, played: set[tuple[str, str, int]]) -> list[base.Trial]:
    key, seed = records.condition_id(job.config), job.config.agent.seed
    return [trial for trial in job.trials if (key, trial.name, seed) not in played]


def work(job: Job, results: base.Results) -> dict[str, bytes]:
    """Trains an agent, if that is not done, and plays the trials that are not stored; returns no files."""
    run, config = results.run(job.config), job.config

    def tell(line: str) -> None:
        sys.stderr.write(f"{config.name}: {line}\n")

    with run.locked():
        if not run.agent_path.exists():
            trainer.train(run, tell=tell, start=None if run.checkpointer.paths() else config)
        run.keep_agent_only()
        if not len(results.load("runs", ["run"], [("run", "==", config.name)])):
            results.append("curves", records.of_curve(run))
            results.append("runs", records.of_run(run))
        for trial in _missing(job, results.played()):
            rows = _play(run, trial)
            results.append("episodes", rows)
            results.append("evaluations", records.of_evaluation(rows, config, trial.name, trial.task_kwargs))
    return {}


def _play(run: run_lib.Run, trial: base.Trial) -> pyarrow.Table:
    """Plays a trial with a run's agent; returns the rows of its episodes."""
    config, network = run.config, finding.load_network(run)
    played_as = dataclasses.replace(config, task_kwargs={**config.task_kwargs, **trial.task_kwargs})
    num_episodes, num_steps = trial.num_episodes, trial.num_steps
    played = playing.play(network, played_as, num_episodes, trial.interaction, num_threads=1, num_steps=num_steps)
    options = suite.options(config.domain)(**played_as.task_kwargs)
    timestep = options.draw_substeps(played.seed, played.episode) * options.physics_timestep
    return records.of_episodes(played, config, trial.name, timestep)


def work_elsewhere(job: Job) -> dict[str, bytes]:
    """Does a job on a machine that does not see the results; returns its files by their paths in the results."""
    with tempfile.TemporaryDirectory() as folder:
        work(job, base.Results(Path(folder)))
        paths = [path for path in Path(folder).rglob("*") if path.is_file() and path.name != ".lock"]
        return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


def _take(made: Mapping[str, bytes], results: base.Results) -> None:
    """Adds files that `work_elsewhere` has made to the results: tables last, and the agent before them."""

    def place(name: str) -> tuple[bool, bool, str]:
        return name.startswith(results_lib.TABLES), name.endswith(".safetensors"), name

    for name in sorted(made, key=place):
        path = results.path / name
        if name.startswith(results_lib.TABLES):
            results.append(path.parent.name, parquet.read_table(io.BytesIO(made[name])))
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            files.write_atomically(path, made[name])


def outlook(jobs: Sequence[Job], results: base.Results, num_processes: int, num_pending: int) -> str:
    """Returns the number of agents and frames to go, and the time left at the speed of these runs, once it is known."""
    stored = results.load("runs", ["run", "frames", "seconds"]).set_index("run")
    rows = []
    for config in (job.config for job in jobs):
        if config.name in stored.index:
            last = dict(stored.loc[config.name])
        else:
            *_, last = [{"frames": 0, "seconds": 0.0}, *results.run(config).metrics()]
        kind, budget = f"{config.task_name} {config.agent.algorithm}", config.agent.frames
        rows.append((kind, budget, min(last["frames"], budget), last["frames"], last["seconds"]))
    runs = pandas.DataFrame(rows, columns=["kind", "budget", "done", "frames", "seconds"])
    agents = "1 agent" if num_pending == 1 else f"{num_pending} agents"
    line = f"{agents} to go, {runs.done.sum() / 1e6:.2f} of {runs.budget.sum() / 1e6:.2f} million frames"
    if not runs.frames.any():
        return line
    alike = runs.groupby("kind")[["seconds", "frames"]].transform("sum")
    pace = (alike.seconds / alike.frames).fillna(runs.seconds.sum() / runs.frames.sum())
    return f"{line}, time left {progress.duration((pace * (runs.budget - runs.done)).sum() / num_processes)}"
