"""Reads and writes files safely: replaces them as a whole, follows no link, and refuses pipes and devices."""

from collections.abc import Iterator
import contextlib
import errno
import fcntl
import json
import os
from pathlib import Path
import re
import secrets
import stat
from typing import IO, Any

_MOST_JSON = 1_000_000  # Bytes; an agent's card has two thousand.
_LONGEST = 50  # Letters of a file's name in that of its temporary file, which may have 255 bytes.
_LITTER = re.compile(r"\..+\.[0-9a-f]{16}\.tmp")  # The names of `_temporary`.


def write_atomically(path: Path, content: bytes) -> None:
    """Replaces a file: after a crash or on a full disk there is the old file or the new one, never a part.

    A link at `path` is replaced as well; what it points to stays as it is. Temporary files in the same folder whose
    writers were killed are removed.

    Raises:
      OSError: if the content cannot be written; the old file is untouched.
    """
    path = Path(path)
    folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
    try:
        _clean(folder)
        name, temporary = _temporary(folder, path.name)
        try:
            with os.fdopen(temporary, "wb") as file:
                file.write(content)
                file.flush()
                os.fsync(temporary)
                os.replace(name, path.name, src_dir_fd=folder, dst_dir_fd=folder)  # While it is locked still.
        except OSError as error:
            if error.filename is None or error.filename == name:  # Of the file that is meant.
                raise type(error)(error.errno, error.strerror, str(path)) from None
            raise
        finally:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(name, dir_fd=folder)
        _sync(folder)
    finally:
        os.close(folder)


def reason(error: Exception) -> str:
    """Returns what an error about a file's content says, for a message: one line of ASCII, cut short."""
    return ascii(" ".join(str(error).split()))[1:-1][:200]


def remove_litter(folder: Path) -> None:
    """Removes the temporary files in a folder whose writers were killed."""
    opened = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        _clean(opened)
    finally:
        os.close(opened)


def open_plain(path: Path, mode: str = "rb", **options: Any) -> IO[Any]:
    """Opens a regular file, as `open` does; never follows a link and never waits for a writer at the other end.

    Raises:
      OSError: as `open`.
      ValueError: if there is a link, a pipe, a device, a socket or a folder.
    """

    def opener(name: str, flags: int) -> int:
        with contextlib.suppress(FileNotFoundError):
            _check_plain(path, os.lstat(name))  # First, since opening alone moves some devices.
        try:
            opened = os.open(name, flags | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY, 0o666)
        except OSError as error:
            if error.errno == errno.ELOOP:
                raise ValueError(_refusal(path, "a symbolic link")) from None
            raise
        try:
            _check_plain(path, os.fstat(opened))
        except ValueError:
            os.close(opened)
            raise
        return opened

    return open(path, mode, opener=opener, **options)


def read_plain(path: Path, most: int) -> bytes:
    """Returns the content of a regular file of at most `most` bytes.

    Raises:
      OSError, ValueError: as `open_plain`; ValueError also if the file is larger.
    """
    with open_plain(path, "rb") as file:
        size = os.fstat(file.fileno()).st_size
        content = file.read(min(size, most) + 1)  # No more: so much memory is set aside before anything is read.
    if len(content) > most:
        raise ValueError(
            f"{path} is larger than {most / 1e6:g} MB, which no file of its kind is; put another in its place"
        )
    return content


def read_json(path: Path) -> Any:
    """Returns what a JSON file of ours holds.

    Raises:
      OSError: if it cannot be read.
      ValueError: if it is no JSON, has numbers that are not finite, or is larger than any of ours.
    """
    content = read_plain(path, _MOST_JSON)
    try:
        return json.loads(content, parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is no JSON: {' '.join(str(error).split())}; put back what was written") from None


def _refuse_constant(name: str) -> float:
    raise ValueError(f"{name} is no number")


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Returns a context that one process at a time is in; the others wait."""
    opened = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        with contextlib.suppress(OSError):  # Of a file system without locks.
            fcntl.flock(opened, fcntl.LOCK_EX)
        yield
    finally:
        os.close(opened)


def refuse_link(folder: Path) -> None:
    """Raises ValueError if a folder is a symbolic link: what is in it would be written and removed somewhere else."""
    if Path(folder).is_symlink():
        raise ValueError(f"{folder} is a symbolic link; put the folder itself in its place")


_KINDS = {
    stat.S_IFLNK: "a symbolic link",
    stat.S_IFIFO: "a pipe",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFDIR: "a folder",
    stat.S_IFSOCK: "a socket",
}


def _check_plain(path: Path, status: os.stat_result) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise ValueError(_refusal(path, _KINDS.get(stat.S_IFMT(status.st_mode), "something else")))


def _refusal(path: Path, kind: str) -> str:
    return f"{path} is {kind}; put a regular file in its place"


def _temporary(folder: int, name: str) -> tuple[str, int]:
    """Returns the name and descriptor of a new file beside `name`, which is locked as long as its writer lives."""
    while True:
        temporary = f".{name[:_LONGEST]}.{secrets.token_hex(8)}.tmp"
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW
        opened = os.open(temporary, flags, 0o666, dir_fd=folder)
        if _lock(opened) and os.fstat(opened).st_nlink:
            return temporary, opened
        os.close(opened)  # Between the two, another writer has taken it for litter.


def _lock(file: int) -> bool:
    """Locks an open file; returns False if another process has."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # Of a file system without locks, where nothing is taken for litter either.
        pass
    return True


def _clean(folder: int) -> None:
    """Removes the temporary files of writers that were killed."""
    for name in os.listdir(folder):
        if _LITTER.fullmatch(name):
            with contextlib.suppress(OSError):  # Another has removed it, or may and we may not.
                _remove_if_abandoned(folder, name)


def _remove_if_abandoned(folder: int, name: str) -> None:
    opened = os.open(name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK, dir_fd=folder)
    try:
        fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)  # Raises while its writer lives.
        os.unlink(name, dir_fd=folder)
    finally:
        os.close(opened)


def _sync(folder: int) -> None:
    """Makes a change of names last."""
    try:
        os.fsync(folder)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.ENOTSUP):  # Some network file systems have no such thing.
            raise
