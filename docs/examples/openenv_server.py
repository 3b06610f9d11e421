"""Serves a task in words to OpenEnv (https://github.com/meta-pytorch/OpenEnv), on this machine alone.

python openenv_server.py strings/features
"""

import sys

from openenv.core.env_server import http_server, interfaces, types
import uvicorn

from physexp import suite
from physexp.suite import words


class Said(types.Action):
    """A reply of the player, with calls such as experiment(2)."""

    text: str


class Told(types.Observation):
    """The replies to the calls."""

    text: str


class Experiments(interfaces.Environment):
    """Plays one episode of a task after another; the last reward of an episode is its discounted return."""

    SUPPORTS_CONCURRENT_SESSIONS = True

    def __init__(self, domain, task):
        super().__init__()
        self._environment = suite.load(domain, task)
        self._episode = words.Episode(self._environment)

    def reset(self, seed=None, episode_id=None, **kwargs):
        """Begins the next episode, or the first one of a seed; tells its rules and its readings."""
        if seed is not None:
            self._environment.task.reseed(seed)
        self._episode = words.Episode(self._environment)
        return Told(text="\n\n".join(message["content"] for message in self._episode.messages()))

    def step(self, action, timeout_s=None, **kwargs):
        """Makes the calls in a reply."""
        told, is_over = self._episode.say(action.text), self._episode.is_over
        return Told(text=told, done=is_over, reward=self._episode.record()["return"] if is_over else 0.0)

    @property
    def state(self):
        """The index of the episode, and the number of its actions."""
        return types.State(episode_id=str(self._episode.index), step_count=len(self._episode.actions))

    def close(self):
        """Frees the simulation."""
        self._environment.close()


if __name__ == "__main__":
    names = sys.argv[1].split("/")
    app = http_server.create_fastapi_app(lambda: Experiments(*names), Said, Told, max_concurrent_envs=8)
    uvicorn.run(app, port=8000)
