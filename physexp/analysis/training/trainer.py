"""Training: runs an agent on a task, and records it in a run's folder."""

import contextlib
import functools
import shutil

from physexp import suite
from physexp.agents import core, devices, guests, processes, registry
from physexp.analysis.data import provenance
from physexp.analysis.training import callbacks, stopping
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import recorder as recorder_lib
from physexp.analysis.training import run as run_lib
from physexp.suite.engine import gl

_WORKERS_PER_CORE = 32  # More would take memory (half a gigabyte each) and no less time.
_CHECKPOINTS_AT_ONCE = 3  # Two are kept, and the next is written before the older one goes.


def make_environment(config: config_lib.TrainConfig, seed: int, num_environments: int, num_threads: int):
    """Returns a batch of a run's environments, with a seed of their own."""
    task_kwargs = {**config.task_kwargs, "random": seed}
    return suite.load_batch(config.domain, config.task, num_environments, task_kwargs, num_threads)


def check(config: config_lib.TrainConfig, on_cluster: bool = False) -> None:
    """Refuses what cannot be trained here, before anything is made of it.

    Raises:
      ValueError: for a task that is none, for an agent that cannot be trained on a cluster, for more workers than this
        machine can bear, for a GPU or an OpenGL library that is needed and is not here.
    """
    needs_gl = suite.load_task(config.domain, config.task, config.task_kwargs).sense.needs_gl
    try:
        if needs_gl:
            gl.check()
        if not on_cluster:  # There each worker computes on what its own machine has.
            devices.choose(config.agent.device, needs_gl)
    except RuntimeError as error:
        raise ValueError(str(error)) from None
    if on_cluster and not config.agent.can_run_on_cluster:
        able = [name for name, agent in config_lib.ALGORITHMS.items() if agent.can_run_on_cluster]
        raise ValueError(
            f"agent is {config.agent.algorithm}, which has one process; on a cluster train {' or '.join(able)}"
        )
    cores = processes.num_cores()
    most = _WORKERS_PER_CORE * cores
    if not on_cluster and config.agent.num_workers > most:
        raise ValueError(
            f"num_workers is {config.agent.num_workers}; this machine has {cores} cores: give at most "
            f"{most}, or train on a cluster"
        )


def make_agent(
    config: config_lib.TrainConfig, on_cluster: bool = False, tell: callbacks.Tell = callbacks.ignore
) -> core.Agent:
    """Returns the agent of a run, as it is before training.

    Args:
      config: the run's.
      on_cluster: train on the cluster that this process has joined.
      tell: called with a line when a worker has died that can be replaced, or has fallen silent.
    """
    environments = functools.partial(make_environment, config)
    if on_cluster:
        return registry.make_on_cluster(environments, config.agent, tell, provenance.versions)
    return registry.make(environments, config.agent, tell)


@guests.own_torch()
def train(
    run: run_lib.Run,
    report: callbacks.Report = callbacks.ignore,
    on_cluster: bool = False,
    tell: callbacks.Tell = callbacks.ignore,
    start: config_lib.TrainConfig | None = None,
    on_checkpoint: recorder_lib.OnCheckpoint | None = None,
) -> None:
    """Trains an agent, and keeps the run's folder locked meanwhile.

    Ctrl-C, SIGTERM or SIGHUP finishes the update and writes a checkpoint; a second one leaves at once. A start
    that comes to nothing leaves nothing behind.

    Args:
      run: a run that has been created, unless it is started here.
      report: called with each row of metrics.
      on_cluster: train on the cluster that this process has joined.
      tell: called with a line when something has gone wrong that training survives: a watcher that fails is such.
      start: what to train from the start; None to go on with the run in the folder, from its last checkpoint if there
        is one.
      on_checkpoint: called after each checkpoint is written; `replay.training.Writer` is such a watcher.

    Raises:
      stopping.Interrupted: after one of these signals, when the checkpoint has been written.
      OSError: if the folder cannot be made or written to.
      RuntimeError: if training cannot go on; it says where it stands.
      ValueError: if another process is training in the run's folder, if there is too little room in it, if it holds a
        run that would be started anew, or records without a checkpoint that would be resumed, or as `check`.
    """
    tell = callbacks.expendable(tell, callbacks.ignore, "the printing of lines")
    with run.locked():
        config = start or run.config
        check(config, on_cluster)
        if start is None:
            run.check_resumable()
        elif moved := run.create(start):
            tell(f"what an earlier attempt without a checkpoint had recorded is now in {moved}")
        try:
            agent = make_agent(config, on_cluster, tell)
            _check_room(run, agent)
            recorder = recorder_lib.Recorder(run, config, report, tell, on_checkpoint)
            recorder.resume(agent)
            with stopping.Interruption(agent.stop) as interruption:
                while not _run(agent, recorder, run, tell):
                    recorder.resume(agent)
        finally:
            if start is not None:
                run.discard()
    if interruption.happened:
        raise interruption.happened


def _check_room(run: run_lib.Run, agent: core.Agent) -> None:
    """Refuses a folder that is too full for checkpoints."""
    needed = _CHECKPOINTS_AT_ONCE * sum(value.nbytes for value in agent.save().values())
    free = shutil.disk_usage(run.path).free
    if free < needed:
        raise ValueError(
            f"{run.path} has {free / 1e6:.1f} MB of free space, and checkpoints need {needed / 1e6:.1f} MB; make room, "
            "or choose another folder"
        )


def _run(agent: core.Agent, recorder: recorder_lib.Recorder, run: run_lib.Run, tell: callbacks.Tell) -> bool:
    """Trains to the end; returns False if it has to go on from the last checkpoint."""
    try:
        with contextlib.closing(agent.updates()) as updates:
            for update in updates:
                if update is not None:
                    recorder.add(update)
                if recorder.checkpoint_is_due():
                    recorder.snapshot(agent.save())
        recorder.snapshot(agent.save())
    except core.VariablesLostError as error:
        tell(f"{error}; training goes on from {'the last checkpoint' if run.checkpointer.paths() else 'the start'}")
        return False
    except core.AgentError as error:
        raise RuntimeError(f"training stopped: {error}{recorder.save_failure(error)}; {_standing(run)}") from None
    except OSError as error:
        run.check_lock()  # Where the folder has gone, nothing in it can be written either.
        raise RuntimeError(
            f"training stopped: cannot write to {run.path}: {error.strerror}; put that right; {_standing(run)}"
        ) from None
    return True


def _standing(run: run_lib.Run) -> str:
    """Returns what there is to go on from, in words."""
    paths = run.checkpointer.paths()
    if not paths:
        return "there is no checkpoint yet, so start it anew"
    return f"the last checkpoint, after {int(paths[-1].stem):,} frames, is whole, --resume it"
