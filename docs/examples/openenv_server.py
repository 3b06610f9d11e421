"""Serves a task in words to OpenEnv (https://github.com/meta-pytorch/OpenEnv), on this machine alone.

python openenv_server.py strings/features serves until it is interrupted; without a task, OpenEnv's own client plays
Threshold by halving.
"""

import sys
import threading
import time

from openenv.core import generic_client
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


def halve(client):
    """Plays an episode of Threshold by halving, from the texts; returns its return and the number of its actions."""
    client.reset()
    low, high, actions = 0, 7, 1
    while low < high:
        middle, actions = (low + high) // 2, actions + 1
        told = client.step({"text": f"experiment({middle})"}).observation["text"]
        low, high = (low, middle) if "slid = [1]" in told else (middle + 1, high)
    return client.step({"text": f"answer({low})"}).reward, actions


if __name__ == "__main__":
    names = (sys.argv[1] if sys.argv[1:] else "threshold/features").split("/")
    app = http_server.create_fastapi_app(lambda: Experiments(*names), Said, Told, max_concurrent_envs=8)
    if sys.argv[1:]:
        uvicorn.run(app, port=8000)
    else:
        # OpenEnv's server logs an error of its own when a client leaves.
        server = uvicorn.Server(uvicorn.Config(app, port=8000, log_level="critical"))
        threading.Thread(target=server.run, daemon=True).start()
        while not server.started:
            time.sleep(0.1)
        with generic_client.GenericEnvClient(base_url="http://127.0.0.1:8000").sync() as client:
            begun = time.monotonic()
            returns, actions = zip(*(halve(client) for _ in range(10)), strict=True)
            each = 1000 * (time.monotonic() - begun) / sum(actions)
        print(f"10 episodes, mean return {sum(returns) / 10:.4f}, {each:.1f} ms an action")
