"""Checkpoints: tensors as safetensors, everything else as JSON, written so that a crash leaves the last one whole."""

from collections.abc import Mapping
import json
import os
from pathlib import Path
from typing import Any

from safetensors import torch as safetensors
import torch


def write_atomically(path: Path, content: bytes) -> None:
    """Replaces a file: after a crash or on a full disk there is the old file or the new one, never a part.

    Raises:
      OSError: if the content cannot be written; the old file is untouched.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        with open(temporary, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


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
          The path of the tensors; the facts lie beside it as JSON.
        """
        self._folder.mkdir(parents=True, exist_ok=True)
        for litter in self._folder.glob(".*.tmp"):  # Of a process that was killed while it wrote.
            litter.unlink()
        path = self._folder / f"{int(tensors['frames']):015d}.safetensors"
        contiguous = {name: value.detach().contiguous() for name, value in tensors.items()}
        # The JSON comes first: a checkpoint is there once its tensors are.
        write_atomically(path.with_suffix(".json"), (json.dumps(dict(facts), indent=1) + "\n").encode())
        write_atomically(path, safetensors.save(contiguous))
        for old in self.paths()[: -self._keep]:
            old.unlink()
            old.with_suffix(".json").unlink(missing_ok=True)
        return path

    def paths(self) -> list[Path]:
        """The checkpoints, oldest first."""
        return sorted(self._folder.glob("[0-9]*.safetensors"))

    def latest(self) -> tuple[dict[str, torch.Tensor], dict[str, Any]] | None:
        """The newest checkpoint's tensors and facts, or None where there is none."""
        paths = self.paths()
        if not paths:
            return None
        return safetensors.load_file(paths[-1]), json.loads(paths[-1].with_suffix(".json").read_text())
