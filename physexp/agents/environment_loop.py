"""Plays episodes of any dm_env environment with any actor."""

from collections.abc import Sequence
from typing import Any

import dm_env

from physexp.agents import core


class Observer:
    """Watches episodes without taking part."""

    def observe_first(self, environment: dm_env.Environment, timestep: dm_env.TimeStep) -> None:
        """Notes the first timestep of an episode."""

    def observe(self, environment: dm_env.Environment, timestep: dm_env.TimeStep, action: int) -> None:
        """Notes an action and the timestep that followed."""

    def get_metrics(self) -> dict[str, Any]:
        """Returns the metrics of the episode that has just ended."""
        return {}


class EnvironmentLoop:
    """Runs an actor in an environment, episode by episode."""

    def __init__(self, environment: dm_env.Environment, actor: core.Actor, observers: Sequence[Observer] = ()):
        self._environment, self._actor, self._observers = environment, actor, tuple(observers)

    def run_episode(self) -> dict[str, Any]:
        """Plays one episode; returns `episode_length`, `episode_return` and the metrics of the observers."""
        timestep = self._environment.reset()
        self._actor.observe_first(timestep)
        for observer in self._observers:
            observer.observe_first(self._environment, timestep)
        length, episode_return = 0, 0.0
        while not timestep.last():
            action = self._actor.select_action(timestep.observation)
            timestep = self._environment.step(action)
            self._actor.observe(action, timestep)
            for observer in self._observers:
                observer.observe(self._environment, timestep, action)
            self._actor.update()
            length += 1
            episode_return += timestep.reward
        metrics = {"episode_length": length, "episode_return": episode_return}
        for observer in self._observers:
            metrics.update(observer.get_metrics())
        return metrics

    def run(self, num_episodes: int) -> list[dict[str, Any]]:
        """Plays episodes; returns the metrics of each; raises ValueError for a number below one."""
        if num_episodes < 1:
            raise ValueError(f"num_episodes is {num_episodes}; give a number >= 1")
        return [self.run_episode() for _ in range(num_episodes)]


class Repeat(core.Actor):
    """Repeats the actions of an episode."""

    def __init__(self, actions: Sequence[int]):
        self._actions, self._step = actions, 0

    def observe_first(self, timestep: dm_env.TimeStep) -> None:
        """Goes back to the first action."""
        self._step = 0

    def select_action(self, observation: Any) -> int:
        """Returns the next action; raises ValueError if there is none."""
        if self._step == len(self._actions):
            raise ValueError(f"the episode goes on after its {self._step} actions; some are missing")
        return int(self._actions[self._step])

    def observe(self, action: int, next_timestep: dm_env.TimeStep) -> None:
        """Goes on to the next action; raises ValueError if the episode is over before it."""
        self._step += 1
        if next_timestep.last() and self._step < len(self._actions):
            raise ValueError(f"the episode ends after {self._step} of its {len(self._actions)} actions")
