"""A3C on a cluster of this machine alone against A3C in processes, and where a parameter server would saturate."""

from collections.abc import Iterator
import os
from pathlib import Path
import signal
import statistics
import tempfile
import time

from physexp.agents.a3c import distributed, parameter_server
from physexp.analysis.bench import measuring
from physexp.analysis.experiments import cluster
from physexp.analysis.training import callbacks, playing, trainer
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

_SECONDS = 15.0
_FRAMES, _EPISODES = 4_000_000, 10_000  # To learn what either trainer makes of an agent, and to measure it.
_REPETITIONS = 3
_WORKERS = (1, 2, 4, 8, 16, 32, 64, 128)
_GIGABIT = 1e9 / 8  # Bytes per second.


def figures() -> Iterator[dict]:
    """Measures frames per second with one and two workers, and derives what many would reach."""
    with cluster.joined(cluster.LOCAL):
        ratios, ours, theirs = [], [], []
        for _ in range(_REPETITIONS):  # Side by side: such machines change their speed within minutes.
            ours.append(_measure(2)[0])
            theirs.append(measuring.training_rate(measuring.REFERENCE, _SECONDS))
            ratios.append(ours[-1] / theirs[-1])
        yield measuring.row(
            "2 workers on a cluster / 2 processes: heavier",
            statistics.median(ratios),
            "x",
            0.7,
            cluster=statistics.median(ours),
            processes=statistics.median(theirs),
        )
        rate, traffic, frames = _measure(1)
        yield measuring.row(
            "a killed worker is back, with an update",
            statistics.median(_recovery() for _ in range(3)),
            "s",
            5,
            at_most=True,
        )
        returns = [_final_return(on_cluster) for on_cluster in (True, False)]
        yield measuring.row(
            "final return, 2 workers on a cluster / 2 processes: heavier",
            returns[0] / returns[1],
            "x",
            0.98,
            cluster=returns[0],
            processes=returns[1],
        )
    seconds = traffic.busy_seconds / traffic.updates
    moved = (traffic.bytes_in + traffic.bytes_out) / traffic.updates
    yield measuring.row(
        "parameter server, time for an update",
        1e3 * seconds,
        "ms",
        5,
        at_most=True,
        kilobytes=moved / 1e3,
        frames_per_update=frames,
        frames_per_second_of_a_worker=rate,
    )
    for workers in _WORKERS:
        limits = {"workers": workers * rate, "server": frames / seconds, "gigabit network": frames * _GIGABIT / moved}
        bound = min(limits, key=limits.__getitem__)
        yield measuring.row(f"{workers} workers, derived: bound by the {bound}", limits[bound], "f/s", 0)


def _measure(num_workers: int) -> tuple[float, parameter_server.Traffic, float]:
    """Returns frames per second once all workers are under way; the traffic; and frames in an update."""
    agent = _agent(num_workers)
    heard: set[int] = set()
    start, first, last = 0.0, None, None
    for update in agent.updates(poll_seconds=0.1):
        if update is not None:
            heard.add(update.seed)
            last = update
        if first is None and len(heard) == num_workers:
            start, first = time.perf_counter(), last
        if first is not None and time.perf_counter() - start > _SECONDS:
            traffic = agent.traffic()
            agent.stop()
            break
    assert first is not None and last is not None
    frames = last.metrics["frames"] - first.metrics["frames"]
    return frames / _SECONDS, traffic, frames / (last.metrics["updates"] - first.metrics["updates"])


def _final_return(on_cluster: bool) -> float:
    """Returns mean discounted return of an agent that two workers have trained."""
    domain, task = measuring.REFERENCE
    agent = config_lib.preset(domain, task, algorithm="a3c").replace(num_workers=2, frames=_FRAMES)
    with tempfile.TemporaryDirectory() as folder:
        run = run_lib.Run(Path(folder) / "run")
        run.create(config_lib.TrainConfig(domain=domain, task=task, agent=agent))
        trainer.train(run, on_cluster=on_cluster)
        return playing.evaluate(run, _EPISODES).summary(agent.discount)["mean_return"]


def _recovery() -> float:
    """Returns seconds from the death of the only worker to the first update of the one that takes its place."""
    told: list[str] = []
    updates = _agent(1, told.append).updates(poll_seconds=0.1)
    next(update for update in updates if update is not None)
    (worker,) = _processes("ray::Worker")
    killed = time.perf_counter()
    os.kill(worker, signal.SIGKILL)
    next(update for update in updates if update is None and told)  # All that the dead one had sent has come.
    next(update for update in updates if update is not None)
    seconds = time.perf_counter() - killed
    updates.close()
    return seconds


def _agent(num_workers: int, tell: callbacks.Tell = callbacks.ignore) -> distributed.DistributedA3C:
    domain, task = measuring.REFERENCE
    preset = config_lib.preset(domain, task, algorithm="a3c").replace(num_workers=num_workers, frames=10**12)
    config = config_lib.TrainConfig(domain=domain, task=task, agent=preset)
    agent = trainer.make_agent(config, on_cluster=True, tell=tell)
    assert isinstance(agent, distributed.DistributedA3C)
    return agent


def _processes(title: str) -> list[int]:
    """Returns the processes of this machine whose command line starts with a title."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            command = (entry / "cmdline").read_bytes()
        except OSError:  # It has just ended.
            continue
        if command.startswith(title.encode()):
            found.append(int(entry.name))
    return found
