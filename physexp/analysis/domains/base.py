"""Facts about a domain that the analysis uses, as data. Imports nothing heavy: the command line is made from it."""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
import functools
from typing import TYPE_CHECKING, Any

from physexp import checks
from physexp.agents import config as agent_config
from physexp.agents.a3c import config as a3c
from physexp.agents.ppo import config as ppo

if TYPE_CHECKING:
    import numpy as np

    from physexp.agents import core
    from physexp.analysis.ideal import base as ideal
    from physexp.analysis.ideal import resting, search


TRACKS = {
    "exact": "the tasks of the first version, from features",
    "pixels": "the same, from images",
    "plan": "those where the most informative interaction is the wrong one, or only prepares another",
    "noise": "readings that are wrong at times",
    "questions": "questions that are not asked in training",
    "unseen": "settings that are not trained on",
}
"""The tracks of the score, and what they ask for; the facts of each domain have their settings."""
HELD_OUT = ("questions", "unseen")
"""Tracks on whose settings no agent may be trained."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class NoOptions:
    """Options of an ideal experimenter that has none."""


class Ideal:
    """Finds the ideal experimenters of a domain's tasks; solves each question once.

    A task that reveals the answer has the same ideal experimenter in every domain: it answers at once.

    Attributes:
      options: a dataclass of the options that the ideal experimenter has besides the task's, with their defaults
        and checks.
    """

    def __init__(self, domain: str, solve: "Callable[..., ideal.Solution]", options: type = NoOptions):
        """Takes a function of a task, its `task_kwargs`, a discount, and the options by name."""
        self.options, self._domain, self._solve = options, domain, solve
        self._solutions: dict[str, ideal.Solution] = {}

    def __call__(self, task: str, task_kwargs: Mapping[str, Any], discount: float, **options: Any) -> "ideal.Solution":
        """Returns the ideal experimenter of a task.

        Args:
          task, task_kwargs: as for `suite.load`; the seed is ignored.
          discount: the agent's gamma, above 0 and at most 1.
          **options: fields of `options`.

        Raises:
          ValueError: for an unknown task or a value that is not allowed.
        """
        asked = {name: value for name, value in task_kwargs.items() if name != "random"}
        discount = checks.discount("discount", discount)
        checks.check_fields(self.options(**options))
        question = repr((task, sorted(asked.items()), discount, sorted(options.items())))
        if question not in self._solutions:
            self._solutions[question] = self._find(task, asked, discount, options)
        return self._solutions[question]

    def _find(self, task, task_kwargs, discount, options) -> "ideal.Solution":
        if task_kwargs.get("reveal"):
            from physexp.analysis.ideal import revealed

            for name, value in options.items():
                raise ValueError(f"{name} is {value}; leave it out with reveal: the answer is known from the start")
            return revealed.Solution(self._domain, task, task_kwargs, discount)
        if variation := task_kwargs.get("step_variation"):
            raise ValueError(
                f"step_variation is {variation}; give 0: the ideal experimenter needs control steps of equal length"
            )
        return self._solve(task, task_kwargs, discount, **options)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Domain:
    """Facts about a domain.

    Attributes:
      name: the domain's name, as `suite.load` takes it.
      presets: default configurations for training, by task and algorithm. Their discount is replaced by the domain's.
        Tasks and algorithms without a preset use the algorithm's defaults.
      labels: by task, the short name of a condition, in which `{option}` stands for an option's value.
      targets: by the names of the agents that come with the package, the least value of a statistic of their
        evaluation: the statistic's name, and the value.
      ideal: finds the ideal experimenter; None if none is known.
      tracks: the options of the domain's tasks in each track of the score that has the domain, by the name in `TRACKS`,
        once for each setting. Scores stay comparable with those of earlier days only if all tracks stay as they are.
      baselines: by task and name, functions that make the actors of hand-written baselines.
      hidden_columns: returns columns for tables of episodes, by name, [N, ...], from hidden properties, [N, ...].
    """

    name: str
    presets: Mapping[str, Mapping[str, agent_config.AgentConfig]] = dataclasses.field(default_factory=dict)
    labels: Mapping[str, str] = dataclasses.field(default_factory=dict)
    targets: Mapping[str, tuple[str, float]] = dataclasses.field(default_factory=dict)
    ideal: Ideal | None = None
    tracks: Mapping[str, Sequence[Mapping[str, Any]]] = dataclasses.field(default_factory=dict)
    baselines: "Mapping[str, Mapping[str, Callable[[], core.Actor]]]" = dataclasses.field(default_factory=dict)
    hidden_columns: "Callable[[np.ndarray], Mapping[str, np.ndarray]]" = lambda hidden: {}

    @functools.cached_property
    def discount(self) -> float:
        """Gamma of the returns that are scored: that of the domain's tasks."""
        from physexp import suite

        return suite.load_task(self.name, suite.TASKS_BY_DOMAIN[self.name][0]).discount

    @property
    def usual_options(self) -> Mapping[str, Any]:
        """The options of the domain's tasks in the track `exact`; none if it is not there."""
        return next(iter(self.tracks.get("exact", ())), {})

    def ideal_with(self, task_kwargs: Mapping[str, Any]) -> Ideal | None:
        """Returns `ideal` if it is exact with these options, otherwise None.

        Noise, variation and step variation make it inexact, unless the answer is revealed.
        """
        is_inexact = any(task_kwargs.get(name) for name in ("noise", "variation", "step_variation"))
        return None if is_inexact and not task_kwargs.get("reveal") else self.ideal

    def label(self, task: str, task_kwargs: Mapping[str, Any]) -> str:
        """Returns the short name of a task with these options; by default, its domain and task."""
        try:
            return self.labels[task].format_map(task_kwargs)
        except KeyError:
            return f"{self.name} {task}"


def resting_domain(
    name: str,
    apparatus: "Callable[[Any], resting.Apparatus]",
    read: "Callable[[Mapping[str, np.ndarray]], int]",
    asked: "Callable[[Any, np.ndarray], resting.Apparatus] | None" = None,
    **facts: Any,
) -> Domain:
    """Returns a domain whose apparatus rests between interactions, so that its ideal experimenter is exact.

    Args:
      name: name of the domain.
      apparatus: returns the apparatus for the task's options.
      read: returns the reading in an observation of features.
      asked: returns the apparatus for the task's options and the table of a question that is told. By default, the
        question is no part of the apparatus, and all its states without renaming must be few, see `questions`.
      **facts: other attributes of the domain.
    """

    def solve(task: str, task_kwargs: Mapping[str, Any], discount: float) -> "ideal.Solution":
        from physexp import suite
        from physexp.analysis.ideal import questions, resting

        played = suite.load_task(name, task, task_kwargs)
        options, told = played.options, played.told
        can_read = read if "features" in suite.tags(name, task) else None

        def find(hidden: "np.ndarray") -> "tuple[int, Sequence[int]]":
            return int(played.kinds(hidden[None])[0]), told.drawn(hidden) if told else [0]

        common: dict[str, Any] = dict(discount=discount, step_limit=played.rules.step_limit, read=can_read, find=find)
        if told is None:
            return resting.Solution(apparatus(options), **common)
        if asked is None:
            return questions.Solution(apparatus(options), told.tables, told.count, **common, ask=told.asked)
        each = [asked(options, table) for table in told.tables]
        return resting.Solution(each[0], **common, ask=told.asked, told=each)

    return Domain(name=name, ideal=Ideal(name, solve), **facts)


def search_domain(
    name: str, hypotheses: "Callable[[], tuple[np.ndarray, np.ndarray]]", read_as: str = "features", **facts: Any
) -> Domain:
    """Returns a domain with finitely many hidden properties, whose ideal experimenter is found by search.

    Args:
      name: name of the domain.
      hypotheses: returns all values of the hidden property, [H, ...], and their probabilities, float64 [H].
      read_as: as for `hypotheses.Hypotheses`.
      **facts: other attributes of the domain.
    """

    def solve(task: str, task_kwargs: Mapping[str, Any], discount: float) -> "search.Solution":
        from physexp.analysis.ideal import hypotheses as hypotheses_lib
        from physexp.analysis.ideal import search

        known = hypotheses_lib.Hypotheses(name, task, *hypotheses(), task_kwargs, read_as=read_as)
        return search.Solution(known, 0.0, discount)

    return Domain(name=name, ideal=Ideal(name, solve), **facts)


def ppo_like(preset: a3c.A3CConfig, **changes) -> ppo.PPOConfig:
    """Returns a configuration of PPO with the hyperparameters that it shares with A3C, and with changes."""
    shared = {field.name: getattr(preset, field.name) for field in dataclasses.fields(agent_config.ActorCriticConfig)}
    return ppo.PPOConfig(**{**shared, **changes})


# One bit a reading: the reward depends on several readings together, so the policy must stay broad until it uses them
# all. Hence much entropy at first, and many episodes in an update.
A3C_OF_BITS = a3c.A3CConfig(
    frames=3_000_000,
    envs_per_worker=128,
    learning_rate=3e-3,
    gae_lambda=0.95,
    entropy_cost=0.2,
    final_entropy_cost=0.002,
    observation_scale=2.0,
)
PPO_OF_BITS = ppo_like(A3C_OF_BITS, frames=1_200_000, num_environments=512)

# Such tasks show few different images, and equal images pass the convolutions once: large updates are cheap.
A3C_OF_FEW_IMAGES = A3C_OF_BITS.replace(frames=1_500_000, envs_per_worker=64, learning_rate=1e-3, observation_scale=8.0)
PPO_OF_FEW_IMAGES = ppo_like(A3C_OF_FEW_IMAGES, num_environments=1024)

PRESETS_OF_BITS: Mapping[str, Mapping[str, agent_config.AgentConfig]] = {
    "features": {"a3c": A3C_OF_BITS, "ppo": PPO_OF_BITS},
    "pixels": {"a3c": A3C_OF_FEW_IMAGES, "ppo": PPO_OF_FEW_IMAGES},
}
"""The presets of a domain whose readings are bits, by task and algorithm."""
