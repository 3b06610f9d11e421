"""The base of every task: a question about something that cannot be seen (paper, Section 3)."""

import abc
from collections.abc import Mapping, Sequence
import dataclasses
import functools
import math
from typing import Any, ClassVar

from dm_control import composer
from dm_control.composer.observation import observable
from dm_env import specs
import numpy as np

from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import checks, rules, seeding
from physexp.suite.engine import senses as senses_lib

# Held parts look exactly as at the start until they have moved by more than this. Contacts at rest settle by less than
# a tenth of it, and the weakest touch moves a block by several times as much.
TOUCH_TOLERANCE = 1e-4  # m, or the same in a quaternion's components

_LONGEST = 1e6  # s

_OK_RGBA, _WRONG_RGBA = (0.45, 0.75, 0.45, 1.0), (0.80, 0.45, 0.40, 1.0)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options:
    """What a user may choose of every task: the `task_kwargs` of `suite.load`.

    Attributes:
      random: an integer seed, a `numpy.random.RandomState`, or None for a seed from the operating system.
      control_timestep: time between actions, a multiple of the physics step, s.
      time_limit: time after which an unanswered episode ends, rounded up to whole control steps, s.
      visualize_reward: colour the floor by the outcome at the end of an episode.

    Raises:
      ValueError: for a value that makes no sense.
    """

    physics_timestep: ClassVar[float]

    random: Any = None
    control_timestep: float = 0.1
    time_limit: float
    visualize_reward: bool = False

    def __post_init__(self):
        object.__setattr__(self, "random", seeding.seed_from(self.random))
        for name in ("control_timestep", "time_limit"):
            seconds = checks.number(name, getattr(self, name), 0, "s", strictly=True)
            if seconds > _LONGEST:
                raise ValueError(f"{name} is {checks.shown(getattr(self, name))}; give at most {_LONGEST:g} s")
            object.__setattr__(self, name, seconds)
        if self.substeps < 1 or abs(self.substeps * self.physics_timestep - self.control_timestep) > 1e-9:
            raise ValueError(
                f"control_timestep is {self.control_timestep} s; "
                f"give a multiple of the physics step, {self.physics_timestep} s"
            )

    @property
    def substeps(self) -> int:
        """Physics steps in a control step."""
        return round(self.control_timestep / self.physics_timestep)

    @property
    def step_limit(self) -> int:
        """Control steps in an unanswered episode."""
        return max(1, math.ceil(self.time_limit / self.control_timestep - 1e-6))


class _Observable(observable.Generic):
    """An observable that knows what it shows before it is asked."""

    def __init__(self, raw_observation_callable, spec: specs.Array):
        super().__init__(raw_observation_callable)
        self._spec = spec

    @property
    def array_spec(self):
        return self._spec


class QuestionTask(composer.Task):
    """A composer task in which interaction actions act and labeling actions answer.

    A subclass builds the scene, says how the hidden property of an episode is drawn and what follows from it.
    The methods with a leading axis [N] serve one environment (N = 1) and a batch alike.

    Attributes:
      rules: how actions are read and judged.
      controls: what each interaction action sends to the actuators, float64 [num_interactions, nu].
      num_divergences: episodes that ended because the simulation diverged.
      sense: how the state is shown.
      apparatus: the compiled model in use; the environment sets it.
    """

    apparatus: apparatus_lib.Apparatus
    options: Options

    def __init__(self, arena, options: Options, sense: senses_lib.Sense, num_interactions: int, num_labels: int):
        """Sets what all tasks share.

        Args:
          arena: the arena, with the entities attached.
          options: what the user chose.
          sense: how the state is shown.
          num_interactions, num_labels: numbers of actions.
        """
        self._arena = arena
        self.options = options
        self.set_timesteps(options.substeps * options.physics_timestep, options.physics_timestep)
        self.rules = rules.Rules(num_interactions, num_labels, options.step_limit)
        self._next_episode = 0
        self.num_divergences = 0
        self.structure = 0
        self._hidden: np.ndarray | None = None
        self._actions = np.zeros(1, np.int64)
        self._steps = np.zeros(1, np.int64)
        self._touched = np.zeros(1, bool)
        self._diverged = False
        self.sense = sense
        self._seen = self.blank_observations(1)
        self._observables = {
            name: _Observable(functools.partial(self._recall, name), spec)
            for name, spec in self.observation_spec().items()
        }
        for reading in self._observables.values():
            reading.enabled = True

    # What a subclass defines.

    question = "Which answer is right?"
    """What is asked, in words."""

    num_structures = 1
    """How many compiled models the hidden property chooses from."""

    @property
    @abc.abstractmethod
    def controls(self) -> np.ndarray:
        """What each interaction action sends to the actuators, float64 [num_interactions, nu]."""

    @property
    @abc.abstractmethod
    def sensors(self) -> dict[str, tuple]:
        """For each feature, the MJCF sensors that make it up and its shape."""

    @property
    @abc.abstractmethod
    def effects(self) -> Sequence[tuple[str, tuple[float, float, float]]]:
        """Returns what each interaction action acts on, and the force (N) or velocity (m/s) to draw there."""

    @property
    @abc.abstractmethod
    def interaction_names(self) -> Sequence[str]:
        """What each interaction action does, in words."""

    @property
    @abc.abstractmethod
    def label_names(self) -> Sequence[str]:
        """The answers, in words."""

    @property
    def bounds(self) -> Mapping[str, tuple[Any, Any]]:
        """For each feature, the least and the greatest values that it ever has; a feature left out has no bounds."""
        return {}

    @property
    def held_joints(self) -> Sequence:
        """Joints that look at rest until they have moved by more than TOUCH_TOLERANCE."""
        return ()

    @property
    def held_sensors(self) -> Sequence:
        """The sensors that show them."""
        return ()

    @property
    def held_geoms(self) -> Sequence:
        """The geoms that show them."""
        return ()

    @abc.abstractmethod
    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """The hidden properties, [N, ...], of some episodes: seeds and episode indices, int64 [N]."""

    @abc.abstractmethod
    def answers(self, hidden: np.ndarray) -> np.ndarray:
        """Indices of the right labels, int64 [N]."""

    def structures(self, hidden: np.ndarray) -> np.ndarray:
        """Which compiled model each hidden property needs, int64 [N]."""
        return np.zeros(len(hidden), np.int64)

    def arrange(self, structure: int) -> None:
        """Puts the MJCF into the form of a structure."""

    @property
    def hidden_joints(self) -> Sequence:
        """Slides that carry bodies whose masses are hidden."""
        return ()

    def hidden_masses(self, hidden: np.ndarray) -> np.ndarray:
        """Masses of the bodies on `hidden_joints`, float64 [N, number of joints], kg."""
        return np.zeros((len(hidden), 0))

    # The question.

    @property
    def num_interactions(self) -> int:
        return self.rules.num_interactions

    @property
    def num_labels(self) -> int:
        return self.rules.num_labels

    @property
    def action_names(self) -> list[str]:
        """What each action does or says, in words."""
        return [*self.interaction_names, *(f"answer: {name}" for name in self.label_names)]

    @property
    def hidden(self) -> np.ndarray:
        """Returns the hidden property of the current episode, which is never part of an observation."""
        if self._hidden is None:
            raise RuntimeError("no episode has been started; call reset() first")
        return self._hidden[0]

    @property
    def correct_answer(self) -> int:
        """Index of the right label in the current episode; never observable."""
        return int(self.answers(self.hidden[None])[0])

    def reseed(self, random) -> None:
        """Takes another seed: the next reset starts its first episode; `random` as in `Options`."""
        self.options = dataclasses.replace(self.options, random=random)
        self._next_episode = 0

    @property
    def next_episode(self) -> int:
        """Index of the episode that the next reset starts, in [0, 2**62); set it to rebuild any episode."""
        return self._next_episode

    @next_episode.setter
    def next_episode(self, episode: int) -> None:
        self._next_episode = checks.integer("next_episode", episode, 0, seeding.LAST_EPISODE)

    @property
    def episode(self) -> int:
        """Index of the current episode, -1 before the first."""
        return self._next_episode - 1

    @property
    def answered(self) -> bool:
        """Whether the last action was a labeling action."""
        return bool(self._actions[0] >= self.num_interactions)

    def action_spec(self, physics=None) -> specs.DiscreteArray:
        return specs.DiscreteArray(self.rules.num_actions, dtype=np.int32, name="action")

    def observation_spec(self) -> dict[str, specs.Array]:
        """What one environment observes."""
        described = {}
        for name, blank in self.blank_observations(1).items():
            array = specs.Array(blank.shape[1:], blank.dtype, name)
            if name in self.bounds:
                array = specs.BoundedArray(array.shape, array.dtype, *self.bounds[name], name)
            described[name] = array
        return described

    # The composer task.

    @property
    def root_entity(self):
        return self._arena

    @property
    def task_observables(self):
        return self._observables

    def build_apparatus(self, structure: int) -> apparatus_lib.Apparatus:
        """Arranges the MJCF and compiles it."""
        self.arrange(structure)
        return apparatus_lib.build(
            self.root_entity.mjcf_model,
            self.sensors,
            self.held_joints,
            self.held_sensors,
            self.held_geoms,
            self.hidden_joints,
        )

    def blank_observations(self, size: int) -> dict[str, np.ndarray]:
        """Arrays for the observations of `size` environments."""
        return self.sense.blank(self.sensors, size)

    def look(self, kit: apparatus_lib.Apparatus, state, touched, rows, observations) -> None:
        """Writes the observations of some simulations.

        Args:
          kit: what is simulated.
          state: the fields that the sense looks at, float64 [N, ...].
          touched: whether held parts have been touched, bool [N].
          rows: where the observations go, int [N].
          observations: arrays with a leading axis that `rows` index; written to.
        """
        shown = {field: kit.shown(field, values, touched) for field, values in state.items()}
        self.sense.look(kit, shown, rows, observations)

    def close(self) -> None:
        """Frees what the sense holds. A closed task can be played again."""
        self.sense.close()

    def note_divergence(self) -> None:
        """Tells the task that the simulation has diverged: nothing more is seen of this episode."""
        self.num_divergences += 1
        self._diverged = True

    def _look(self, state) -> None:
        self.look(self.apparatus, state, self._touched, np.zeros(1, np.intp), self._seen)

    def _recall(self, name: str, physics) -> np.ndarray:
        """What was last seen: composer may ask many times, and it is looked at once for each control step."""
        return self._seen[name][0].copy()

    def initialize_episode_mjcf(self, random_state):
        hidden = self.draw(np.array([self.options.random]), np.array([self._next_episode]))
        self._hidden, self._answers = hidden, self.answers(hidden)
        self._next_episode += 1
        self.structure = int(self.structures(hidden)[0])
        self.arrange(self.structure)

    def initialize_episode(self, physics, random_state):
        for field, (addresses, values) in self.apparatus.mass_fields(self.hidden_masses(self.hidden[None])).items():
            getattr(physics.model, field)[addresses] = values[0]
        self._steps[0] = 0
        self._actions[0] = 0
        self._touched[0] = False
        self._look({field: self.apparatus.rest[field][None] for field in self.sense.fields})
        if self.options.visualize_reward:
            physics.bind(self._arena.floor).rgba = self._arena.floor.rgba

    def before_step(self, physics, action, random_state):
        self._actions[0] = self._checked(action)
        self._diverged = False
        self._steps[0] += 1
        if not self.answered:
            physics.data.ctrl[:] = self.controls[self._actions[0]]
            if self._steps[0] == 1:
                physics.data.qacc_warmstart[:] = 0  # A batch resets its rows without a forward pass.

    def _checked(self, action) -> int:
        checked = self.rules.check_type(action, ())
        self.rules.check_range(checked)
        return int(checked)

    def after_step(self, physics, random_state):
        if not (self.answered or self._diverged):
            self._touched |= self.apparatus.moved(physics.data.qpos[None], TOUCH_TOLERANCE)
            self._look({field: getattr(physics.data, field)[None] for field in self.sense.fields})
        self._rewards, self._last = self.rules.judge(self._actions, self._answers, self._steps)
        if self.options.visualize_reward and self._last[0]:
            physics.bind(self._arena.floor).rgba = _OK_RGBA if self._rewards[0] > 0 else _WRONG_RGBA

    def get_reward(self, physics):
        return float(self._rewards[0])

    def get_discount(self, physics):
        return 0.0 if self._last[0] else 1.0

    def should_terminate_episode(self, physics):
        return bool(self._last[0])
