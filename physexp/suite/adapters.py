"""Spaces, infos, checks and images that the adapters for Gymnasium and Stable-Baselines3 share."""

from collections.abc import Mapping, Sequence
import dataclasses
import inspect
import math
from typing import Any

import dm_env
from gymnasium import error, spaces
import numpy as np

from physexp import checks, suite
from physexp.suite.engine import batch as batch_lib
from physexp.suite.engine import contract, rendering, seeding

RENDER_MODE = checks.optional(checks.word("rgb_array"))
"""The check of how one environment is drawn: as an array, or not at all."""

_LARGEST_GRID = 1920  # Pixels, of the images of many environments side by side.


def observation_space(spec: Mapping[str, dm_env.specs.Array], is_flat: bool = False) -> spaces.Space[Any]:
    """Returns the space of observations, of flattened ones if `is_flat`; features have the bounds of their specs."""
    boxes: dict[str, spaces.Space[Any]] = {}
    for name, array in spec.items():
        low: Any
        high: Any
        if isinstance(array, dm_env.specs.BoundedArray):
            low, high = (np.broadcast_to(side, array.shape) for side in (array.minimum, array.maximum))
        else:
            low, high = (0, 255) if array.dtype == np.uint8 else (-np.inf, np.inf)
        boxes[name] = spaces.Box(low, high, array.shape, array.dtype)
    return spaces.flatten_space(spaces.Dict(boxes)) if is_flat else spaces.Dict(boxes)


def flattened(observation: Mapping[str, np.ndarray], num_axes: int = 0) -> np.ndarray:
    """Returns the arrays of an observation as one vector, sorted by name, after `num_axes` leading axes."""
    arrays = (observation[name] for name in sorted(observation))
    return np.concatenate([array.reshape(*array.shape[:num_axes], -1) for array in arrays], axis=-1)


def outcomes(task: contract.Task, steps: np.ndarray, rewards: np.ndarray, answers: np.ndarray) -> dict[str, np.ndarray]:
    """Returns the infos of N episodes that have ended, arrays [N], from their steps, last rewards and right labels."""
    return {
        "correct_answer": answers,
        "discounted_return": rewards * task.discount ** (steps - 1.0),
        "is_success": rewards > 0,
    }


def beginnings(batch: suite.BatchEnvironment) -> dict[str, np.ndarray]:
    """Returns the infos of the episodes that have begun, int64 [B]: seeds and indices, which rebuild them."""
    return {"seed": batch.seeds, "episode_index": batch.episodes}


def refuse_unknown(kind: type, domain: str, task_kwargs: Mapping[str, Any]) -> None:
    """Raises TypeError, as Python does, for a keyword that neither a class nor the domain's options have."""
    own = list(inspect.signature(kind).parameters)[2:-1]  # Between the names of the task and its options.
    allowed = [*own, *(field.name for field in dataclasses.fields(suite.options(domain)))]
    for name in task_kwargs:
        if name not in allowed:
            raise TypeError(
                f"{kind.__name__} got an unexpected keyword argument {name!r}; allowed: {', '.join(allowed)}"
            )


def check_options(options: Any, *allowed: str) -> dict[str, Any]:
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


def check_num_envs(num_envs: Any) -> int:
    """Returns the number of environments as an int."""
    return checks.integer("num_envs", num_envs, 1, batch_lib.MOST_ENVIRONMENTS)


def check_seed(seed: Any) -> int | None:
    """Returns a seed, in [0, 2**63), as an int; or None."""
    return None if seed is None else checks.integer("seed", seed, 0, seeding.LARGEST_SEED)


def check_started(started: bool) -> None:
    """Raises `gymnasium.error.ResetNeeded` if no episode has begun."""
    if not started:
        raise error.ResetNeeded("there is no episode to step in; call reset() first")


def images(batch: suite.BatchEnvironment) -> tuple[np.ndarray, ...]:
    """Returns one image for each environment, uint8 [size, size, 3], at most 480 pixels and 1920 side by side."""
    per_side = math.ceil(math.sqrt(batch.num_environments))
    return tuple(batch.render(min(rendering.SIZE_FOR_PEOPLE, _LARGEST_GRID // per_side)))


def grid(drawn: Sequence[np.ndarray]) -> np.ndarray:
    """Returns images [size, size, 3] as one, row by row in a square; places that are left over are black."""
    per_side, size = math.ceil(math.sqrt(len(drawn))), len(drawn[0])
    rows = math.ceil(len(drawn) / per_side)
    tiles = np.zeros((rows * per_side, *drawn[0].shape), np.uint8)
    tiles[: len(drawn)] = drawn
    return tiles.reshape(rows, per_side, size, size, 3).swapaxes(1, 2).reshape(rows * size, per_side * size, 3)


def frames_per_second(task: contract.Task) -> int:
    """Returns how many images a second of an episode has."""
    return max(1, round(1 / task.options.control_timestep))
