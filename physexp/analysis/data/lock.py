"""Locks a folder, so that one process at a time writes into it."""

from collections.abc import Callable, Iterator
import contextlib
import os
from pathlib import Path

import filelock

_ATTEMPTS = 100  # Each but the first because another process has just ended, and removed the folder that it had made.


@contextlib.contextmanager
def locked(folder: Path, busy: str) -> Iterator[Callable[[], bool]]:
    """Returns a context in which no other process holds the lock of a folder; the operating system ends it at a kill.

    The folder is made if need be, and removed again if it is empty in the end. The context gives a function that
    returns whether the lock file is still in its place: somebody may remove it, or move the folder.

    Raises:
      OSError: if the folder cannot be made or written to.
      ValueError: if another process holds the lock (`busy` is the message), or the folder is a file or lies below one.
    """
    path = folder / ".lock"
    made = [parent for parent in (folder, *folder.parents) if not parent.exists()]
    lock = filelock.FileLock(path, blocking=False)
    try:
        _acquire(lock, folder, busy)
        taken = path.stat()

        def is_in_place() -> bool:
            return path.exists() and os.path.samestat(taken, path.stat())

        try:
            yield is_in_place
        finally:
            if is_in_place():  # Removed before it is released: a process that has opened it meanwhile tries again.
                with contextlib.suppress(OSError):  # The folder may be read-only by now.
                    path.unlink()
            lock.release()
    finally:
        for parent in made:
            with contextlib.suppress(OSError):  # It is not empty.
                parent.rmdir()


def _acquire(lock: filelock.BaseFileLock, folder: Path, busy: str) -> None:
    for _ in range(_ATTEMPTS):
        try:
            folder.mkdir(parents=True, exist_ok=True)
            lock.acquire()
            return
        except filelock.Timeout:
            raise ValueError(busy) from None
        except (FileExistsError, NotADirectoryError):
            raise ValueError(f"{folder} is a file or lies below one; choose another folder") from None
        except FileNotFoundError:
            continue
    raise FileNotFoundError(f"{folder} cannot be made; choose another folder")
