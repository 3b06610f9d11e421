"""Training: runs an agent on a task, and records it in a run's folder."""

from collections.abc import Callable
import contextlib
import functools
import io
import os
import shutil
import time

import numpy as np

from physexp import suite
from physexp.agents import checkpointing, core, devices, files, learning, registry, starting
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import stopping
from physexp.suite.engine import rendering

ROW_SECONDS = 5.0  # Between rows of metrics.csv.
_WORKERS_PER_CORE = 32  # More would take memory (half a gigabyte each) and no less time.
_CHECKPOINTS_AT_ONCE = 3  # Two are kept, and the next is written before the older one goes.
_REPLAY_SEED = 2_000_003  # Of the episode that replays show, apart from those of training and evaluation.


def make_environment(config: config_lib.TrainConfig, seed: int, num_environments: int, num_threads: int):
    """The environments of a run, with a seed of their own."""
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
            rendering.check()
        if not on_cluster:  # There each worker computes on what its own machine has.
            devices.choose(config.agent.device, needs_gl)
    except RuntimeError as error:
        raise ValueError(str(error)) from None
    if on_cluster and not config.agent.can_run_on_cluster:
        able = [name for name, agent in config_lib.ALGORITHMS.items() if agent.can_run_on_cluster]
        raise ValueError(
            f"agent is {config.agent.algorithm}, which has one process; on a cluster train {' or '.join(able)}"
        )
    cores = os.cpu_count() or 1
    most = _WORKERS_PER_CORE * cores
    if not on_cluster and config.agent.num_workers > most:
        raise ValueError(
            f"num_workers is {config.agent.num_workers}; this machine has {cores} cores: give at most "
            f"{most}, or train on a cluster"
        )


def make_agent(
    config: config_lib.TrainConfig, on_cluster: bool = False, tell: Callable[[str], None] = lambda line: None
) -> core.Agent:
    """The agent of a run, as it is before training.

    Args:
      config: the run's.
      on_cluster: train on the cluster that this process has joined.
      tell: called with a line when a worker has died that can be replaced, or has fallen silent.
    """
    environments = functools.partial(make_environment, config)
    if on_cluster:
        return registry.make_on_cluster(environments, config.agent, tell, run_lib.versions)
    return registry.make(environments, config.agent, tell)


def train(
    run: run_lib.Run,
    report: Callable[[dict], None] = lambda row: None,
    on_cluster: bool = False,
    tell: Callable[[str], None] = lambda line: None,
    start: config_lib.TrainConfig | None = None,
) -> None:
    """Trains an agent, and keeps the run's folder locked meanwhile.

    Ctrl-C, SIGTERM or SIGHUP finishes the update and writes a checkpoint; a second one leaves at once. A start
    that comes to nothing leaves nothing behind.

    Args:
      run: a run that has been created, unless it is started here.
      report: called with each row of metrics.
      on_cluster: train on the cluster that this process has joined.
      tell: called with a line when something has gone wrong that training survives.
      start: what to train from the start; None to go on with the run in the folder, from its last checkpoint if there
        is one.

    Raises:
      stopping.Interrupted: after one of these signals, when the checkpoint has been written.
      OSError: if the folder cannot be made or written to.
      RuntimeError: if training cannot go on; it says where it stands.
      ValueError: if another process is training in the run's folder, if there is too little room in it, if it holds a
        run that would be started anew, or records without a checkpoint that would be resumed, or as `check`.
    """
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
            recorder = _Recorder(run, config, report, tell)
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


def _run(agent: core.Agent, recorder: "_Recorder", run: run_lib.Run, tell: Callable[[str], None]) -> bool:
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
    """What is there to go on from."""
    paths = run.checkpointer.paths()
    if not paths:
        return "there is no checkpoint yet, so start it anew"
    return f"the last checkpoint, after {int(paths[-1].stem):,} frames, is whole, --resume it"


class _Recorder:
    """Writes a run's rows, episodes and checkpoints.

    A checkpoint is written when all updates in it, and none after it, have been recorded: so the records of a run that
    was killed and resumed have no gap, and nothing twice.
    """

    def __init__(
        self,
        run: run_lib.Run,
        config: config_lib.TrainConfig,
        report: Callable[[dict], None],
        tell: Callable[[str], None],
    ):
        self._run, self._config, self._report, self._tell = run, config, report, tell
        self._num_interactions = suite.load_task(config.domain, config.task, config.task_kwargs).num_interactions
        self._start_over()

    def _start_over(self) -> None:
        """Records nothing yet."""
        self._frames = self._updates = self._episodes = 0
        self._seconds = 0.0
        self._started = self._checkpointed = time.monotonic()
        self._row_started = 0.0  # Set by the first update: the workers take a while to start.
        self._frames_at_row = self._replayed = 0
        self._window: list[core.Update] = []
        self._snapshot: dict | None = None
        self._later: list[core.Update] = []
        self._records: list[dict[str, list]] = []

    def resume(self, agent: core.Agent) -> None:
        """Puts the agent and the records back to the last checkpoint that is whole, or to the start.

        Raises:
          ValueError: if none is whole, or it is of another task or does not fit; it names the file.
        """
        self._start_over()

        def accept(tensors, facts):
            self._check_facts(facts)
            agent.restore(tensors)

        most = checkpointing.num_bytes(agent.save().values())
        found = self._run.checkpointer.latest(self._tell, accept, most)
        if found is None:
            self._run.rewind(-1)
            return
        tensors, facts = found
        self._frames, self._updates = int(tensors["frames"]), int(tensors["updates"])
        self._episodes, self._seconds = facts["episodes"], facts["seconds"]
        self._frames_at_row = self._replayed = self._frames
        self._run.rewind(self._frames)

    def _check_facts(self, facts: dict) -> None:
        """Refuses the facts beside a checkpoint that is of another task, or no run's."""
        task, episodes, seconds = (facts.get(name) for name in ("task", "episodes", "seconds"))
        if task != self._config.task_name:
            task = ascii(task)[:80] if not isinstance(task, str) else task[:80]
            raise ValueError(
                f"the checkpoint is of {task}, the run of {self._config.task_name}; put back the run's own"
            )
        if not isinstance(episodes, int) or isinstance(episodes, bool) or not 0 <= episodes < 2**63:
            raise ValueError("the checkpoint's `episodes` is no count; put back the run's own")
        if not isinstance(seconds, (int, float)) or isinstance(seconds, bool) or not 0 <= seconds < 2**63:
            raise ValueError("the checkpoint's `seconds` is no duration; put back the run's own")

    def add(self, update: core.Update) -> None:
        """Records an update, or keeps it until the checkpoint before it has been written."""
        if self._snapshot is not None and update.metrics["updates"] > int(self._snapshot["updates"]):
            self._later.append(update)
            return
        if not self._row_started:
            self._row_started = time.monotonic()
        self._window.append(update)
        self._updates += 1
        self._frames += update.episodes.num_frames
        self._episodes += len(update.episodes.lengths)
        if time.monotonic() - self._row_started > ROW_SECONDS:
            self._write_row()
        self._write_checkpoint_when_complete()

    def checkpoint_is_due(self) -> bool:
        waited = time.monotonic() - self._checkpointed
        return self._snapshot is None and waited > self._config.agent.checkpoint_seconds

    def snapshot(self, tensors: dict) -> None:
        """Writes a checkpoint of these variables, as soon as the updates in it have been recorded, if there are any."""
        if int(tensors["updates"]) == 0:
            return
        self._snapshot = tensors
        self._write_checkpoint_when_complete()

    def save_failure(self, error: core.AgentError) -> str:
        """Saves the episodes that made the loss diverge; returns a phrase that says where."""
        if error.batch is None:
            return ""
        path, content = self._run.path / "failed_batch.npz", io.BytesIO()
        np.savez_compressed(content, **error.batch)
        try:
            files.write_atomically(path, content.getvalue())
        except OSError as obstacle:
            return f" (the batch could not be written to {path}: {obstacle.strerror})"
        return f" (the batch is in {path})"

    def _write_checkpoint_when_complete(self) -> None:
        if self._snapshot is None or self._updates < int(self._snapshot["updates"]):
            return
        tensors, self._snapshot = self._snapshot, None
        if self._window:
            self._write_row()
        self._run.check_lock()
        if self._records:
            columns = {name: sum((record[name] for record in self._records), []) for name in self._records[0]}
            self._run.append_episodes(self._frames, columns)
            self._records = []
        if self._config.replay_every and self._frames - self._replayed >= self._config.replay_every:
            self._write_replay(tensors)
        facts = {
            "task": self._config.task_name,
            "episodes": self._episodes,
            "seconds": self._elapsed(),
            "versions": run_lib.versions(),
        }
        self._run.check_lock()  # Once more: a replay takes seconds.
        self._run.checkpointer.save(tensors, facts)
        self._checkpointed = time.monotonic()
        later, self._later = self._later, []
        for update in later:
            self.add(update)

    def _write_replay(self, tensors: dict) -> None:
        """Lets the agent as it is now play one episode, always the same, and writes it for the viewer."""
        from physexp.analysis.replay import recording, writing  # Takes seconds to import, and most runs do without.

        network = starting.make_network(make_environment(self._config, 0, 1, 1), self._config.agent)
        network.load_state_dict(learning.network_variables(tensors))
        title = f"{self._config.name} after {self._frames:,} steps"
        path = self._run.path / "replays" / f"{self._frames:015d}.rrd"
        writing.write(path, [lambda: [recording.reenact(network, self._config, _REPLAY_SEED, 0, None, title)]])
        self._replayed = self._frames

    def _elapsed(self) -> float:
        return self._seconds + time.monotonic() - self._started

    def _write_row(self) -> None:
        self._run.check_lock()
        now = time.monotonic()
        row = {"frames": self._frames, "updates": self._updates, "episodes": self._episodes, "seconds": self._elapsed()}
        row["frames_per_second"] = (self._frames - self._frames_at_row) / max(1e-3, now - self._row_started)
        row.update(self._summary())
        self._run.append_metrics(row)
        self._records.append(self._columns(self._window[-1]))
        self._report(row)
        self._window, self._row_started, self._frames_at_row = [], now, self._frames

    def _summary(self) -> dict[str, float]:
        """Means over the episodes and the updates of the window."""
        rewards, lengths, interactions = [], [], []
        for update in self._window:
            rewards.append(update.episodes.rewards.sum(axis=0))
            lengths.append(update.episodes.lengths)
            interactions.append(interaction_counts(update.episodes, self._num_interactions))
        reward, length, pokes = (np.concatenate(arrays) for arrays in (rewards, lengths, interactions))
        learner = {
            name: float(np.mean([update.metrics[name] for update in self._window]))
            for name in self._config.agent.metrics
        }
        return {
            "success_rate": float((reward > 0).mean()),
            "episode_return": float((reward * self._config.agent.discount ** (length - 1)).mean()),
            "interactions": float(pokes.mean()),
            "timeouts": float((pokes == length).mean()),
            **learner,
        }

    def _columns(self, update: core.Update) -> dict[str, list]:
        """The episodes of an update as columns of `run.EPISODES`."""
        episodes = update.episodes
        size = len(episodes.lengths)
        environments = [suite.environment_seed(update.seed, i) for i in range(size)]
        return {
            "frames": [self._frames] * size,
            "seed": environments,
            "episode": [update.episode] * size,
            **episode_columns(episodes, self._num_interactions),
        }


def interaction_counts(episodes, num_interactions: int) -> np.ndarray:
    """How many interaction actions each episode of a `Round` has, int64 [B]."""
    played = np.arange(len(episodes.actions))[:, None] < episodes.lengths
    return (played & (episodes.actions < num_interactions)).sum(axis=0)


def episode_columns(episodes, num_interactions: int) -> dict[str, list]:
    """Answers, labels, rewards, lengths and actions of a `Round`, one entry an episode."""
    last = episodes.actions[episodes.lengths - 1, np.arange(len(episodes.lengths))]
    return {
        "answer": episodes.answers.tolist(),
        "label": np.where(last >= num_interactions, last - num_interactions, -1).tolist(),
        "reward": episodes.rewards.sum(axis=0).tolist(),
        "length": episodes.lengths.tolist(),
        "actions": [row[:length].tolist() for row, length in zip(episodes.actions.T, episodes.lengths, strict=True)],
    }
