"""Real training processes for tests: starting them, finding their workers, waiting for checkpoints."""

import contextlib
import json
import os
from pathlib import Path
import shutil
import signal
import sys

import commands
import psutil
from waiting import wait_until

from physexp.agents.a3c import config as a3c
from physexp.agents.belief import config as belief
from physexp.agents.ppo import config as ppo
from physexp.analysis.data import provenance
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer as trainer_lib

PHYSEXP = Path(sys.executable).with_name("physexp")

NUM_ENVIRONMENTS = belief.NUM_ENVIRONMENTS  # And episodes of an update, for all of them.
SMALL = {
    "a3c": a3c.A3CConfig(num_workers=1, envs_per_worker=NUM_ENVIRONMENTS, checkpoint_seconds=0.2),
    "belief": belief.BeliefConfig(frames_per_update=64, checkpoint_seconds=0.2),
    "ppo": ppo.PPOConfig(num_threads=1, num_environments=NUM_ENVIRONMENTS, num_minibatches=1, checkpoint_seconds=0.2),
}
"""An agent of each algorithm that makes small updates, in one process."""


def create(path, algorithm="a3c", **agent):
    """A new run of Which is Heavier with a small agent."""
    run, learner = run_lib.Run(path), SMALL[algorithm].replace(**agent)
    options = {"difficulty": 10.0}
    run.create(config_lib.TrainConfig(domain="which_is_heavier", task="features", task_kwargs=options, agent=learner))
    return run


def save_first_checkpoint(run, poison=False) -> Path:
    """Writes the checkpoint of an untrained agent, on request with a weight too large to learn with."""
    tensors = trainer_lib.make_agent(run.config).save()
    if poison:
        tensors["network/value.bias"][0] = 3e38  # Finite, but not its square.
    facts = {"task": run.config.task_name, "episodes": 0, "seconds": 0.0, "versions": provenance.versions()}
    return run.checkpointer.save(tensors, facts)


def copy_of(run, path):
    """Returns the same run in another folder."""
    shutil.copytree(run.path, path)
    return run_lib.Run(path)


def set_frames(run, frames):
    """Changes the frames that a run is trained for."""
    path = run.path / "config.json"
    facts = json.loads(path.read_text())
    facts["train"]["agent"]["frames"] = frames
    path.write_text(json.dumps(facts))


def resumed(run):
    """The arguments of `physexp` that resume a run."""
    return ["train", "which_is_heavier", "features", "--run-dir", run.path, "--resume"]


def trainer(run, **kwargs):
    """`physexp train --resume` on a run, in a process group of its own that is gone after `with`."""
    return commands.start(*resumed(run), **kwargs)


def group(leader):
    """The living processes of a group; one lives, and holds its locks, until its last thread has ended."""
    found = []
    for process in psutil.process_iter():
        with contextlib.suppress(ProcessLookupError, psutil.NoSuchProcess):
            if os.getpgid(process.pid) != leader:
                continue
            if process.status() != psutil.STATUS_ZOMBIE or process.num_threads() > 1:
                found.append(process)
    return found


def _ignores(process, number):
    """Whether a process ignores a signal; False once it has ended."""
    try:
        status = Path(f"/proc/{process.pid}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False
    (line,) = (line for line in status.splitlines() if line.startswith("SigIgn"))
    return bool(int(line.split()[1], 16) >> (number - 1) & 1)


def workers(process):
    """The worker processes of a trainer: unlike programs that it is about to run, they ignore SIGTERM."""
    return [member for member in group(process.pid) if member.pid != process.pid and _ignores(member, signal.SIGTERM)]


def wait_for_checkpoint(process, run, beyond=-1):
    """Waits until a trainer has written a checkpoint of more than some frames."""

    def is_there():
        assert process.poll() is None, process.communicate()[1]
        paths = run.checkpointer.paths()
        return bool(paths) and int(paths[-1].stem) > beyond

    wait_until(is_there, "a checkpoint")
