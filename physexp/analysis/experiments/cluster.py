"""Clusters of Ray: joining one, and running a sweep's agents on it."""

from collections.abc import Iterator
from concurrent import futures
import contextlib
import logging
import os
import socket
import subprocess
import sys
import tempfile

import ray
from ray._private import ray_constants

from physexp.agents import processes
from physexp.analysis.experiments import sweep

AUTO, LOCAL = "auto", "local"
CONNECT_SECONDS, HEALTH_SECONDS = 5.0, 30.0  # For a head to accept a connection, and to answer as one of Ray's.
_ATTEMPTS = 4  # Of an agent whose machine or process dies.
# Parameters and gradients travel with the calls, instead of by way of the object store: twice as fast.
_RECOMMENDED = {"max_direct_call_object_size": 2**20}
_LOOPBACK_VARIABLE = "RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER"  # What Ray calls it; 0 keeps any system on the loopback.


@contextlib.contextmanager
def joined(address: str) -> Iterator[None]:
    """Returns a context in which this process belongs to a cluster.

    A cluster that is started here listens on the loopback only, has no dashboard, demands Ray's token, and keeps its
    files in a folder of this user's.

    Args:
      address: of the cluster's head, `HOST:PORT`; `local` for a new one of this machine alone; `auto` for the one that
        runs here, or else a local one.

    Raises:
      ValueError: if there is no such cluster, it does not answer, it demands a token that this process does not have,
        or it has another version of Ray or Python.
    """
    with contextlib.ExitStack() as stack:
        try:
            _join(address, stack)
        except (OSError, RuntimeError, ValueError, ray.exceptions.RayError) as error:
            raise ValueError(f"cannot join the cluster {address}: {' '.join(str(error).split())}") from None
        yield


def _join(address: str, stack: contextlib.ExitStack) -> None:
    stack.callback(ray.shutdown)
    if address == AUTO:
        try:
            ray.init(AUTO, logging_level=logging.ERROR)
            return
        except ConnectionError:
            address = LOCAL
    if address == LOCAL:
        # Ray opens its folder to all users: it lies in a private one, which is removed after the cluster has ended.
        private = tempfile.TemporaryDirectory(prefix="ray-", ignore_cleanup_errors=True)
        folder = stack.enter_context(private)
        stack.callback(ray.shutdown)
        stack.enter_context(_on_the_loopback())
        mask = os.umask(0o077)  # The token is for this user.
        try:
            with processes.stop_signals_blocked():
                ray.init(
                    LOCAL,
                    logging_level=logging.ERROR,
                    include_dashboard=False,
                    _system_config=_RECOMMENDED,
                    _temp_dir=os.path.join(folder, "r"),
                )
        finally:
            os.umask(mask)
        return
    host, _, port = address.rpartition(":")
    if not host or not port.isdecimal():
        raise ValueError(f"give HOST:PORT, {AUTO} or {LOCAL}")
    with socket.create_connection((host, int(port)), CONNECT_SECONDS):
        pass
    _check_health(address)  # Ray itself would try for many minutes.
    ray.init(address, logging_level=logging.ERROR)


def _check_health(address: str) -> None:
    """Raises ValueError where there is no head, or one that does not let this process in."""
    command = [sys.executable, "-m", "ray.scripts.scripts", "health-check", "--skip-version-check"]
    try:
        said = subprocess.run(
            [*command, "--address", address], timeout=HEALTH_SECONDS, capture_output=True, check=False
        ).stderr
    except subprocess.TimeoutExpired as error:
        said = error.stderr or b""
        if b"InvalidAuthToken" not in said:
            raise ValueError(f"no head of Ray answers there within {HEALTH_SECONDS:.0f} s") from None
    if b"InvalidAuthToken" in said:
        raise ValueError("it demands another token: set RAY_AUTH_MODE=token, and copy its ~/.ray/auth_token to here")


@contextlib.contextmanager
def _on_the_loopback() -> Iterator[None]:
    """Returns a context in which Ray starts clusters that only this machine can reach.

    By default its servers listen on all addresses, whatever address they are given.
    """
    variable, enabled = os.environ.get(_LOOPBACK_VARIABLE), ray_constants.ENABLE_RAY_CLUSTER
    os.environ[_LOOPBACK_VARIABLE], ray_constants.ENABLE_RAY_CLUSTER = "0", False
    try:
        yield
    finally:
        ray_constants.ENABLE_RAY_CLUSTER = enabled
        del os.environ[_LOOPBACK_VARIABLE]
        if variable is not None:
            os.environ[_LOOPBACK_VARIABLE] = variable


def submit(job: sweep.Job) -> futures.Future:
    """Trains an agent on some machine; the future's result are the files that it made, by path."""
    task = ray.remote(num_cpus=1, max_retries=_ATTEMPTS - 1)(sweep.work_elsewhere)
    return task.remote(job).future()
