"""Agents of one process, which play a round of whole episodes and learn from it in turns."""

from collections.abc import Generator

from physexp.agents import core, devices, rounds, starting
from physexp.agents.belief import config as belief
from physexp.agents.ppo import config as ppo


class SynchronousAgent(core.Agent, core.Learner):
    """Plays a round at each step, with the parameters that all rounds before have led to.

    Attributes:
      last_round: the round that was played last.
    """

    last_round: rounds.Round

    def __init__(
        self,
        make_environment: core.EnvironmentFactory,
        num_environments: int,
        config: belief.BeliefConfig | ppo.PPOConfig,
    ):
        """Makes the environments."""
        self._max_frames, self._num_threads = config.frames, config.num_threads
        self._seed = starting.worker_seed(config.seed, 0)
        self._environment = make_environment(self._seed, num_environments, config.num_threads)

    @property
    def next_episode(self) -> int:
        """Returns the index of the episodes that the next step plays."""
        return int(self.variables.rounds[0])

    def updates(self) -> Generator[core.Update | None, None, None]:
        """Yields each update until all frames are done or `stop` was called."""
        # Convolutions are computed in all threads; without images one thread is faster.
        num_threads = self._num_threads if self.variables.network.sees_images else 1
        while not self._is_stopping and self.frames < self._max_frames:
            episode = self.next_episode
            with devices.own_torch(num_threads):
                metrics = self.step()
            yield core.Update(self._seed, episode, metrics, self.last_round.record())
