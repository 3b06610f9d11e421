"""Processes: how many at a time, in how much memory, what children inherit, and that none outlives its parent."""

import contextlib
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
_QUOTA = Path("/sys/fs/cgroup/cpu.max")  # Of a container: processor time in each period, and the period, us.
_MOST_MEMORY = Path("/sys/fs/cgroup/memory.max")  # Of a container, bytes.


def num_cores() -> int:
    """Returns how many cores this process may use: those that it may run on, or fewer by a container's quota."""
    cores = len(os.sched_getaffinity(0))
    if _QUOTA.exists():
        quota, period = _QUOTA.read_text(encoding="utf-8").split()
        if quota != "max":
            cores = min(cores, max(1, int(quota) // int(period)))
    return cores


def memory() -> int:
    """Returns how much memory this process may use, bytes: the machine's, or less by a container's limit."""
    installed = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    most = _MOST_MEMORY.read_text(encoding="utf-8").strip() if _MOST_MEMORY.exists() else "max"
    return installed if most == "max" else min(installed, int(most))


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
