"""Finds all that can be scored, each as a `Target`: baselines, trained agents, teams of them, and users' functions."""

from collections.abc import Callable, Collection, Mapping, Sequence
import dataclasses
import functools
from pathlib import Path
import re
from typing import TYPE_CHECKING, Any

from physexp.agents import core
from physexp.analysis import domains
from physexp.analysis.domains import base
from physexp.analysis.score import actors, beliefs, protocol
from physexp.analysis.training import config as config_lib

if TYPE_CHECKING:
    from physexp.analysis.training import finding  # Imports torch, without which other targets are found in no time.

SHIPPED = "shipped"
"""The team of the best agents that come with the package."""

_LONGEST = 60  # Letters of a file's name; file systems allow 255 bytes.


@dataclasses.dataclass(frozen=True)
class Target:
    """A baseline, a trained agent, a team of trained agents, or a user's function.

    Attributes:
      name: the text that it was found by.
      greedy: whether trained agents take their likeliest actions instead of drawing them.
      questions: its own tasks; None for all, as far as is known before an actor is made.
      make: makes its actors; None for a user's function, which has a process of its own.
      agents: trained agents, by the task that they were trained on: for each task as many, which differ only in their
        seeds and play its episodes in turns.
      facts: facts about another target.
      stated: beliefs that the player of records has stated, if any.
    """

    name: str
    greedy: bool
    questions: tuple[protocol.Question, ...] | None
    make: actors.Make | None
    agents: "Mapping[protocol.Question, Sequence[finding.Agent]]" = dataclasses.field(default_factory=dict)
    facts: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    stated: beliefs.Beliefs = dataclasses.field(default_factory=dict)

    @property
    def num_agents(self) -> int:
        """The number of agents of a task."""
        return len(next(iter(self.agents.values()), [None]))

    def choose(self, tasks: Sequence[str], tracks: Sequence[str]) -> tuple[protocol.Question, ...]:
        """Returns the tasks of some names, and those of some tracks that it can play.

        Without either they are its own, of one trained agent; of others, those of the track `exact`.

        Raises:
          ValueError: if there is no such task or track, the target does not play it, or was trained on a task that is
            held out.
        """
        own = self.questions or ()
        if not tasks and not tracks and len(self.agents) == 1:
            return own
        found = protocol.in_tracks(tracks if tasks or tracks else [next(iter(protocol.TRACKS))])
        can, wanted = tuple(filter(self._can_play, found)), protocol.named(tasks)
        others = [question.name for question in wanted if not self._can_play(question)]
        if others or (tracks and not can):
            what = "".join(others[:1]) or f"any task of {', '.join(tracks)}"
            raise ValueError(f"{self.name} does not play {what}; it plays {', '.join(one.name for one in own)}")
        held_out = protocol.in_tracks([name for name in tracks if name in base.HELD_OUT])
        if seen := [question.name for question in held_out if question in self._trained_on()]:
            raise ValueError(f"{self.name} was trained on {seen[0]}, which its track holds out; score another agent")
        return tuple(dict.fromkeys(wanted + can)) or own

    def _trained_on(self) -> set[protocol.Question]:
        """Returns all settings that its agents were trained on."""
        configs = [agent.config for agents in self.agents.values() for agent in agents]
        settings = (setting for one in configs for setting in one.settings)
        return {protocol.question(each.domain, each.task, each.task_kwargs) for each in settings}

    def _can_play(self, question: protocol.Question) -> bool:
        return self.questions is None or question in self.questions or _trained_for(question, self.agents) is not None

    def describe(self, questions: Sequence[protocol.Question]) -> dict[str, Any]:
        """Returns how the agents of some tasks were trained; the facts about other targets.

        They are algorithm, seeds, gamma, whether answers were revealed, command, commit, frames and seconds; of several
        agents of a task, command and commit of the first one, and mean frames and seconds. Of a team, they are
        algorithms, sums, and `agents`.
        """
        own = {question.name: _trained_for(question, self.agents) for question in questions}
        facts = {one: _facts(agents) for one, agents in self.agents.items() if one in own.values()}
        if len(self.agents) < 2:
            return next(iter(facts.values()), dict(self.facts))
        sums = {name: sum(one[name] for one in facts.values()) for name in ("frames", "seconds")}
        algorithms = dict.fromkeys(one["algorithm"] for one in facts.values())
        each = {name: facts[one] for name, one in own.items() if one is not None}
        return {"algorithm": ", ".join(algorithms), **sums, "agents": each}


def find(name: str, greedy: bool = False) -> Target:
    """Returns the target of a name; raises ValueError if there is none, and lists those that there are.

    Args:
      name: a baseline; the folder of a run, the file of a published agent, or an agent that comes with the package;
        several agents with commas between them, a folder of runs, `shipped`, or a learner's name, for a team in which
        each plays its own task, in turns with others that differ only in their seeds; or `module:function`.
      greedy: a trained agent takes its likeliest action instead of drawing one.
    """
    if _is_function(name):
        return Target(name, greedy, None, None)
    if name in actors.BASELINES:
        return Target(name, greedy, None, actors.BASELINES[name])
    if makers := _baselines_of_domains().get(name):
        return Target(name, greedy, tuple(makers), lambda question, index: makers[question]())
    return _trained(name, greedy)


def file_name(name: str) -> str:
    """Returns a name for files of a target: letters, digits and underscores; of a folder like `..`, its own."""
    for text in (name, Path(name).resolve().name):
        if safe := re.sub(r"\W+", "_", text).strip("_"):
            return safe[:_LONGEST]
    return "target"


def _trained(name: str, greedy: bool) -> Target:
    """Returns an agent, or a team: names of agents and of teams with commas between them."""
    from physexp.agents import acting

    agents: dict[protocol.Question, list[finding.Agent]] = {}
    for part in name.split(","):
        if _is_function(part) or part in actors.BASELINES or part in _baselines_of_domains():
            raise ValueError(f"{part} is no trained agent; a team is of trained agents, so give it alone")
        for agent in map(_agent, _members(part)):
            config = agent.config
            agents.setdefault(protocol.question(config.domain, config.task, config.task_kwargs), []).append(agent)
    _check_seeds(name, agents)

    def make(question: protocol.Question, index: int) -> core.Actor:
        own = _trained_for(question, agents)
        assert own is not None
        return acting.RecurrentActor(agents[own][index % len(agents[own])].network, index, greedy)

    return Target(name, greedy, tuple(agents), make, agents)


def _members(name: str) -> Sequence[str]:
    """Returns the names of the agents of a team, or of the runs in a folder; of an agent, its own."""
    if name == SHIPPED or name in config_lib.ALGORITHMS:
        return _shipped(name)
    folder = Path(name).expanduser()
    runs = [] if (folder / "config.json").exists() else sorted(folder.glob("*/config.json"))
    return [str(run.parent) for run in runs] or [name]


def _check_seeds(name: str, agents: "Mapping[protocol.Question, Sequence[finding.Agent]]") -> None:
    """Raises ValueError unless each task has one agent, or as many as the others that differ in their seeds alone."""
    counts = {question.name: len(its) for question, its in agents.items()}
    for question, its in agents.items():
        seeds = {one.config.agent.seed for one in its}
        alike = [dataclasses.replace(one.config, agent=one.config.agent.replace(seed=0)) for one in its]
        if len(seeds) < len(its) or any(one != alike[0] for one in alike):
            raise ValueError(
                f"{name} has two agents for {question.name} with equal seeds or of other configurations; leave out one"
            )
    if len(set(counts.values())) > 1 or 2 in counts.values():
        told = ", ".join(f"{count} for {task}" for task, count in counts.items())
        raise ValueError(f"{name} has agents: {told}; give one for each task, or as many for each, at least 3")


def _trained_for(question: protocol.Question, own: Collection[protocol.Question]) -> protocol.Question | None:
    """Returns the task whose agent plays a task: the same, or the first with other options and equal spaces."""
    alike = [one for one in own if _spaces(one) == _spaces(question)]
    return question if question in alike else next(iter(alike), None)


def _spaces(question: protocol.Question) -> tuple[Any, ...]:
    observations = {name: (spec.shape, spec.dtype) for name, spec in question.observation_spec.items()}
    return question.domain, question.task, observations, question.num_interactions, question.num_actions


def _facts(agents: "Sequence[finding.Agent]") -> dict[str, Any]:
    """Returns how the agents of a task were trained."""
    recorded, config = [agent.provenance() for agent in agents], agents[0].config.agent
    return {
        "algorithm": config.title,
        "seeds": [agent.config.agent.seed for agent in agents],
        "gamma": config.discount,
        "answers_revealed": bool(getattr(config, "answers_revealed", False)),
        **{fact: recorded[0].get(fact) for fact in ("command", "commit")},
        **{fact: sum(one[fact] for one in recorded) // len(agents) for fact in ("frames", "seconds")},
    }


def _agent(name: str) -> "finding.Agent":
    from physexp.analysis.training import finding

    try:
        return finding.find_agent(name)
    except ValueError as error:
        others = ", ".join([*actors.BASELINES, *_baselines_of_domains(), SHIPPED, *config_lib.ALGORITHMS])
        raise ValueError(f"{error}; or give {others}, or MODULE:FUNCTION") from None


@functools.cache  # The cards of all agents are read.
def _shipped(learner: str) -> list[str]:
    """Returns the agents that come with the package, of tasks without options and of the tracks', one for each.

    They are the best ones, or those of a learner.
    """
    from physexp.agents import pretrained
    from physexp.analysis.training import finding, publishing

    team: dict[protocol.Question, str] = {}
    for name in pretrained.names():
        config = finding.config_of(pretrained.card_named(name))
        is_wanted = "/" not in name if learner == SHIPPED else config.agent.algorithm == learner
        question = protocol.question(config.domain, config.task, config.task_kwargs)
        if is_wanted and (publishing.is_default(config) or question in protocol.in_tracks(["all"])):
            team.setdefault(question, name)
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
