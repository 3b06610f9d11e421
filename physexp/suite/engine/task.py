"""The base of every task: a question about something that cannot be seen (paper, Section 3)."""

import abc
from collections.abc import Iterator, Mapping, Sequence
import dataclasses
import functools
import math
from typing import Any

from dm_control import composer
from dm_control.composer.observation import observable
from dm_env import specs
import numpy as np

from physexp import checks
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import declarations, episodes, rules, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.engine import senses as senses_lib

CAMERA_VARIATION = 0.02  # m, in each direction
ANSWER = "answer"  # The name of what is observed of the right label, where it is revealed.
_IMAGE = "an image from the task's camera: rows, columns, and red, green and blue"

_OK_RGBA, _WRONG_RGBA = (0.45, 0.75, 0.45, 1.0), (0.80, 0.45, 0.40, 1.0)
_ROW = np.zeros(1, np.intp)  # The only row of a single environment.


class _Observable(observable.Generic):
    """An observable whose spec is known before it is first evaluated."""

    def __init__(self, raw_observation_callable, spec: specs.Array):
        super().__init__(raw_observation_callable)
        self._spec = spec

    @property
    def array_spec(self):
        return self._spec


class QuestionTask(composer.Task):
    """A composer task in which interaction actions act and labeling actions answer.

    A subclass builds the scene, declares what can be done and seen, says how the hidden property of an episode is
    drawn, and what follows from it. Methods with a leading axis [N] serve one environment (N = 1) and a batch alike.

    Attributes:
      options: what the user chose.
      sense: how the state is shown.
      rules: how actions are read and judged.
      controls: what each interaction action sends to the actuators, float64 [num_interactions, nu].
      apparatus: the compiled model in use; the environment sets it.
      measured: the sensors' values of which the last observation was made, float64 [1, nsensordata].
      num_divergences: episodes that ended because the simulation diverged.
    """

    apparatus: apparatus_lib.Apparatus
    measured: np.ndarray
    options: options_lib.Options

    def __init__(self, arena: composer.Arena, options: options_lib.Options, sense: senses_lib.Sense):
        """Sets what all tasks share.

        Args:
          arena: the arena, with the entities attached.
          options: what the user chose.
          sense: how the state is shown.
        """
        self._arena = arena
        self.options = options
        self.set_timesteps(options.substeps * options.physics_timestep, options.physics_timestep)
        self.rules = rules.Rules(len(self.interactions), len(self.label_names), options.step_limit)
        self.controls = np.array([interaction.control for interaction in self.interactions], float)
        self.num_divergences = 0
        self.sense = sense
        if options.noise and not self._noisy:
            raise ValueError(f"noise is {options.noise:g}; give 0 where no reading in metres is observed")
        if options.variation and not self.num_nuisances:
            raise ValueError(f"variation is {options.variation:g}; give 0 where episodes differ in nothing else")
        if options.reveal and sense.needs_gl:
            raise ValueError("reveal is True; give False where images are observed, or choose a task with features")
        self._ledger = episodes.Ledger(self, 1)
        self._ledger.seeds[:] = options.random
        self._given_hidden: np.ndarray | None = None
        self._action = 0
        self._diverged = False
        self._seen = self.blank_observations(1)
        self._observables = {
            name: _Observable(functools.partial(self._recall, name), spec)
            for name, spec in self.observation_spec().items()
        }
        for reading in self._observables.values():
            reading.enabled = True

    # What a subclass declares.

    question: str
    """What is asked, in words."""

    discount = 0.95
    """Gamma of the returns that are scored; the environment's own discount is 1 until an episode's last step."""

    num_structures = 1
    """How many compiled models the hidden property chooses from."""

    largest_hidden: float = math.inf
    """The largest value that a hidden property may be given; the least is 0."""

    @property
    @abc.abstractmethod
    def interactions(self) -> Sequence[declarations.Interaction]:
        """The interaction actions."""

    @property
    @abc.abstractmethod
    def label_names(self) -> Sequence[str]:
        """The answers, in words."""

    @property
    @abc.abstractmethod
    def readings(self) -> Mapping[str, declarations.Reading]:
        """The features, by name."""

    @property
    def num_nuisances(self) -> int:
        """How many numbers say what episodes differ in beside what is hidden, where there is variation.

        By default images differ in where the camera is, and readings in nothing.
        """
        return 3 if self.sense.needs_gl else 0

    @property
    def held(self) -> Sequence[composer.Entity]:
        """Entities that look exactly as at the start until something moves them, each for itself."""
        return ()

    @property
    def indicators(self) -> Sequence[declarations.Indicator]:
        """Geoms that show readings in images."""
        return ()

    @abc.abstractmethod
    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the hidden properties, [N, ...], of some episodes: seeds and episode indices, int64 [N]."""

    @abc.abstractmethod
    def answers(self, hidden: np.ndarray) -> np.ndarray:
        """Returns the indices of the right labels, int64 [N]."""

    def structures(self, hidden: np.ndarray) -> np.ndarray:
        """Returns which compiled model each hidden property needs, int64 [N]."""
        return np.zeros(len(hidden), np.int64)

    def arrange(self, structure: int) -> None:
        """Changes the MJCF model into the one that a structure stands for."""

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        """Returns the model fields that follow from hidden properties: any that `Batch.expand` takes."""
        return {}

    def circumstances(self, apparatus: apparatus_lib.Apparatus, nuisances: np.ndarray) -> declarations.Circumstances:
        """Returns what follows from nuisances, float64 [N, num_nuisances] in [-1, 1], 0 for no variation."""
        return declarations.Circumstances(camera=CAMERA_VARIATION * nuisances)

    def drive(self, actions: np.ndarray, qpos: np.ndarray, ctrl: np.ndarray) -> np.ndarray:
        """Returns what is sent to the actuators during a control step, float64 [N, nu].

        Args:
          actions: the interaction actions, int [N].
          qpos: the coordinates at the start of the step, float64 [N, nq].
          ctrl: what was sent in the step before, float64 [N, nu]; zero in the first.
        """
        return self.controls[actions]

    def play_out(self, physics: Any, label: int) -> Iterator[None]:
        """Steps a simulation on to what an answer leads to, for replays: yields after each physics step."""
        yield from ()

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        """Returns what a replay shows of one hidden property, [...]."""
        return declarations.Revealed()

    def hardness(self, hidden: np.ndarray) -> np.ndarray | None:
        """Returns how hard instances are, float64 [N], the larger the harder; None where it is not known beforehand."""
        return None

    # The question.

    @property
    def num_interactions(self) -> int:
        return self.rules.num_interactions

    @property
    def num_labels(self) -> int:
        return self.rules.num_labels

    @property
    def action_names(self) -> list[str]:
        """Returns what each action does or says, in words."""
        interactions = (interaction.name for interaction in self.interactions)
        return [*interactions, *(f"answer: {name}" for name in self.label_names)]

    @functools.cached_property
    def all_readings(self) -> dict[str, declarations.Reading]:
        """The features, by name, and the right answer where it is revealed."""
        if not self.options.reveal:
            return dict(self.readings)
        revealed = declarations.Reading(
            (), (self.num_labels,), "1 for the right answer, 0 for the others", "", bounds=(0, 1)
        )
        return {**self.readings, ANSWER: revealed}

    @property
    def observation_meanings(self) -> dict[str, str]:
        """What each observation says, in words, with the unit of its values."""
        meanings = {
            name: f"{reading.meaning}, {reading.unit}" if reading.unit else reading.meaning
            for name, reading in self.all_readings.items()
        }
        return {name: meanings.get(name, _IMAGE) for name in self.observation_spec()}

    @property
    def hidden(self) -> np.ndarray:
        """Returns the hidden property of the current episode, which is never part of an observation."""
        return self._ledger.hidden[0].copy()

    @property
    def correct_answer(self) -> int:
        """Index of the right label in the current episode; never observable."""
        return int(self.answers(self.hidden[None])[0])

    def reseed(self, random) -> None:
        """Takes another seed: the next reset starts its first episode; `random` as in `Options`."""
        self.options = dataclasses.replace(self.options, random=random)
        self._ledger.reseed(np.array([self.options.random]))

    @property
    def next_episode(self) -> int:
        """Index of the episode that the next reset starts, in [0, 2**62); set it to rebuild any episode."""
        return int(self._ledger.next_episodes[0])

    @next_episode.setter
    def next_episode(self, episode: int) -> None:
        self._ledger.next_episodes[0] = checks.integer("next_episode", episode, 0, seeding.LAST_EPISODE)

    @property
    def episode(self) -> int:
        """Index of the current episode, -1 before the first."""
        return self.next_episode - 1

    @property
    def steps(self) -> int:
        """Control steps taken in the current episode."""
        return int(self._ledger.steps[0])

    @property
    def structure(self) -> int:
        """The compiled model that the current episode needs."""
        return int(self._ledger.structures[0])

    @property
    def answered(self) -> bool:
        """Whether the last action was a labeling action."""
        return self._action >= self.num_interactions

    def give_hidden(self, hidden: Any) -> None:
        """Makes the next reset start an episode with this hidden property, [...]. For analysis."""
        self._given_hidden = np.asarray(hidden)[None]

    def action_spec(self, physics=None) -> specs.DiscreteArray:
        return specs.DiscreteArray(self.rules.num_actions, dtype=np.int32, name="action")

    def observation_spec(self) -> dict[str, specs.Array]:
        """Returns the specs of what one environment observes."""
        described = {}
        for name, blank in self.blank_observations(1).items():
            array = specs.Array(blank.shape[1:], blank.dtype, name)
            bounds = self.all_readings[name].bounds if name in self.all_readings else None
            if bounds is not None and not (self.options.noise and name in self._noisy):
                array = specs.BoundedArray(array.shape, array.dtype, *bounds, name)
            described[name] = array
        return described

    # The apparatus.

    def build_apparatus(self, structure: int) -> apparatus_lib.Apparatus:
        """Compiles the MJCF of a structure."""
        return self.build_apparatuses([structure])[0]

    def build_apparatuses(self, structures: Sequence[int]) -> list[apparatus_lib.Apparatus]:
        """Compiles the MJCF of structures."""
        return [apparatus_lib.build(xml, self.readings, self.held, self.indicators) for xml in self.compose(structures)]

    def compose(self, structures: Sequence[int]) -> list[str]:
        """Returns the MJCF of structures as text."""
        found = []
        for structure in structures:
            self.arrange(structure)
            found.append(self.root_entity.mjcf_model.to_xml_string())
        return found

    def begin(
        self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray, nuisances: np.ndarray
    ) -> tuple[list[tuple[str, np.ndarray, np.ndarray]], apparatus_lib.Starts]:
        """Returns what episodes are simulated with.

        Args:
          apparatus: what is simulated.
          hidden: the hidden properties, [N, ...].
          nuisances: float64 [N, number of them], which is 0 without variation.

        Returns:
          Fields of the model, their addresses, int [M], and values, float64 [N, M]; and how the episodes start.
        """
        fields = self.hidden_fields(apparatus, hidden)
        if not nuisances.shape[1]:
            return _listed(fields), apparatus.start.repeated(len(nuisances))
        circumstances = self.circumstances(apparatus, nuisances)
        starts = apparatus.starts(circumstances, len(nuisances))
        return _listed(fields) + _listed(circumstances.fields), starts

    def blank_observations(self, size: int) -> dict[str, np.ndarray]:
        """Returns arrays for the observations of `size` environments."""
        return self.sense.blank({name: reading.shape for name, reading in self.all_readings.items()}, size)

    def look(self, apparatus: apparatus_lib.Apparatus, state, touched, starts, rows, observations) -> None:
        """Writes the observations of some simulations.

        Args:
          apparatus: what is simulated.
          state: the fields that the sense looks at, float64 [N, ...].
          touched: whether each held entity has been touched, bool [N, number of held entities].
          starts: how episodes started, with a leading axis that `rows` index.
          rows: which environments these are, int [N].
          observations: arrays with a leading axis that `rows` index; written to.
        """
        shown = {field: apparatus.shown(field, values, touched, starts, rows) for field, values in state.items()}
        self.sense.look(apparatus, shown, starts.camera[rows], rows, observations)

    @functools.cached_property
    def _noisy(self) -> dict[str, tuple[int, ...]]:
        """The shapes of the readings that noise is added to, by name."""
        if self.sense.needs_gl:
            return {}
        return {name: reading.shape for name, reading in self.readings.items() if reading.unit == "m"}

    def add_noise(self, ledger: episodes.Ledger, rows, observations) -> None:
        """Adds the noise of the current control step to the observations of some environments.

        It follows from seed, episode, step and reading alone: it is the same whatever is hidden.

        Args:
          ledger: of the environments.
          rows: which of them, int [N].
          observations: arrays with a leading axis that `rows` index; written to.
        """
        if not self.options.noise:
            return
        sizes = [math.prod(shape) for shape in self._noisy.values()]
        draws = seeding.normals(ledger.seeds[rows], ledger.next_episodes[rows] - 1, ledger.steps[rows], sum(sizes))
        parts = np.split(self.options.noise * draws, np.cumsum(sizes)[:-1], axis=1)
        for (name, shape), part in zip(self._noisy.items(), parts, strict=True):
            observations[name][rows] += part.reshape(len(part), *shape).astype(np.float32)

    def reveal_answers(self, ledger: episodes.Ledger, rows, observations) -> None:
        """Writes the right answers, where they are observed; arguments as for `add_noise`."""
        if self.options.reveal:
            observations[ANSWER][rows] = ledger.answers[rows, None] == np.arange(self.num_labels)

    def close(self) -> None:
        """Frees what the sense holds. A closed task can be played again."""
        self.sense.close()

    def note_divergence(self) -> None:
        """Tells the task that the simulation has diverged: the last observation stays the one before."""
        self.num_divergences += 1
        self._diverged = True

    def _look(self, state) -> None:
        self.measured = state["sensordata"].copy()
        self.look(self.apparatus, state, self._ledger.touched, self._starts, _ROW, self._seen)
        self.add_noise(self._ledger, _ROW, self._seen)

    def _recall(self, name: str, physics) -> np.ndarray:
        """Returns the last observation: composer may ask many times, and it is made once for each control step."""
        return self._seen[name][0].copy()

    # The composer task.

    @property
    def root_entity(self):
        return self._arena

    @property
    def task_observables(self):
        return self._observables

    def initialize_episode_mjcf(self, random_state):
        given, self._given_hidden = self._given_hidden, None
        self._ledger.begin(_ROW, given)
        self.control_timestep = int(self._ledger.substeps[0]) * self.physics_timestep
        self.arrange(self.structure)

    def initialize_episode(self, physics, random_state):
        fields, self._starts = self.begin(self.apparatus, self._ledger.hidden, self._ledger.nuisances)
        for field, addresses, values in fields:
            getattr(physics.model, field)[addresses] = values[0]
        physics.data.qpos[:] = self._starts.qpos[0]
        self._action = 0
        self._look({field: self._starts.shown[field] for field in self.sense.fields})
        self.reveal_answers(self._ledger, _ROW, self._seen)
        if self.options.visualize_reward:
            physics.bind(self._arena.floor).rgba = self._arena.floor.rgba

    def before_step(self, physics, action, random_state):
        checked = self.rules.check_type(action, ())
        self.rules.check_range(checked)
        self._action = int(checked)
        self._diverged = False
        self._ledger.steps[0] += 1
        if not self.answered:
            data = physics.data
            data.ctrl[:] = (self.drive(checked[None], data.qpos[None], data.ctrl[None]) * self._starts.strength)[0]
            if self._ledger.steps[0] == 1:
                data.qacc_warmstart[:] = 0  # A batch resets its rows without a forward pass.

    def after_step(self, physics, random_state):
        data = physics.data
        if not (self.answered or self._diverged):
            self._ledger.touched |= self.apparatus.moved(data.qpos[None], self._starts.qpos)
            self._look({field: getattr(data, field)[None] for field in self.sense.fields})
            self.apparatus.indicate(data.geom_xpos[None], data.sensordata[None])  # For `physics.render`.
        rewards, last = self._ledger.judge(_ROW, np.array([self._action]))
        self._reward, self._last = float(rewards[0]), bool(last[0])
        if self.options.visualize_reward and self._last:
            physics.bind(self._arena.floor).rgba = _OK_RGBA if self._reward > 0 else _WRONG_RGBA

    def get_reward(self, physics):
        return self._reward

    def get_discount(self, physics):
        return 0.0 if self._last else 1.0

    def should_terminate_episode(self, physics):
        return self._last


def _listed(fields: declarations.Fields) -> list[tuple[str, np.ndarray, np.ndarray]]:
    return [(field, addresses, values) for field, (addresses, values) in fields.items()]
