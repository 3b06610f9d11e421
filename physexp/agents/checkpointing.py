"""Checkpoints: tensors as safetensors, everything else as JSON, written so that a crash leaves the last one whole.

A file may come from anybody: nothing in it is executed, and only finite numbers of the right names, shapes and types
are taken from it.
"""

from collections.abc import Callable, Iterable, Mapping
import hashlib
import json
import os
from pathlib import Path
from typing import Any

from safetensors import SafetensorError
from safetensors import torch as safetensors
import torch

from physexp.agents import core, files

FORMAT = 1
"""The format of checkpoints."""
_KEPT = 2  # Checkpoints: if the last one is damaged, there is the one before.
_MOST_HEADER = 1_000_000  # Bytes, of the names and shapes of tensors; those of a checkpoint take five thousand.


def agent_bytes(variables: Mapping[str, torch.Tensor]) -> bytes:
    """A network's variables, by name, as a safetensors file in half precision that contains its checksum.

    Raises:
      ValueError: if a number is not finite, or too large for half precision.
    """
    tensors = {
        name: (value.half() if value.is_floating_point() else value).contiguous() for name, value in variables.items()
    }
    if wrong := [name for name, value in tensors.items() if not _is_finite(value)]:
        raise ValueError(
            f"weights are not finite in half precision ({_some(wrong)}); keep an agent that has not diverged"
        )
    return safetensors.save(tensors, {"sha256": _digest(tensors)})


def write_agent(path: Path, variables: Mapping[str, torch.Tensor]) -> None:
    """Writes a network's variables, by name, in half precision: what is kept of an agent that is trained.

    Raises:
      ValueError: as `agent_bytes`; the old file is untouched.
    """
    files.write_atomically(path, agent_bytes(variables))


def read_agent(path: Path, like: Mapping[str, torch.Tensor], sha256: str | None = None) -> dict[str, torch.Tensor]:
    """Reads what `write_agent` wrote.

    Args:
      path: the file.
      like: variables with the names, shapes and types that the network has; their values do not matter.
      sha256: of the whole file, where it is known.

    Returns:
      Variables by name, floating-point ones in half precision.

    Raises:
      OSError: if the file cannot be read.
      ValueError: if it is damaged or does not fit.
    """
    halved = {
        name: torch.empty(value.shape, dtype=torch.half if value.is_floating_point() else value.dtype, device="meta")
        for name, value in like.items()
    }
    content = files.read_plain(path, num_bytes(halved.values()))
    try:
        if sha256 is not None and hashlib.sha256(content).hexdigest() != sha256:
            raise ValueError("is damaged: its checksum differs")
        tensors, metadata = _parse(content)
        if "sha256" in metadata and metadata["sha256"] != _digest(tensors):
            raise ValueError("is damaged: its checksum differs")
        check(tensors, halved)
    except ValueError as error:
        raise ValueError(f"{path} {error}; put back the agent's own") from None
    return tensors


def num_bytes(tensors: Iterable[torch.Tensor]) -> int:
    """Returns the most bytes that a file with such tensors takes."""
    return _MOST_HEADER + sum(value.numel() * value.element_size() for value in tensors)


def check(tensors: Mapping[str, torch.Tensor], like: Mapping[str, torch.Tensor]) -> None:
    """Refuses tensors unless they have the names, shapes and types of others, and are finite.

    Raises:
      ValueError: with a phrase that goes on after the tensors' name.
    """
    if differing := sorted(set(tensors) ^ set(like)):
        raise ValueError(f"does not fit the configuration: only one of them has {_some(differing)}")
    for name, own in like.items():
        value = tensors[name]
        if (value.shape, value.dtype) != (own.shape, own.dtype):
            raise ValueError(f"does not fit the configuration: {name} is {_kind(value)} instead of {_kind(own)}")
    if wrong := [name for name, value in tensors.items() if not _is_finite(value)]:
        raise ValueError(f"holds numbers that are not finite in {_some(wrong)}")


def _kind(value: torch.Tensor) -> str:
    return f"{str(value.dtype).removeprefix('torch.')} {list(value.shape)}"


def _is_finite(value: torch.Tensor) -> bool:
    return not value.is_floating_point() or bool(torch.isfinite(value).all())


def _some(names: list[str]) -> str:
    """A few names in one line, whatever they are."""
    shown = ", ".join(name if name.isprintable() and len(name) < 80 else ascii(name)[:80] for name in names[:3])
    return shown + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def _digest(tensors: Mapping[str, torch.Tensor]) -> str:
    """SHA-256 of names, types, shapes and bytes, in the order of the names."""
    digest = hashlib.sha256()
    for name in sorted(tensors):
        value = tensors[name].contiguous()
        digest.update(f"{name} {_kind(value)}\n".encode())
        digest.update(value.reshape(-1).view(torch.uint8).numpy().tobytes())
    return digest.hexdigest()


def _parse(content: bytes) -> tuple[dict[str, torch.Tensor], dict[str, str]]:
    """The tensors of a safetensors file, and what its header says beside them.

    Raises:
      ValueError: if it is no such file.
    """
    if int.from_bytes(content[:8], "little") > _MOST_HEADER:
        raise ValueError("is damaged: its header is too long")
    try:
        tensors = safetensors.load(content)
    except (SafetensorError, KeyError) as error:  # KeyError: a type that torch has not.
        raise ValueError(f"is damaged: {files.reason(error)}") from None
    header = json.loads(content[8 : 8 + int.from_bytes(content[:8], "little")])
    return tensors, header.get("__metadata__") or {}


class Checkpointer:
    """Keeps the latest checkpoints of a run in a folder."""

    def __init__(self, folder: Path):
        """Uses `folder`, which is made when needed, for the two latest checkpoints."""
        self._folder = Path(folder)

    def save(self, tensors: Mapping[str, torch.Tensor], facts: Mapping[str, Any]) -> Path:
        """Writes a checkpoint and removes those that are too old.

        Args:
          tensors: tensors by name, with `frames` among them.
          facts: anything that JSON can hold.

        Returns:
          The path of the tensors; the facts lie beside it as JSON, with checksums of both.

        Raises:
          OSError: if it cannot be written; those before it are untouched.
          ValueError: if the folder is a link.
        """
        files.refuse_link(self._folder)
        self._folder.mkdir(parents=True, exist_ok=True)
        path = self._folder / f"{int(tensors['frames']):015d}.safetensors"
        content = safetensors.save({name: value.detach().contiguous() for name, value in tensors.items()})
        card = {
            "format": FORMAT,
            "sha256": hashlib.sha256(content).hexdigest(),
            "facts": dict(facts),
            "facts_sha256": json_digest(dict(facts)),
        }
        # The JSON comes first: a checkpoint is there once its tensors are.
        files.write_atomically(path.with_suffix(".json"), (json.dumps(card, indent=1) + "\n").encode())
        files.write_atomically(path, content)
        for old in self.paths()[:-_KEPT]:
            old.unlink()
            old.with_suffix(".json").unlink(missing_ok=True)
        return path

    def paths(self) -> list[Path]:
        """Returns the paths of the checkpoints, oldest first."""
        return sorted(path for path in self._folder.glob("*.safetensors") if _is_number(path.stem))

    def latest(
        self,
        tell: Callable[[str], None] = lambda line: None,
        accept: Callable[[dict[str, torch.Tensor], dict[str, Any]], None] = lambda tensors, facts: None,
        most: int | None = None,
    ) -> tuple[dict[str, torch.Tensor], dict[str, Any]] | None:
        """Returns the tensors and facts of the newest checkpoint that is whole, or None where there is none at all.

        Args:
          tell: called with a line for each one that is damaged, where there is one before it that is whole.
          accept: called with those tensors and facts; raises ValueError if they do not fit.
          most: bytes that the tensors' file may have.

        Raises:
          OSError: if a file cannot be read.
          ValueError: if all are damaged, or the newest that is whole has another format or does not fit; it names the
            file.
        """
        files.refuse_link(self._folder)
        damaged = []
        for path in reversed(self.paths()):
            try:
                tensors, facts = _read(path, most)
            except core.DamagedError as error:
                damaged.append((path, str(error)))
                continue
            for newer, fault in damaged:
                tell(f"{newer} is damaged ({fault}); the one before it is used")
            try:
                accept(tensors, facts)
            except ValueError as error:
                raise ValueError(f"{path}: {error}") from None
            return tensors, facts
        if damaged:
            newest, fault = damaged[0]
            raise ValueError(
                f"no checkpoint in {self._folder} is whole ({newest.name}: {fault}); remove that folder to start over"
            )
        return None


def _is_number(text: str) -> bool:
    return text.isascii() and text.isdecimal()


def json_digest(value: Any) -> str:
    """Returns the SHA-256 of what JSON can hold, however it is laid out in a file."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()


def _read(path: Path, most: int | None) -> tuple[dict[str, torch.Tensor], dict[str, Any]]:
    """Reads a checkpoint; nothing in it is executed, and nothing whose checksum differs is used."""
    facts_path = path.with_suffix(".json")
    if facts_path.is_dir():  # Nothing that is written later could replace it.
        raise ValueError(f"{facts_path} is a folder; remove it")
    try:
        card = files.read_json(facts_path)
        form, checksum, facts = card["format"], card["sha256"], card["facts"]
        is_whole = isinstance(facts, dict) and card.get("facts_sha256") in (None, json_digest(facts))
    except (FileNotFoundError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise core.DamagedError(f"its JSON cannot be read: {files.reason(error)}") from None
    if form != FORMAT:
        raise ValueError(f"{path} has format {ascii(form)[:80]}; this version reads format {FORMAT}")
    if not is_whole:
        raise core.DamagedError(f"the checksum of {facts_path.name} differs")
    content = files.read_plain(path, os.lstat(path).st_size if most is None else most)
    if hashlib.sha256(content).hexdigest() != checksum:
        raise core.DamagedError("its checksum differs")
    try:
        tensors, _ = _parse(content)
    except ValueError as error:
        raise core.DamagedError(f"it holds no tensors: it {error}") from None
    frames = tensors.get("frames")
    if frames is None or (frames.dtype, frames.shape) != (torch.int64, ()) or int(frames) != int(path.stem):
        raise core.DamagedError("its frames are not those in its name")
    return tensors, facts
