"""How much memory a test uses."""

from collections.abc import Callable
import ctypes
import gc
import os
import sys

_LARGEST_BLOCK = 512  # Bytes: Python takes larger blocks from the C library too.
_libc = ctypes.CDLL(None)


class _AllocatorFigures(ctypes.Structure):
    """`struct mallinfo2` of the GNU C library."""

    _names = "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost"
    _fields_ = [(name, ctypes.c_size_t) for name in _names.split()]


_libc.mallinfo2.restype = _AllocatorFigures


def resident_bytes() -> int:
    """Returns the resident memory of this process after freed memory has gone back to the system."""
    gc.collect()
    _libc.malloc_trim(0)
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def allocated_bytes() -> int:
    """Returns the allocated memory of this process; every small object counts as the largest one."""
    sys._clear_type_cache()  # It keeps up to 4096 names, and dm_control makes new ones at each reset.
    gc.collect()
    figures = _libc.mallinfo2()
    return figures.uordblks + figures.hblkhd + _LARGEST_BLOCK * sys.getallocatedblocks()


def open_files() -> int:
    """Returns the number of open files of this process after a garbage collection."""
    gc.collect()
    return len(os.listdir("/proc/self/fd"))


def growth(action: Callable[[], object], count: int, num_warm_up: int) -> int:
    """Returns the growth of allocated memory over `count` calls of an action, after a warm-up."""
    for _ in range(num_warm_up):
        action()
    before = allocated_bytes()
    for _ in range(count):
        action()
    return allocated_bytes() - before
