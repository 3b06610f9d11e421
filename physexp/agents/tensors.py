"""Tensors in safetensors files, with facts (JSON) and a checksum of both in the header's metadata."""

from collections.abc import Iterator, Mapping
import contextlib
import hashlib
import json
from pathlib import Path
from typing import Any

import safetensors
from safetensors import torch as safetensors_torch
import torch

from physexp.agents import core, files


def halved(variables: Mapping[str, torch.Tensor]) -> dict[str, torch.Tensor]:
    """Returns variables with floating-point numbers in half precision; raises ValueError if one is not finite then."""
    tensors = {name: value.half() if value.is_floating_point() else value for name, value in variables.items()}
    if wrong := not_finite(tensors):
        raise ValueError(f"weights are not finite in half precision ({wrong}); keep an agent that has not diverged")
    return tensors


def not_finite(tensors: Mapping[str, torch.Tensor]) -> str:
    """Returns the names of tensors with numbers that are not finite, shortened; empty if there are none."""
    return _listed([name for name, value in tensors.items() if not bool(torch.isfinite(value).all())])


def write(path: Path, tensors: Mapping[str, torch.Tensor], facts: Mapping[str, Any]) -> None:
    """Writes tensors, and facts that JSON can hold, into one file; raises OSError if that fails."""
    plain, text = {name: value.detach().contiguous() for name, value in tensors.items()}, json.dumps(dict(facts))
    metadata = {"facts": text, "sha256": digest(plain, text)}
    files.write_atomically(path, safetensors_torch.save(plain, metadata))


def read(path: Path) -> tuple[dict[str, torch.Tensor], dict[str, Any]]:
    """Returns the tensors and the facts of a file.

    Raises OSError if it cannot be read, and DamagedError if it is no such file or differs from what was written.
    """
    with _opened(path) as file:
        metadata = file.metadata() or {}
        text, sha256 = metadata["facts"], metadata["sha256"]
        tensors = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
        if digest(tensors, text) != sha256:
            raise ValueError("its checksum differs")
        return tensors, dict(json.loads(text))


def read_facts(path: Path) -> dict[str, Any]:
    """Returns the facts of a file without reading its tensors or verifying the checksum; raises as `read`."""
    with _opened(path) as file:
        return dict(json.loads((file.metadata() or {})["facts"]))


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[Any]:
    try:
        with safetensors.safe_open(path, "pt") as file:
            yield file
    except (safetensors.SafetensorError, KeyError, TypeError, ValueError, RecursionError) as error:
        what = f"its header lacks {error}" if isinstance(error, KeyError) else files.reason(error)
        raise core.DamagedError(f"{path} is damaged: {what}; put back what was written") from None


def check(tensors: Mapping[str, torch.Tensor], like: Mapping[str, torch.Tensor]) -> None:
    """Raises ValueError unless tensors are finite and have the names, shapes and kinds of others.

    Its message follows the name of the tensors' file.
    """
    if differing := sorted(set(tensors) ^ set(like)):
        raise ValueError(f"does not fit the configuration: only one of them has {_listed(differing)}")
    for name, own in like.items():
        if _kind(tensors[name]) != _kind(own):
            raise ValueError(f"does not fit the configuration: {name} is {_kind(tensors[name])}, not {_kind(own)}")
    if wrong := not_finite(tensors):
        raise ValueError(f"holds numbers that are not finite in {wrong}")


def _kind(value: torch.Tensor) -> str:
    return f"{'floating' if value.is_floating_point() else 'integer'} {list(value.shape)}"


def digest(tensors: Mapping[str, torch.Tensor], text: str = "") -> str:
    """Returns the SHA-256 of a text and of the tensors' names, types, shapes and bytes."""
    found = hashlib.sha256(text.encode())
    for name, value in sorted(tensors.items()):
        found.update(f"{name} {value.dtype} {list(value.shape)}\n".encode())
        found.update(value.contiguous().reshape(-1).view(torch.uint8).numpy().tobytes())
    return found.hexdigest()


def _listed(names: list[str]) -> str:
    shown = ", ".join(name if name.isprintable() and len(name) < 80 else ascii(name)[:80] for name in names[:3])
    return shown + (f" and {len(names) - 3} more" if len(names) > 3 else "")
