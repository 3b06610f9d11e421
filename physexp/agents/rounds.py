"""Rounds: whole episodes, one in each environment of a batch, as arrays to learn from and to record."""

import dataclasses
from typing import Any

import numpy as np
import torch


@dataclasses.dataclass(frozen=True)
class BehaviourData:
    """Data of the policy that acted, to learn from episodes with other parameters than its own; all packed.

    Attributes:
      observation: what was seen before each action, arrays [N, ...] by name.
      log_probabilities: of the actions, by the policy that took them, float32 [N].
      values: that network's estimates of the return, float32 [N].
    """

    observation: dict[str, torch.Tensor]
    log_probabilities: torch.Tensor
    values: torch.Tensor

    def select(self, steps: torch.Tensor) -> "BehaviourData":
        """Returns the data of some steps, int64 [n]."""
        observation = {name: array[steps] for name, array in self.observation.items()}
        return BehaviourData(observation, self.log_probabilities[steps], self.values[steps])


@dataclasses.dataclass(frozen=True)
class Round:
    """Whole episodes, one in each environment of a batch, padded to the longest.

    Steps that were played can be packed: all first steps, then all second steps, and so on, [N, ...].

    Attributes:
      actions: actions taken, int64 [T, B].
      rewards: rewards that followed, float32 [T, B].
      lengths: actions in each episode, int64 [B].
      answers: the right labels, int64 [B]: for records, not for learning.
      inputs: the network's encoding of what was seen before each action, packed, [N, F], with the graph that made it
        where parameters did that are learned; None where it is not kept.
      behaviour: data of the policy that acted; None where the round is not to be learned from with other parameters.
    """

    actions: np.ndarray
    rewards: np.ndarray
    lengths: np.ndarray
    answers: np.ndarray
    inputs: torch.Tensor | None = None
    behaviour: BehaviourData | None = None

    @property
    def num_frames(self) -> int:
        """Returns the number of steps played."""
        return int(self.lengths.sum())

    @property
    def played(self) -> np.ndarray:
        """Returns which steps were played, bool [T, B]."""
        return np.arange(len(self.actions))[:, None] < self.lengths

    @property
    def batch_sizes(self) -> torch.Tensor:
        """Returns how many episodes have a t-th step, int64 [T]."""
        return torch.from_numpy(self.played.sum(axis=1))

    def packed(self, array: np.ndarray) -> torch.Tensor:
        """Returns the steps of an array [T, B, ...] that were played, packed."""
        return torch.from_numpy(array[self.played])

    def select(self, episodes: np.ndarray | None = None) -> "Round":
        """Returns some episodes, or all, from the longest to the shortest, as the network unrolls them."""
        episodes = np.arange(len(self.lengths)) if episodes is None else episodes
        episodes = episodes[np.argsort(-self.lengths[episodes], kind="stable")]
        longest = self.lengths[episodes].max()
        places = self.played.ravel().cumsum().reshape(self.played.shape) - 1
        steps = torch.from_numpy(places[:longest, episodes][self.played[:longest, episodes]])
        return Round(
            self.actions[:longest, episodes],
            self.rewards[:longest, episodes],
            self.lengths[episodes],
            self.answers[episodes],
            None if self.inputs is None else self.inputs[steps.to(self.inputs.device)],
            self.behaviour and self.behaviour.select(steps),
        )

    def record(self) -> "Round":
        """Returns the same round without what is only for learning."""
        return dataclasses.replace(self, inputs=None, behaviour=None)

    def arrays(self) -> dict[str, np.ndarray]:
        """Returns everything as plain arrays by name: to be written, or sent by a process that ends."""
        named: dict[str, Any] = {**vars(self), **(vars(self.behaviour) if self.behaviour else {})}
        named |= named.pop("observation", {})
        del named["behaviour"]
        return {
            name: value.detach().cpu().numpy() if isinstance(value, torch.Tensor) else value
            for name, value in named.items()
            if value is not None
        }
