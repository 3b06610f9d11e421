"""The replay memory: whole episodes, of which the oldest are replaced first."""

from collections.abc import Callable
import dataclasses
import functools
import math

import numpy as np
import torch

from physexp.agents import acting, processes, rounds

_LARGEST_SHARE = 0.5  # Of the memory that there is.


@dataclasses.dataclass(frozen=True)
class Episodes:
    """Episodes to learn from, B of them, padded to the longest.

    Attributes:
      inputs: the network's encoding of what was seen before each action, [N, F], of the steps that were played: all
        first steps, then all second steps, and so on.
      actions: int64 [T, B].
      rewards: of the last actions, float32 [B].
      lengths: actions in each episode, int64 [B].
      answers: the right labels, int64 [B]; to be learned from only where they are revealed.
      judges: the member of the network that judges each episode and does not learn from it, int64 [B], ascending.
    """

    inputs: torch.Tensor
    actions: torch.Tensor
    rewards: torch.Tensor
    lengths: torch.Tensor
    answers: torch.Tensor
    judges: torch.Tensor

    @property
    def played(self) -> torch.Tensor:
        """Returns which steps were played, bool [T, B]."""
        return torch.arange(len(self.actions))[:, None] < self.lengths

    def arrays(self) -> dict[str, np.ndarray]:
        """Returns everything as plain arrays by name."""
        return {name: value.numpy() for name, value in vars(self).items()}


class Replay:
    """Rounds of episodes, one episode in each of B environments.

    An episode follows from its seed, its index and its actions, so a checkpoint needs only the actions: `restore` plays
    them again.

    Attributes:
      actions: what was done, int16 [R, T, B], for the last R rounds; -1 where nothing was.
    """

    def __init__(self, num_rounds: int, longest: int, num_environments: int, num_inputs: int, dtype: type):
        """Makes room for rounds of episodes of at most `longest` actions, and for what was seen, as numbers of a type.

        Raises:
          ValueError: if they would take more than half of the memory that there is.
        """
        steps = num_rounds, longest, num_environments
        num_bytes = math.prod(steps) * num_inputs * np.dtype(dtype).itemsize
        memory = processes.memory()
        if num_bytes > _LARGEST_SHARE * memory:
            fitting = int(num_rounds * num_environments * _LARGEST_SHARE * memory / num_bytes)
            raise ValueError(
                f"{num_rounds * num_environments:,} episodes to learn from take {num_bytes / 1e9:.1f} GB, "
                f"and there are {memory / 1e9:.1f} GB; give replay_episodes at most {fitting}"
            )
        # Memory is taken when something is written to it.
        self._inputs: np.ndarray = np.zeros((*steps, num_inputs), dtype)
        self.actions = torch.full(steps, -1, dtype=torch.int16)
        self._rewards = np.zeros((num_rounds, num_environments), np.float32)
        self._answers = np.zeros(self._rewards.shape, np.int64)

    def add(self, played: rounds.Round, number: int) -> None:
        """Keeps the round `number`, with its inputs, in place of the one R rounds before."""
        assert played.inputs is not None
        slot, length = number % len(self.actions), len(played.actions)
        self.actions[slot] = -1
        self.actions[slot, :length] = torch.from_numpy(np.where(played.played, played.actions, -1))
        self._inputs[slot, :length][played.played] = played.inputs.cpu().numpy()
        self._rewards[slot] = played.rewards.sum(axis=0)
        self._answers[slot] = played.answers

    def restore(self, play: Callable[[int, acting.Choose], rounds.Round], num_rounds: int) -> None:
        """Plays the rounds in `actions` again, to get back what was observed.

        Args:
          play: plays the round of a number, and keeps its inputs.
          num_rounds: how many rounds were played in all.
        """
        actions = self.actions.numpy().astype(np.int64)
        for number in range(max(0, num_rounds - len(actions)), num_rounds):
            self.add(play(number, functools.partial(_again, actions[number % len(actions)])), number)

    def sample(self, generator: np.random.Generator, size: int, num_members: int, num_rounds: int) -> Episodes:
        """Returns episodes of the last of so many rounds, drawn with replacement, as many for each judge.

        Every K-th environment has the same one of K judges. `size` is a multiple of K, and there are K environments.
        """
        judges = np.arange(size) * num_members // size
        slots = generator.integers(min(num_rounds, len(self.actions)), size=size)
        num_theirs = (self.actions.shape[2] - 1 - judges) // num_members + 1
        environments = generator.integers(num_theirs) * num_members + judges
        lengths = (self.actions[slots, :, environments] >= 0).sum(1).numpy()
        longest = lengths.max()
        steps, columns = np.nonzero(np.arange(longest)[:, None] < lengths)
        return Episodes(
            torch.from_numpy(self._inputs[slots[columns], steps, environments[columns]]),
            self.actions[slots, :, environments].T[:longest].long().clamp(min=0),
            torch.from_numpy(self._rewards[slots, environments]),
            torch.from_numpy(lengths),
            torch.from_numpy(self._answers[slots, environments]),
            torch.from_numpy(judges),
        )


def _again(actions: np.ndarray, logits: torch.Tensor, active: np.ndarray, step: int) -> np.ndarray:
    """Chooses what was done before, [T, B]; see `acting.Choose`."""
    return actions[step, active]
