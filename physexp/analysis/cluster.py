"""Clusters of Ray: joining one, and running a sweep's agents on it."""

from collections.abc import Iterator
from concurrent import futures
import contextlib
import logging
import socket

import ray

from physexp.analysis import sweep

AUTO, LOCAL = "auto", "local"
_ATTEMPTS = 4  # Of an agent whose machine or process dies.
_CONNECT_SECONDS = 5.0
# Parameters and gradients travel with the calls, instead of by way of the object store: twice as fast.
_RECOMMENDED = {"max_direct_call_object_size": 2**20}


@contextlib.contextmanager
def joined(address: str) -> Iterator[None]:
    """A context in which this process belongs to a cluster.

    Args:
      address: of the cluster's head, `HOST:PORT`; `local` for a new one of this machine alone; `auto` for the one that
        runs here, or else a local one.

    Raises:
      ValueError: if there is no such cluster, or it has another version of Ray or Python.
    """
    try:
        _join(address)
    except (OSError, RuntimeError, ValueError) as error:
        raise ValueError(f"cannot join the cluster {address}: {' '.join(str(error).split())}") from None
    try:
        yield
    finally:
        ray.shutdown()


def _join(address: str) -> None:
    if address == AUTO:
        try:
            ray.init(AUTO, logging_level=logging.ERROR)
            return
        except ConnectionError:
            address = LOCAL
    if address == LOCAL:
        ray.init(LOCAL, logging_level=logging.ERROR, include_dashboard=False, _system_config=_RECOMMENDED)
        return
    host, _, port = address.rpartition(":")
    if not host or not port.isdecimal():
        raise ValueError(f"give HOST:PORT, {AUTO} or {LOCAL}")
    with socket.create_connection((host, int(port)), _CONNECT_SECONDS):  # Ray itself would try for minutes.
        pass
    ray.init(address, logging_level=logging.ERROR)


def submit(job: sweep.Job) -> futures.Future:
    """Trains an agent on some machine; the future's result are the files that it made, by path."""
    task = ray.remote(num_cpus=1, max_retries=_ATTEMPTS - 1)(sweep.work_elsewhere)
    return task.remote(job).future()
