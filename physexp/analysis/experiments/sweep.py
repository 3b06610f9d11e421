"""Sweeps: trains the agents that are missing, several at a time, lets them play, and picks up where it was stopped."""

from collections.abc import Callable, Mapping, Sequence
from concurrent import futures
import dataclasses
from pathlib import Path
import tempfile
import time

import pyarrow

from physexp import suite
from physexp.agents import files
from physexp.analysis.experiments import base, conditions
from physexp.analysis.experiments import jobs as jobs_lib
from physexp.analysis.training import (
    callbacks,
    finding,
    playing,
    progress,
    recorder,
    records,
    stopping,
    trainer,
    verdict,
)
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

_POLL_SECONDS = 5.0
_REPORT_SECONDS = 60.0


@dataclasses.dataclass(frozen=True)
class Job:
    """One agent: how it is trained, and what it then plays."""

    config: config_lib.TrainConfig
    trials: tuple[base.Trial, ...]


def jobs(
    experiments: Sequence[base.Experiment],
    observations: Sequence[str],
    num_seeds: Callable[[str], int],
    frames: int | None = None,
) -> list[Job]:
    """Returns the agents that experiments need, each once, the first seed of all before the second of any.

    Args:
      experiments: what is asked for.
      observations: kinds of observations that agents may have.
      num_seeds: how many agents to train in each condition, by kind of observation.
      frames: environment steps to train for; None for each condition's own budget.
    """
    played: dict[config_lib.TrainConfig, list[base.Trial]] = {}
    for experiment in experiments:
        for condition in experiment.conditions:
            kind = conditions.observations(condition)
            for seed in range(num_seeds(kind) if kind in observations else 0):
                agent = condition.agent.replace(seed=seed, frames=frames or condition.agent.frames)
                trials = played.setdefault(dataclasses.replace(condition, agent=agent), [])
                trials += [trial for trial in experiment.trials if trial not in trials]
    return [Job(config, tuple(played[config])) for config in sorted(played, key=lambda config: config.agent.seed)]


def run(
    jobs: Sequence[Job],
    results: base.Results,
    num_processes: int,
    tell: callbacks.Tell,
    submit: Callable[[Job], futures.Future] | None = None,
) -> None:
    """Does what is not done yet.

    Args:
      jobs: the agents.
      results: where everything goes.
      num_processes: how many agents to train at a time, here.
      tell: called with lines that tell how it goes.
      submit: trains an agent elsewhere, as `cluster.submit` does; by default agents are trained here, as those are
        always that have begun here.

    Raises:
      RuntimeError: when some agents could not be trained; all others are done by then.
      stopping.Interrupted: after a request to end, when the agents that were being trained have their checkpoints.
      ValueError: when the folder holds a run of the same name with another configuration, or what such a run played.
    """
    for job in jobs:
        _check(job, results)
    todo = [job for job in jobs if not _is_done(job, results)]
    tell(f"{len(jobs) - len(todo)} of {len(jobs)} agents are done")
    if not todo:
        return
    meter = Meter(jobs, results, num_processes)
    reported = time.monotonic()
    failures = []
    with (
        jobs_lib.Processes(_work, num_processes, tell) as processes,
        stopping.Interruption(processes.stop) as interruption,
    ):
        here, elsewhere = {}, {}
        for job in todo:
            if submit is None or results.run(job.config).path.exists():
                here[processes.submit(job.config.name, job, results)] = job
            else:
                elsewhere[submit(job)] = job
        pending = here | elsewhere
        # The cluster forgets its tasks when this process ends.
        while pending:
            done, _ = futures.wait(pending, timeout=_POLL_SECONDS, return_when=futures.FIRST_COMPLETED)
            if interruption.happened and not done and pending.keys() <= elsewhere.keys():
                break
            for future in done:
                job = pending.pop(future)
                if interruption.happened and future in here:
                    continue
                obstacle = future.exception() or _keep(future.result() or {}, results)
                if obstacle is not None:
                    if not interruption.happened:
                        failures.append(f"{job.config.name}: {obstacle}")
                        tell(f"FAILED {failures[-1]}")
                    continue
                problem = verdict.of_run(results.run(job.config))
                tell(f"done: {job.config.name}" + (f", but {problem}" if problem else ""))
            if pending and not interruption.happened and (done or time.monotonic() - reported > _REPORT_SECONDS):
                tell(meter.line(len(pending)))
                reported = time.monotonic()
    if interruption.happened:
        raise interruption.happened
    if failures:
        raise RuntimeError(f"{len(failures)} of {len(todo)} agents could not be trained: {'; '.join(failures)}")


def _keep(made: Mapping[str, bytes], results: base.Results) -> OSError | None:
    """Writes the files of an agent that was trained elsewhere; returns what was in the way.

    They are written so that a part of them is a run that can go on: its configuration first, what it played last.
    """
    for name in sorted(made, key=lambda name: (name.startswith("episodes"), not name.endswith("config.json"), name)):
        try:
            (results.path / name).parent.mkdir(parents=True, exist_ok=True)
            files.write_atomically(results.path / name, made[name])
        except OSError as error:
            return error
    return None


def _check(job: Job, results: base.Results) -> None:
    """Refuses what another agent of the same name has left."""
    run_of_job = results.run(job.config)
    if (run_of_job.path / "config.json").exists():
        if run_of_job.config != job.config:
            raise ValueError(
                f"{run_of_job.path} was made with another configuration; move it away or choose another --results-dir"
            )
    elif played := results.all_episodes(job.config):
        raise ValueError(
            f"{', '.join(map(str, played))}: the run that played this is gone; move it away or choose "
            "another --results-dir"
        )


def _is_done(job: Job, results: base.Results) -> bool:
    if not job.trials:
        return results.run(job.config).is_finished
    return all(results.episodes_path(trial, job.config).exists() for trial in job.trials)


def _work(tell: callbacks.Tell, job: Job, results: base.Results) -> None:
    """Trains an agent, if that is not done, and plays what it has not played."""
    run = results.run(job.config)
    with run.locked():
        if not run.agent_path.exists():
            is_new = not run.checkpointer.paths()
            trainer.train(
                run,
                tell=lambda line: tell(f"{job.config.name}: {line}"),
                start=job.config if is_new else None,
                on_checkpoint=_replays(run, job.config),
            )
        run.keep_agent_only()
    for trial in job.trials:
        path = results.episodes_path(trial, job.config)
        if not path.exists():
            records.write(path, _play(run, trial))


def work_elsewhere(job: Job) -> dict[str, bytes]:
    """Trains an agent on a machine that does not see the results; returns the files that belong there, by path."""
    with tempfile.TemporaryDirectory() as folder:
        _work(print, job, base.Results(Path(folder)))
        return {
            str(path.relative_to(folder)): path.read_bytes()
            for path in sorted(Path(folder).rglob("*"))
            if path.is_file()
        }


def _replays(run: run_lib.Run, config: config_lib.TrainConfig) -> recorder.OnCheckpoint | None:
    """Returns what writes replays while a run trains, if it is to have any."""
    if not config.replay_every:
        return None
    from physexp.analysis.replay import training  # Takes seconds, and most runs do without.

    return training.Writer(run, config)


def _play(run: run_lib.Run, trial: base.Trial) -> pyarrow.Table:
    """Returns the rows of what a run's agent plays."""
    config = run.config
    played_as = dataclasses.replace(config, task_kwargs={**config.task_kwargs, **trial.task_kwargs})
    played = playing.play(
        finding.load_network(run),
        played_as,
        trial.num_episodes,
        trial.interaction,
        num_threads=1,
        num_steps=trial.num_steps,
    )
    options = suite.options(config.domain)(**played_as.task_kwargs)
    timestep = options.draw_substeps(played.seed, played.episode) * options.physics_timestep
    return records.table(played, played_as, trial.interaction, timestep)


class Meter:
    """Tells how far a sweep is and how long it will take, from the speed of its own runs."""

    def __init__(self, jobs: Sequence[Job], results: base.Results, num_processes: int):
        self._jobs, self._results, self._num_processes = jobs, results, num_processes

    def line(self, num_pending: int) -> str:
        """Returns how many agents and frames there are to go, and for how long, as far as that is known."""
        done = total = left = 0.0
        speeds: dict[tuple[str, ...], list[tuple[float, float]]] = {}
        remaining: dict[tuple[str, ...], float] = {}
        for job in self._jobs:
            kind: tuple[str, ...] = (job.config.domain, job.config.task, job.config.agent.algorithm)
            rows = self._results.run(job.config).metrics()
            frames = min(rows[-1]["frames"], job.config.agent.frames) if rows else 0
            if frames:
                speeds.setdefault(kind, []).append((rows[-1]["seconds"], rows[-1]["frames"]))
            remaining[kind] = remaining.get(kind, 0) + job.config.agent.frames - frames
            done, total = done + frames, total + job.config.agent.frames
        agents = "1 agent" if num_pending == 1 else f"{num_pending} agents"
        line = f"{agents} to go, {done / 1e6:.2f} of {total / 1e6:.2f} million frames"
        if not speeds:
            return line
        for kind, frames in remaining.items():
            known = speeds.get(kind) or [pair for pairs in speeds.values() for pair in pairs]
            left += frames * sum(seconds for seconds, _ in known) / sum(count for _, count in known)
        return f"{line}, time left {progress.duration(left / self._num_processes)}"
