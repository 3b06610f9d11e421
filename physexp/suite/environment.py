"""One environment: dm_control's composer environment, with each structure of the task compiled only once."""

import copy

from dm_control import composer, mjcf
from dm_control.mujoco import wrapper
from dm_control.rl import control
import dm_env


class Environment(composer.Environment):
    """A composer environment that keeps one compiled physics for each structure of its task.

    Composer recompiles at every episode; here a reset picks the physics that the hidden property calls for.
    """

    def __init__(self, task, raise_exception_on_physics_error=False):
        """Builds the environment.

        Args:
          task: a `QuestionTask`.
          raise_exception_on_physics_error: raise when the simulation diverges, instead of ending that episode
            with a warning.
        """
        self._compiled = {}  # Apparatus and physics of each structure used so far.
        self._current_structure = None
        super().__init__(task, random_state=0, strip_singleton_obs_buffer_dim=True,
                         raise_exception_on_physics_error=raise_exception_on_physics_error)  # fmt: skip

    def reset(self) -> dm_env.TimeStep:
        """Starts the next episode."""
        self._check_open()
        return super().reset()

    def step(self, action) -> dm_env.TimeStep:
        """Takes one action, an integer.

        Raises:
          ValueError: if the action is not one of the action spec's; the episode stays as it was.
        """
        self._check_open()
        return super().step(action)

    def close(self) -> None:
        """Frees the simulations. Closing twice does nothing."""
        for _, physics in self._compiled.values():
            physics.free()
        self._compiled = {}
        self._task.close()
        self._physics = self._physics_proxy = None

    def _check_open(self):
        if self._physics is None:
            raise RuntimeError("the environment is closed; load another")

    def _recompile_physics_and_update_observables(self):
        if self._task.structure != self._current_structure:
            super()._recompile_physics_and_update_observables()
            self._current_structure = self._task.structure

    def _recompile_physics(self):
        structure = self._task.structure
        if structure not in self._compiled:
            kit = self._task.build_apparatus(structure)
            physics = mjcf.Physics.from_model(wrapper.MjModel(copy.copy(kit.model)))
            physics.legacy_step = self._legacy_step
            self._compiled[structure] = (kit, physics)
        self._task.apparatus, self._physics = self._compiled[structure]

    def _substep(self, action):
        if self._task.answered:  # An answer ends the episode at once: nothing moves any more.
            return
        try:
            super()._substep(action)
        except control.PhysicsError:
            self._task.note_divergence()
            raise
