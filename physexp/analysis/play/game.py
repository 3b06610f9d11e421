"""A person's game in a terminal, beside the ideal experimenter and a trained agent on the same instances."""

from collections.abc import Callable, Mapping
import dataclasses
import json
from pathlib import Path
import shutil
import textwrap
import time
from typing import Any

from physexp import suite
from physexp.agents import config as agent_config
from physexp.agents import core, environment_loop
from physexp.analysis.data import episodes
from physexp.analysis.play import others as others_lib
from physexp.analysis.play import terminal
from physexp.analysis.score import protocol

_QUIT, _HELP = "q", "?"


@dataclasses.dataclass
class Score:
    """Score of a player."""

    episodes: int = 0
    answers: int = 0
    right: int = 0
    total: float = 0.0  # The sum of the discounted returns.

    def add(self, environment: suite.Environment) -> None:
        """Adds the episode that has ended in an environment."""
        ledger = environment.task.ledger
        self.episodes += 1
        self.answers += environment.task.rules.num_questions
        self.right += int(ledger.num_right[0])
        self.total += float(ledger.returns[0])

    def __str__(self) -> str:
        return f"{self.right} of {self.answers} right, mean return {self.total / max(1, self.episodes):.3f}"


class _Quit(Exception):  # noqa: N818
    """The player has quit."""


class _Person(core.Actor):
    """Asks a person, who sees drawings of the observations.

    Attributes:
      actions, times: the actions of the episode, and the time that each took, ms.
    """

    def __init__(self, task, rules: str, read: Callable[[str], str], show: Callable[[str], None]):
        self._task, self._rules, self._read, self._show = task, rules, read, show
        self.actions: list[int] = []
        self.times: list[int] = []

    def observe_first(self, timestep):
        """Begins a record; the drawing comes with the question."""
        self.actions, self.times = [], []

    def select_action(self, observation):
        """Returns the action that the person types; raises _Quit if it is none."""
        self._show(terminal.drawing(observation, self._task.observer.readings, *shutil.get_terminal_size()))
        count, steps = self._task.rules.num_actions, len(self.actions)
        left = self._task.rules.step_limit - steps
        self._show(f"worth now {self._task.discount**steps:.2f}; {left} move{'' if left == 1 else 's'} left")
        shown_at = time.monotonic()
        while True:
            try:
                text = self._read("action: ").strip()
            except EOFError:
                text = _QUIT
            if text == _QUIT:
                raise _Quit
            if text.isdecimal() and len(text) < 10 and int(text) < count:
                self.actions.append(int(text))
                self.times.append(round(1000 * (time.monotonic() - shown_at)))
                return int(text)
            refusal = f"{text[:40]!r} is no action; " if text else ""
            asked = f"{refusal}type a number from 0 to {count - 1}, {_HELP} or {_QUIT}"
            self._show(self._rules if text == _HELP else asked)

    def observe(self, action, next_timestep):
        label, ledger = action - self._task.num_interactions, self._task.ledger
        if next_timestep.last() or label >= 0:
            answer = ledger.answers[0, ledger.num_answered[0] - (label >= 0)]
            self._show(f"{'Right!' if label == answer else 'Wrong.'} The answer: {self._task.label_names[answer]}.")


def play(
    domain: str,
    task: str,
    task_kwargs: Mapping[str, Any] | None = None,
    seed: int | None = None,
    view: bool = False,
    records: Path | None = None,
    read: Callable[[str], str] = input,
    show: Callable[[str], None] = print,
) -> dict[str, Score]:
    """Plays until the player quits.

    Args:
      domain, task, task_kwargs: arguments of `suite.load`, without the seed.
      seed: seed of the environment; by default one from the operating system.
      view: show the scene in rerun's viewer as well.
      records: file to which the record of each episode is appended.
      read: returns the player's reply to a prompt; an end of file quits.
      show: shows a text.

    Returns:
      Scores of `you`, and, if there are any, of the `trained agent` and the `ideal experimenter`.

    Raises:
      ValueError: for an unknown name, or for `view` without a display.
    """
    kwargs = dict(task_kwargs or {})
    environment = suite.load(domain, task, task_kwargs={**kwargs, "random": seed})
    observers = _viewers(domain, task, kwargs) if view else []
    rules = _rules(environment)
    show(rules)
    show(f"seed {environment.task.options.random}")
    others = others_lib.players(domain, task, kwargs)
    if others_lib.TRAINED not in others:
        trained = "".join(f" at {name} {agent_config.shown(value)}" for name, value in kwargs.items())
        show(f"There is no agent trained{trained} to compare you with.\n")
    scores = {name: Score() for name in ("you", *others)}
    person = _Person(environment.task, rules, read, show)
    you = environment_loop.EnvironmentLoop(environment, person, observers)
    # The others play in an environment of their own, with the same instances.
    again = suite.load(domain, task, task_kwargs={**kwargs, "random": environment.task.options.random})
    while True:
        try:
            you.run_episode()
        except _Quit:
            return scores
        scores["you"].add(environment)
        if records is not None:
            _append(records, protocol.question(domain, task, kwargs).name, environment, person)
        for name, actor in others.items():
            played = episodes.play(again, actor, environment.task.episode)
            scores[name].add(again)
            moves = ", ".join(again.task.action_names[action] for action in played.actions)
            show(f"  the {name} was {_outcome(again)}: {moves}")
        show("\n".join(f"{name:20} {score}" for name, score in scores.items()) + "\n")


def _append(path: Path, name: str, environment: suite.Environment, person: _Person) -> None:
    """Appends the record of an episode that a person has played to a file."""
    task = environment.task
    played = {
        "seed": int(task.options.random),
        "episode": task.episode,
        "actions": person.actions,
        "times": person.times,
    }
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps({"player": "you", "task": name, **played}) + "\n")


def _viewers(domain: str, task: str, kwargs: Mapping[str, Any]) -> list[environment_loop.Observer]:
    """Returns observers that show the scene in the viewer."""
    from physexp.analysis.replay import recording, viewing, writing  # The import takes a second.

    recorder = recording.EpisodeRecorder(domain, task, kwargs, agent="you")
    return [recorder, writing.Live(recorder, viewing.Viewer())]


def _outcome(environment: suite.Environment) -> str:
    """Returns how right the answers of an episode were, and after how many interactions."""
    ledger, count = environment.task.ledger, environment.task.rules.num_questions
    right, interactions = int(ledger.num_right[0]), int(ledger.steps[0] - ledger.num_answered[0])
    verdict = f"right in {right} of {count} questions" if count > 1 else "right" if right else "wrong"
    return f"{verdict} after {interactions} interaction{'' if interactions == 1 else 's'}"


def _rules(environment: suite.Environment) -> str:
    """Returns the question, a legend of the drawings, the rewards and the actions."""
    task = environment.task
    legend = terminal.legend(environment.observation_spec(), task.observer.readings)
    actions = "\n".join(f"{number:3}  {name}" for number, name in enumerate(task.action_names))
    count = task.rules.num_questions
    several = f"There are {count} questions; an answer takes a step, too.\n\n" if count > 1 else ""
    asked = "\n\n".join(filter(None, [task.question, textwrap.fill(task.description, 100)]))
    return (
        f"{asked}\n\n{legend}\n\n{several}"
        f"The right answer is worth 1, a wrong one or none in {task.rules.step_limit} steps -1. Each interaction\n"
        f"before it multiplies that by {task.discount:g}. Type a number:\n\n"
        f"{actions}\n  {_HELP}  show this again\n  {_QUIT}  quit\n"
    )
