"""Observers of the environment loop that tests share."""

from physexp.agents import environment_loop


class Watcher(environment_loop.Observer):
    """Keeps the observations and actions of the last episode.

    Attributes:
      seen: the observation before each action, and the last one.
      actions: the actions.
    """

    def observe_first(self, environment, timestep):
        self.seen, self.actions = [timestep.observation], []

    def observe(self, environment, timestep, action):
        self.seen.append(timestep.observation)
        self.actions.append(action)
