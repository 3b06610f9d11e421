"""The configuration of a training run: the task, its options, and the agent's configuration.

Imports nothing heavy, since the command line is made from it.
"""

from collections.abc import Mapping
import dataclasses
from typing import Any

from physexp import checks
from physexp.agents import config as agent_config
from physexp.agents.a3c import config as a3c
from physexp.agents.belief import config as belief
from physexp.agents.ppo import config as ppo
from physexp.analysis import domains

REPLAY_EVERY = 1_000_000
"""Environment steps between the replays that `physexp train` writes."""

ALGORITHMS: dict[str, type[agent_config.AgentConfig]] = {
    config.algorithm: config for config in (a3c.A3CConfig, belief.BeliefConfig, ppo.PPOConfig)
}
"""The configurations of all agents, by name."""

DEFAULT_ALGORITHM = belief.BeliefConfig.algorithm
"""The learner that needs the fewest environment steps."""

_UNNAMED = a3c.A3CConfig.algorithm  # Names of runs leave the paper's learner out.


def preset(domain: str = "", task: str = "", *, algorithm: str = DEFAULT_ALGORITHM) -> agent_config.AgentConfig:
    """Returns a task's preset for an algorithm, or the algorithm's defaults, with the domain's discount, if any."""
    if not domain:
        return ALGORITHMS[algorithm]()
    known = domains.find(domain)
    preset = known.presets.get(task, {}).get(algorithm, ALGORITHMS[algorithm]())
    return preset.replace(discount=known.discount)


@dataclasses.dataclass(frozen=True, kw_only=True)
class TrainConfig:
    """A training run.

    Attributes:
      domain, task: names of the environment.
      task_kwargs: the `task_kwargs` of `suite.load` that were chosen, without the seed: numbers, texts or flags.
      also: options of further settings, beside `task_kwargs`; rounds of training take turns in all of them.
      replay_every: environment steps between replays that training writes; 0 for none.
      agent: the agent's configuration.
    """

    domain: str
    task: str
    task_kwargs: Mapping[str, Any] = dataclasses.field(default_factory=dict, hash=False)  # Dictionaries have no hash.
    also: tuple[Mapping[str, Any], ...] = dataclasses.field(default=(), hash=False)
    replay_every: int = 0
    agent: agent_config.AgentConfig

    def __post_init__(self):
        object.__setattr__(self, "replay_every", checks.integer("replay_every", self.replay_every, 0))
        task_kwargs, *also = map(_as_options, (self.task_kwargs, *self.also))  # Copies, which the caller cannot change.
        object.__setattr__(self, "task_kwargs", task_kwargs)
        object.__setattr__(self, "also", tuple(also))

    @property
    def task_name(self) -> str:
        """Domain and task, as `towers/fist_features`."""
        return f"{self.domain}/{self.task}"

    @property
    def label(self) -> str:
        """A short label of the task and its options, as `10-F`."""
        return domains.find(self.domain).label(self.task, self.task_kwargs)

    @property
    def name(self) -> str:
        """A name for the run's folder."""
        options = "-also".join(map(_in_name, (self.task_kwargs, *self.also)))
        algorithm = "" if self.agent.title == _UNNAMED else f"-{self.agent.title}"
        numbers = f"discount{self.agent.discount:g}-seed{self.agent.seed}"
        return f"{self.domain}-{self.task}{options}{algorithm}-{numbers}"

    @property
    def settings(self) -> "list[TrainConfig]":
        """The configuration of each setting alone that training takes turns in; the first is that of `task_kwargs`."""
        every = ({**self.task_kwargs, **more} for more in ({}, *self.also))
        return [dataclasses.replace(self, task_kwargs=task_kwargs, also=()) for task_kwargs in every]

    def load_task(self) -> Any:
        """Returns the task with its options; see `suite.load_task`."""
        from physexp import suite  # Imports MuJoCo.

        return suite.load_task(self.domain, self.task, self.task_kwargs)

    def to_json(self) -> dict:
        """Returns the fields as JSON; `from_json` makes an equal configuration of them."""
        fields = dataclasses.asdict(self)
        return {**fields, "agent": {"algorithm": self.agent.algorithm, **fields["agent"]}}

    @classmethod
    def from_json(cls, fields: dict) -> "TrainConfig":
        """Returns the configuration that `to_json` has written."""
        agent: dict[str, Any] = {
            name: tuple(value) if isinstance(value, list) else value  # JSON has lists.
            for name, value in fields["agent"].items()
        }
        algorithm = ALGORITHMS[agent.pop("algorithm")]
        return cls(**{**fields, "also": tuple(fields.get("also", ())), "agent": algorithm(**agent)})


def _as_options(options: Any) -> dict[str, Any]:
    if not isinstance(options, Mapping):
        raise ValueError(f"task_kwargs is {options!r}; give a dictionary")
    return {name: _as_python(name, value) for name, value in options.items()}


def _in_name(options: Mapping[str, Any]) -> str:
    return "".join(f"-{name}{agent_config.shown(value)}" for name, value in sorted(options.items()))


def _as_python(name: str, value):
    """Returns an option's value, which may be of NumPy, as a type that JSON has."""
    if isinstance(name, str):
        if isinstance(value, str):
            return value
        for kind, is_one in {bool: checks.is_flag, int: checks.is_integer, float: checks.is_float}.items():
            if is_one(value):
                return kind(value)
    raise ValueError(f"task_kwargs has {name!r}: {value!r}; give numbers, texts or flags by name")
