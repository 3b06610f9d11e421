"""What the analysis knows of a domain, as data. Imports nothing heavy, since the command line is made from it."""

from collections.abc import Mapping
import dataclasses
from typing import Any

from physexp.agents import config as agent_config
from physexp.agents.a3c import config as a3c
from physexp.agents.ppo import config as ppo


@dataclasses.dataclass(frozen=True, kw_only=True)
class Domain:
    """A domain, as the analysis sees it.

    Attributes:
      name: the domain's name, as `suite.load` takes it.
      discount: the agents' gamma.
      presets: by task and algorithm, the configuration to train with where nothing else is asked for. A task or an
        algorithm that is not there has the algorithm's defaults, with the domain's discount.
      labels: by task, the short name of a condition, in which `{option}` stands for an option's value.
    """

    name: str
    discount: float = agent_config.AgentConfig.discount
    presets: Mapping[str, Mapping[str, agent_config.AgentConfig]] = dataclasses.field(default_factory=dict)
    labels: Mapping[str, str] = dataclasses.field(default_factory=dict)

    def label(self, task: str, task_kwargs: Mapping[str, Any]) -> str:
        """Returns the short name of a task with these options; domain and task where it has no other."""
        try:
            return self.labels[task].format_map(task_kwargs)
        except KeyError:
            return f"{self.name} {task}"


def ppo_like(preset: a3c.A3CConfig, **changes) -> ppo.PPOConfig:
    """Returns a configuration of PPO with the hyperparameters that A3C's has too, and with changes."""
    shared = {field.name: getattr(preset, field.name) for field in dataclasses.fields(agent_config.AgentConfig)}
    return ppo.PPOConfig(**{**shared, **changes})
