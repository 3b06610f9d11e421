"""How much memory a test uses."""

import ctypes
import gc
import os


def resident_bytes() -> int:
    """What this process holds; what has been freed goes back to the system first, and does not count."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
