"""Finds trained agents: those of runs, published ones, and those that come with the package."""

from collections.abc import Mapping
import difflib
from pathlib import Path
from typing import Any

import numpy as np

from physexp import suite
from physexp.agents import config as agent_config
from physexp.agents import networks, pretrained, registry
from physexp.analysis.data import untrusted
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer


def load_network(run: run_lib.Run) -> networks.RecurrentNetwork:
    """Returns the network that a run has trained.

    Raises:
      ValueError: if there is none yet, or its files are damaged or do not fit; it names the file.
    """
    config = run.config
    environment = trainer.make_environment(config, 0, 1, 1)
    network = registry.make_network(environment, config.agent)
    environment.close()
    network.load_state_dict(run.variables(network.state_dict()))
    return network.eval()


def find_agent(
    target: str, task_kwargs: Mapping[str, Any] | None = None
) -> tuple[networks.RecurrentNetwork, config_lib.TrainConfig]:
    """Returns a trained agent's network, and what it plays.

    Args:
      target: the folder of a run; the file of a published agent (`FOLDER/NAME.safetensors`); or an agent that comes
        with the package: `domain/task`, or the name of its file.
      task_kwargs: options that the agent is to be trained with; the others are those of the folder or file, or else
        the task's.

    Raises:
      ValueError: if there is no such agent, or none with these options; it lists those that come with the package.
    """
    path, wanted = Path(target).expanduser(), task_kwargs or {}
    domain, _, task = target.partition("/")
    if agent := published(target):
        found = agent.network, config_of(agent.card)
    elif path.exists():
        run = run_lib.Run(path)
        found = load_network(run), run.config
    elif (domain, task) in suite.ALL_TASKS:
        found = shipped_agent(domain, task, wanted)
    else:
        close = difflib.get_close_matches(target, [*pretrained.names(), *map("/".join, suite.ALL_TASKS)])
        raise ValueError(
            f"{target} holds no run (no config.json); give the folder of a run, the file of a published agent "
            f"(NAME.safetensors), or a trained agent: "
            f"{', '.join(close) or 'DOMAIN/TASK, as `physexp tasks` lists them'}"
        )
    _check_options(target, found[1], wanted)
    return found


def published(target: str) -> pretrained.Pretrained | None:
    """Returns the published agent in a file, or the one with this name in the package; None if it is neither.

    Raises:
      ValueError: if its file is damaged.
    """
    path = Path(target).expanduser()
    if path.is_file():
        if path.suffix != ".safetensors":
            raise ValueError(f"{target} is no agent; give the folder of a run, or a published agent (NAME.safetensors)")
        untrusted.check(path, untrusted.MAX_AGENT)
        return _checked(pretrained.load_file(path))
    return _checked(pretrained.load_named(target)) if target in pretrained.names() and not path.exists() else None


def shipped_agent(
    domain: str, task: str, task_kwargs: Mapping[str, Any]
) -> tuple[networks.RecurrentNetwork, config_lib.TrainConfig]:
    """Returns the network of the agent that comes with the package for a task with these options, and what it plays.

    Raises:
      ValueError: if there is none; it lists those that there are.
    """
    options = {name: value for name, value in task_kwargs.items() if name in pretrained.options_of(domain, task)}
    agent = _checked(pretrained.load(domain, task, **options))
    config = config_of(agent.card)
    _check_options(f"{domain}/{task}", config, task_kwargs)
    return agent.network, config


def _check_options(target: str, config: config_lib.TrainConfig, wanted: Mapping[str, Any]) -> None:
    """Refuses an agent that was trained with other options than are wanted."""
    if not wanted:
        return
    options = suite.load_task(config.domain, config.task, config.task_kwargs).options
    for name, value in wanted.items():
        has_it = hasattr(options, name)
        trained_at = getattr(options, name, None)  # The task's own, where the configuration has none.
        if value != trained_at:
            usual = "without" if trained_at is None else f"at {name} {agent_config.shown(trained_at)}"
            what = f"was trained {usual}" if has_it else f"has no {name}"
            raise ValueError(f"{target} {what}, and {name} is {value}; leave that out, or name another agent")


def _checked(agent: pretrained.Pretrained) -> pretrained.Pretrained:
    """Refuses an agent whose network does not fit the task on its card."""
    config = config_of(agent.card)
    if {**agent.card["network"], "frozen": None} != {**network_facts(config), "frozen": None}:
        raise ValueError(f"the agent of {config.task_name} has a network that cannot play it; publish it again")
    return agent


def network_facts(config: config_lib.TrainConfig) -> dict[str, Any]:
    """Returns what a network is made from: specs of the environment, and hyperparameters."""
    environment = trainer.make_environment(config, 0, 1, 1)
    observations = {
        name: [list(spec.shape), np.dtype(spec.dtype).name] for name, spec in environment.observation_spec().items()
    }
    kind = registry.NETWORKS[config.agent.algorithm]
    facts = {
        "kind": kind.__name__,
        "observations": observations,
        "num_actions": environment.action_spec().num_values,
        "hyperparameters": kind.hyperparameters(environment, config.agent),
    }
    environment.close()
    return facts


def config_of(card: Mapping[str, Any]) -> config_lib.TrainConfig:
    """Returns the configuration that an agent was trained with, from its card.

    Raises:
      ValueError: if its card does not say so.
    """
    try:
        facts = {name: card[name] for name in ("domain", "task", "task_kwargs", "agent")}
        return config_lib.TrainConfig.from_json(facts)
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"an agent's card lacks its configuration: {error!r}; publish the agent again") from None
