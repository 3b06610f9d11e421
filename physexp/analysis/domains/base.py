"""What the analysis knows of a domain, as data. Imports nothing heavy, since the command line is made from it."""

from collections.abc import Callable, Mapping
import dataclasses
import functools
from typing import TYPE_CHECKING, Any

from physexp.agents import config as agent_config
from physexp.agents.a3c import config as a3c
from physexp.agents.ppo import config as ppo

if TYPE_CHECKING:
    import numpy as np

    from physexp.agents import core
    from physexp.analysis.ideal import base as ideal


@dataclasses.dataclass(frozen=True, kw_only=True)
class NoOptions:
    """What can be chosen of an ideal experimenter where the task says all."""


@dataclasses.dataclass(frozen=True)
class Ideal:
    """How to find the ideal experimenter of a domain's tasks. Calling it solves, once for each question.

    A task that reveals the answer has the same ideal experimenter in every domain, who gives it at once.

    Attributes:
      domain: the domain's name.
      solve: returns the `Solution` of a task, its `task_kwargs` and a discount, with further options by name; raises
        ValueError for a value that makes no sense.
      options: a dataclass of those further options, with their defaults.
    """

    domain: str
    solve: "Callable[..., ideal.Solution]"
    options: type = NoOptions
    _found: "dict[str, ideal.Solution]" = dataclasses.field(default_factory=dict, init=False, repr=False, compare=False)

    def __call__(self, task: str, task_kwargs: Mapping[str, Any], discount: float, **options: Any) -> "ideal.Solution":
        asked = {name: value for name, value in task_kwargs.items() if name != "random"}
        question = repr((task, sorted(asked.items()), discount, sorted(options.items())))
        if question not in self._found:
            self._found[question] = self._solve(task, asked, discount, options)
        return self._found[question]

    def _solve(self, task, task_kwargs, discount, options) -> "ideal.Solution":
        if not task_kwargs.get("reveal"):
            if task_kwargs.get("step_variation"):
                raise ValueError(
                    f"step_variation is {task_kwargs['step_variation']}; "
                    "give 0: the ideal experimenter is known where all control steps are alike"
                )
            return self.solve(task, task_kwargs, discount, **options)
        if options:
            name, value = next(iter(options.items()))
            raise ValueError(
                f"{name} is {value}; leave it out with reveal: what is revealed is told apart from the start"
            )
        from physexp.analysis.ideal import revealed

        return revealed.Solution(self.domain, task, task_kwargs, discount)


def nothing(hidden: "np.ndarray") -> "Mapping[str, np.ndarray]":
    """Returns no columns: those of a domain without columns of its own."""
    return {}


@dataclasses.dataclass(frozen=True, kw_only=True)
class Domain:
    """What the analysis knows of a domain.

    Attributes:
      name: the domain's name, as `suite.load` takes it.
      skill: what it asks of an agent beyond others, in a few words.
      presets: by task and algorithm, the configuration to train with where nothing else is asked for, but for the
        discount, which is the domain's. A task or an algorithm that is not there has the algorithm's defaults.
      labels: by task, the short name of a condition, in which `{option}` stands for an option's value.
      targets: by the names of the agents that come with the package, what each must reach: a figure of its evaluation
        and the least value.
      ideal: how to find the ideal experimenter; None where none is known.
      baselines: by task, experimenters that nobody trained, by name, as functions that make their actors.
      hidden_columns: returns columns for tables of episodes, by name, [N, ...], of hidden properties, [N, ...].
    """

    name: str
    skill: str = ""
    presets: Mapping[str, Mapping[str, agent_config.AgentConfig]] = dataclasses.field(default_factory=dict)
    labels: Mapping[str, str] = dataclasses.field(default_factory=dict)
    targets: Mapping[str, tuple[str, float]] = dataclasses.field(default_factory=dict)
    ideal: Ideal | None = None
    baselines: "Mapping[str, Mapping[str, Callable[[], core.Actor]]]" = dataclasses.field(default_factory=dict)
    hidden_columns: "Callable[[np.ndarray], Mapping[str, np.ndarray]]" = nothing

    @functools.cached_property
    def discount(self) -> float:
        """Gamma of the returns that are scored, as the domain's tasks have it."""
        from physexp import suite

        return suite.load_task(self.name, suite.TASKS_BY_DOMAIN[self.name][0]).discount

    def ideal_with(self, task_kwargs: Mapping[str, Any]) -> Ideal | None:
        """Returns how to find the ideal experimenter of tasks with these options.

        None with noise, variation or step variation, unless the answer is revealed.
        """
        is_alike = not any(task_kwargs.get(name) for name in ("noise", "variation", "step_variation"))
        return self.ideal if is_alike or task_kwargs.get("reveal") else None

    def label(self, task: str, task_kwargs: Mapping[str, Any]) -> str:
        """Returns the short name of a task with these options; domain and task where it has no other."""
        try:
            return self.labels[task].format_map(task_kwargs)
        except KeyError:
            return f"{self.name} {task}"


def ppo_like(preset: a3c.A3CConfig, **changes) -> ppo.PPOConfig:
    """Returns a configuration of PPO with the hyperparameters that A3C's has too, and with changes."""
    shared = {field.name: getattr(preset, field.name) for field in dataclasses.fields(agent_config.ActorCriticConfig)}
    return ppo.PPOConfig(**{**shared, **changes})


# Where readings are bits, rewards tell of the last of several only, so policies must stay broad until those are used:
# much entropy at first, and many episodes to an update.
A3C_OF_BITS = a3c.A3CConfig(
    frames=3_000_000,
    envs_per_worker=128,
    learning_rate=3e-3,
    trace=0.95,
    entropy_cost=0.2,
    final_entropy_cost=0.002,
    observation_scale=2.0,
)
PPO_OF_BITS = ppo_like(A3C_OF_BITS, frames=1_200_000, num_environments=512)

# Such readings make few different images, and only different ones pass the convolutions: the larger an update, the
# cheaper.
A3C_OF_FEW_IMAGES = A3C_OF_BITS.replace(frames=1_500_000, envs_per_worker=64, learning_rate=1e-3, observation_scale=8.0)
PPO_OF_FEW_IMAGES = ppo_like(A3C_OF_FEW_IMAGES, num_environments=1024)

PRESETS_OF_BITS: Mapping[str, Mapping[str, agent_config.AgentConfig]] = {
    "features": {"a3c": A3C_OF_BITS, "ppo": PPO_OF_BITS},
    "pixels": {"a3c": A3C_OF_FEW_IMAGES, "ppo": PPO_OF_FEW_IMAGES},
}
"""The presets of a domain whose readings are bits, by task and algorithm."""
