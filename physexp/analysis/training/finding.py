"""Finds trained agents: those of runs, published ones, and those that come with the package."""

from collections.abc import Mapping
import difflib
import os
from pathlib import Path
from typing import Any

import numpy as np
import torch

from physexp import suite
from physexp.agents import config as agent_config
from physexp.agents import networks, pretrained, registry
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
    with torch.device("meta"):  # Nothing is made that the variables do not fit.
        like = registry.make_network(environment, config.agent).state_dict()
    variables = run.variables(like)
    network = registry.make_network(environment, config.agent)
    environment.close()
    network.load_state_dict(variables)
    return network.eval()


def find_agent(
    target: str, task_kwargs: Mapping[str, Any] | None = None
) -> tuple[networks.RecurrentNetwork, config_lib.TrainConfig]:
    """Returns a trained agent's network, and what it plays.

    Args:
      target: the folder of a run; the card of a published agent (`FOLDER/NAME.json`); or an agent that comes with the
        package: `domain/task`, or the name of its files.
      task_kwargs: options that the agent is to be trained with; the others are those of the folder or name, or else
        the task's.

    Raises:
      ValueError: if there is no such agent, or none with these options; it lists those that come with the package.
    """
    target, wanted = os.path.expanduser(target), task_kwargs or {}
    domain, _, task = target.partition("/")
    if agent := published(target):
        _check_options(target, config_of(agent.card), wanted)
        return _with_config(agent)
    if Path(target).is_file():
        raise ValueError(f"{target} is a file; give the folder of a run, or the card of a published agent (NAME.json)")
    if Path(target).exists():
        run = run_lib.Run(Path(target))
        _check_options(target, run.config, wanted)
        return load_network(run), run.config
    if (domain, task) in suite.ALL_TASKS:
        return shipped_agent(domain, task, wanted)
    close = difflib.get_close_matches(target, [*pretrained.names(), *map("/".join, suite.ALL_TASKS)])
    raise ValueError(
        f"{target} holds no run (no config.json); give the folder of a run, the card of a published agent (NAME.json), "
        f"or a trained agent: {', '.join(close) or 'DOMAIN/TASK, as `physexp tasks` lists them'}"
    )


def published(target: str) -> pretrained.Pretrained | None:
    """Returns the published agent with this card, or with this name in the package; None if it is neither.

    Raises:
      ValueError: if its files are damaged.
    """
    path = Path(target)
    if path.suffix == ".json" and path.is_file() and path.name != "config.json":  # Which is in the folder of a run.
        return pretrained.load_named(path.stem, path.parent)
    return pretrained.load_named(target) if target in pretrained.names() and not path.exists() else None


def shipped_agent(
    domain: str, task: str, task_kwargs: Mapping[str, Any]
) -> tuple[networks.RecurrentNetwork, config_lib.TrainConfig]:
    """Returns the network of the agent that comes with the package for a task with these options, and what it plays.

    Raises:
      ValueError: if there is none; it lists those that there are.
    """
    tell_apart = pretrained.options_of(domain, task)
    agent = pretrained.load(domain, task, **{name: value for name, value in task_kwargs.items() if name in tell_apart})
    _check_options(f"{domain}/{task}", config_of(agent.card), task_kwargs)
    return _with_config(agent)


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


def _with_config(agent: pretrained.Pretrained) -> tuple[networks.RecurrentNetwork, config_lib.TrainConfig]:
    config = config_of(agent.card)
    if agent.card["network"] != network_facts(config):
        raise ValueError(
            f"the card of the agent of {config.task_name} has a network that cannot play it; publish it again"
        )
    return agent.network, config


def network_facts(config: config_lib.TrainConfig) -> dict[str, Any]:
    """What a network is made from, as it is on an agent's card: specs of the environment, and hyperparameters."""
    environment = trainer.make_environment(config, 0, 1, 1)
    observations = {
        name: [list(spec.shape), np.dtype(spec.dtype).name] for name, spec in environment.observation_spec().items()
    }
    num_actions = environment.action_spec().num_values
    kind = registry.NETWORKS[config.agent.algorithm]
    hyperparameters = kind.hyperparameters(environment, config.agent)
    environment.close()
    return {
        "kind": kind.__name__,
        "observations": observations,
        "num_actions": num_actions,
        "hyperparameters": hyperparameters,
    }


def config_of(card: Mapping[str, Any]) -> config_lib.TrainConfig:
    """Returns what an agent that comes with the package plays, and how it was trained, from its card.

    Raises:
      ValueError: if its card does not say so.
    """
    try:
        facts = {name: card[name] for name in ("domain", "task", "task_kwargs", "agent")}
        return config_lib.TrainConfig.from_json(facts)
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"an agent's card is not what was written: {error!r}; publish the agent again") from None
