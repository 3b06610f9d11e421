"""What agents of one process have in common: they play a round of whole episodes, learn from it, and so on."""

from physexp.agents import core, guests, learning, rounds


class SynchronousLearner(core.Learner):
    """Plays a round at each step, with all that was learned from the rounds before.

    Attributes:
      variables: what training changes.
      last_round: the round that was played last.
    """

    variables: learning.Variables
    last_round: rounds.Round

    @property
    def next_episode(self) -> int:
        """Returns the index of the episodes that the next step plays."""
        return int(self.variables.rounds[0])

    def get_variables(self):
        return learning.network_variables(self.save())

    def save(self):
        return self.variables.save()

    def restore(self, state):
        self.variables.restore(state)


class SynchronousAgent(core.Agent):
    """Takes the steps of a learner, one after the other."""

    def __init__(self, learner: SynchronousLearner, frames: int, seed: int, num_threads: int):
        """Takes a learner.

        Args:
          learner: the learner.
          frames: environment steps to train for.
          seed: seed of its environments.
          num_threads: threads for convolutions.
        """
        self._learner, self._most_frames, self._seed, self._num_threads = learner, frames, seed, num_threads
        self._stopping = False

    @property
    def frames(self):
        return self._learner.variables.frames.item()

    def updates(self, poll_seconds=0.5):
        # More of them than the images' convolutions can use only wait for each other.
        num_threads = self._num_threads if self._learner.variables.network.sees_images else 1
        while not self._stopping and self.frames < self._most_frames:
            episode = self._learner.next_episode
            with guests.own_torch(num_threads):
                metrics = self._learner.step()
            yield core.Update(self._seed, episode, metrics, self._learner.last_round.record())

    def stop(self):
        self._stopping = True

    def save(self):
        return self._learner.save()

    def restore(self, tensors):
        self._learner.restore(tensors)
