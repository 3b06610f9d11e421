"""Everything that can be scored: baselines, trained agents, and users' functions, each as a `Target`."""

from collections.abc import Callable, Collection, Sequence
import dataclasses
import functools
import importlib
import inspect
import os
from pathlib import Path
import re
import sys
from typing import Any

from physexp.agents import config as agent_config
from physexp.agents import core
from physexp.analysis import domains
from physexp.analysis.score import actors, protocol
from physexp.analysis.training import config as config_lib

SHIPPED = "shipped"
"""The team of the best agents that come with the package; a learner's name stands for those of the learner."""

_METHODS = ("select_action", "observe_first", "observe", "update")
_LONGEST = 60  # Letters of a file's name; file systems allow 255 bytes.


class TargetError(ValueError):
    """A target cannot play; the line says what is allowed."""


@dataclasses.dataclass(frozen=True)
class Target:
    """A baseline, a trained agent, a team of them, or a user's function.

    Attributes:
      name: as it was given.
      questions: the tasks that it can play; None for all, as far as is known before an actor is made.
      make: returns an actor for a task, from the task and the index of the first episode that it will play.
      facts: returns how the agents of some tasks, `domain/task`, were trained: algorithm, seed, command, commit,
        frames, seconds; of a team, algorithms, frames and seconds in all, and all of it of each of its `agents`.
      is_function: whether it is a user's function, which plays in a process of its own.
      is_trained: whether it is a trained agent or a team of them.
    """

    name: str
    questions: tuple[protocol.Question, ...] | None
    make: Callable[[protocol.Question, int], core.Actor]
    facts: Callable[[Collection[str]], dict[str, Any]] = lambda tasks: {}
    is_function: bool = False
    is_trained: bool = False

    def choose(self, tasks: Sequence[str], observations: str) -> tuple[protocol.Question, ...]:
        """Returns the tasks to play.

        Args:
          tasks: named ones, as `domain/task`; none for all that it can play.
          observations: the kind of these, as for `protocol.observing`, where it can play any.

        Raises:
          ValueError: if there is no such task, or the target does not play it.
        """
        can = self.questions
        if tasks:
            found = protocol.named(tasks)
        else:
            usual = protocol.observing(observations)
            found = usual if can is None else tuple(asked for asked in can if asked in usual) or can
        for asked in found:
            if can is not None and asked not in can:
                raise ValueError(
                    f"{self.name} does not play {asked.name}; it plays {', '.join(one.name for one in can)}"
                )
        return found


def find(name: str, greedy: bool = False) -> Target:
    """Returns the target of a name.

    Args:
      name: a baseline; the folder of a run, the card of a published agent, or an agent that comes with the package;
        several of these with commas between, `shipped`, or a learner's name, for a team in which each plays its own
        task; or `module:function`.
      greedy: a trained agent takes its likeliest action instead of drawing one.

    Raises:
      ValueError: if there is no such target; the line lists what there is.
    """
    if name in actors.BASELINES:
        return Target(name, None, actors.BASELINES[name])
    if _is_function(name):
        return Target(name, None, lambda asked, first: _actor_of_function(name, asked), is_function=True)
    if name == SHIPPED or name in config_lib.ALGORITHMS:
        return _team(name, _shipped(name), greedy)
    if "," in name:
        return _team(name, _members(name), greedy)
    if baselines := _baselines_of_domains().get(name):
        return Target(name, tuple(baselines), lambda asked, first: baselines[asked]())
    return _agent(name, greedy)


def file_name(name: str) -> str:
    """Returns a name for files of a target: letters, digits and underscores; of a folder like `..`, its own."""
    for text in (name, Path(name).resolve().name):
        if safe := re.sub(r"\W+", "_", text).strip("_"):
            return safe[:_LONGEST]
    return "target"


def _agent(name: str, greedy: bool) -> Target:
    """Returns a trained agent."""
    from physexp.analysis.training import finding, publishing

    try:
        network, config = finding.find_agent(name)
    except ValueError as error:
        others = ", ".join([*actors.BASELINES, *_baselines_of_domains(), SHIPPED, *config_lib.ALGORITHMS])
        raise ValueError(f"{error}; or give {others}, or MODULE:FUNCTION") from None
    if not publishing.is_default(config):
        options = ", ".join(f"{option} {agent_config.shown(value)}" for option, value in config.task_kwargs.items())
        raise ValueError(
            f"{name} was trained with {options}, and the score plays tasks without options: train an agent of "
            f"{config.domain}/{config.task} without any"
        )
    return Target(
        name,
        (protocol.question(config.domain, config.task),),
        lambda asked, first: actors.Network(network.eval(), greedy, first),
        lambda tasks: _facts(name, config),
        is_trained=True,
    )


def _facts(name: str, config: config_lib.TrainConfig) -> dict[str, Any]:
    """Returns how an agent was trained."""
    from physexp.agents import pretrained
    from physexp.analysis.training import finding, publishing
    from physexp.analysis.training import run as run_lib

    if agent := finding.published(name):
        trained = agent.card
    elif Path(name).exists():
        run = run_lib.Run(Path(name))
        frames, seconds = publishing.progress(run)
        trained = {
            "frames": frames,
            "seconds": seconds,
            "commit": run.facts.get("commit", "not recorded"),
            "command": publishing.command(config),
        }
    else:
        trained = pretrained.load(config.domain, config.task).card
    found = {fact: trained.get(fact) for fact in ("command", "commit", "frames", "seconds")}
    return {"algorithm": config.agent.title, "seed": config.agent.seed, **found}


def _team(name: str, members: dict[str, str], greedy: bool) -> Target:
    """Returns a team, of the names of agents by task."""

    def facts(tasks: Collection[str]) -> dict[str, Any]:
        each = {task: find(member).facts([task]) for task, member in members.items() if task in tasks}
        sums = {fact: sum(one[fact] for one in each.values()) for fact in ("frames", "seconds")}
        algorithms = dict.fromkeys(one["algorithm"] for one in each.values())
        return {"algorithm": ", ".join(algorithms), **sums, "agents": each}

    return Target(
        name,
        protocol.named(list(members)),
        lambda asked, first: find(members[asked.name], greedy).make(asked, first),
        facts,
        is_trained=True,
    )


def _members(name: str) -> dict[str, str]:
    """Returns the agents of a team by task, of names with commas between.

    Raises:
      ValueError: if one of them is no trained agent, or two play the same task.
    """
    team: dict[str, str] = {}
    for member in name.split(","):
        target = find(member)
        if not target.is_trained:
            raise ValueError(f"{member} is no trained agent; a team is of trained agents, so give it alone")
        is_team = member == SHIPPED or member in config_lib.ALGORITHMS
        for asked in target.questions or ():
            if other := team.get(asked.name):
                raise ValueError(f"both {other} and {member} play {asked.name}; name one of them")
            team[asked.name] = _shipped(member)[asked.name] if is_team else member
    return team


@functools.cache  # All agents are looked at.
def _shipped(learner: str) -> dict[str, str]:
    """Returns the agents that come with the package, by task: the best ones, or those of a learner."""
    from physexp.agents import pretrained
    from physexp.analysis.training import finding, publishing

    team: dict[str, str] = {}
    for name in pretrained.names():
        config = finding.config_of(pretrained.card_named(name))
        is_wanted = "/" not in name if learner == SHIPPED else config.agent.algorithm == learner
        if is_wanted and publishing.is_default(config):
            team.setdefault(f"{config.domain}/{config.task}", name)
    return team


def _baselines_of_domains() -> dict[str, dict[protocol.Question, Callable[[], core.Actor]]]:
    """Returns the baselines that only some tasks have: by name, and then by task."""
    found: dict[str, dict[protocol.Question, Callable[[], core.Actor]]] = {}
    for domain, known in domains.DOMAINS.items():
        for task, baselines in known.baselines.items():
            for name, make in sorted(baselines.items()):
                found.setdefault(name, {})[protocol.question(domain, task)] = make
    return found


def _is_function(name: str) -> bool:
    """Returns whether a name is a user's function, given as `module:function`."""
    module, colon, function = name.partition(":")
    return bool(colon) and all(part.isidentifier() for part in [*module.split("."), function])


def _actor_of_function(name: str, asked: protocol.Question) -> core.Actor:
    """Returns an actor from a user's function, which is a policy, or makes an actor or a policy for a task."""
    module, _, attribute = name.partition(":")
    if os.getcwd() not in sys.path:
        sys.path.insert(0, os.getcwd())
    try:
        function = getattr(importlib.import_module(module), attribute)
    except ModuleNotFoundError as error:
        raise TargetError(f"{error}; start where it is, or install it") from None
    except AttributeError:
        raise TargetError(f"{module} has no {attribute}; name a function that it has") from None
    count = _num_parameters(function) if callable(function) else 0
    if count == 2:
        return actors.Policy(function)
    if count == 1:
        return _as_actor(function(asked))
    what = f"has {count} parameters without a default" if callable(function) else "is no function"
    raise TargetError(
        f"{attribute} {what}; give a function of a question, which returns an actor or a policy, or a policy, a "
        "function of an observation and a state"
    )


def _num_parameters(function: Callable[..., Any]) -> int:
    """Returns how many arguments a function must be given."""
    parameters = inspect.signature(function).parameters.values()
    optional = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    return sum(one.default is one.empty and one.kind not in optional for one in parameters)


def _as_actor(made: Any) -> core.Actor:
    if all(callable(getattr(made, method, None)) for method in _METHODS):
        return made
    if callable(made):
        return actors.Policy(made)
    raise TargetError(
        f"it returned {type(made).__name__}; return an actor, with {', '.join(_METHODS)}, or a policy, a function "
        "of an observation and a state"
    )
