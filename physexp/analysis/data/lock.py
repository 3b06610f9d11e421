"""Locks a folder: one process at a time writes into it, and no lock file is left when none does."""

from collections.abc import Callable, Iterator
import contextlib
import os
from pathlib import Path

import filelock

_ATTEMPTS = 100  # Each but the first because an owner has just ended, and removed the folder that it had made.


@contextlib.contextmanager
def locked(folder: Path, busy: str) -> Iterator[Callable[[], bool]]:
    """Returns a context in which no other process holds the lock of a folder; the operating system ends it at a kill.

    The folder is made if need be. A folder that was made, and is empty in the end, is removed again.

    Args:
      folder: the folder.
      busy: the error's message when another process holds the lock: one line.

    Yields:
      A function that returns whether the lock file is still in its place: somebody may remove it, or move the folder.

    Raises:
      OSError: if the folder cannot be made or written to, or the lock file is a link.
      ValueError: if another process holds the lock, or the folder is a file or lies below one.
    """
    path = folder / ".lock"
    missing = [folder for folder in (folder, *folder.parents) if not folder.exists()]
    lock = filelock.FileLock(path, blocking=False)
    try:
        _take(lock, path, busy)
        taken = os.lstat(path)

        def is_in_place() -> bool:
            return os.path.lexists(path) and os.path.samestat(taken, os.lstat(path))

        try:
            yield is_in_place
        finally:
            if is_in_place():  # Removed before it is released: a process that has opened it meanwhile tries again.
                with contextlib.suppress(OSError):  # The folder may be read-only by now.
                    path.unlink()
            lock.release()
    finally:
        for made in missing:
            with contextlib.suppress(OSError):  # It holds something.
                made.rmdir()


def _take(lock: filelock.BaseFileLock, path: Path, busy: str) -> None:
    for _ in range(_ATTEMPTS):
        try:
            lock.acquire()  # Makes the folder.
            return
        except filelock.Timeout:
            raise ValueError(busy) from None
        except (FileExistsError, FileNotFoundError, NotADirectoryError):
            if any(os.path.lexists(one) and not one.is_dir() for one in path.parents):
                raise ValueError(f"{path.parent} is a file or lies below one; choose another folder") from None
            # Otherwise the lock's last owner has removed the folder meanwhile.
    raise FileNotFoundError(f"{path.parent} cannot be made; choose another folder")
