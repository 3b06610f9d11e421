"""Plays Which is Heavier ideally in the real environment, from what can be observed alone."""

from collections.abc import Callable, Mapping
from typing import Any

import mujoco
import numpy as np
from scipy import interpolate

from physexp import suite
from physexp.agents import core
from physexp.analysis.ideal import which_is_heavier

_CALIBRATION_NODES = 513


class IdealExperimenter(core.Actor):
    """Plays the real environment from its observations alone: from how high a block rises it infers the mass."""

    def __init__(self, solution: which_is_heavier.Solution, task_kwargs: Mapping[str, Any] | None = None):
        """Plays a solution for four blocks.

        Args:
          solution: what `which_is_heavier.solve` found.
          task_kwargs: those of the environment, of which the control time step matters.

        Raises:
          ValueError: if the control step is so long that a poked block reaches the ceiling, where its mass is hidden.
        """
        self._solution = solution
        self._mass_of = calibrate(task_kwargs)

    def observe_first(self, timestep):
        self._known = np.full((1, self._solution.num_blocks), np.nan)

    def select_action(self, observation) -> int:
        return int(self._solution.actions(self._known)[0])

    def observe(self, action, next_timestep):
        if action < self._solution.num_blocks and not next_timestep.last():
            self._known[0, action] = self._mass_of(next_timestep.observation["heights"][action])

    def update(self):
        """Needs nothing: it has learned all there is to learn."""


def calibrate(task_kwargs: Mapping[str, Any] | None = None) -> Callable[[float], float]:
    """Pokes blocks of known masses; returns the function from a height after one poke, m, to the mass in [0, 1].

    Raises:
      ValueError: if blocks of different masses rise equally high.
    """
    task = suite.load_task("which_is_heavier", "features", task_kwargs)
    kit = task.build_apparatus(0)
    data = mujoco.MjData(kit.model)
    masses, heights = np.linspace(0, 1, _CALIBRATION_NODES), []
    for mass in masses:
        hidden = np.full((1, task.num_interactions), mass)
        for field, (addresses, values) in task.hidden_fields(kit, hidden).items():
            getattr(kit.model, field)[addresses] = values[0]
        mujoco.mj_resetData(kit.model, data)
        data.ctrl[:] = task.controls[0]
        mujoco.mj_step(kit.model, data, nstep=task.options.substeps)
        heights.append(data.qpos[0])
    if not (np.diff(heights) < 0).all():
        raise ValueError(
            f"control_timestep is {task.options.control_timestep} s, in which a light block reaches the ceiling and "
            "hides its mass; give a shorter one"
        )
    inverse = interpolate.PchipInterpolator(heights[::-1], masses[::-1], extrapolate=True)
    return lambda height: float(np.clip(inverse(height), 1e-9, 1 - 1e-9))
