"""What can be scored: baselines, trained agents, and anybody's own, as something that makes actors."""

from collections.abc import Callable, Sequence
import importlib
import inspect
import os
from pathlib import Path
import re
import sys
from typing import Any

import numpy as np

from physexp.agents import core
from physexp.analysis import domains
from physexp.analysis.score import episodes, protocol

BASELINES = ("random", "at_once", "silent", "ideal")
"""Experimenters that every task has."""

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
    if target in BASELINES or _is_function(target):
        return None
    if found := _with_baseline(target):
        return found
    from physexp.analysis.evaluation import playing

    try:
        _, config = playing.find_agent(target)
    except ValueError as error:
        raise ValueError(f"{error}; or give {', '.join(_all_baselines())}, or MODULE:FUNCTION") from None
    asked = protocol.question(config.domain, config.task)
    if config.task_kwargs:
        from physexp import suite

        chosen, usual = (
            suite.load_task(asked.domain, asked.task, {**kwargs, "random": 0}).options
            for kwargs in (config.task_kwargs, {})
        )
        if chosen != usual:
            raise ValueError(f"{target} was trained with {dict(config.task_kwargs)}; score an agent of the usual task")
    return (asked,)


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
    found = protocol.named(tasks) if tasks else can or protocol.observing(observations)
    refused = [asked.name for asked in found if can is not None and asked not in can]
    if refused:
        raise ValueError(
            f"{target} does not play {refused[0]}; it plays {', '.join(asked.name for asked in can or ())}"
        )
    return found


def maker(target: str, greedy: bool = False) -> MakeActor:
    """Returns what makes an actor for a task.

    Args:
      target: a baseline; the folder of a run, or an agent that comes with the package; or `module:function`.
      greedy: a trained agent takes its likeliest action instead of drawing one.

    Raises:
      ValueError: if there is no such target, or it is no function that can play.
    """
    if target in BASELINES:
        return {"random": _Random, "at_once": _AtOnce, "silent": _Silent, "ideal": _ideal}[target]
    if _with_baseline(target):
        return lambda asked: domains.find(asked.domain).baselines[asked.task][target]()
    if _is_function(target):
        return _of_function(target)
    from physexp.analysis.evaluation import playing

    network, _ = playing.find_agent(target)
    return lambda asked: _Network(network.eval(), greedy)


def file_name(target: str) -> str:
    """Returns the name that files of a target have: letters, digits and underscores."""
    return re.sub(r"\W+", "_", target).strip("_")


def facts(target: str) -> dict[str, Any]:
    """Returns how a trained agent was trained: algorithm, seed, command, commit, frames, seconds; nothing of others."""
    if target in _all_baselines() or _is_function(target):
        return {}
    from physexp.agents import pretrained
    from physexp.analysis.evaluation import playing, publishing
    from physexp.analysis.training import run as run_lib

    _, config = playing.find_agent(target)
    if Path(target).exists():
        run = run_lib.Run(Path(target))
        trained = {**run.metrics()[-1], "commit": run.facts["commit"], "command": publishing.command(config)}
    else:
        agent = pretrained.load_named(target) if target in pretrained.names() else pretrained.load(*target.split("/"))
        trained = agent.card
    found = {name: trained.get(name) for name in ("command", "commit", "frames", "seconds")}
    return {"algorithm": config.agent.title, "seed": config.agent.seed, **found}


def _all_baselines() -> list[str]:
    own = {name for known in domains.DOMAINS.values() for baselines in known.baselines.values() for name in baselines}
    return [*BASELINES, *sorted(own)]


def _with_baseline(target: str) -> tuple[protocol.Question, ...]:
    """Returns the tasks whose domains have a baseline of this name."""
    return tuple(
        protocol.question(name, task)
        for name, known in domains.DOMAINS.items()
        for task, baselines in known.baselines.items()
        if target in baselines
    )


def _is_function(target: str) -> bool:
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
        return lambda asked: _Policy(function)
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
        return _Policy(made)
    raise TargetError(
        f"it returned {type(made).__name__}; return an actor, with {', '.join(_METHODS)}, or a policy, a function "
        "of an observation and a state"
    )


class _Policy(core.Actor):
    """Plays a policy in Gymnasium's manner: of an observation and a state, None at first, to an action and a state."""

    def __init__(self, policy: Callable[[Any, Any], tuple[int, Any]]):
        self._policy, self._state = policy, None

    def observe_first(self, timestep):
        self._state = None

    def select_action(self, observation):
        action, self._state = self._policy(observation, self._state)
        return action

    def observe(self, action, next_timestep):
        """Does nothing: the policy sees the next observation when it is asked."""

    def update(self):
        """Does nothing: the policy is fixed."""


class _Baseline(core.Actor):
    """An experimenter who looks at nothing."""

    def __init__(self, asked: protocol.Question):
        self._asked, self._number = asked, -1

    def observe_first(self, timestep):
        self._number += 1

    def observe(self, action, next_timestep):
        """Does nothing."""

    def update(self):
        """Does nothing."""


class _Random(_Baseline):
    """Draws every action, interactions and answers alike; in an episode of some number always the same."""

    def observe_first(self, timestep):
        super().observe_first(timestep)
        self._generator = np.random.default_rng(self._number)

    def select_action(self, observation):
        return int(self._generator.integers(self._asked.num_actions))


class _AtOnce(_Baseline):
    """Gives the likeliest answer at once."""

    def __init__(self, asked):
        super().__init__(asked)
        hidden = protocol.drawn(asked, 1)[0]
        nothing = episodes.Episode(hidden, np.zeros(0, np.int64), np.zeros(0), [])
        self._label = int(protocol.ideal(asked).beliefs(nothing)[0].argmax())

    def select_action(self, observation):
        return self._asked.num_interactions + self._label


class _Silent(_Baseline):
    """Never answers."""

    def select_action(self, observation):
        return 0


def _ideal(asked: protocol.Question) -> core.Actor:
    return protocol.ideal(asked).actor()


class _Network(core.Actor):
    """Plays a trained network; what it draws in an episode of some number is always the same."""

    def __init__(self, network, greedy: bool):
        self._network, self._greedy, self._number = network, greedy, -1

    def observe_first(self, timestep):
        from physexp.agents import acting

        self._number += 1
        self._actor = acting.RecurrentActor(self._network, self._number, self._greedy)
        self._actor.observe_first(timestep)

    def select_action(self, observation):
        return self._actor.select_action(observation)

    def observe(self, action, next_timestep):
        self._actor.observe(action, next_timestep)

    def update(self):
        """Does nothing: the network is fixed."""
