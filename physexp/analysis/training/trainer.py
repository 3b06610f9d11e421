"""Training: runs an agent on a task and records it in a run's folder."""

import contextlib
import functools
import shutil

from physexp import suite
from physexp.agents import alternating, core, devices, networks, processes, registry, starting
from physexp.analysis.training import callbacks, stopping
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import recorder as recorder_lib
from physexp.analysis.training import run as run_lib
from physexp.suite.engine import gl

_WORKERS_PER_CORE = 32  # More would take memory (half a gigabyte each) and no less time.
_CHECKPOINTS_AT_ONCE = 3  # Two are kept, and the next is written before the older one is removed.


def make_environment(config: config_lib.TrainConfig, seed: int, num_environments: int, num_threads: int):
    """Returns a batch of a run's environments, with a seed of their own."""
    batches = [
        suite.load_batch(
            setting.domain, setting.task, num_environments, {**setting.task_kwargs, "random": seed}, num_threads
        )
        for setting in config.settings
    ]
    return alternating.Alternating(batches) if config.also else batches[0]


def make_network(config: config_lib.TrainConfig) -> networks.RecurrentNetwork:
    """Returns the network of a run's agent, its weights drawn from the seed."""
    return starting.make_network(registry.NETWORKS[config.agent.algorithm], config.load_task(), config.agent)


@devices.own_torch()
def make_agent(config: config_lib.TrainConfig) -> core.Agent:
    """Returns the agent of a run, as it is before training."""
    return registry.AGENTS[config.agent.algorithm](functools.partial(make_environment, config), config.agent)


def check(config: config_lib.TrainConfig) -> None:
    """Raises ValueError if a run cannot be trained on this machine, before anything is written.

    It names an unknown task, a GPU or an OpenGL library that is needed and missing, or more workers than there is room
    for.
    """
    task, *_ = [setting.load_task() for setting in config.settings]
    needs_gl = task.pixels
    try:
        if needs_gl:
            gl.check()
        devices.choose(config.agent.device, needs_gl)
    except RuntimeError as error:
        raise ValueError(str(error)) from None
    cores = processes.num_cores()
    if config.agent.num_workers > _WORKERS_PER_CORE * cores:
        raise ValueError(
            f"num_workers is {config.agent.num_workers}; this machine has {cores} cores: give at most "
            f"{_WORKERS_PER_CORE * cores}"
        )


@devices.own_torch()
def train(
    run: run_lib.Run,
    report: callbacks.Report = callbacks.ignore,
    tell: callbacks.Tell = callbacks.ignore,
    start: config_lib.TrainConfig | None = None,
    on_checkpoint: recorder_lib.OnCheckpoint | None = None,
) -> None:
    """Trains an agent, with the run's folder locked meanwhile.

    With a configuration in `start` it trains a new run, otherwise it continues that in the folder from its last
    checkpoint, if any. Ctrl-C, SIGTERM or SIGHUP ends training with a checkpoint, and raises `stopping.Interrupted`; a
    second one leaves at once. A start that fails before the first checkpoint leaves nothing behind. `report` is called
    with each row of metrics, and `tell` with a line when something has gone wrong that training survives.

    Raises:
      OSError: if the folder cannot be made or written to.
      RuntimeError: if training cannot go on; the message names the last checkpoint.
      ValueError: if the folder has too little room, or its run cannot be started or continued, or as `check`.
    """
    tell = callbacks.expendable(tell, callbacks.ignore, "the printing of lines")
    with run.locked():
        config = start or run.config
        check(config)
        if start is None:
            run.check_resumable()
        elif moved := run.create(start):
            tell(f"the records of an earlier attempt without a checkpoint are now in {moved}")
        try:
            agent = make_agent(config)
            _check_room(run, agent)
            recorder = recorder_lib.Recorder(run, config, report, tell, on_checkpoint or callbacks.ignore)
            recorder.resume(agent)
            with stopping.deferred(agent.stop):
                _run(agent, recorder, run)
        finally:
            if start is not None:
                run.discard()


def _check_room(run: run_lib.Run, agent: core.Agent) -> None:
    needed = _CHECKPOINTS_AT_ONCE * sum(value.nbytes for value in agent.save().values())
    free = shutil.disk_usage(run.path).free
    if free < needed:
        raise ValueError(
            f"{run.path} has {free / 1e6:.1f} MB of free space, and checkpoints need {needed / 1e6:.1f} MB; make room, "
            "or choose another folder"
        )


def _run(agent: core.Agent, recorder: recorder_lib.Recorder, run: run_lib.Run) -> None:
    """Trains to the end, or until a signal; raises RuntimeError if it cannot go on."""
    try:
        with contextlib.closing(agent.updates()) as updates:
            for update in updates:
                if update is not None:
                    recorder.add(update)
                if recorder.checkpoint_is_due():
                    recorder.snapshot(agent.save())
        recorder.snapshot(agent.save())
    except core.AgentError as error:
        raise RuntimeError(f"training stopped: {error}{recorder.save_failure(error)}; {_standing(run)}") from None
    except OSError as error:
        run.check_lock()  # A folder that was moved is the cause of other errors.
        fault = f"cannot write to {run.path}: {error.strerror}; put that right"
        raise RuntimeError(f"training stopped: {fault}; {_standing(run)}") from None


def _standing(run: run_lib.Run) -> str:
    """Returns a phrase that names the last checkpoint."""
    paths = run.checkpointer.paths()
    if not paths:
        return "there is no checkpoint yet, so start it anew"
    return f"the last checkpoint, after {int(paths[-1].stem):,} frames, is whole, --resume it"
