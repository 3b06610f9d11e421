"""What can be scored: baselines, trained agents, and anybody's own, as something that makes actors."""

from collections.abc import Callable, Collection, Sequence
import functools
import importlib
import inspect
import os
from pathlib import Path
import re
import sys
from typing import Any

from physexp.agents import core
from physexp.analysis import domains
from physexp.analysis.score import actors, protocol
from physexp.analysis.training import config as config_lib

SHIPPED = "shipped"
"""The team of the best agents that come with the package; a learner's name stands for those of the learner."""

MakeActor = Callable[[protocol.Question], core.Actor]

_METHODS = ("select_action", "observe_first", "observe", "update")


class TargetError(ValueError):
    """What was named is nothing that can play; the line says what is allowed."""


def suitable(target: str) -> "tuple[protocol.Question, ...] | None":
    """Returns the tasks that a target can play; None for all, as far as can be told before it is asked for an actor.

    Args:
      target: see `maker`.

    Raises:
      ValueError: if there is no such target; the line lists what there is.
    """
    if target in actors.BASELINES or is_function(target):
        return None
    if team := _team(target):
        return protocol.named(list(team))
    if found := _with_baseline(target):
        return found
    from physexp.analysis.evaluation import finding, publishing

    try:
        _, config = finding.find_agent(target)
    except ValueError as error:
        others = ", ".join([*_all_baselines(), SHIPPED, *config_lib.ALGORITHMS])
        raise ValueError(f"{error}; or give {others}, or MODULE:FUNCTION") from None
    if not publishing.is_default(config):
        raise ValueError(
            f"{target} was trained with {dict(config.task_kwargs)}; what is scored is the task without options: train "
            "an agent without them"
        )
    return (protocol.question(config.domain, config.task),)


def _team(target: str) -> dict[str, str]:
    """Returns who plays each task, by the tasks' names; nothing where the target is no team.

    Raises:
      ValueError: if one of them plays anything, or two play the same.
    """
    if target == SHIPPED or target in config_lib.ALGORITHMS:
        return _shipped(target)
    team: dict[str, str] = {}
    for member in target.split(",") if "," in target else []:
        can = suitable(member)
        if can is None or member in _all_baselines():
            raise ValueError(f"{member} is no trained agent; a team is of trained agents, so give it alone")
        for asked in can:
            if other := team.get(asked.name):
                raise ValueError(f"both {other} and {member} play {asked.name}; name one of them")
            team[asked.name] = _team(member).get(asked.name, member)  # Of a team, the one who plays it.
    return team


@functools.cache  # All agents are looked at.
def _shipped(whose: str) -> dict[str, str]:
    """Returns the agents that come with the package, by task: the best ones, or those of a learner."""
    from physexp.agents import pretrained
    from physexp.analysis.evaluation import finding, publishing

    team: dict[str, str] = {}
    for name in pretrained.names():
        config = finding.config_of(pretrained.card_named(name))
        is_wanted = "/" not in name if whose == SHIPPED else config.agent.algorithm == whose
        if is_wanted and publishing.is_default(config):
            team.setdefault(f"{config.domain}/{config.task}", name)
    return team


def chosen(target: str, tasks: Sequence[str], observations: str) -> tuple[protocol.Question, ...]:
    """Returns the tasks that a target is to play.

    Args:
      target: see `maker`.
      tasks: those that are named, as `domain/task`; none for all that it can play.
      observations: the kind of these, as for `protocol.observing`, where it can play any.

    Raises:
      ValueError: if there is no such target or task, or the target does not play it.
    """
    can = suitable(target)
    if tasks:
        found = protocol.named(tasks)
    else:
        usual = protocol.observing(observations)
        found = usual if can is None else tuple(asked for asked in can if asked in usual) or can
    refused = [asked.name for asked in found if can is not None and asked not in can]
    if refused:
        raise ValueError(
            f"{target} does not play {refused[0]}; it plays {', '.join(asked.name for asked in can or ())}"
        )
    return found


def maker(target: str, greedy: bool = False) -> MakeActor:
    """Returns what makes an actor for a task.

    Args:
      target: a baseline; the folder of a run, the card of a published agent, or an agent that comes with the package;
        several of these with commas between, `shipped`, or a learner's name, for a team in which each plays its own
        task; or `module:function`.
      greedy: a trained agent takes its likeliest action instead of drawing one.

    Raises:
      ValueError: if there is no such target, or it is no function that can play.
    """
    if target in actors.BASELINES:
        return actors.BASELINES[target]
    if team := _team(target):
        return lambda asked: maker(team[asked.name], greedy)(asked)
    if _with_baseline(target):
        return lambda asked: domains.find(asked.domain).baselines[asked.task][target]()
    if is_function(target):
        return _of_function(target)
    from physexp.analysis.evaluation import finding

    network, _ = finding.find_agent(target)
    return lambda asked: actors.Network(network.eval(), greedy)


def file_name(target: str) -> str:
    """Returns the name that files of a target have: letters, digits and underscores; of a folder like `..`, its own."""
    for name in (target, Path(target).resolve().name):
        if safe := re.sub(r"\W+", "_", name).strip("_"):
            return safe
    return "target"


def facts(target: str, tasks: Collection[str] | None = None) -> dict[str, Any]:
    """Returns how a trained agent was trained: algorithm, seed, command, commit, frames, seconds; nothing of others.

    Of a team, algorithms, frames and seconds in all, and all of it of each of its `agents`, by task.

    Args:
      target: see `maker`.
      tasks: what counts of a team, as `domain/task`; all of it by default.
    """
    if target in _all_baselines() or is_function(target):
        return {}
    if team := _team(target):
        each = {task: facts(member) for task, member in team.items() if tasks is None or task in tasks}
        sums = {name: sum(one[name] for one in each.values()) for name in ("frames", "seconds")}
        algorithms = dict.fromkeys(one["algorithm"] for one in each.values())
        return {"algorithm": ", ".join(algorithms), **sums, "agents": each}
    from physexp.agents import pretrained
    from physexp.analysis.evaluation import finding, publishing
    from physexp.analysis.training import run as run_lib

    _, config = finding.find_agent(target)
    if agent := finding.published(target):
        trained = agent.card
    elif Path(target).exists():
        run = run_lib.Run(Path(target))
        frames, seconds = publishing.progress(run)
        trained = {
            "frames": frames,
            "seconds": seconds,
            "commit": run.facts.get("commit", "not recorded"),
            "command": publishing.command(config),
        }
    else:
        trained = pretrained.load(config.domain, config.task).card
    found = {name: trained.get(name) for name in ("command", "commit", "frames", "seconds")}
    return {"algorithm": config.agent.title, "seed": config.agent.seed, **found}


def _all_baselines() -> list[str]:
    own = {name for known in domains.DOMAINS.values() for baselines in known.baselines.values() for name in baselines}
    return [*actors.BASELINES, *sorted(own)]


def _with_baseline(target: str) -> tuple[protocol.Question, ...]:
    """Returns the tasks whose domains have a baseline of this name."""
    return tuple(
        protocol.question(name, task)
        for name, known in domains.DOMAINS.items()
        for task, baselines in known.baselines.items()
        if target in baselines
    )


def is_function(target: str) -> bool:
    """Returns whether a target is anybody's function, given as `module:function`."""
    module, colon, function = target.partition(":")
    return bool(colon) and all(part.isidentifier() for part in [*module.split("."), function])


def _of_function(target: str) -> MakeActor:
    """Returns what a function of anybody's makes: of a question an actor or a policy, or itself a policy."""
    module, _, name = target.partition(":")
    sys.path.insert(0, os.getcwd())
    try:
        function = getattr(importlib.import_module(module), name)
    except ModuleNotFoundError as error:
        raise TargetError(f"{error}; start where it is, or install it") from None
    except AttributeError:
        raise TargetError(f"{module} has no {name}; name a function that it has") from None
    count = len(inspect.signature(function).parameters) if callable(function) else 0
    if count == 2:
        return lambda asked: actors.Policy(function)
    if count == 1:
        return lambda asked: _as_actor(function(asked))
    what = f"has {count} parameters" if callable(function) else "is no function"
    raise TargetError(
        f"{name} {what}; give a function of a question, which returns an actor or a policy, or a policy, a function "
        "of an observation and a state"
    )


def _as_actor(made: Any) -> core.Actor:
    if all(callable(getattr(made, method, None)) for method in _METHODS):
        return made
    if callable(made):
        return actors.Policy(made)
    raise TargetError(
        f"it returned {type(made).__name__}; return an actor, with {', '.join(_METHODS)}, or a policy, a function "
        "of an observation and a state"
    )
