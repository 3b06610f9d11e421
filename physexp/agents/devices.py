"""The device that a network computes on, and its precision."""

import contextlib
import functools
from pathlib import Path

import torch


def choose(device: str, sees_images: bool) -> torch.device:
    """Chooses the device to compute on.

    Args:
      device: `cpu`, `cuda`, or `auto`: the GPU where there is one and convolutions to compute. Without
        them a CPU is faster.
      sees_images: whether there are convolutions.

    Raises:
      ValueError: for `cuda` where torch finds no GPU.
    """
    if device == "cuda" and not torch.cuda.is_available():
        raise ValueError("device is cuda, but torch finds no GPU here; choose cpu or auto")
    wanted = device == "cuda" or (device == "auto" and sees_images)
    return torch.device("cuda" if wanted and torch.cuda.is_available() else "cpu")


def autocast(device: torch.device, sees_images: bool):
    """Returns a context in which images are computed with in bf16, where the hardware is made for it.

    Features keep their precision: bf16 has eight bits, in which a millimetre of a position is lost.

    Args:
      device: that computes.
      sees_images: whether there are images.
    """
    if sees_images and _has_fast_bfloat16(device.type):
        return torch.autocast(device.type, torch.bfloat16)
    return contextlib.nullcontext()


@functools.cache
def _has_fast_bfloat16(device_type: str) -> bool:
    if device_type == "cuda":
        return torch.cuda.is_bf16_supported(including_emulation=False)
    cpuinfo = Path("/proc/cpuinfo")
    return cpuinfo.exists() and " amx_bf16 " in cpuinfo.read_text(encoding="utf-8")
