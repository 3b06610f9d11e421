"""The contract of a task: what a question declares about something that cannot be seen (paper, Section 3)."""

import abc
from collections.abc import Callable, Iterator, Mapping, Sequence
import dataclasses
import functools
import math
from typing import Any

from dm_control import composer
from dm_control.utils import containers
from dm_env import specs
import numpy as np

from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import declarations, observing, rules
from physexp.suite.engine import options as options_lib

CAMERA_VARIATION = 0.02  # m, in each direction


@dataclasses.dataclass(frozen=True, kw_only=True)
class Scene:
    """The parts of a task: the scene, and what can be done, seen and answered in it.

    Attributes:
      arena: the arena, with all entities attached.
      interactions: the interaction actions.
      label_names: the answers, in words.
      readings: the features, by name.
      indicators: geoms that show readings in images.
      staged: geoms that show readings to people alone.
      held: entities that look exactly as at the start until something moves them, each for itself.
      num_nuisances: how many numbers describe the variation of an episode; None if only the camera varies.
      num_structures: how many compiled models the hidden property chooses from.
    """

    arena: composer.Arena
    interactions: Sequence[declarations.Interaction]
    label_names: Sequence[str]
    readings: Mapping[str, declarations.Reading]
    indicators: Sequence[declarations.Indicator] = ()
    staged: Sequence[declarations.Staged] = ()
    held: Sequence[composer.Entity] = ()
    num_nuisances: int | None = None
    num_structures: int = 1


class Task(abc.ABC):
    """A task in which interaction actions act and labeling actions answer.

    A subclass builds the scene, says how the hidden property of an episode is drawn, and what follows from it. Methods
    with a leading axis [N] serve one environment (N = 1) and a batch alike. A task holds no episode: `Environment` and
    `BatchEnvironment` play it.

    Attributes:
      options: the options that the user chose.
      pixels: whether images are observed in place of features.
      scene: the parts of the task.
      rules: how actions are read and judged.
      controls: control signals of each interaction action, float64 [num_interactions, nu].
      observer: writes the observations.
    """

    question: str
    """The question, in words."""

    discount = 0.95
    """Gamma of the returns that are scored; the environment's own discount is 1 until an episode's last step."""

    told: Any = None
    """The questions that are drawn and told, `parts.questions.Questions`, if they are; `build` sets them."""

    largest_hidden: float | np.ndarray = math.inf
    """The largest value that a hidden property may be given, one or [...]; the least is 0."""

    options: Any
    """The options, of the domain's own class."""

    def __init__(self, options: options_lib.Options, pixels: bool = False):
        self.options = options
        self.pixels = pixels
        self.scene = self.build()
        self.root_entity.mjcf_model.option.timestep = options.physics_timestep
        counts = len(self.interactions), len(self.label_names), options.step_limit
        self.rules = rules.Rules(*counts, self.told.count if self.told else 1)
        self.controls = np.array([interaction.control for interaction in self.interactions], float)
        self.observer = observing.Observer(self)
        if options.variation and not self.num_nuisances:
            raise ValueError(f"variation is {options.variation:g}; give 0 where episodes differ in nothing else")

    # A subclass defines three methods.

    @abc.abstractmethod
    def build(self) -> Scene:
        """Returns the scene; called once, when `options` and `pixels` are set."""

    @abc.abstractmethod
    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the hidden properties, [N, ...], of some episodes: seeds and episode indices, int64 [N]."""

    @abc.abstractmethod
    def answers(self, hidden: np.ndarray) -> np.ndarray:
        """Returns the indices of the right labels, int64 [N], or [N, K] of the K questions of an episode."""

    # It may define others.

    @property
    def description(self) -> str:
        """The apparatus, in words: the effects of interactions, what lasts, and how likely the labels are."""
        return ""

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        """Returns the model fields that follow from hidden properties: any that `Batch.expand` takes."""
        return {}

    def kinds(self, hidden: np.ndarray) -> np.ndarray:
        """Returns the kinds of hidden properties that questions distinguish, int64 [N]; by default the right labels."""
        return self.answers(hidden)

    def structures(self, hidden: np.ndarray) -> np.ndarray:
        """Returns the compiled model that each hidden property needs, int64 [N]."""
        return np.zeros(len(hidden), np.int64)

    def arrange(self, structure: int) -> None:  # noqa: B027
        """Changes the MJCF model and the scene into those of a structure."""

    def circumstances(self, apparatus: apparatus_lib.Apparatus, nuisances: np.ndarray) -> declarations.Circumstances:
        """Returns the variation that follows from nuisances, float64 [N, num_nuisances] in [-1, 1]; 0 is none."""
        return declarations.Circumstances(camera=CAMERA_VARIATION * nuisances)

    def drive(self, actions: np.ndarray, qpos: np.ndarray, ctrl: np.ndarray) -> np.ndarray:
        """Returns the control signals of a control step, float64 [N, nu].

        Args:
          actions: the interaction actions, int [N].
          qpos: the coordinates at the start of the step, float64 [N, nq].
          ctrl: the control signals of the step before, float64 [N, nu]; zero in the first.
        """
        return self.controls[actions]

    def play_out(self, physics: Any, label: int) -> Iterator[None]:
        """Steps a simulation on to the consequences of an answer, for replays; yields after each physics step."""
        yield from ()

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        """Returns the marks that a replay shows for one hidden property, [...]."""
        return declarations.Revealed()

    def hardness(self, hidden: np.ndarray) -> np.ndarray | None:
        """Returns how hard instances are, float64 [N], the larger the harder; None where it is not known beforehand."""
        return None

    # All follows from these.

    @property
    def interactions(self) -> Sequence[declarations.Interaction]:
        return self.scene.interactions

    @property
    def label_names(self) -> Sequence[str]:
        return self.scene.label_names

    @property
    def readings(self) -> Mapping[str, declarations.Reading]:
        return self.scene.readings

    @property
    def root_entity(self) -> composer.Arena:
        return self.scene.arena

    @property
    def num_nuisances(self) -> int:
        """Number of values that describe the variation of an episode."""
        given = self.scene.num_nuisances
        return given if given is not None else 3 * self.pixels

    @property
    def num_interactions(self) -> int:
        """Number of interaction actions; they come first."""
        return self.rules.num_interactions

    @property
    def is_told(self) -> bool:
        """Whether the first observation of an episode tells which question is asked."""
        return self.told is not None

    @property
    def step_limit(self) -> int:
        """Maximum number of actions in an episode."""
        return self.rules.step_limit

    @property
    def num_labels(self) -> int:
        return len(self.label_names)

    @property
    def action_names(self) -> list[str]:
        """The meaning of each action, in words."""
        interactions = (interaction.name for interaction in self.interactions)
        return [*interactions, *(f"answer: {name}" for name in self.label_names)]

    @functools.cached_property
    def observation_meanings(self) -> dict[str, str]:
        """The meaning of each observation, in words, with the unit of its values."""
        return self.observer.meanings()

    def tell(self, hidden: np.ndarray, asked: np.ndarray, steps: np.ndarray) -> np.ndarray:
        """Returns the values of the sensors of type `user`, float64 [N, number of values], after steps, int64 [N].

        By default they tell the questions of these indices, int64 [N], among the K questions of each episode.
        """
        return self.told.tell(self.told.drawn(hidden), asked) if self.told else np.zeros((len(hidden), 0))

    def reseed(self, random: Any) -> None:
        """Takes another seed; `random` as in `Options`."""
        self.options = dataclasses.replace(self.options, random=random)

    def action_spec(self) -> specs.DiscreteArray:
        return specs.DiscreteArray(self.rules.num_actions, dtype=np.int32, name="action")

    def observation_spec(self) -> dict[str, specs.Array]:
        """Returns the specs of the observations of one environment, by name."""
        return self.observer.specs()

    def build_apparatus(self, structure: int) -> apparatus_lib.Apparatus:
        """Compiles the MJCF of a structure."""
        return apparatus_lib.build(self.compose(structure), self.readings, self.scene.held, self.scene.indicators)

    def compose(self, structure: int) -> str:
        """Returns the MJCF of a structure as text."""
        self.arrange(structure)
        return self.root_entity.mjcf_model.to_xml_string()

    def begin(
        self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray, nuisances: np.ndarray
    ) -> tuple[list[tuple[str, tuple[np.ndarray, np.ndarray]]], apparatus_lib.Starts]:
        """Returns the model fields of N episodes with addresses, int [M], and values, [N, M], and their initial states.

        They follow from the hidden properties, [N, ...], and the nuisances, [N, 0] without variation.
        """
        fields = list(self.hidden_fields(apparatus, hidden).items())
        if nuisances.shape[1]:
            circumstances = self.circumstances(apparatus, nuisances)
            fields += circumstances.fields.items()
        elif len(apparatus.told):
            circumstances = declarations.Circumstances()
        else:
            return fields, apparatus.start.repeated(len(nuisances))
        starts = apparatus.starts(circumstances, len(nuisances))
        starts.shown["sensordata"][:, apparatus.told] = self.tell(hidden, *np.zeros((2, len(hidden)), np.int64))
        return fields, starts

    def close(self) -> None:
        """Frees the renderers. A closed task can be played again."""
        self.observer.close()


def features_and_pixels(
    kind: Callable[..., Task] | None = None, **kinds: Callable[..., Task]
) -> containers.TaggedTasks:
    """Returns the suite of a domain: two tasks, `features` and `pixels`, from its class of task.

    Several kinds have two tasks each, as `fist_features` and `fist_pixels`, with their names as tags.
    """
    suite = containers.TaggedTasks()
    for observed in ("features", "pixels"):
        for name, make in ({"": kind} if kind else kinds).items():
            factory = functools.partial(make, pixels=observed == "pixels")
            factory.__name__ = f"{name}_{observed}".removeprefix("_")  # type: ignore[attr-defined]
            suite.add(observed, *filter(None, [name]))(factory)
    return suite
