"""Checkpoints: one safetensors file each, in which the facts of the run stand in the header."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import torch

from physexp.agents import core, files
from physexp.agents import tensors as tensors_lib

_NUM_KEPT = 2  # If the last one is damaged, there is the one before.

Accept = Callable[[dict[str, torch.Tensor], dict[str, Any]], None]
"""Called with the tensors and facts of a checkpoint; raises ValueError if they do not fit."""


class Checkpointer:
    """Keeps the latest checkpoints of a run in a folder."""

    def __init__(self, folder: Path):
        """Uses `folder`, which is made when needed, for the two latest checkpoints."""
        self._folder = Path(folder)

    def save(self, tensors: Mapping[str, torch.Tensor], facts: Mapping[str, Any]) -> Path:
        """Writes tensors, with `frames` among them, and facts that JSON can hold; removes checkpoints that are too old.

        Returns the path. Raises OSError if it cannot be written; the checkpoints before it are untouched then.
        """
        self._folder.mkdir(parents=True, exist_ok=True)
        files.remove_litter(self._folder)
        path = self._folder / f"{int(tensors['frames']):015d}.safetensors"
        tensors_lib.write(path, tensors, facts)
        for old in self.paths()[:-_NUM_KEPT]:
            old.unlink()
        return path

    def paths(self) -> list[Path]:
        """Returns the paths of the checkpoints, oldest first."""
        return sorted(self._folder.glob(f"{'[0-9]' * 15}.safetensors"))

    def latest(
        self, tell: Callable[[str], None] = lambda line: None, accept: Accept = lambda tensors, facts: None
    ) -> tuple[dict[str, torch.Tensor], dict[str, Any]] | None:
        """Returns the tensors and facts of the newest checkpoint that is whole, or None if there is none at all.

        `tell` gets a line for each one that is damaged, if there is one before it that is whole. Raises OSError if a
        file cannot be read, and ValueError if all are damaged, or `accept` refuses the newest that is whole.
        """
        damaged: list[str] = []
        for path in reversed(self.paths()):
            try:
                tensors, facts = tensors_lib.read(path)
            except core.DamagedError as error:
                damaged.append(str(error))
                continue
            for fault in damaged:
                tell(f"{fault}; the one before it is used")
            try:
                accept(tensors, facts)
            except ValueError as error:
                raise ValueError(f"{path}: {error}") from None
            return tensors, facts
        if damaged:
            raise ValueError(
                f"no checkpoint in {self._folder} is whole ({damaged[0]}); remove that folder to start over"
            )
        return None
