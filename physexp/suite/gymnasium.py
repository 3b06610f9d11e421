"""The environments for Gymnasium: one by one, and as a vector environment on a batch.

Importing this module registers every version of every task, so that Gymnasium finds them by name with the module
before it::

    gymnasium.make("physexp.suite.gymnasium:physexp/towers-fist_pixels-v0")
    gymnasium.make_vec("physexp.suite.gymnasium:physexp/towers-fist_pixels-v0", num_envs=64,
                       vectorization_mode="vector_entry_point")
"""

from collections.abc import Mapping
import dataclasses
import inspect
import math
from typing import Any, NoReturn

import dm_env

from physexp import checks, extras, suite
from physexp.suite.engine import batch as batch_lib
from physexp.suite.engine import contract, episodes, rendering, seeding

extras.require("gymnasium")

import gymnasium  # noqa: E402
from gymnasium import error, spaces  # noqa: E402
from gymnasium.vector import utils as vector_utils  # noqa: E402
from gymnasium.vector import vector_env  # noqa: E402
import numpy as np  # noqa: E402

Observation = dict[str, np.ndarray] | np.ndarray
Infos = dict[str, Any]

RENDER_MODE = checks.optional(checks.word("rgb_array"))
"""The check of how one environment is drawn: as an array, or not at all."""

_RENDER_MODE_OF_MANY = checks.optional(checks.word("rgb_array", "rgb_array_grid"))
_SEED = checks.optional(checks.whole(0, seeding.LARGEST_SEED))
_LARGEST_GRID = 1920  # Pixels, of the images of many environments side by side.


def observation_space(spec: Mapping[str, dm_env.specs.Array], is_flat: bool = False) -> spaces.Space[Any]:
    """Returns the space of observations, of flattened ones if `is_flat`; features have the bounds of their specs."""
    boxes: dict[str, spaces.Space[Any]] = {}
    for name, array in spec.items():
        low: Any
        high: Any
        low, high = (0, 255) if array.dtype == np.uint8 else (-np.inf, np.inf)
        if isinstance(array, dm_env.specs.BoundedArray):
            low, high = (np.broadcast_to(side, array.shape) for side in (array.minimum, array.maximum))
        boxes[name] = spaces.Box(low, high, array.shape, array.dtype)
    return spaces.flatten_space(spaces.Dict(boxes)) if is_flat else spaces.Dict(boxes)


class Environment(gymnasium.Env[Any, Any]):
    """One environment. Running out of time is a wrong answer, so every episode terminates and none is truncated.

    An episode whose simulation diverges is truncated: it has no outcome.

    Attributes:
      dm_env: the dm_env environment behind this one.
      discount: gamma of the returns that are scored; rewards are not discounted by the environment.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"]}

    def __init__(
        self, domain: str, task: str, render_mode: str | None = None, flat_observation: bool = False, **task_kwargs: Any
    ):
        """Loads an environment.

        Args:
          domain, task, task_kwargs: as for `suite.load`.
          render_mode: `rgb_array`, or None.
          flat_observation: observe one vector of all arrays, sorted by name.
        """
        RENDER_MODE("render_mode", render_mode)
        _refuse_unknown(Environment, domain, task_kwargs)
        self.dm_env = suite.load(domain, task, task_kwargs, {"flat_observation": flat_observation})
        played = self.dm_env.task
        self.discount: float = played.discount
        self._is_flat = flat_observation
        self._playing = False
        self.render_mode = render_mode
        self.metadata = {**self.metadata, "render_fps": _frames_per_second(played)}
        self.observation_space = observation_space(played.observation_spec(), self._is_flat)
        self.action_space = spaces.Discrete(played.rules.num_actions)
        super().reset(seed=played.options.random)  # `np_random_seed` is the seed that is played.

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Observation, Infos]:
        """Starts the next episode, or with a seed, in [0, 2**63), the first one of that seed.

        The option `episode` is the index of another one. A reset with `info["seed"]` as the seed and
        `info["episode_index"]` as the option `episode` starts an episode again.
        """
        seed, options = _SEED("seed", seed), _check_options(options, "episode")
        super().reset(seed=seed)
        task = self.dm_env.task
        if seed is not None:
            task.reseed(seed)
        task.next_episode = options.get("episode", task.next_episode)
        timestep = self.dm_env.reset()
        self._playing = True
        return self._shown(timestep.observation), {"seed": task.options.random, "episode_index": task.episode}

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, Infos]:
        """Takes an action.

        After the last one of an episode, `info` has `correct_answer`, the index of the right label, of the last
        question; `discounted_return` with the task's gamma; and `is_success`, whether all answers were right.

        Raises:
          ValueError: if the action is not one of the action space's; the episode stays as it was.
          gymnasium.error.ResetNeeded: if no episode has begun, or it is over.
        """
        _check_started(self._playing)
        task = self.dm_env.task
        diverged = task.num_divergences
        timestep = self.dm_env.step(action)
        ended, lost = timestep.last(), task.num_divergences > diverged
        self._playing = not ended
        info = {}
        if ended:
            info = {name: values.item() for name, values in _outcomes(task.ledger, task).items()}
        return self._shown(timestep.observation), float(timestep.reward), ended and not lost, lost, info

    def render(self) -> Any:
        """Returns an image of the scene for people, uint8 [480, 480, 3]; None without a render mode."""
        return None if self.render_mode is None else self.dm_env.render()

    def close(self) -> None:
        self.dm_env.close()

    def __reduce__(self) -> NoReturn:  # Of copies and of pickles.
        self.dm_env.__reduce__()

    def _shown(self, observation: Mapping[str, np.ndarray]) -> Observation:
        return observation["observations"] if self._is_flat else dict(observation)


class VectorEnvironment(vector_env.VectorEnv[Any, Any, Any]):
    """Many environments that step together; `autoreset_mode` says when the next episode starts after an end.

    - `next_step`: the environment's next step ignores its action and starts it.
    - `same_step`: the same step starts it; `final_obs` and `final_info` are the last ones of the episode that ended.
    - `disabled`: a reset with the option `reset_mask` starts it.

    Observations, rewards and infos are those of Gymnasium's own `SyncVectorEnv` of single environments.

    Attributes:
      batch: the batch behind this environment.
      discount: as in `Environment`.
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
        flat_observation: bool = False,
        autoreset_mode: str | vector_env.AutoresetMode = vector_env.AutoresetMode.NEXT_STEP,
        max_episode_steps: int | None = None,
        **task_kwargs: Any,
    ):
        """Loads a batch.

        Args:
          domain, task, task_kwargs, num_threads: as for `suite.load_batch`.
          num_envs: number of environments.
          render_mode: `rgb_array` for an image of each environment, as Gymnasium's wrappers want them, `rgb_array_grid`
            for one image of all, or None.
          flat_observation: observe one vector of all arrays, sorted by name.
          autoreset_mode: `next_step`, `same_step` or `disabled`, or one of Gymnasium's `AutoresetMode`.
          max_episode_steps: Gymnasium's own limit; episodes end by themselves, so it may not be less than the task's.
        """
        _RENDER_MODE_OF_MANY("render_mode", render_mode)
        self.num_envs = checks.integer("num_envs", num_envs, 1, batch_lib.MOST_ENVIRONMENTS)
        self.autoreset_mode = _check_autoreset_mode(autoreset_mode)
        self._is_flat = checks.flag("flat_observation", flat_observation)
        _refuse_unknown(VectorEnvironment, domain, task_kwargs)
        self.batch = suite.load_batch(domain, task, num_envs, task_kwargs, num_threads)
        played = self.batch.task
        self.discount: float = played.discount
        if max_episode_steps is not None:
            checks.integer("max_episode_steps", max_episode_steps, played.rules.step_limit)
        self._observation = played.observer.blank(num_envs)
        self._ended = np.zeros(num_envs, bool)
        self._started = False
        self.render_mode = render_mode
        told = {"autoreset_mode": self.autoreset_mode, "render_fps": _frames_per_second(played)}
        self.metadata = {**self.metadata, **told}
        self.single_observation_space = observation_space(played.observation_spec(), self._is_flat)
        self.single_action_space = spaces.Discrete(played.rules.num_actions)
        self.observation_space = vector_utils.batch_space(self.single_observation_space, num_envs)
        self.action_space = vector_utils.batch_space(self.single_action_space, num_envs)
        super().reset(seed=played.options.random)  # `np_random_seed` is the seed that is played.

    def reset(self, *, seed: Any = None, options: dict[str, Any] | None = None) -> tuple[Observation, Infos]:
        """Starts the next episode everywhere; with a seed, the first of each: `environment_seed(seed, i)`.

        The options are `episode`, the index of the episode to start in place of the next one, and `reset_mask`, bool
        [num_envs], true for the environments to reset, which are all at first.
        """
        seed, options = _SEED("seed", seed), _check_options(options, "episode", "reset_mask")
        mask = self._check_mask(options.get("reset_mask"), seed)
        super().reset(seed=seed)
        if seed is not None:
            self.batch.reseed(seed)
        infos = self._begin(mask, options.get("episode"))
        self._started = True
        return self._shown(), infos

    def step(self, actions: Any) -> tuple[Observation, np.ndarray, np.ndarray, np.ndarray, Infos]:
        """Takes actions, int [num_envs]; infos are those of single environments, each with a mask.

        Raises:
          ValueError: if an action is not one of the action space's; nothing has moved then.
          gymnasium.error.ResetNeeded: if `reset` has never been called, or, where `autoreset_mode` is `disabled`, if an
            episode is over.
        """
        _check_started(self._started)
        if self.autoreset_mode is vector_env.AutoresetMode.DISABLED and self._ended.any():
            raise error.ResetNeeded("an episode is over; reset it with options={'reset_mask': terminated | truncated}")
        timestep = self.batch.step(actions)  # Starts the next episode where one had ended before.
        rewards, ended = timestep.reward, timestep.last()
        # Only an interaction whose simulation diverges ends an episode without a verdict.
        lost = ended & (rewards == 0) & (np.asarray(actions) < self.batch.num_interactions)
        self._observation, self._ended = dict(timestep.observation), ended
        infos = _masked(_outcomes(self.batch.ledger, self.batch.task), ended)
        if self.autoreset_mode is vector_env.AutoresetMode.SAME_STEP and ended.any():
            last, final = self._shown(), np.full(self.num_envs, None, object)
            for row in np.flatnonzero(ended):
                final[row] = (
                    {name: values[row] for name, values in last.items()} if isinstance(last, dict) else last[row]
                )
            infos = {"final_obs": final, "_final_obs": ended, "final_info": infos, "_final_info": ended.copy()}
            infos |= self._begin(ended)
        else:
            infos |= self._beginnings(timestep.first())
        return self._shown(), rewards, ended & ~lost, lost, infos

    def render(self) -> Any:
        """Returns images for people as the render mode says: a tuple of one for each environment, or one; or None.

        Images are uint8 [size, size, 3], of at most 480 pixels each and 1920 side by side. In a single one they are row
        by row in a square, and places that are left over are black.
        """
        if self.render_mode is None:
            return None
        per_side = math.ceil(math.sqrt(self.num_envs))
        size = min(rendering.SIZE_FOR_PEOPLE, _LARGEST_GRID // per_side)
        images = self.batch.render(size)
        if self.render_mode == "rgb_array":
            return tuple(images)
        rows = math.ceil(self.num_envs / per_side)
        tiles = np.zeros((rows * per_side, size, size, 3), np.uint8)
        tiles[: self.num_envs] = images
        return tiles.reshape(rows, per_side, size, size, 3).swapaxes(1, 2).reshape(rows * size, per_side * size, 3)

    def close_extras(self, **kwargs: Any) -> None:
        self.batch.close()

    def __reduce__(self) -> NoReturn:  # Of copies and of pickles.
        self.batch.__reduce__()

    def _begin(self, mask: np.ndarray, episode: int | None = None) -> Infos:
        """Starts episodes in some environments, bool [num_envs]; returns the infos."""
        first = self.batch.reset(np.flatnonzero(mask), episode).observation
        for name, values in first.items():
            self._observation[name][mask] = values
        self._ended = self._ended & ~mask
        return self._beginnings(mask)

    def _beginnings(self, mask: np.ndarray) -> Infos:
        """Returns the infos of episodes that have begun: seeds and indices, which rebuild them."""
        return _masked({"seed": self.batch.seeds, "episode_index": self.batch.episodes}, mask)

    def _shown(self) -> Observation:
        """Returns the observations, which nothing changes later."""
        if self._is_flat:
            arrays = (self._observation[name] for name in sorted(self._observation))
            return np.concatenate([array.reshape(self.num_envs, -1) for array in arrays], axis=-1)
        return {name: values.copy() for name, values in self._observation.items()}

    def _check_mask(self, mask: Any, seed: int | None) -> np.ndarray:
        """Returns the environments to reset, bool [num_envs]."""
        if mask is None:
            return np.ones(self.num_envs, bool)
        array = np.asarray(mask)
        if array.dtype != bool or array.shape != (self.num_envs,) or not array.any():
            raise ValueError(f"reset_mask is {checks.shown(mask)}; give {self.num_envs} booleans, one of them true")
        if not array.all():
            _check_started(self._started)
            if seed is not None:
                raise ValueError(f"seed is {seed} beside a reset_mask; a seed starts all environments: reset all")
        return array


def _refuse_unknown(kind: type, domain: str, task_kwargs: Mapping[str, Any]) -> None:
    """Raises TypeError, as Python does, for a keyword that neither a class nor the domain's options have."""
    own = list(inspect.signature(kind).parameters)[2:-1]  # Between the names of the task and its options.
    allowed = [*own, *(field.name for field in dataclasses.fields(suite.options(domain)))]
    for name in task_kwargs:
        if name not in allowed:
            raise TypeError(
                f"{kind.__name__} got an unexpected keyword argument {name!r}; allowed: {', '.join(allowed)}"
            )


def _check_options(options: Any, *allowed: str) -> dict[str, Any]:
    """Returns the options of a reset; raises ValueError for an unknown one, or an index that no episode has."""
    if not isinstance(options, Mapping | None):
        raise ValueError(f"options is {checks.shown(options)}; give a dictionary with {', '.join(allowed)}, or None")
    found = dict(options or {})
    for name in found:
        if name not in allowed:
            raise ValueError(f"options has {checks.shown(name)}; allowed: {', '.join(allowed)}")
    if "episode" in found:
        found["episode"] = checks.integer("episode", found["episode"], 0, seeding.LAST_EPISODE)
    return found


def _check_started(started: bool) -> None:
    """Raises `gymnasium.error.ResetNeeded` if no episode has begun."""
    if not started:
        raise error.ResetNeeded("there is no episode to step in; call reset() first")


def _frames_per_second(task: contract.Task) -> int:
    """Returns how many images a second of an episode has."""
    return max(1, round(1 / task.options.control_timestep))


def _outcomes(ledger: episodes.Ledger, task: contract.Task) -> dict[str, np.ndarray]:
    """Returns the infos of N episodes that have ended, arrays [N]."""
    are_right = ledger.num_right == task.rules.num_questions
    return {"correct_answer": ledger.correct_answers, "discounted_return": ledger.returns, "is_success": are_right}


def _check_autoreset_mode(given: Any) -> vector_env.AutoresetMode:
    """Returns one of Gymnasium's modes; raises ValueError for anything else than it or its name."""
    for mode in vector_env.AutoresetMode:
        if given in (mode, mode.value, mode.name.lower()):
            return mode
    choices = ", ".join(repr(mode.name.lower()) for mode in vector_env.AutoresetMode)
    raise ValueError(f"autoreset_mode is {checks.shown(given)}; choose from {choices}")


def _masked(infos: Mapping[str, np.ndarray], mask: np.ndarray) -> Infos:
    """Returns infos of some environments, as Gymnasium has them: 0 for the others, and a mask beside each."""
    if not mask.any():
        return {}
    shown = {name: np.where(mask, values, values.dtype.type(0)) for name, values in infos.items()}
    return {**shown, **{f"_{name}": mask.copy() for name in infos}}


def environment_id(domain: str, task: str, version: int | None = None) -> str:
    """Returns the name under which a version of a task, by default the newest, is registered."""
    newest = len(suite.versions(domain)) - 1
    return f"physexp/{domain}-{task}-v{newest if version is None else version}"


for _domain, _task in suite.ALL_TASKS:
    for _version, _kwargs in enumerate(suite.versions(_domain)):
        gymnasium.register(
            environment_id(_domain, _task, _version),
            entry_point=f"{__name__}:Environment",
            vector_entry_point=f"{__name__}:VectorEnvironment",
            kwargs={"domain": _domain, "task": _task, **_kwargs},
        )
