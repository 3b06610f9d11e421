"""A guard that keeps a simulation to one thread at a time: two at once would corrupt it, or crash the process."""

import threading


class Guard:
    """A context manager for every use of a simulation; within one thread it may be nested.

    While another thread is inside, it raises RuntimeError instead of waiting. An object that has a guard can be neither
    pickled nor deeply copied, since its simulation cannot.
    """

    def __init__(self, name: str):
        """Makes a guard; `name` is what it guards, in messages."""
        self._name = name
        self._lock = threading.RLock()

    def __enter__(self):
        if not self._lock.acquire(blocking=False):
            raise RuntimeError(
                f"another thread is using this {self._name}; "
                "load one for each thread, or let load_batch(..., num_threads=) step many"
            )

    def __exit__(self, *error):
        self._lock.release()

    def __reduce__(self):
        raise TypeError(
            f"an open {self._name} can be neither copied nor pickled; "
            "load another with the same random, and start the same episode in it"
        )
