"""A guard that keeps a simulation to one thread at a time: two at once would corrupt it, or crash the process."""

import os
import threading
from typing import NoReturn


class Guard:
    """A context manager for all uses of a simulation by one thread; it may be nested.

    While another thread is inside, it raises RuntimeError instead of waiting. An object with a guard can be neither
    copied nor pickled.
    """

    def __init__(self, name: str, num_threads: int = 1):
        """Names the simulation for messages; in a fork, which has no threads of its parent's, several are refused."""
        self._name = name
        self._process = os.getpid() if num_threads > 1 else None
        self._lock = threading.RLock()

    def __enter__(self) -> None:
        if self._process not in (None, os.getpid()):
            raise RuntimeError(
                f"this {self._name} was loaded in process {self._process}, and this is a fork; load another"
            )
        if not self._lock.acquire(blocking=False):
            raise RuntimeError(
                f"another thread is using this {self._name}; "
                "load one for each thread, or let load_batch(..., num_threads=) step many"
            )

    def __exit__(self, *error: object) -> None:
        self._lock.release()

    def __reduce__(self) -> NoReturn:
        raise TypeError(
            f"an open {self._name} can be neither copied nor pickled; "
            "load another with the same random, and start the same episode in it"
        )
