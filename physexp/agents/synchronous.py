"""Agents of one process, which play a round of whole episodes and learn from it in turns."""

from collections.abc import Generator, Mapping

import torch

from physexp.agents import core, guests, rounds


class SynchronousLearner(core.Learner):
    """Plays a round at each step, with the parameters that all rounds before have led to.

    Attributes:
      last_round: the round that was played last.
    """

    last_round: rounds.Round

    @property
    def next_episode(self) -> int:
        """Returns the index of the episodes that the next step plays."""
        return int(self.variables.rounds[0])


class SynchronousAgent(core.Agent):
    """Takes the steps of a learner."""

    def __init__(self, learner: SynchronousLearner, frames: int, seed: int, num_threads: int):
        """Takes a learner, the frames to train it for, and the seed of its environments.

        Convolutions are computed in `num_threads`; without images one thread is faster.
        """
        self._learner, self._max_frames, self._seed = learner, frames, seed
        self._num_threads = num_threads if learner.variables.network.sees_images else 1
        self._is_stopping = False

    @property
    def frames(self) -> int:
        """Returns the environment steps trained on."""
        return int(self._learner.variables.frames)

    def updates(self) -> Generator[core.Update | None, None, None]:
        """Yields each update until all frames are done or `stop` was called."""
        while not self._is_stopping and self.frames < self._max_frames:
            episode = self._learner.next_episode
            with guests.own_torch(self._num_threads):
                metrics = self._learner.step()
            yield core.Update(self._seed, episode, metrics, self._learner.last_round.record())

    def stop(self) -> None:
        """Asks it to end after the update under way; may be called by a signal's handler."""
        self._is_stopping = True

    def save(self) -> dict[str, torch.Tensor]:
        """Returns copies of all variables, by name."""
        return self._learner.save()

    def restore(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Takes up the tensors of `save`; raises ValueError if they do not fit."""
        self._learner.restore(tensors)
