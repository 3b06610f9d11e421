"""Jobs of a sweep in processes of this machine: one that is killed fails, and the others go on."""

from collections.abc import Mapping
from concurrent import futures
import contextlib
from multiprocessing import connection, process
import signal

from physexp.agents import processes
from physexp.analysis.experiments import base, sweep


class Processes:
    """Does jobs, each in a process of its own; a context that leaves no process behind."""

    def __init__(self, num_processes: int):
        """Prepares to do so many jobs at a time."""
        self._threads = futures.ThreadPoolExecutor(num_processes)
        self._children: list[process.BaseProcess] = []
        self._asked: list[process.BaseProcess] = []
        self._is_stopping = False

    def __enter__(self) -> "Processes":
        return self

    def __exit__(self, *_: object) -> None:
        self._is_stopping = True
        for child in self._children:
            if child.is_alive():  # None is after a sweep that ends in order.
                child.kill()
        self._threads.shutdown(cancel_futures=True)

    def submit(self, job: sweep.Job, results: base.Results) -> futures.Future[Mapping[str, bytes]]:
        """Does a job as soon as a process is free."""
        return self._threads.submit(self._work, job, results)

    def stop(self) -> None:
        """Asks all jobs to write a checkpoint and to end; may be called by a signal's handler."""
        self._is_stopping = True
        for child in self._children:
            if child.is_alive() and child not in self._asked:  # A second request would end it at once.
                self._asked.append(child)
                child.terminate()

    def _work(self, job: sweep.Job, results: base.Results) -> Mapping[str, bytes]:
        if self._is_stopping:
            raise futures.CancelledError
        context = processes.spawning()
        outcome, sender = context.Pipe(duplex=False)
        child = context.Process(target=_work, args=(job, results, sender))
        with processes.stop_signals_blocked():
            child.start()
        self._children.append(child)
        sender.close()
        try:
            error = outcome.recv()
        except EOFError:
            raise RuntimeError("its process was killed; run the sweep again to go on from its checkpoint") from None
        finally:
            child.join()
        if error is not None:
            raise error
        return {}


def _work(job: sweep.Job, results: base.Results, outcome: connection.Connection) -> None:
    """Does a job in a process that hears SIGTERM alone, by which its parent asks it to end; sends the error or None."""
    processes.begin(ignored=set(processes.STOP_SIGNALS) - {signal.SIGTERM})  # It may have come already.
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, processes.STOP_SIGNALS)
    try:
        sweep.work(job, results)
        outcome.send(None)
    except BaseException as error:
        outcome.send(error)


def opened(num_processes: int | None, cluster: str | None) -> contextlib.AbstractContextManager[sweep.Pool]:
    """Returns a context with a pool: of processes of this machine, or of a cluster where its address is given.

    Raises:
      ValueError: if the cluster cannot be joined.
    """
    if cluster is None:
        return Processes(num_processes or processes.num_cores())
    from physexp.analysis.experiments import cluster as cluster_lib  # Imports Ray.

    return cluster_lib.Cluster(cluster)
