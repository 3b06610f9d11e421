"""Finds trained agents: those of runs, published ones, and those that come with the package."""

from collections.abc import Callable, Mapping
import dataclasses
import difflib
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from physexp import suite
from physexp.agents import config as agent_config
from physexp.agents import networks, pretrained, registry
from physexp.analysis.data import tables
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer


class Agent(NamedTuple):
    """A trained agent.

    Attributes:
      network: its network.
      config: the configuration of its training: the task, its options, and the learner; or of one setting of that
        training alone.
      provenance: returns command, commit, frames and seconds of its training.
    """

    network: networks.RecurrentNetwork
    config: config_lib.TrainConfig
    provenance: Callable[[], Mapping[str, Any]]


def load_network(run: run_lib.Run) -> networks.RecurrentNetwork:
    """Returns the network that a run has trained.

    Raises ValueError if there is none yet, or its files are damaged or do not fit; it names the file.
    """
    network = trainer.make_network(run.config)
    network.load_state_dict(run.variables(network.state_dict()))
    return network.eval()


def find_agent(target: str, task_kwargs: Mapping[str, Any] | None = None) -> Agent:
    """Returns a trained agent; raises ValueError if there is none, or none that was trained with these options.

    `target` is the folder of a run; the file of a published agent (`FOLDER/NAME.safetensors`); or an agent that comes
    with the package: `domain/task`, or the name of its file.
    """
    path, wanted = Path(target).expanduser(), task_kwargs or {}
    domain, _, task = target.partition("/")
    if path.is_file():
        if path.suffix != ".safetensors":
            raise ValueError(f"{target} is no agent; give the folder of a run, or a published agent (NAME.safetensors)")
        tables.check(path, tables.MAX_AGENT)
        found = _of_card(pretrained.load_file(path))
    elif path.exists():
        run = run_lib.Run(path)
        found = Agent(load_network(run), run.config, lambda: provenance(run))
    elif target in pretrained.names():
        found = _of_card(pretrained.load_named(target))
    elif (domain, task) in suite.ALL_TASKS:
        found = shipped_agent(domain, task, wanted)
    else:
        close = difflib.get_close_matches(target, [*pretrained.names(), *map("/".join, suite.ALL_TASKS)])
        known = ", ".join(close) or "DOMAIN/TASK, as `physexp tasks` lists them"
        raise ValueError(
            f"{target} holds no run (no config.json); give the folder of a run, the file of a published agent "
            f"(NAME.safetensors), or a trained agent: {known}"
        )
    return _in_setting(target, found, wanted)


def shipped_agent(domain: str, task: str, task_kwargs: Mapping[str, Any]) -> Agent:
    """Returns the agent that comes with the package for a task with these options; raises as `find_agent`."""
    options = {name: value for name, value in task_kwargs.items() if name in pretrained.options_of(domain, task)}
    agent = _of_card(pretrained.load(domain, task, **options))
    return _in_setting(f"{domain}/{task}", agent, task_kwargs)


def _in_setting(target: str, agent: Agent, wanted: Mapping[str, Any]) -> Agent:
    """Returns an agent in the first setting of its training that has some options; refuses it if there is none."""
    if not (difference := _difference(agent.config, wanted)):
        return agent
    for config in agent.config.settings:
        if not _difference(config, wanted):
            return agent._replace(config=config)
    raise ValueError(f"{target} {difference}; leave that out, or name another agent")


def _difference(config: config_lib.TrainConfig, wanted: Mapping[str, Any]) -> str:
    """Returns a clause on the first option that differs from the one wanted; nothing if none does."""
    options = dataclasses.asdict(config.load_task().options) if wanted else {}
    for name, value in wanted.items():
        trained_at = options.get(name)  # The task's own, where the configuration has none.
        if value != trained_at:
            usual = "without" if trained_at is None else f"at {name} {agent_config.shown(trained_at)}"
            what = f"was trained {usual}" if name in options else f"has no {name}"
            return f"{what}, and {name} is {value}"
    return ""


def _of_card(agent: pretrained.Pretrained) -> Agent:
    """Returns a published agent; refuses one whose network does not fit the task on its card."""
    config = config_of(agent.card)
    if {**agent.card["network"], "frozen": None} != {**network_facts(config), "frozen": None}:
        raise ValueError(f"the agent of {config.task_name} has a network that cannot play it; publish it again")
    return Agent(agent.network, config, lambda: agent.card)


def network_facts(config: config_lib.TrainConfig) -> dict[str, Any]:
    """Returns the specs of the task and the hyperparameters that a network is made from."""
    task, kind = config.load_task(), registry.NETWORKS[config.agent.algorithm]
    return {
        "kind": kind.__name__,
        "observations": {
            name: [list(spec.shape), np.dtype(spec.dtype).name] for name, spec in task.observation_spec().items()
        },
        "num_actions": task.action_spec().num_values,
        "hyperparameters": kind.hyperparameters(task, config.agent),
    }


def config_of(card: Mapping[str, Any]) -> config_lib.TrainConfig:
    """Returns the configuration that an agent was trained with; raises ValueError if its card does not say so."""
    try:
        facts = {name: card[name] for name in ("domain", "task", "task_kwargs", "agent")}
        return config_lib.TrainConfig.from_json({**facts, "also": card.get("also", ())})
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"an agent's card lacks its configuration: {error!r}; publish the agent again") from None


def provenance(run: run_lib.Run) -> dict[str, Any]:
    """Returns command, commit, frames and seconds of training; raises ValueError if a run's metrics are of no use."""
    path = run.path / "metrics.csv"
    try:
        last = run.metrics()[-1]
        frames, seconds = int(last["frames"]), round(last["seconds"])
        if frames < 0 or seconds < 0:
            raise ValueError("negative numbers")
    except (IndexError, KeyError, TypeError, ValueError, OverflowError):
        raise ValueError(
            f"{path} does not say in its last row how long the agent was trained; resume the run or put the file back"
        ) from None
    commit = run.facts.get("commit", "not recorded")
    return {"command": command(run.config), "commit": commit, "frames": frames, "seconds": seconds}


def command(config: config_lib.TrainConfig) -> str:
    """Returns the command that trains such a run, with the options that differ from the task's preset."""
    words = ["physexp", "train", config.domain, config.task, "--agent", config.agent.algorithm]
    preset = dataclasses.asdict(config_lib.preset(config.domain, config.task, algorithm=config.agent.algorithm))
    changed = [(name, value) for name, value in dataclasses.asdict(config.agent).items() if value != preset[name]]
    for name, value in [*config.task_kwargs.items(), *changed]:
        words += _flag(name, value)
    also = [",".join(f"{name}={agent_config.shown(value)}" for name, value in more.items()) for more in config.also]
    return " ".join([*words, *(["--also", *also] if also else [])])


def _flag(name: str, value: Any) -> list[str]:
    flag = name.replace("_", "-")
    if isinstance(value, bool):
        return [f"--{flag}" if value else f"--no-{flag}"]
    items = [agent_config.shown(item) for item in (value if isinstance(value, (list, tuple)) else [value])]
    if any(item.startswith("-") for item in items):  # Which could be read as another option.
        return [f"--{flag}={item}" for item in items]
    return [f"--{flag}", *items]
