"""Tools of the attacks: children that are killed at a chosen call, byte or moment, or confined, and what came of them.

To add an attack: write a function at the top level of a module, hand it to `run` with a way to die or a confinement,
and look at the folder that it leaves.
"""

import collections
import ctypes
import dataclasses
import itertools
import json
import os
from pathlib import Path
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import commands
import numpy as np

_FILE_CALLS = {
    "open",
    "write",
    "flush",
    "fsync",
    "replace",
    "rename",
    "link",
    "unlink",
    "remove",
    "mkdir",
    "rmdir",
    "close",
    "truncate",
    "flock",
    "scandir",
}
"""Names of C functions that touch files, before and after each of which a child may die."""


def repetitions(default: int, share: float = 1.0) -> int:
    """How often to attack: `default`, or the share of PHYSEXP_ATTACKS where that is set."""
    asked = os.environ.get("PHYSEXP_ATTACKS")
    return default if asked is None else max(1, round(share * int(asked)))


def generator() -> random.Random:
    """Random numbers; PHYSEXP_ATTACKS_SEED has those of an earlier attack again."""
    seed = int(os.environ.get("PHYSEXP_ATTACKS_SEED") or np.random.SeedSequence().entropy % 2**32)
    print("\nPHYSEXP_ATTACKS_SEED", seed)
    return random.Random(seed)


class Tally(collections.Counter):
    """Counts what came of attacks, and prints it at the end."""

    def __init__(self, what: str):
        super().__init__()
        self._what = what

    def __enter__(self):
        return self

    def __exit__(self, *_):
        counts = "; ".join(f"{name}: {count}" for name, count in sorted(self.items()))
        print(f"{self._what}: {sum(self.values())} attacks; {counts}")


# Ways to die. They are called in the child before the function.


@dataclasses.dataclass(frozen=True)
class AtCall:
    """Dies by SIGKILL at the n-th time that a function which touches files is entered or left."""

    number: int

    def __call__(self):
        _profile(self._count(itertools.count()))

    def _count(self, counter):
        def count():
            if next(counter) == self.number:
                os.kill(os.getpid(), signal.SIGKILL)

        return count


@dataclasses.dataclass(frozen=True)
class AtByte:
    """The kernel kills the process when a file would grow beyond so many bytes: those before are written."""

    number: int

    def __call__(self):
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (self.number, self.number))
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)


@dataclasses.dataclass(frozen=True)
class AtMoment:
    """The kernel kills the process after so many seconds."""

    seconds: float

    def __call__(self):
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_REAL, self.seconds)


@dataclasses.dataclass(frozen=True)
class Extent:
    """How much of each there is in an undisturbed run of a function: the range that deaths are drawn from."""

    calls: int
    bytes: int
    seconds: float

    def draw(self, generator: random.Random):
        """Any of the ways to die, anywhere in the run."""
        way = generator.choice([AtCall, AtCall, AtByte, AtMoment])
        if way is AtCall:
            return AtCall(generator.randrange(self.calls))
        if way is AtByte:
            return AtByte(generator.randrange(self.bytes))
        return AtMoment(max(1e-6, generator.uniform(0, self.seconds)))


def measure(function, folder: Path, *args) -> Extent:
    """Runs `function(folder, *args)` undisturbed in a child."""
    with tempfile.TemporaryDirectory() as there:
        end = run(_measured, function, Path(there) / "extent", folder, *args)
        assert end.code == 0, end.said
        calls, seconds = json.loads((Path(there) / "extent").read_text())
    largest = max(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    return Extent(calls, largest, seconds)


def _measured(function, path, *args):
    counter = itertools.count()
    _profile(lambda: next(counter))
    started = time.monotonic()
    function(*args)
    sys.setprofile(None)
    path.write_text(json.dumps([next(counter), time.monotonic() - started]))


def _profile(count) -> None:
    """Calls `count` before and after each call of a function of `_FILE_CALLS`."""

    def profile(frame, event, called):
        if event in ("c_call", "c_return") and called.__name__ in _FILE_CALLS:
            count()

    sys.setprofile(profile)


# Confinements. They are called in the child before the function.


@dataclasses.dataclass(frozen=True)
class FullAtByte:
    """The disk takes no file of more than so many bytes (EFBIG)."""

    number: int

    def __call__(self):
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (self.number, self.number))


@dataclasses.dataclass(frozen=True)
class Memory:
    """The process may have so many bytes more than it has."""

    number: int

    def __call__(self):
        limit = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize() + self.number
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


@dataclasses.dataclass(frozen=True)
class SmallDisk:
    """The disk below a folder has room for what is there and so many bytes more (ENOSPC)."""

    folder: Path
    room: int

    def __call__(self):
        """Puts a file system of this process's own in the folder's place; what is in it is copied back at the end."""
        saved = Path(tempfile.mkdtemp()) / "saved"
        shutil.copytree(self.folder, saved)
        in_own_mounts()
        pages = sum(-(-path.stat().st_size // 4096) for path in saved.rglob("*") if path.is_file())
        mount("tmpfs", self.folder, f"size={4096 * max(1, pages) + self.room}")
        shutil.copytree(saved, self.folder, dirs_exist_ok=True)
        child = os.fork()
        if not child:
            return
        _, status = os.waitpid(child, 0)
        shutil.rmtree(saved)
        shutil.copytree(self.folder, saved)
        unmount(self.folder)
        shutil.rmtree(self.folder)
        shutil.copytree(saved, self.folder)
        shutil.rmtree(saved.parent)
        os._exit(os.waitstatus_to_exitcode(status))


def in_own_mounts() -> None:
    """Gives this process mounts of its own, that end with it.

    Raises:
      OSError: where this user may not.
    """
    new_mounts, new_user, recursive_and_private = 0x20000, 0x10000000, 0x4000 | 0x40000
    libc = ctypes.CDLL(None, use_errno=True)
    user, group = os.getuid(), os.getgid()
    if libc.unshare(new_mounts if user == 0 else new_mounts | new_user):
        raise OSError(ctypes.get_errno(), "cannot have mounts of one's own")
    if user:
        Path("/proc/self/setgroups").write_text("deny")
        Path("/proc/self/uid_map").write_text(f"0 {user} 1")
        Path("/proc/self/gid_map").write_text(f"0 {group} 1")
    if libc.mount(b"none", b"/", None, recursive_and_private, None):
        raise OSError(ctypes.get_errno(), "cannot have mounts of one's own")


def mount(kind: str, folder: Path, options: str) -> None:
    """Mounts a file system; raises OSError if that cannot be."""
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.mount(b"none", os.fsencode(folder), kind.encode(), 0, options.encode()):
        raise OSError(ctypes.get_errno(), "cannot mount")


def unmount(folder: Path) -> None:
    """Takes it away again, even while it is in use."""
    lazily = 2
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.umount2(os.fsencode(folder), lazily):
        raise OSError(ctypes.get_errno(), "cannot unmount")


# Children.


def barrier(parties: int):
    """Something that children wait at for each other."""
    return commands.context.Barrier(parties)


@dataclasses.dataclass(frozen=True)
class End:
    """How a child ended.

    Attributes:
      code: its exit status; below zero the signal that killed it.
      said: what it wrote to stdout and stderr.
      seconds: how long it took.
    """

    code: int
    said: str
    seconds: float

    @property
    def was_killed(self) -> bool:
        return self.code < 0

    def assert_refused(self, words: str = "") -> None:
        """Asserts that a command has failed with one readable line, which contains these words."""
        assert self.code in (1, 2), (self.code, self.said)
        assert "Traceback" not in self.said, self.said
        errors = [line for line in self.said.splitlines() if line.startswith("physexp: ")]
        assert len(errors) == 1 and words in errors[0], self.said


class Child(commands.Process):
    """A child of the server, whose output and errors are one."""

    def __init__(self, function, *args, first=None):
        super().__init__(function, *args, first=first, stderr=subprocess.STDOUT)

    def end(self) -> End:
        """Waits for its end; what it has started goes with it."""
        self.wait()
        self.kill_all()
        return End(self.returncode, self.stdout.read(), self.seconds)


def run(function, *args, first=None) -> End:
    """Runs `function(*args)` in a child, after `first()`, to its end."""
    return Child(function, *args, first=first).end()


def litter(folder: Path) -> list[str]:
    """What no reader looks at: files and folders of writers that have not cleaned up."""
    return [str(path.relative_to(folder)) for path in folder.rglob(".*") if path.name != ".lock"]
