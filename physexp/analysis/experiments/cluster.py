"""Runs of a sweep on a cluster of Ray."""

from collections.abc import Mapping
from concurrent import futures
import logging
import socket
import subprocess
import sys

import ray

from physexp.analysis.experiments import base, sweep

AUTO = "auto"
CONNECT_SECONDS, HEALTH_SECONDS = 5.0, 30.0  # For a head to accept a connection, and to answer as a head of Ray.
_ATTEMPTS = 4  # At a job whose machine or process dies.


class Cluster:
    """Does jobs on the machines of a cluster, one on each core; a context in which this process belongs to it."""

    def __init__(self, address: str):
        """Joins the cluster whose head has an address, `HOST:PORT`; `auto` for the one that runs on this machine.

        Raises:
          ValueError: if there is no such cluster, it does not answer, it demands a token that this process does not
            have, or it has another version of Ray or Python.
        """
        try:
            if address != AUTO:
                _check_head(address)
            ray.init(address, logging_level=logging.ERROR)
        except (OSError, RuntimeError, ValueError, ray.exceptions.RayError) as error:
            ray.shutdown()
            raise ValueError(f"cannot join the cluster {address}: {' '.join(str(error).split())}") from None
        self._work = ray.remote(num_cpus=1, max_retries=_ATTEMPTS - 1)(sweep.work_elsewhere)
        self._futures: list[futures.Future] = []

    def __enter__(self) -> "Cluster":
        return self

    def __exit__(self, *_: object) -> None:
        ray.shutdown()  # Ends the jobs that are not done.

    def submit(self, job: sweep.Job, results: base.Results) -> futures.Future[Mapping[str, bytes]]:
        """Does a job as soon as a core of the cluster is free."""
        self._futures.append(self._work.remote(job).future())
        return self._futures[-1]

    def stop(self) -> None:
        """Cancels the jobs: their files are on other machines."""
        for future in self._futures:
            future.cancel()


def _check_head(address: str) -> None:
    """Raises OSError or ValueError unless a head of Ray answers that lets this process in: Ray tries for minutes."""
    host, _, port = address.rpartition(":")
    if not host or not port.isdecimal():
        raise ValueError(f"give HOST:PORT or {AUTO}")
    with socket.create_connection((host, int(port)), CONNECT_SECONDS):
        pass
    command = [sys.executable, "-m", "ray.scripts.scripts", "health-check", "--skip-version-check"]
    try:
        errors = subprocess.run([*command, "--address", address], timeout=HEALTH_SECONDS, capture_output=True).stderr
    except subprocess.TimeoutExpired as error:
        errors = error.stderr or b""
        if b"InvalidAuthToken" not in errors:
            raise ValueError(f"no head of Ray answers there within {HEALTH_SECONDS:.0f} s") from None
    if b"InvalidAuthToken" in errors:
        raise ValueError("it demands another token: set RAY_AUTH_MODE=token, and copy its ~/.ray/auth_token to here")
