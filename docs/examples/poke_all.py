"""An agent of a dozen lines, played with ours."""

import numpy as np

from physexp import suite
from physexp.agents import core, environment_loop


class PokeAllThenAnswer(core.Actor):
    """Pokes each block once, then names the one that rose least right after its poke."""

    def observe_first(self, timestep):
        self.rises = []

    def select_action(self, observation):
        return len(self.rises) if len(self.rises) < 4 else 4 + int(np.argmin(self.rises))

    def observe(self, action, next_timestep):
        if action < 4:
            self.rises.append(next_timestep.observation["heights"][action])

    def update(self):
        pass


def play(num_episodes=20):
    """Plays Which is Heavier; returns the episodes' returns."""
    environment = suite.load("which_is_heavier", "features", task_kwargs={"random": 0, "difficulty": 3})
    episodes = environment_loop.EnvironmentLoop(environment, PokeAllThenAnswer()).run(num_episodes)
    return [episode["episode_return"] for episode in episodes]


if __name__ == "__main__":
    print(play())
