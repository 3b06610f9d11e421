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

_UNNAMED = a3c.A3CConfig.algorithm  # Names of runs, and configurations of format 1, leave the paper's learner out.
_OF_FORMAT_1 = ("difficulty", "control_timestep")  # Fields that now are in `task_kwargs`; null for the task's default.

_RENAMED = {
    "trace": "gae_lambda",
    "relative_entropy": "kl_to_prior",
    "action_prior": "initial_logits",
    "most_interactions": "max_interactions",
    "frames_per_step": "frames_per_update",
}
_GONE = (
    *(
        "learning_rate",
        "max_gradient_norm",
        "lstm_units",
        "max_staleness",
        "num_epochs",
        "clip",
        "num_members",
        "units",
    ),
    *("num_environments", "greedy", "cut", "exploration", "gae_lambda", "batch_size", "dropout", "weight_decay"),
    *("num_members", "averaging"),
)


def preset(domain: str = "", task: str = "", *, algorithm: str = DEFAULT_ALGORITHM) -> agent_config.AgentConfig:
    """Returns the configuration to train a task's agent with; without a preset, the algorithm's defaults.

    Its discount is the domain's; without a domain, the algorithm's default.
    """
    if not domain:
        return ALGORITHMS[algorithm]()
    known = domains.find(domain)
    usual = known.presets.get(task, {}).get(algorithm) or ALGORITHMS[algorithm]()
    return usual.replace(discount=known.discount)


@dataclasses.dataclass(frozen=True, kw_only=True)
class TrainConfig:
    """A training run.

    Attributes:
      domain: the domain's name.
      task: the task's name.
      task_kwargs: the `task_kwargs` of `suite.load` that were chosen, without the seed: numbers, texts or flags.
      replay_every: environment steps between replays that training writes; 0 for none.
      agent: the agent's configuration.

    Raises:
      ValueError: if `task_kwargs` holds anything else, or `replay_every` is no integer >= 0.
    """

    domain: str
    task: str
    task_kwargs: Mapping[str, Any] = dataclasses.field(default_factory=dict, hash=False)  # A dictionary has no hash.
    replay_every: int = 0
    agent: agent_config.AgentConfig

    def __post_init__(self):
        object.__setattr__(self, "replay_every", checks.integer("replay_every", self.replay_every, 0))
        if not isinstance(self.task_kwargs, Mapping):
            raise ValueError(f"task_kwargs is {self.task_kwargs!r}; give a dictionary")
        task_kwargs = {name: _as_python(name, value) for name, value in self.task_kwargs.items()}
        object.__setattr__(self, "task_kwargs", task_kwargs)  # One's own: nobody else changes it.

    @property
    def task_name(self) -> str:
        """Domain and task, as in `towers/fist_features`."""
        return f"{self.domain}/{self.task}"

    @property
    def label(self) -> str:
        """The short name of what is trained, as in `10-F`."""
        return domains.find(self.domain).label(self.task, self.task_kwargs)

    @property
    def name(self) -> str:
        """A name for the run's folder."""
        options = "".join(f"-{name}{agent_config.shown(value)}" for name, value in sorted(self.task_kwargs.items()))
        algorithm = "" if self.agent.title == _UNNAMED else f"-{self.agent.title}"
        discount = f"-discount{self.agent.discount:g}"
        return f"{self.domain}-{self.task}{options}{algorithm}{discount}-seed{self.agent.seed}"

    def load_task(self) -> Any:
        """Returns the task with its options; see `suite.load_task`."""
        from physexp import suite  # Imports MuJoCo.

        return suite.load_task(self.domain, self.task, self.task_kwargs)

    def to_json(self) -> dict:
        """Returns the fields as JSON has them; `from_json` makes an equal configuration of them."""
        fields = dataclasses.asdict(self)
        return {**fields, "agent": {"algorithm": self.agent.algorithm, **fields["agent"]}}

    @classmethod
    def from_json(cls, fields: dict) -> "TrainConfig":
        """Returns the configuration that `to_json`, of this version or an earlier one, has written."""
        agent: dict[str, Any] = {
            name: tuple(value) if isinstance(value, list) else value  # JSON has lists.
            for name, value in fields["agent"].items()
        }
        algorithm = ALGORITHMS[agent.pop("algorithm", _UNNAMED)]
        agent = {_RENAMED.get(name, name): value for name, value in agent.items()}  # Until stored runs are converted.
        known = {field.name for field in dataclasses.fields(algorithm)}
        agent = {name: value for name, value in agent.items() if name in known or name not in _GONE}
        chosen = {name: fields[name] for name in _OF_FORMAT_1 if fields.get(name) is not None}
        others = {name: value for name, value in fields.items() if name not in _OF_FORMAT_1}
        task_kwargs = {**chosen, **fields.get("task_kwargs", {})}
        return cls(**{**others, "task_kwargs": task_kwargs, "agent": algorithm(**agent)})


def _as_python(name: str, value):
    """Returns an option's value, which may be NumPy's, as JSON can hold it."""
    if isinstance(name, str):
        if isinstance(value, str):
            return value
        for kind, is_one in {bool: checks.is_flag, int: checks.is_integer, float: checks.is_float}.items():
            if is_one(value):
                return kind(value)
    raise ValueError(f"task_kwargs has {name!r}: {value!r}; give numbers, texts or flags by name")
