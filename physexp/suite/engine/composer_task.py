"""The composer task: plays a task's episodes in one environment of dm_control."""

from typing import Any

from dm_control import composer
from dm_env import specs
import numpy as np

from physexp import checks
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, episodes, seeding

_OK_RGBA, _WRONG_RGBA = (0.45, 0.75, 0.45, 1.0), (0.80, 0.45, 0.40, 1.0)
_ROW = np.zeros(1, np.intp)  # The only row of a single environment.


class ComposerTask(composer.Task):
    """Plays a task in a composer environment, and has everything that the task declares.

    Attributes:
      apparatus: the compiled model in use; the environment sets it.
      measured: the sensors' values at the last observation, float64 [1, nsensordata].
      num_divergences: episodes that ended because the simulation diverged.
      ledger: the bookkeeping of the episode, for the engine's own use.
    """

    apparatus: apparatus_lib.Apparatus
    measured: np.ndarray

    def __init__(self, task: contract.Task):
        self._declared = task
        options = task.options
        self.set_timesteps(options.substeps * options.physics_timestep, options.physics_timestep)
        self.num_divergences = 0
        self.ledger = episodes.Ledger(task, 1)
        self.ledger.seeds[:] = options.random
        self._given_hidden: np.ndarray | None = None
        self._action = 0
        self._diverged = False
        self._seen = task.observer.blank(1)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._declared, name)

    # The episode.

    @property
    def hidden(self) -> np.ndarray:
        """The hidden property of the current episode, which is never part of an observation."""
        return self.ledger.hidden[0].copy()

    @property
    def correct_answer(self) -> int:
        """Index of the right label of the current question; never observable."""
        return int(self.ledger.correct_answers[0])

    def reseed(self, random: Any) -> None:
        """Takes another seed: the next reset starts its first episode; `random` as in `Options`."""
        self._declared.reseed(random)
        self.ledger.reseed(np.array([self._declared.options.random]))

    @property
    def next_episode(self) -> int:
        """Index of the episode that the next reset starts, in [0, 2**62); set it to rebuild any episode."""
        return int(self.ledger.next_episodes[0])

    @next_episode.setter
    def next_episode(self, episode: int) -> None:
        self.ledger.next_episodes[0] = checks.integer("next_episode", episode, 0, seeding.LAST_EPISODE)

    @property
    def episode(self) -> int:
        """Index of the current episode, -1 before the first."""
        return self.next_episode - 1

    @property
    def steps(self) -> int:
        """Control steps taken in the current episode."""
        return int(self.ledger.steps[0])

    @property
    def structure(self) -> int:
        """The compiled model that the current episode needs."""
        return int(self.ledger.structures[0])

    @property
    def answered(self) -> bool:
        """Whether the last action was a labeling action."""
        return self._action >= self._declared.num_interactions

    def give_hidden(self, hidden: Any) -> None:
        """Makes the next reset start an episode with this hidden property, [...]. For analysis."""
        self._given_hidden = np.asarray(hidden)[None]

    def note_divergence(self) -> None:
        """Notes that the simulation has diverged: the last observation stays the one before."""
        self.num_divergences += 1
        self._diverged = True

    def sensed(self, sensordata: np.ndarray) -> np.ndarray:
        """Returns values of the sensors with those that the task tells, float64 [1, nsensordata]."""
        told = sensordata.reshape(1, -1).copy()
        told[:, self.apparatus.told] = self.ledger.told(_ROW)
        return told

    def _look(self, state: dict[str, np.ndarray]) -> None:
        self.measured = state["sensordata"]
        observer = self._declared.observer
        observer.look(self.apparatus, state, self.ledger.touched, self._starts, _ROW, self._seen)
        observer.complete(self.ledger, _ROW, self._seen)

    def last_observation(self) -> dict[str, np.ndarray]:
        """Returns a copy of the last observation."""
        return {name: values[0].copy() for name, values in self._seen.items()}

    # Methods that composer calls.

    @property
    def root_entity(self) -> composer.Arena:
        return self._declared.root_entity

    def action_spec(self, physics: Any = None) -> specs.DiscreteArray:
        return self._declared.action_spec()

    def initialize_episode_mjcf(self, random_state: Any) -> None:
        given, self._given_hidden = self._given_hidden, None
        self.ledger.begin(_ROW, given)
        self.control_timestep = int(self.ledger.substeps[0]) * self.physics_timestep
        self._declared.arrange(self.structure)

    def initialize_episode(self, physics: Any, random_state: Any) -> None:
        task = self._declared
        fields, self._starts = task.begin(self.apparatus, self.ledger.hidden, self.ledger.nuisances)
        for field, (addresses, values) in fields:
            getattr(physics.model, field)[addresses] = values[0]
        physics.data.qpos[:] = self._starts.qpos[0]
        self._action = 0
        self._look({field: self._starts.shown[field] for field in task.observer.fields})
        self._resize(physics)
        if task.options.visualize_reward:
            self._colour_floor(physics, self.root_entity.floor.rgba)

    def before_step(self, physics: Any, action: Any, random_state: Any) -> None:
        rules = self._declared.rules
        checked = rules.check_type(action, ())
        rules.check_range(checked)
        self._action = int(checked)
        self._diverged = False
        self.ledger.steps[0] += 1
        if not self.answered:
            data = physics.data
            driven = self._declared.drive(checked[None], data.qpos[None], data.ctrl[None])
            data.ctrl[:] = (driven * self._starts.strength)[0]
            if self.ledger.steps[0] - self.ledger.num_answered[0] == 1:
                data.qacc_warmstart[:] = 0  # A batch resets its rows without a forward pass.

    def after_step(self, physics: Any, random_state: Any) -> None:
        data, task = physics.data, self._declared
        rewards, last = self.ledger.judge(_ROW, np.array([self._action]), self._diverged)
        self._reward, self._last = float(rewards[0]), bool(last[0])
        if not (self._diverged or (self.answered and self._last)):
            state = {field: getattr(data, field)[None] for field in task.observer.fields}
            if not self.answered:
                self.ledger.touched |= self.apparatus.moved(data.qpos[None], self._starts.qpos)
            # An answer changes the values of no other sensors.
            state["sensordata"] = self.sensed(self.measured if self.answered else data.sensordata)
            self._look(state)
            self.apparatus.indicate(data.geom_xpos[None], self.measured)  # For `physics.render`.
            self._resize(physics)
        if task.options.visualize_reward and self._last:
            self._colour_floor(physics, _OK_RGBA if self._reward > 0 else _WRONG_RGBA)

    def _resize(self, physics: Any) -> None:
        """Gives indicators the sizes that `physics.render` draws; no contact depends on them."""
        for geom, sizes in self.apparatus.sizes(self.measured).items():
            physics.model.geom_size[geom] = sizes[0]

    def _colour_floor(self, physics: Any, rgba: Any) -> None:
        physics.bind(self.root_entity.floor).rgba = rgba

    def get_reward(self, physics: Any) -> float:
        return self._reward

    def get_discount(self, physics: Any) -> float:
        return 0.0 if self._last else 1.0

    def should_terminate_episode(self, physics: Any) -> bool:
        return self._last
