"""The environments for Gymnasium: one by one, and as a vector environment on a batch.

Importing this module registers every task, so that Gymnasium finds them by name with the module before it::

    gymnasium.make("physexp.suite.gymnasium:physexp/towers-fist_pixels-v0")
    gymnasium.make_vec("physexp.suite.gymnasium:physexp/towers-fist_pixels-v0", num_envs=64,
                       vectorization_mode="vector_entry_point")
"""

from collections.abc import Sequence
import math
from typing import Any

import dm_env

from physexp import checks, extras, suite
from physexp.suite.engine import batch as batch_lib
from physexp.suite.engine import rendering, seeding

extras.require("gymnasium")

import gymnasium  # noqa: E402
from gymnasium import error, spaces  # noqa: E402
from gymnasium.vector import utils as vector_utils  # noqa: E402
from gymnasium.vector import vector_env  # noqa: E402
import numpy as np  # noqa: E402

_LARGEST_GRID = 1920  # Pixels, of the images of many environments side by side.


def observation_space(spec) -> spaces.Dict:
    """Images are bounded by their type, features by what the task knows of them."""
    boxes: dict[str, spaces.Space] = {}
    for name, array in spec.items():
        low: Any
        high: Any
        if isinstance(array, dm_env.specs.BoundedArray):
            low, high = (np.broadcast_to(side, array.shape) for side in (array.minimum, array.maximum))
        else:
            low, high = (0, 255) if array.dtype == np.uint8 else (-np.inf, np.inf)
        boxes[name] = spaces.Box(low, high, array.shape, array.dtype)
    return spaces.Dict(boxes)


def check_render_mode(render_mode: str | None, known: tuple[str, ...] = ("rgb_array",)) -> None:
    """Raises ValueError unless the render mode is None or one of `known`."""
    if render_mode is not None and render_mode not in known:
        choices = " or ".join(map(repr, (None, *known)))
        raise ValueError(f"render_mode is {checks.shown(render_mode)}; choose {choices}")


def check_num_envs(num_envs: int) -> int:
    """Returns the number of environments as an int; raises ValueError if it is out of range."""
    return checks.integer("num_envs", num_envs, 1, batch_lib.MOST_ENVIRONMENTS)


def check_seed(seed: Any) -> int | None:
    """Returns a seed as an int, or None; raises ValueError if it is neither None nor an integer in [0, 2**63)."""
    return None if seed is None else checks.integer("seed", seed, 0, seeding.LARGEST_SEED)


def images(batch: suite.BatchEnvironment) -> tuple[np.ndarray, ...]:
    """Returns one image for each environment, uint8 [size, size, 3]; the more environments, the smaller the images.

    Side by side they fit into a square of 1920 pixels: up to 16 environments are drawn with 480 pixels, 64 with 240.
    """
    a_side = math.ceil(math.sqrt(batch.num_environments))
    return tuple(batch.render(min(rendering.SIZE_FOR_PEOPLE, _LARGEST_GRID // a_side)))


def grid(drawn: Sequence[np.ndarray]) -> np.ndarray:
    """Returns images [size, size, 3] as one, row by row in a square; places that are left over are black."""
    a_side, size = math.ceil(math.sqrt(len(drawn))), len(drawn[0])
    rows = math.ceil(len(drawn) / a_side)
    tiles = np.zeros((rows * a_side, *drawn[0].shape), np.uint8)
    tiles[: len(drawn)] = drawn
    return tiles.reshape(rows, a_side, size, size, 3).swapaxes(1, 2).reshape(rows * size, a_side * size, 3)


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
        check_render_mode(render_mode)
        self._environment = suite.load(domain, task, task_kwargs=task_kwargs)
        self._seeded = "random" in task_kwargs
        self._playing = False
        self.render_mode = render_mode
        self.metadata = {**self.metadata, "render_fps": frames_per_second(self._environment.task)}
        self.observation_space = observation_space(self._environment.observation_spec())
        self.action_space = spaces.Discrete(self._environment.action_spec().num_values)

    @property
    def dm_env(self) -> suite.Environment:
        """The dm_env environment that this one wraps."""
        return self._environment

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None):
        """Starts the next episode, or with a seed the first one of that seed.

        Raises:
          ValueError: for a seed that is no integer in [0, 2**63).
        """
        seed = check_seed(seed)
        super().reset(seed=seed)
        if seed is not None or not self._seeded:
            self._environment.task.reseed(int(self.np_random.integers(2**32)) if seed is None else seed)
            self._seeded = True
        timestep = self._environment.reset()
        self._playing = True
        return dict(timestep.observation), {}

    def step(self, action):
        """Takes an action; after the last one of an episode, `info["correct_answer"]` is the right label.

        Raises:
          ValueError: if the action is not one of the action space's; the episode stays as it was.
          gymnasium.error.ResetNeeded: if no episode has begun, or it is over.
        """
        check_started(self._playing)
        diverged = self._environment.task.num_divergences
        timestep = self._environment.step(action)
        self._playing = not timestep.last()
        lost = self._environment.task.num_divergences > diverged
        info = {"correct_answer": self._environment.task.correct_answer} if timestep.last() else {}
        return dict(timestep.observation), float(timestep.reward), timestep.last() and not lost, lost, info

    def render(self):
        """Returns an image of the scene for people, uint8 [480, 480, 3]; None without a render mode."""
        return None if self.render_mode is None else self._environment.render()

    def close(self) -> None:
        self._environment.close()


class VectorEnvironment(vector_env.VectorEnv):
    """Many environments that step together.

    After an episode's end, the environment's next step ignores its action and starts the next episode
    (`AutoresetMode.NEXT_STEP`).
    """

    metadata: dict[str, Any] = {
        "render_modes": ["rgb_array", "rgb_array_grid"],
        "autoreset_mode": vector_env.AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        domain: str,
        task: str,
        num_envs: int = 1,
        num_threads: int = 1,
        render_mode: str | None = None,
        **task_kwargs: Any,
    ):
        """Loads a batch.

        Args:
          domain, task, task_kwargs: as for `suite.load`.
          num_envs: how many.
          num_threads: threads that simulate.
          render_mode: `rgb_array` for an image of each environment, as Gymnasium's wrappers want them, `rgb_array_grid`
            for one image of all, or None.

        Raises:
          ValueError: for an unknown name or a bad argument.
        """
        check_render_mode(render_mode, ("rgb_array", "rgb_array_grid"))
        num_envs = check_num_envs(num_envs)
        self._batch = suite.load_batch(domain, task, num_envs, task_kwargs, num_threads)
        self._seeded = "random" in task_kwargs
        self._started = False
        self.num_envs = num_envs
        self.render_mode = render_mode
        self.metadata = {**self.metadata, "render_fps": frames_per_second(self._batch.task)}
        self.single_observation_space = observation_space(self._batch.observation_spec())
        self.single_action_space = spaces.Discrete(self._batch.action_spec().num_values)
        self.observation_space = vector_utils.batch_space(self.single_observation_space, num_envs)
        self.action_space = vector_utils.batch_space(self.single_action_space, num_envs)

    @property
    def batch(self) -> suite.BatchEnvironment:
        """The batch that this one wraps."""
        return self._batch

    def reset(self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None):
        """Starts the next episode everywhere; with a seed, the first of each: `environment_seed(seed, i)`.

        Raises:
          ValueError: for a list of seeds: the batch derives them from one, an integer in [0, 2**63); or for a
            `reset_mask` among the options.
        """
        seed = check_seed(seed)
        if "reset_mask" in (options or {}):
            raise ValueError("options has a reset_mask; reset all: where an episode has ended, a step begins the next")
        super().reset(seed=seed)
        if seed is not None or not self._seeded:
            self._batch.reseed(int(self.np_random.integers(2**32)) if seed is None else seed)
            self._seeded = True
        timestep = self._batch.reset()
        self._started = True
        return dict(timestep.observation), {}

    def step(self, actions):
        """Takes actions, int [num_envs]; `info["correct_answer"]` is filled in where an episode has ended.

        Raises:
          ValueError: if an action is not one of the action space's; nothing has moved then.
          gymnasium.error.ResetNeeded: if `reset` has never been called.
        """
        check_started(self._started)
        timestep = self._batch.step(actions)
        ended = timestep.last()
        lost = ended & (timestep.reward == 0)  # Only a diverged simulation ends without a verdict.
        info = {}
        if ended.any():
            info = {"correct_answer": np.where(ended, self._batch.correct_answers, 0), "_correct_answer": ended}
        return dict(timestep.observation), timestep.reward, ended & ~lost, lost, info

    def render(self):
        """Returns images for people (see `images`), as the render mode says: a tuple, or one; None without a mode."""
        if self.render_mode is None:
            return None
        drawn = images(self._batch)
        return drawn if self.render_mode == "rgb_array" else grid(drawn)

    def close_extras(self, **kwargs: Any) -> None:
        self._batch.close()


def frames_per_second(task) -> int:
    """Returns how many images a second of an episode has."""
    return max(1, round(1 / task.control_timestep))


def check_started(started: bool) -> None:
    """Raises `gymnasium.error.ResetNeeded` if no episode has begun."""
    if not started:
        raise error.ResetNeeded("there is no episode to step in; call reset() first")


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
