"""Tools of the attacks: children that are killed at a chosen call, byte or moment, or confined.

To add an attack: write a function at the top level of a module, pass it to `run` with a way to die or a confinement,
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
    *("open", "write", "flush", "fsync", "close", "truncate", "flock", "scandir"),
    *("replace", "rename", "link", "unlink", "remove", "mkdir", "rmdir"),
}
"""Names of C functions that touch files, before and after each of which a child may die."""


def repetitions(default: int, share: float = 1.0) -> int:
    """Returns the number of attacks: `default`, or a share of PHYSEXP_ATTACKS if that is set."""
    asked = os.environ.get("PHYSEXP_ATTACKS")
    return default if asked is None else max(1, round(share * int(asked)))


def generator() -> random.Random:
    """Returns random numbers; PHYSEXP_ATTACKS_SEED repeats those of an earlier attack."""
    seed = int(os.environ.get("PHYSEXP_ATTACKS_SEED") or np.random.SeedSequence().entropy % 2**32)
    print("\nPHYSEXP_ATTACKS_SEED", seed)
    return random.Random(seed)


class Tally(collections.Counter):
    """Counts the outcomes of attacks, and prints them at the end."""

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
    """Dies by SIGKILL at the n-th entry into, or exit from, a function that touches files."""

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
    """Has the kernel kill the process when a file would grow beyond a number of bytes."""

    number: int

    def __call__(self):
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (self.number, self.number))
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)


@dataclasses.dataclass(frozen=True)
class AtMoment:
    """Has the kernel kill the process after a time."""

    seconds: float

    def __call__(self):
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_REAL, self.seconds)


@dataclasses.dataclass(frozen=True)
class Extent:
    """The number of calls, bytes and seconds of an undisturbed run, from which deaths are drawn."""

    calls: int
    bytes: int
    seconds: float

    def draw(self, generator: random.Random):
        """Returns a random way to die, anywhere in the run."""
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
    """Lets the disk take no file of more than a number of bytes (EFBIG)."""

    number: int

    def __call__(self):
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (self.number, self.number))


@dataclasses.dataclass(frozen=True)
class Memory:
    """Limits the memory that the process may take beyond its own."""

    number: int

    def __call__(self):
        limit = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize() + self.number
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


@dataclasses.dataclass(frozen=True)
class SmallDisk:
    """Limits the room on the disk of a folder to its present content and some bytes more (ENOSPC)."""

    folder: Path
    room: int

    def __call__(self):
        """Mounts a small file system in the folder's place, whose content is copied back at the end."""
        saved = Path(tempfile.mkdtemp()) / "saved"
        shutil.copytree(self.folder, saved)
        _in_own_mounts()
        pages = sum(-(-path.stat().st_size // 4096) for path in saved.rglob("*") if path.is_file())
        options = f"size={4096 * max(1, pages) + self.room}"
        _call("mount", b"none", os.fsencode(self.folder), b"tmpfs", 0, options.encode())
        shutil.copytree(saved, self.folder, dirs_exist_ok=True)
        child = os.fork()
        if not child:
            return
        _, status = os.waitpid(child, 0)
        shutil.rmtree(saved)
        shutil.copytree(self.folder, saved)
        _call("umount2", os.fsencode(self.folder), _LAZILY)
        shutil.rmtree(self.folder)
        shutil.copytree(saved, self.folder)
        shutil.rmtree(saved.parent)
        os._exit(os.waitstatus_to_exitcode(status))


_LAZILY = 2  # Even while it is in use.


def _in_own_mounts() -> None:
    """Gives this process mounts of its own, that end with it; raises OSError if this user may not."""
    new_mounts, new_user, recursive_and_private = 0x20000, 0x10000000, 0x4000 | 0x40000
    user, group = os.getuid(), os.getgid()
    _call("unshare", new_mounts if user == 0 else new_mounts | new_user)
    if user:
        Path("/proc/self/setgroups").write_text("deny")
        Path("/proc/self/uid_map").write_text(f"0 {user} 1")
        Path("/proc/self/gid_map").write_text(f"0 {group} 1")
    _call("mount", b"none", b"/", None, recursive_and_private, None)


def _call(name, *arguments) -> None:
    """Calls a function of the C library; raises OSError if it fails."""
    if getattr(ctypes.CDLL(None, use_errno=True), name)(*arguments):
        raise OSError(ctypes.get_errno(), f"cannot have mounts of one's own: {name} failed")


# Children.


def barrier(parties: int):
    """Returns a barrier for children."""
    return commands.context.Barrier(parties)


@dataclasses.dataclass(frozen=True)
class End:
    """The end of a child.

    Attributes:
      code: its exit status; below zero the signal that killed it.
      said: its stdout and stderr.
      seconds: its duration.
    """

    code: int
    said: str
    seconds: float

    @property
    def was_killed(self) -> bool:
        return self.code < 0

    def assert_refused(self, words: str = "") -> None:
        """Asserts that a command has failed with one readable line that contains these words."""
        assert self.code in (1, 2), (self.code, self.said)
        assert "Traceback" not in self.said, self.said
        errors = [line for line in self.said.splitlines() if line.startswith("physexp: ")]
        assert len(errors) == 1 and words in errors[0], self.said


class Child(commands.Process):
    """A child of the server, whose output and errors are one."""

    def __init__(self, function, *args, first=None):
        super().__init__(function, *args, first=first, stderr=subprocess.STDOUT)

    def end(self) -> End:
        """Waits for its end, and ends all that it has started."""
        self.wait()
        self.kill_all()
        return End(self.returncode, self.stdout.read(), self.seconds)


def run(function, *args, first=None) -> End:
    """Runs `function(*args)` in a child, after `first()`, to its end."""
    return Child(function, *args, first=first).end()


def litter(folder: Path) -> list[str]:
    """Returns the temporary files and folders of killed writers."""
    return [str(path.relative_to(folder)) for path in folder.rglob(".*") if path.name != ".lock"]
