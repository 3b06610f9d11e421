"""Finds all that can be scored, each as a `Target`: baselines, trained agents, teams of them, and users' functions."""

from collections.abc import Callable, Collection, Sequence
import dataclasses
import functools
from pathlib import Path
import re
from typing import Any

from physexp.agents import config as agent_config
from physexp.agents import core
from physexp.analysis import domains
from physexp.analysis.score import actors, protocol
from physexp.analysis.training import config as config_lib

SHIPPED = "shipped"
"""The team of the best agents that come with the package."""

_LONGEST = 60  # Letters of a file's name; file systems allow 255 bytes.


@dataclasses.dataclass(frozen=True)
class Target:
    """A baseline, a trained agent, a team of trained agents, or a user's function.

    Attributes:
      name: the text that it was found by.
      greedy: whether trained agents take their likeliest actions instead of drawing them.
      questions: the tasks that it can play; None for all, as far as is known before an actor is made.
      make: makes its actors; None for a user's function, which has a process of its own.
      describe: returns how the agents of some tasks, by name, were trained: algorithm, seed, command, commit, frames,
        seconds; of a team, algorithms and sums, and `agents` by the task's name.
    """

    name: str
    greedy: bool
    questions: tuple[protocol.Question, ...] | None
    make: actors.Make | None
    describe: Callable[[Collection[str]], dict[str, Any]] = lambda tasks: {}

    def choose(self, tasks: Sequence[str], observations: str) -> tuple[protocol.Question, ...]:
        """Returns the tasks of some names; by default those that it can play and that have some kind of observations.

        Raises:
          ValueError: if there is no such task or kind, or the target does not play it.
        """
        found = protocol.named(tasks) if tasks else protocol.observing(observations)
        can = found if self.questions is None else self.questions
        if not tasks:
            return tuple(question for question in can if question in found) or can
        if others := [question.name for question in found if question not in can]:
            raise ValueError(f"{self.name} does not play {others[0]}; it plays {', '.join(one.name for one in can)}")
        return found


def find(name: str, greedy: bool = False) -> Target:
    """Returns the target of a name; raises ValueError if there is none, and lists those that there are.

    Args:
      name: a baseline; the folder of a run, the file of a published agent, or an agent that comes with the package;
        several agents with commas between them, `shipped`, or a learner's name, for a team in which each plays its own
        task; or `module:function`.
      greedy: a trained agent takes its likeliest action instead of drawing one.
    """
    if _is_function(name):
        return Target(name, greedy, None, None)
    if name in actors.BASELINES:
        return Target(name, greedy, None, actors.BASELINES[name])
    if makers := _baselines_of_domains().get(name):
        return Target(name, greedy, tuple(makers), lambda question, index: makers[question]())
    if "," in name or _is_team(name):
        return _team(name, greedy)
    return _agent(name, greedy)


def file_name(name: str) -> str:
    """Returns a name for files of a target: letters, digits and underscores; of a folder like `..`, its own."""
    for text in (name, Path(name).resolve().name):
        if safe := re.sub(r"\W+", "_", text).strip("_"):
            return safe[:_LONGEST]
    return "target"


def _agent(name: str, greedy: bool) -> Target:
    from physexp.agents import acting
    from physexp.analysis.training import finding, publishing

    try:
        agent = finding.find_agent(name)
    except ValueError as error:
        others = ", ".join([*actors.BASELINES, *_baselines_of_domains(), SHIPPED, *config_lib.ALGORITHMS])
        raise ValueError(f"{error}; or give {others}, or MODULE:FUNCTION") from None
    config = agent.config
    if not publishing.is_default(config):
        options = ", ".join(f"{option} {agent_config.shown(value)}" for option, value in config.task_kwargs.items())
        raise ValueError(
            f"{name} was trained with {options}, and the score plays tasks without options: train an agent of "
            f"{config.domain}/{config.task} without any"
        )

    def describe(tasks: Collection[str]) -> dict[str, Any]:
        trained = agent.provenance()
        found = {fact: trained.get(fact) for fact in ("command", "commit", "frames", "seconds")}
        return {"algorithm": config.agent.title, "seed": config.agent.seed, **found}

    def make(question: protocol.Question, index: int) -> core.Actor:
        return acting.RecurrentActor(agent.network, index, greedy)

    return Target(name, greedy, (protocol.question(config.domain, config.task),), make, describe)


def _team(name: str, greedy: bool) -> Target:
    """Returns a team, of names of agents and of teams with commas between them."""
    members: dict[protocol.Question, Target] = {}
    for part in name.split(","):
        if _is_function(part) or part in actors.BASELINES or part in _baselines_of_domains():
            raise ValueError(f"{part} is no trained agent; a team is of trained agents, so give it alone")
        for member in _shipped(part) if _is_team(part) else [part]:
            agent = _agent(member, greedy)
            (question,) = agent.questions or ()
            if question in members:
                raise ValueError(f"both {members[question].name} and {member} play {question.name}; name one of them")
            members[question] = agent

    def describe(tasks: Collection[str]) -> dict[str, Any]:
        each = {question.name: agent.describe(tasks) for question, agent in members.items() if question.name in tasks}
        sums = {name: sum(one[name] for one in each.values()) for name in ("frames", "seconds")}
        algorithms = dict.fromkeys(one["algorithm"] for one in each.values())
        return {"algorithm": ", ".join(algorithms), **sums, "agents": each}

    makers = {question: agent.make for question, agent in members.items() if agent.make}
    return Target(name, greedy, tuple(members), lambda question, index: makers[question](question, index), describe)


def _is_team(name: str) -> bool:
    return name == SHIPPED or name in config_lib.ALGORITHMS


@functools.cache  # The cards of all agents are read.
def _shipped(learner: str) -> list[str]:
    """Returns the agents that come with the package, one for each task: the best ones, or those of a learner."""
    from physexp.agents import pretrained
    from physexp.analysis.training import finding, publishing

    team: dict[str, str] = {}
    for name in pretrained.names():
        config = finding.config_of(pretrained.card_named(name))
        is_wanted = "/" not in name if learner == SHIPPED else config.agent.algorithm == learner
        if is_wanted and publishing.is_default(config):
            team.setdefault(f"{config.domain}/{config.task}", name)
    return list(team.values())


def _baselines_of_domains() -> dict[str, dict[protocol.Question, Callable[[], core.Actor]]]:
    """Returns the baselines of single tasks: by name, and then by task."""
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
