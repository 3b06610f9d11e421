"""The replay memory of whole episodes; new ones replace the oldest."""

from collections.abc import Callable
import functools
import math

import numpy as np
import torch

from physexp.agents import acting, networks, processes, rounds

_LARGEST_SHARE = 0.5  # Of the machine's memory.


class Replay:
    """Rounds of episodes, one episode in each of B environments.

    An episode follows from its seed, its index and its actions, so a checkpoint needs only the actions: `restore` plays
    them again.

    Attributes:
      actions: the actions of the last R rounds, int16 [R, T, B]; -1 after an episode's end.
    """

    def __init__(self, num_rounds: int, longest: int, num_environments: int, num_inputs: int, dtype: type):
        """Makes room for rounds of episodes of at most `longest` actions, and for their inputs as numbers of a type.

        Raises ValueError if they would take more than half of the machine's memory.
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
        self._rewards = np.zeros(steps, np.float32)
        self._answers = np.zeros((num_rounds, num_environments), np.int64)

    def add(self, played: rounds.Round, number: int) -> None:
        """Keeps the round `number`, with its inputs, in place of the one R rounds before."""
        assert played.inputs is not None
        slot, length = number % len(self.actions), len(played.actions)
        self.actions[slot] = -1
        self.actions[slot, :length] = torch.from_numpy(np.where(played.played, played.actions, -1))
        self._inputs[slot, :length][played.played] = played.inputs.cpu().numpy()
        self._rewards[slot] = 0
        self._rewards[slot, :length] = played.rewards
        self._answers[slot] = played.answers

    def restore(self, play: Callable[[int, acting.Choose], rounds.Round], num_rounds: int) -> None:
        """Has `play`, which keeps inputs, play again the rounds in `actions`, the last of `num_rounds`."""
        actions = self.actions.numpy().astype(np.int64)
        for number in range(max(0, num_rounds - len(actions)), num_rounds):
            self.add(play(number, functools.partial(_again, actions[number % len(actions)])), number)

    def sample(
        self, generator: np.random.Generator, size: int, ensemble_size: int, num_rounds: int
    ) -> tuple[rounds.Round, torch.Tensor]:
        """Draws B episodes, `size`, of the last of `num_rounds` rounds, equally many for each of K held-out members.

        Every K-th environment has the same held-out member; B is a multiple of K. Returns the episodes, drawn with
        replacement, and their held-out members, int64 [B], ascending.
        """
        held_out = np.arange(size) * ensemble_size // size
        slots = generator.integers(min(num_rounds, len(self.actions)), size=size)
        num_theirs = (self.actions.shape[2] - 1 - held_out) // ensemble_size + 1
        environments = generator.integers(num_theirs) * ensemble_size + held_out
        actions = self.actions.numpy()[slots, :, environments]
        lengths = (actions >= 0).sum(1)
        longest = lengths.max()
        steps, columns = np.nonzero(np.arange(longest)[:, None] < lengths)
        episodes = rounds.Round(
            actions.T[:longest].astype(np.int64).clip(min=0),
            self._rewards[slots, :, environments].T[:longest],
            lengths,
            self._answers[slots, environments],
            torch.from_numpy(self._inputs[slots[columns], steps, environments[columns]]),
        )
        return episodes, torch.from_numpy(held_out)


def _again(actions: np.ndarray, output: networks.Output, active: np.ndarray, step: int) -> np.ndarray:
    """Chooses the actions of before, [T, B]; see `acting.Choose`."""
    chosen: np.ndarray = actions[step, active]
    return chosen
