"""Jobs of a sweep in processes of this machine: one that is killed fails, and the others go on."""

from collections.abc import Mapping
from concurrent import futures
from concurrent.futures import process
import contextlib
from multiprocessing import context
import signal
from typing import Any

from physexp.agents import processes
from physexp.analysis.experiments import base, sweep


class Processes:
    """Does jobs, each in a process of its own; a context that leaves no process behind."""

    def __init__(self, num_processes: int):
        """Prepares to do so many jobs at a time."""
        self._threads = futures.ThreadPoolExecutor(num_processes)
        self._context = _Context()
        self._is_stopping = False

    def __enter__(self) -> "Processes":
        return self

    def __exit__(self, *_: object) -> None:
        self._is_stopping = True
        for child in self._context.living():  # There are none after a sweep that ends in order.
            child.kill()
        self._threads.shutdown(cancel_futures=True)

    def submit(self, job: sweep.Job, results: base.Results) -> futures.Future[Mapping[str, bytes]]:
        """Does a job as soon as a process is free."""
        return self._threads.submit(self._work, job, results)

    def stop(self) -> None:
        """Asks all jobs to write a checkpoint and to end; may be called by a signal's handler."""
        self._is_stopping = True
        for child in self._context.living():
            if child not in self._context.asked:  # A second request would end it at once.
                self._context.asked.append(child)
                child.terminate()

    def _work(self, job: sweep.Job, results: base.Results) -> Mapping[str, bytes]:
        if self._is_stopping:
            raise futures.CancelledError
        with futures.ProcessPoolExecutor(1, mp_context=self._context, initializer=_begin) as executor:
            with processes.stop_signals_blocked():
                future = executor.submit(sweep.work, job, results)
            try:
                return future.result()
            except process.BrokenProcessPool:
                raise RuntimeError("its process was killed; run the sweep again to go on from its checkpoint") from None


class _Context(context.SpawnContext):
    """Spawns processes and remembers them, since the caller may have other children."""

    def __init__(self) -> None:
        self.children: list[context.SpawnProcess] = []
        self.asked: list[context.SpawnProcess] = []

    def Process(self, *args: Any, **kwargs: Any) -> context.SpawnProcess:  # type: ignore[override]
        """Returns a new process, as `multiprocessing` asks for it."""
        self.children.append(context.SpawnProcess(*args, **kwargs))
        return self.children[-1]

    def living(self) -> list[context.SpawnProcess]:
        """Returns the processes that have been started and have not ended."""
        return [child for child in self.children if child.pid is not None and child.is_alive()]


def _begin() -> None:
    """Lets a process hear SIGTERM alone, by which its parent asks it to end, and end when its parent dies."""
    processes.begin()
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, processes.STOP_SIGNALS)


def opened(num_processes: int | None, cluster: str | None) -> contextlib.AbstractContextManager[sweep.Pool]:
    """Returns a context with a pool: of processes of this machine, or of a cluster where its address is given.

    Raises:
      ValueError: if the cluster cannot be joined.
    """
    if cluster is None:
        return Processes(num_processes or processes.num_cores())
    from physexp.analysis.experiments import cluster as cluster_lib  # Imports Ray.

    return cluster_lib.Cluster(cluster)
