"""Tools of the attacks: children that are killed at a chosen call, byte or moment, or confined.

To add an attack: write a function at the top level of a module, pass it to `run` with a way to die or a confinement,
and look at the folder that it leaves.
"""

import collections
import dataclasses
import functools
import itertools
import json
import os
from pathlib import Path
import random
import resource
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


# Ways to die and confinements. They are called in the child before the function, as partial functions.


def die_at_call(number: int) -> None:
    """Dies by SIGKILL at the n-th entry into, or exit from, a function that touches files."""
    counter = itertools.count()

    def count():
        if next(counter) == number:
            os.kill(os.getpid(), signal.SIGKILL)

    _profile(count)


def die_at_byte(number: int) -> None:
    """Has the kernel kill the process when a file would grow beyond a number of bytes."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (number, number))
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)


def die_at_moment(seconds: float) -> None:
    """Has the kernel kill the process after a time."""
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_REAL, seconds)


def fill_disk(number: int) -> None:
    """Lets the disk take no file of more than a number of bytes (EFBIG)."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (number, number))


def limit_memory(number: int) -> None:
    """Limits the memory that the process may take beyond its own, bytes."""
    limit = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize() + number
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


@dataclasses.dataclass(frozen=True)
class Extent:
    """The number of calls, bytes and seconds of an undisturbed run, from which deaths are drawn."""

    calls: int
    bytes: int
    seconds: float

    def draw(self, generator: random.Random):
        """Returns a random way to die, anywhere in the run."""
        way = generator.choice([die_at_call, die_at_call, die_at_byte, die_at_moment])
        ranges = {die_at_call: self.calls, die_at_byte: self.bytes, die_at_moment: self.seconds}
        at = generator.uniform(1e-6, ranges[way])
        return functools.partial(way, at if way is die_at_moment else int(at))


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


# Children.


@dataclasses.dataclass(frozen=True)
class End:
    """The end of a child.

    Attributes:
      code: its exit status; below zero the signal that killed it.
      said: its stdout and stderr.
    """

    code: int
    said: str

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
        return End(self.returncode, self.stdout.read())


def run(function, *args, first=None) -> End:
    """Runs `function(*args)` in a child, after `first()`, to its end."""
    return Child(function, *args, first=first).end()


def litter(folder: Path) -> list[str]:
    """Returns the temporary files and folders of killed writers."""
    return [str(path.relative_to(folder)) for path in folder.rglob(".*") if path.name != ".lock"]
