"""Rounds: whole episodes, one in each environment of a batch, as arrays to learn from and to record."""

import dataclasses

import numpy as np
import torch


@dataclasses.dataclass(frozen=True)
class Round:
    """Whole episodes, one in each environment of a batch, padded to the longest.

    The steps that were played can be packed: all first steps, then all second steps, and so on, [N, ...].

    Attributes:
      actions: actions taken, int64 [T, B].
      rewards: rewards that followed, float32 [T, B].
      lengths: actions in each episode, int64 [B].
      answers: the right labels, int64 [B].
      inputs: encoded observations before each action, packed, [N, F], with the graph that made them; None if not kept.
      observation: observations before each action, packed, arrays [N, ...] by name; empty if not kept.
      log_probabilities: of the actions under the policy that took them, packed, float32 [N]; None if not kept.
      values: that policy's estimates of the return, packed, float32 [N]; None if not kept.
    """

    actions: np.ndarray
    rewards: np.ndarray
    lengths: np.ndarray
    answers: np.ndarray
    inputs: torch.Tensor | None = None
    observation: dict[str, torch.Tensor] = dataclasses.field(default_factory=dict)
    log_probabilities: torch.Tensor | None = None
    values: torch.Tensor | None = None

    @property
    def num_frames(self) -> int:
        """Returns the number of steps played."""
        return int(self.lengths.sum())

    @property
    def played(self) -> np.ndarray:
        """Returns which steps were played, bool [T, B]."""
        return np.arange(len(self.actions))[:, None] < self.lengths

    @property
    def is_last(self) -> np.ndarray:
        """Returns which step is the last of its episode, bool [T, B]."""
        return np.arange(len(self.actions))[:, None] == self.lengths - 1

    @property
    def batch_sizes(self) -> torch.Tensor:
        """Returns how many episodes have a t-th step, int64 [T]."""
        return torch.from_numpy(self.played.sum(axis=1))

    def packed(self, array: np.ndarray) -> torch.Tensor:
        """Returns the steps of an array [T, B, ...] that were played, packed."""
        return torch.from_numpy(array[self.played])

    def padded(self, packed: torch.Tensor) -> torch.Tensor:
        """Returns packed steps, [N, ...], as [T, B, ...], 0 after an episode's end."""
        padded = packed.new_zeros((*self.actions.shape, *packed.shape[1:]))
        padded[torch.from_numpy(self.played).to(packed.device)] = packed
        return padded

    def select(self, episodes: np.ndarray | None = None) -> "Round":
        """Returns some episodes, or all, from the longest to the shortest, as the network unrolls them."""
        episodes = np.arange(len(self.lengths)) if episodes is None else episodes
        episodes = episodes[np.argsort(-self.lengths[episodes], kind="stable")]
        longest = self.lengths[episodes].max()
        places = self.played.ravel().cumsum().reshape(self.played.shape) - 1
        steps = torch.from_numpy(places[:longest, episodes][self.played[:longest, episodes]])
        packed = {"inputs": self.inputs, "log_probabilities": self.log_probabilities, "values": self.values}
        return Round(
            self.actions[:longest, episodes],
            self.rewards[:longest, episodes],
            self.lengths[episodes],
            self.answers[episodes],
            observation={name: array[steps] for name, array in self.observation.items()},
            **{name: array[steps.to(array.device)] for name, array in packed.items() if array is not None},
        )

    def record(self) -> "Round":
        """Returns the part that is recorded: actions, rewards, lengths and answers."""
        return Round(self.actions, self.rewards, self.lengths, self.answers)

    def arrays(self) -> dict[str, np.ndarray]:
        """Returns everything as plain arrays by name: to be written, or sent by a process that ends."""
        named = {**vars(self), **self.observation}
        del named["observation"]
        return {
            name: value.detach().cpu().numpy() if isinstance(value, torch.Tensor) else value
            for name, value in named.items()
            if value is not None
        }
