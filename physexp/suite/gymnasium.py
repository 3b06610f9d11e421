"""The environments for Gymnasium: one by one, and as a vector environment on a batch.

Importing this module registers every task, so that Gymnasium finds them by name with the module before it::

    gymnasium.make("physexp.suite.gymnasium:physexp/towers-fist_pixels-v0")
    gymnasium.make_vec("physexp.suite.gymnasium:physexp/towers-fist_pixels-v0", num_envs=64,
                       vectorization_mode="vector_entry_point")
"""

from typing import Any

from physexp import extras, suite

extras.require("gymnasium")

import gymnasium  # noqa: E402
from gymnasium import spaces  # noqa: E402
from gymnasium.vector import utils as vector_utils  # noqa: E402
from gymnasium.vector import vector_env  # noqa: E402
import numpy as np  # noqa: E402

_RENDER_SIZE = 480  # Pixels, for people.


def observation_space(spec) -> spaces.Dict:
    """Images are bounded by their type, features by nothing."""
    boxes: dict[str, spaces.Space] = {}
    for name, array in spec.items():
        is_image = array.dtype == np.uint8
        low, high = (0, 255) if is_image else (-np.inf, np.inf)
        boxes[name] = spaces.Box(low, high, array.shape, array.dtype)
    return spaces.Dict(boxes)


class Environment(gymnasium.Env):
    """One environment. Running out of time is a wrong answer, so every episode terminates and none is truncated.

    An episode whose simulation diverges is truncated: it has no outcome.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"]}

    def __init__(self, domain: str, task: str, render_mode: str | None = None, **task_kwargs: Any):
        """Loads an environment.

        Args:
          domain, task, task_kwargs: as for `suite.load`.
          render_mode: `rgb_array`, or None.

        Raises:
          ValueError: for an unknown name, a bad keyword argument or an unknown render mode.
        """
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode is {render_mode!r}; choose None or 'rgb_array'")
        self._environment = suite.load(domain, task, task_kwargs=task_kwargs)
        self._seeded = "random" in task_kwargs
        self.render_mode = render_mode
        self.metadata = {**self.metadata, "render_fps": round(1 / self._environment.control_timestep())}
        self.observation_space = observation_space(self._environment.observation_spec())
        self.action_space = spaces.Discrete(self._environment.action_spec().num_values)

    @property
    def dm_env(self) -> suite.Environment:
        """The environment behind it."""
        return self._environment

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None):
        """Starts the next episode, or with a seed the first one of that seed."""
        super().reset(seed=seed)
        if seed is not None or not self._seeded:
            self._environment.task.reseed(int(self.np_random.integers(2**32)) if seed is None else seed)
            self._seeded = True
        timestep = self._environment.reset()
        return dict(timestep.observation), {}

    def step(self, action):
        """Takes an action; after the last one of an episode, `info["correct_answer"]` is the right label."""
        diverged = self._environment.task.num_divergences
        timestep = self._environment.step(np.int32(action))
        lost = self._environment.task.num_divergences > diverged
        info = {"correct_answer": self._environment.task.correct_answer} if timestep.last() else {}
        return dict(timestep.observation), float(timestep.reward), timestep.last() and not lost, lost, info

    def render(self):
        """An image of the scene for people, uint8 [480, 480, 3]; None without a render mode."""
        if self.render_mode is None:
            return None
        return self._environment.physics.render(_RENDER_SIZE, _RENDER_SIZE, camera_id="observer")

    def close(self) -> None:
        self._environment.close()


class VectorEnvironment(vector_env.VectorEnv):
    """Many environments that step together.

    After an episode's end, the environment's next step ignores its action and starts the next episode
    (`AutoresetMode.NEXT_STEP`).
    """

    def __init__(self, domain: str, task: str, num_envs: int = 1, num_threads: int = 1, **task_kwargs: Any):
        """Loads a batch.

        Args:
          domain, task, task_kwargs: as for `suite.load`.
          num_envs: how many.
          num_threads: threads that simulate.

        Raises:
          ValueError: for an unknown name or a bad argument.
        """
        self._batch = suite.load_batch(domain, task, num_envs, task_kwargs, num_threads)
        self._seeded = "random" in task_kwargs
        self.num_envs = num_envs
        self.metadata = {"autoreset_mode": vector_env.AutoresetMode.NEXT_STEP}
        self.single_observation_space = observation_space(self._batch.observation_spec())
        self.single_action_space = spaces.Discrete(self._batch.action_spec().num_values)
        self.observation_space = vector_utils.batch_space(self.single_observation_space, num_envs)
        self.action_space = vector_utils.batch_space(self.single_action_space, num_envs)

    @property
    def batch(self) -> suite.BatchEnvironment:
        """The batch behind it."""
        return self._batch

    def reset(self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None):
        """Starts the next episode everywhere; with a seed, the first of each: `environment_seed(seed, i)`.

        Raises:
          ValueError: for a list of seeds; the batch derives them from one.
        """
        if seed is not None and not isinstance(seed, (int, np.integer)):
            raise ValueError(f"seed is {seed!r}; give one integer, from which those of all environments follow")
        super().reset(seed=seed)
        if seed is not None or not self._seeded:
            self._batch.reseed(int(self.np_random.integers(2**32)) if seed is None else int(seed))
            self._seeded = True
        return dict(self._batch.reset().observation), {}

    def step(self, actions):
        """Takes actions, int [num_envs]; `info["correct_answer"]` is filled in where an episode has ended."""
        timestep = self._batch.step(np.asarray(actions))
        ended = timestep.last()
        lost = ended & (timestep.reward == 0)  # Only a diverged simulation ends without a verdict.
        info = {}
        if ended.any():
            info = {"correct_answer": np.where(ended, self._batch.correct_answers, 0), "_correct_answer": ended}
        return dict(timestep.observation), timestep.reward, ended & ~lost, lost, info

    def close_extras(self, **kwargs: Any) -> None:
        self._batch.close()


def environment_id(domain: str, task: str) -> str:
    """The name under which a task is registered."""
    return f"physexp/{domain}-{task}-v0"


for _domain, _task in suite.ALL_TASKS:
    gymnasium.register(
        environment_id(_domain, _task),
        entry_point=f"{__name__}:Environment",
        vector_entry_point=f"{__name__}:VectorEnvironment",
        kwargs={"domain": _domain, "task": _task},
    )
