"""How torch computes: the device, its precision, and settings that leave the caller's alone."""

from collections.abc import Iterator
import contextlib
import functools
from pathlib import Path
from typing import Any

import torch


def choose(device: str, sees_images: bool) -> torch.device:
    """Returns the device to compute on; raises ValueError for `cuda` without a GPU.

    `auto` is a GPU for convolutions, if there is one; without convolutions a CPU is faster.
    """
    if device == "cuda" and not torch.cuda.is_available():
        raise ValueError("device is cuda, but torch finds no GPU here; choose cpu or auto")
    wanted = device == "cuda" or (device == "auto" and sees_images)
    return torch.device("cuda" if wanted and torch.cuda.is_available() else "cpu")


def autocast(device: torch.device, sees_images: bool) -> contextlib.AbstractContextManager[Any]:
    """Returns an autocast context: bfloat16 for images on hardware that supports it, otherwise none.

    Features keep their precision: bf16 has eight bits, too few for a millimetre of a position.
    """
    if sees_images and _has_fast_bfloat16(device.type):
        return torch.autocast(device.type, torch.bfloat16)
    return contextlib.nullcontext()


@functools.cache
def _has_fast_bfloat16(device_type: str) -> bool:
    if device_type == "cuda":
        return bool(torch.cuda.is_bf16_supported(including_emulation=False))
    cpuinfo = Path("/proc/cpuinfo")
    return cpuinfo.exists() and " amx_bf16 " in cpuinfo.read_text(encoding="utf-8")


@contextlib.contextmanager
def own_torch(num_threads: int = 1) -> Iterator[None]:
    """Returns a context in which torch has its usual settings, and these threads; it decorates functions, too.

    The settings are the random state, the number of threads, the default type, and that gradients are computed.
    Afterwards the caller finds its own.
    """
    threads, dtype = torch.get_num_threads(), torch.get_default_dtype()
    try:
        torch.set_num_threads(num_threads)
        torch.set_default_dtype(torch.float32)
        with torch.random.fork_rng(devices=[]), torch.inference_mode(False), torch.enable_grad():
            yield
    finally:
        torch.set_default_dtype(dtype)
        torch.set_num_threads(threads)
