"""One environment: dm_control's composer environment, with each structure of the task compiled only once."""

import copy
from typing import Any, NoReturn

from dm_control import composer, mjcf
from dm_control.mujoco import wrapper
from dm_control.rl import control
import dm_env
from dm_env import specs
import numpy as np

from physexp import checks
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import composer_task, contract, guard, rendering


class Environment(composer.Environment):
    """A composer environment that keeps one compiled physics for each structure of its task.

    Composer recompiles at every episode; here a reset picks the physics that the hidden property calls for.
    """

    def __init__(
        self, task: contract.Task, raise_exception_on_physics_error: bool = False, flat_observation: bool = False
    ):
        """Builds the environment of a task; arguments as `environment_kwargs` of `suite.load`."""
        self._guard = guard.Guard("environment")
        self._flat = checks.flag("flat_observation", flat_observation)
        raises = checks.flag("raise_exception_on_physics_error", raise_exception_on_physics_error)
        self._compiled: dict[int, tuple[apparatus_lib.Apparatus, mjcf.Physics]] = {}  # By structure.
        self._current: tuple[int, int] | None = None  # The structure in use, and the physics steps in a control step.
        super().__init__(composer_task.ComposerTask(task), random_state=0, raise_exception_on_physics_error=raises)

    def reset(self, hidden: Any = None) -> dm_env.TimeStep:
        """Starts the next episode, for analysis with a hidden property of the shape, type and range of a drawn one."""
        with self._guard:
            self._check_open()
            if hidden is not None:
                self._task.give_hidden(hidden)
            return self._observing(super().reset())

    def step(self, action: Any) -> dm_env.TimeStep:
        """Takes one action, an integer; for one that is not the action spec's, the episode stays as it was."""
        with self._guard:
            self._check_open()
            return self._observing(super().step(action))

    def observation_spec(self) -> dict[str, specs.Array]:
        """Returns the specs of the observations by name, with bounds if the task knows them."""
        described = self._task.observation_spec()
        if not self._flat:
            return described
        blank = control.flatten_observation({name: np.zeros(one.shape, one.dtype) for name, one in described.items()})
        return {name: specs.Array(value.shape, value.dtype, name) for name, value in blank.items()}

    def render(self) -> np.ndarray:
        """Returns an image of the scene for people, uint8 [480, 480, 3]; raises RuntimeError if no GL backend works."""
        with self._guard:
            self._check_open()
            size, apparatus, physics = rendering.SIZE_FOR_PEOPLE, self._task.apparatus, self.physics
            positions = physics.data.geom_xpos[None].copy()
            apparatus.indicate(positions, self._task.measured)
            image = np.zeros((size, size, 3), np.uint8)
            poses, sizes = (positions, physics.data.geom_xmat[None]), apparatus.sizes(self._task.measured)
            renderer, colors = self._task.observer.renderer(apparatus, size), physics.model.geom_rgba
            renderer.render(*poses, np.zeros(1, np.intp), image[None], colors=colors, sizes=sizes)
            return image

    def close(self) -> None:
        """Frees the simulations. Closing twice does nothing."""
        with self._guard:
            for _, physics in self._compiled.values():
                physics.free()
            self._compiled = {}
            self._task.close()
            self._physics = self._physics_proxy = None

    def __reduce__(self) -> NoReturn:  # Of copies and of pickles.
        self._guard.__reduce__()

    def _observing(self, timestep: dm_env.TimeStep) -> dm_env.TimeStep:
        """Returns a time step with the last observation, which composer knows nothing of."""
        seen = self._task.last_observation()
        return timestep._replace(observation=control.flatten_observation(seen) if self._flat else seen)

    def _check_open(self) -> None:
        if self._physics is None:
            raise RuntimeError("the environment is closed; load another")

    def _recompile_physics_and_update_observables(self) -> None:
        wanted = self._task.structure, self._task.physics_steps_per_control_step
        if wanted != self._current:
            super()._recompile_physics_and_update_observables()
            self._current = wanted

    def _recompile_physics(self) -> None:
        structure = self._task.structure
        if structure not in self._compiled:
            apparatus = self._task.build_apparatus(structure)
            physics = mjcf.Physics.from_model(wrapper.MjModel(copy.copy(apparatus.model)))
            physics.legacy_step = self._legacy_step
            self._compiled[structure] = (apparatus, physics)
        self._task.apparatus, self._physics = self._compiled[structure]

    def _substep(self, action: Any) -> None:
        if self._task.answered:  # Nothing moves, and no time passes.
            return
        try:
            super()._substep(action)
        except control.PhysicsError:
            self._task.note_divergence()
            raise
