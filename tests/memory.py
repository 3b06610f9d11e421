"""How much memory a test uses."""

from collections.abc import Callable
import ctypes
import gc
import os


def resident_bytes() -> int:
    """What this process holds; what has been freed goes back to the system first, and does not count."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def growth(action: Callable[[], object], count: int, num_warm_up: int) -> int:
    """By how many bytes doing something so often makes this process grow, once it is warm."""
    for _ in range(num_warm_up):
        action()
    before = resident_bytes()
    for _ in range(count):
        action()
    return resident_bytes() - before
