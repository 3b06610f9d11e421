"""How much memory a test uses."""

from collections.abc import Callable
import ctypes
import gc
import os
import sys

_LARGEST_BLOCK = 512  # Bytes: what is larger, Python takes from the C library too.
_libc = ctypes.CDLL(None)


class _AllocatorFigures(ctypes.Structure):
    """`struct mallinfo2` of the GNU C library."""

    _fields_ = [
        (name, ctypes.c_size_t)
        for name in (
            "arena",
            "ordblks",
            "smblks",
            "hblks",
            "hblkhd",
            "usmblks",
            "fsmblks",
            "uordblks",
            "fordblks",
            "keepcost",
        )
    ]


_libc.mallinfo2.restype = _AllocatorFigures


def resident_bytes() -> int:
    """What this process holds; what has been freed goes back to the system first, and does not count."""
    gc.collect()
    _libc.malloc_trim(0)
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def allocated_bytes() -> int:
    """What has been asked for and not given back, whatever pages it lies in; small objects count as the largest."""
    sys._clear_type_cache()  # It keeps up to 4096 names, and dm_control makes new ones at each reset.
    gc.collect()
    figures = _libc.mallinfo2()
    return figures.uordblks + figures.hblkhd + _LARGEST_BLOCK * sys.getallocatedblocks()


def open_files() -> int:
    """How many files this process has open; what nobody holds any more is closed first, and does not count."""
    gc.collect()
    return len(os.listdir("/proc/self/fd"))


def growth(action: Callable[[], object], count: int, num_warm_up: int) -> int:
    """By how many bytes doing something so often makes what this process uses grow, once it is warm."""
    for _ in range(num_warm_up):
        action()
    before = allocated_bytes()
    for _ in range(count):
        action()
    return allocated_bytes() - before
