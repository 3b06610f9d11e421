"""Processes: how many at a time, in how much memory, what children inherit, and that none outlives its parent."""

from collections.abc import Iterator
import contextlib
import math
import multiprocessing
from multiprocessing import resource_tracker
import os
from pathlib import Path
import signal
import sys
import threading
import types

STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""Requests to end, from Ctrl-C, from schedulers and containers, and from a terminal that is gone."""

_DEATH_SECONDS = 5.0  # For the system to take away what was killed.
_OWN_GROUPS = Path("/proc/self/cgroup")
_GROUPS = Path("/sys/fs/cgroup")  # Mounted control groups: those of version 2, or a folder for each kind of 1.


def num_cores() -> int:
    """Returns how many cores this process may use: those that it may run on, or fewer by a control group's quota."""
    has_affinity = hasattr(os, "sched_getaffinity")  # macOS has none.
    cores = len(os.sched_getaffinity(0)) if has_affinity else os.cpu_count() or 1
    for group in _groups("cpu"):
        # Processor time in each period, -1 or infinite without a quota, and the period, us.
        match _read(group, "cpu.max") or _read(group, "cpu.cfs_quota_us", "cpu.cfs_period_us"):
            case [quota, period] if quota > 0:
                cores = int(min(cores, max(1, quota / period)))
    return cores


def memory() -> int:
    """Returns how much memory this process may use, bytes: the machine's, or less by a control group's limit."""
    installed = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    names = "memory.max", "memory.limit_in_bytes"
    limits = [limit for group in _groups("memory") for name in names for limit in _read(group, name)]
    return int(min(installed, *limits, math.inf))


def _groups(kind: str) -> Iterator[Path]:
    """Yields the control groups of a kind, of either version, that this process is in, and those around them."""
    for line in _OWN_GROUPS.read_text(encoding="utf-8").splitlines() if _OWN_GROUPS.exists() else ():
        _, kinds, path = line.split(":", 2)
        if kind in kinds.split(",") or not kinds:
            root = _GROUPS / kind if kinds else _GROUPS
            own = root / path.lstrip("/")
            yield from (own, *(folder for folder in own.parents if folder.is_relative_to(root)))


def _read(group: Path, *names: str) -> list[float]:
    """Returns the numbers in files of a control group; none where it has no such file."""
    if not (group / names[0]).exists():
        return []
    words = " ".join((group / name).read_text(encoding="utf-8") for name in names).split()
    return [float(word.replace("max", "inf")) for word in words]


@contextlib.contextmanager
def unheard_by_children():
    """Returns a context in which the stop signals are blocked, for the processes that are started in it.

    Terminals and schedulers send those signals to every process, but it is the parent that asks its children to stop.
    A signal that comes meanwhile is delivered afterwards.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, STOP_SIGNALS)
    try:
        resource_tracker.ensure_running()  # It makes some of them heard again, and ignores these alone by itself.
        signal.pthread_sigmask(signal.SIG_BLOCK, STOP_SIGNALS)
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def spawning():
    """Returns the context that spawns processes; the tracker of its semaphores hears no stop signal, as they do not."""
    with unheard_by_children():
        return multiprocessing.get_context("spawn")


@contextlib.contextmanager
def without_script():
    """Returns a context in which processes are spawned that do not run this program's script: it needs no guard."""
    script, sys.modules["__main__"] = sys.modules["__main__"], types.ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = script


@contextlib.contextmanager
def inherited_by_workers():
    """Returns a context in which workers are started: as `unheard_by_children`, and with one thread for torch."""
    threads = os.environ.get("OMP_NUM_THREADS")
    os.environ["OMP_NUM_THREADS"] = "1"  # Read when a worker imports torch.
    try:
        with unheard_by_children():
            yield
    finally:
        if threads is None:
            del os.environ["OMP_NUM_THREADS"]
        else:
            os.environ["OMP_NUM_THREADS"] = threads


def begin() -> None:
    """Makes a child's process, first of all, ignore requests to end, and end when its parent does."""
    for number in STOP_SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)  # Whatever it is at, or waits for: nobody is left to want it.


def kill(process) -> None:
    """Ends a child for certain: one that is stopped, or hangs, takes no other signal."""
    if process.pid is not None:
        process.kill()
        process.join(_DEATH_SECONDS)
