"""From a reading to what is hidden: interacts with things of known values and inverts what it reads."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy import interpolate

from physexp import suite

_NODES = 513


def calibrate(
    domain_name: str, task_name: str, feature: str, task_kwargs: Mapping[str, Any] | None = None
) -> Callable[[Mapping[str, np.ndarray], int], float]:
    """Returns how to read a thing's hidden value from the observation after one interaction with it.

    Interaction k acts on thing k, of which the feature's component k tells; all things are alike.

    Args:
      domain_name, task_name, task_kwargs: as for `suite.load`; the hidden property is K values in [0, 1].
      feature: name of the observation.

    Returns:
      A function of an observation and an interaction, to the value in (0, 1).

    Raises:
      ValueError: if different values are read as the same.
    """
    task = suite.load_task(domain_name, task_name, {**(task_kwargs or {}), "random": 0})
    batch = suite.BatchEnvironment(task, _NODES)
    values = np.linspace(0, 1, _NODES)
    batch.reset(hidden=np.repeat(values[:, None], task.num_interactions, axis=1))
    readings = batch.step(np.zeros(_NODES, np.int64)).observation[feature][:, 0].astype(float)
    batch.close()
    order = np.argsort(readings)
    if not (np.diff(readings) < 0).all() and not (np.diff(readings) > 0).all():
        raise ValueError(
            f"control_timestep is {task.options.control_timestep} s, after which things with different hidden values "
            "look the same; give a shorter one"
        )
    inverse = interpolate.PchipInterpolator(readings[order], values[order], extrapolate=True)
    return lambda observation, action: float(np.clip(inverse(observation[feature][action]), 1e-9, 1 - 1e-9))
