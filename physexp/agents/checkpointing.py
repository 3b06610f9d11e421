"""Checkpoints: tensors as safetensors, everything else as JSON, written so that a crash leaves the last one whole."""

from collections.abc import Callable, Mapping
import hashlib
import json
from pathlib import Path
from typing import Any

from safetensors import SafetensorError
from safetensors import torch as safetensors
import torch

from physexp.agents.files import write_atomically

FORMAT = 1
"""Of checkpoints."""


def write_agent(path: Path, variables: Mapping[str, torch.Tensor]) -> None:
    """Writes a network's variables, by name, in half precision: what is kept of an agent that is trained."""
    tensors = {
        name: (value.half() if value.is_floating_point() else value).contiguous() for name, value in variables.items()
    }
    write_atomically(path, safetensors.save(tensors))


class Checkpointer:
    """Keeps the latest checkpoints of a run in a folder."""

    def __init__(self, folder: Path, keep: int = 2):
        """Uses `folder`, which is made when needed, for the `keep` latest checkpoints."""
        self._folder, self._keep = Path(folder), keep

    def save(self, tensors: Mapping[str, torch.Tensor], facts: Mapping[str, Any]) -> Path:
        """Writes a checkpoint and removes those that are too old.

        Args:
          tensors: tensors by name, with `frames` among them.
          facts: anything that JSON can hold.

        Returns:
          The path of the tensors; the facts lie beside it as JSON, with a checksum.
        """
        self._folder.mkdir(parents=True, exist_ok=True)
        for litter in self._folder.glob(".*.tmp"):  # Of a process that was killed while it wrote.
            litter.unlink()
        path = self._folder / f"{int(tensors['frames']):015d}.safetensors"
        content = safetensors.save({name: value.detach().contiguous() for name, value in tensors.items()})
        card = {"format": FORMAT, "sha256": hashlib.sha256(content).hexdigest(), "facts": dict(facts)}
        # The JSON comes first: a checkpoint is there once its tensors are.
        write_atomically(path.with_suffix(".json"), (json.dumps(card, indent=1) + "\n").encode())
        write_atomically(path, content)
        for old in self.paths()[: -self._keep]:
            old.unlink()
            old.with_suffix(".json").unlink(missing_ok=True)
        return path

    def paths(self) -> list[Path]:
        """The checkpoints, oldest first."""
        return sorted(self._folder.glob("[0-9]*.safetensors"))

    def latest(self, tell: Callable[[str], None] = lambda line: None
               ) -> tuple[dict[str, torch.Tensor], dict[str, Any]] | None:  # fmt: skip
        """The tensors and facts of the newest checkpoint that is whole, or None where there is none at all.

        Args:
          tell: called with a line for each one that is damaged.

        Raises:
          ValueError: if all are damaged, or the newest has another format.
        """
        damaged = []
        for path in reversed(self.paths()):
            try:
                return _read(path)
            except _DamagedError as error:
                damaged.append(path)
                tell(f"{path} is damaged ({error}); the one before it is used")
        if damaged:
            raise ValueError(f"no checkpoint in {self._folder} is whole; remove that folder to start over")
        return None


class _DamagedError(Exception):
    """A checkpoint is not what was written."""


def _read(path: Path) -> tuple[dict[str, torch.Tensor], dict[str, Any]]:
    """Reads a checkpoint; nothing in it is run, and nothing is looked at whose checksum differs."""
    try:
        card = json.loads(path.with_suffix(".json").read_bytes())
        form, checksum, facts = card["format"], card["sha256"], card["facts"]
    except (FileNotFoundError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise _DamagedError(f"its JSON cannot be read: {error!r}") from None
    if form != FORMAT:
        raise ValueError(f"{path} has format {form}; this version reads format {FORMAT}")
    content = path.read_bytes()
    if hashlib.sha256(content).hexdigest() != checksum:
        raise _DamagedError("its checksum differs")
    try:
        return safetensors.load(content), facts
    except SafetensorError as error:
        raise _DamagedError(f"it holds no tensors: {error}") from None
