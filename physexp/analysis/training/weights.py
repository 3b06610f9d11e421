"""The weights in a run's folder: checkpoints while training goes on, the network alone once it is over."""

from collections.abc import Mapping
from pathlib import Path

import torch

from physexp.agents import checkpointing, learning
from physexp.agents import tensors as tensors_lib


class Weights:
    """The weights of a run.

    Attributes:
      checkpointer: writes and reads checkpoints.
    """

    def __init__(self, folder: Path, agent_path: Path):
        """Names the folder of a run, and the file in it for the network alone; writes nothing."""
        self._folder, self._agent_path = folder, agent_path
        self.checkpointer = checkpointing.Checkpointer(folder / "checkpoints")

    def variables(self, like: Mapping[str, torch.Tensor]) -> dict[str, torch.Tensor]:
        """Returns the network's variables by name; see `Run.variables`."""
        if self._agent_path.exists():
            tensors, _ = tensors_lib.read(self._agent_path)
            try:
                tensors_lib.check(tensors, like)
            except ValueError as error:
                raise ValueError(f"{self._agent_path} {error}; put back the agent's own") from None
            return tensors

        def accept(tensors, facts):
            try:
                tensors_lib.check(learning.network_variables(tensors), like)
            except ValueError as error:
                raise ValueError(f"the network {error}; put back the run's own, or remove it") from None

        return self._network(self.checkpointer.latest(accept=accept))

    def keep_network(self) -> None:
        """Writes the network of the last checkpoint, in half precision, unless that has been done; see `Run`."""
        if not self._agent_path.exists():
            variables = self._network(self.checkpointer.latest())
            tensors_lib.write(self._agent_path, tensors_lib.halved(variables), {})

    def _network(self, checkpoint) -> dict[str, torch.Tensor]:
        if checkpoint is None:
            raise ValueError(f"{self._folder} holds no checkpoint yet; let the training write one")
        tensors, _ = checkpoint
        return learning.network_variables(tensors)
