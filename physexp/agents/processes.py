"""Processes: the cores and the memory that they may use, what children inherit, and how they end."""

from collections.abc import Iterable, Iterator
import contextlib
import math
import multiprocessing
from multiprocessing import context, process, resource_tracker
import os
from pathlib import Path
import signal
import sys
import threading
import types

STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""Requests to end: from Ctrl-C, from schedulers and containers, and from a terminal that was closed."""

_DEATH_SECONDS = 5.0  # For the system to remove a killed process.
_OWN_GROUPS = Path("/proc/self/cgroup")
_GROUPS = Path("/sys/fs/cgroup")  # Control groups of version 2, or a folder for each kind of version 1.


def num_cores() -> int:
    """Returns the number of cores that this process may use: its affinity, or less by a control group's quota."""
    has_affinity = hasattr(os, "sched_getaffinity")  # macOS has none.
    cores = len(os.sched_getaffinity(0)) if has_affinity else os.cpu_count() or 1
    for group in _groups("cpu"):
        # Processor time in each period, -1 or infinite without a quota, and the period, us.
        match _read(group, "cpu.max") or _read(group, "cpu.cfs_quota_us", "cpu.cfs_period_us"):
            case [quota, period] if quota > 0:
                cores = int(min(cores, max(1, quota / period)))
    return cores


def memory() -> int:
    """Returns the memory that this process may use, bytes: the machine's, or less by a control group's limit."""
    installed = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    names = "memory.max", "memory.limit_in_bytes"
    limits = [limit for group in _groups("memory") for name in names for limit in _read(group, name)]
    return int(min(installed, *limits, math.inf))


def _groups(kind: str) -> Iterator[Path]:
    """Yields the control groups of a kind that this process is in, and their parents."""
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
def stop_signals_blocked() -> Iterator[None]:
    """Context in which the stop signals are blocked, for the processes that are started in it.

    Terminals and schedulers send those signals to every process, but the parent decides when its children stop. A
    signal that arrives meanwhile is delivered afterwards.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, STOP_SIGNALS)
    try:
        resource_tracker.ensure_running()  # It unblocks some of them, and ignores only those in its own process.
        signal.pthread_sigmask(signal.SIG_BLOCK, STOP_SIGNALS)
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def spawning() -> context.SpawnContext:
    """Returns the context of multiprocessing that spawns; its resource tracker ignores the stop signals."""
    with stop_signals_blocked():
        return multiprocessing.get_context("spawn")


@contextlib.contextmanager
def without_script() -> Iterator[None]:
    """Context in which spawned processes get neither this program's script nor its arguments.

    The script needs no `__main__` guard, and files that the arguments name stay unknown.
    """
    script, arguments = sys.modules["__main__"], sys.argv
    sys.modules["__main__"], sys.argv = types.ModuleType("__main__"), arguments[:1]
    try:
        yield
    finally:
        sys.modules["__main__"], sys.argv = script, arguments


@contextlib.contextmanager
def inherited_by_workers() -> Iterator[None]:
    """Context in which workers are started: with the stop signals blocked, and with one thread for torch."""
    threads = os.environ.get("OMP_NUM_THREADS")
    os.environ["OMP_NUM_THREADS"] = "1"  # Read when a worker imports torch.
    try:
        with stop_signals_blocked():
            yield
    finally:
        if threads is None:
            del os.environ["OMP_NUM_THREADS"]
        else:
            os.environ["OMP_NUM_THREADS"] = threads


def begin(ignored: Iterable[signal.Signals] = STOP_SIGNALS) -> None:
    """Makes a child's process ignore signals, also one that waits, and end when its parent ends; call it first."""
    for number in ignored:
        signal.signal(number, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


def kill(child: process.BaseProcess) -> None:
    """Kills a child and waits for its end; SIGKILL also ends a child that is stopped or hangs."""
    if child.pid is not None:
        child.kill()
        child.join(_DEATH_SECONDS)
