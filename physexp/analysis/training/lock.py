"""The lock of a folder: one trainer at a time, and a folder without a lock file when none is at work."""

from collections.abc import Iterator
import contextlib
import fcntl
import os
from pathlib import Path
from typing import IO, Any

from physexp.agents import files

_ATTEMPTS = 100  # Each but the first because an owner has just ended, and removed the file.


class FolderLock:
    """A lock of one process at a time; the operating system releases it when that process ends, however it does."""

    def __init__(self, folder: Path):
        self._folder, self._path = folder, folder / ".lock"
        self._file: IO[Any] | None = None

    @contextlib.contextmanager
    def held(self) -> Iterator[None]:
        """Returns a context in which nobody else holds the lock; the folder is made if need be. It may be nested.

        A folder that was made, and has nothing in it in the end, is removed again.

        Raises:
          OSError: if the folder cannot be made or written to.
          ValueError: if another process holds the lock, or the folder is a file or lies below one.
        """
        if self._file is not None:
            yield
            return
        missing = [folder for folder in (self._folder, *self._folder.parents) if not folder.exists()]
        try:
            self._file = self._take()
            yield
        finally:
            self._give_back()
            for folder in missing:
                with contextlib.suppress(OSError):  # There is something in it.
                    folder.rmdir()

    @property
    def is_held(self) -> bool:
        """Whether this process holds the lock, and its file is still where it was."""
        return self._file is not None and self._is_in_place(self._file)

    def _take(self) -> IO[Any]:
        for _ in range(_ATTEMPTS):
            try:
                self._folder.mkdir(parents=True, exist_ok=True)
                file = files.open_plain(self._path, "a")
            except (FileExistsError, NotADirectoryError, FileNotFoundError):
                if any(os.path.lexists(path) and not path.is_dir() for path in (self._folder, *self._folder.parents)):
                    raise ValueError(f"{self._folder} is a file or lies below one; choose another folder") from None
                continue  # Its last owner has removed it meanwhile.
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                file.close()
                raise ValueError(
                    f"another process is training in {self._folder}; wait for it or choose another"
                ) from None
            except OSError as error:  # A file system without locks.
                file.close()
                raise OSError(error.errno, error.strerror, str(self._path)) from None
            if self._is_in_place(file):
                return file
            file.close()
        raise FileNotFoundError(f"{self._folder} cannot be made; choose another folder")

    def _give_back(self) -> None:
        if self._file is None:
            return
        if self.is_held:  # Removed first: who opens it from now on waits for nobody, and finds it out of place.
            with contextlib.suppress(OSError):  # The folder may be read-only by now; the lock ends all the same.
                self._path.unlink()
        self._file.close()
        self._file = None

    def _is_in_place(self, file: IO[Any]) -> bool:
        try:
            return os.path.samestat(os.fstat(file.fileno()), os.lstat(self._path))
        except OSError:
            return False
