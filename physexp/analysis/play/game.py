"""A person's game in a terminal, beside the ideal experimenter and a trained agent on the same instances."""

from collections.abc import Callable, Mapping
import contextlib
import dataclasses
import shutil
from typing import Any

from physexp import suite
from physexp.agents import acting, core, environment_loop
from physexp.agents import config as agent_config
from physexp.analysis import domains
from physexp.analysis.play import terminal
from physexp.analysis.training import finding

_QUIT, _HELP = "q", "?"


@dataclasses.dataclass
class Score:
    """Score of a player."""

    episodes: int = 0
    right: int = 0
    total: float = 0.0  # The sum of the discounted returns.

    def add(self, length: int, reward: float, discount: float) -> None:
        """Adds an episode of `length` actions."""
        self.episodes += 1
        self.right += reward > 0
        self.total += reward * discount ** (length - 1)

    def __str__(self) -> str:
        return f"{self.right} of {self.episodes} right, mean return {self.total / max(1, self.episodes):.3f}"


class _Quit(Exception):  # noqa: N818
    """The player has quit."""


class _Person(core.Actor):
    """Asks a person, who sees drawings of the observations."""

    def __init__(self, task, rules: str, read: Callable[[str], str], show: Callable[[str], None]):
        self._task, self._rules, self._read, self._show = task, rules, read, show

    def observe_first(self, timestep):
        """Does nothing: the drawing comes with the question."""

    def select_action(self, observation):
        """Returns the action that the person types; raises _Quit if it is none."""
        self._show(terminal.drawing(observation, self._task.observer.readings, *shutil.get_terminal_size()))
        count = self._task.rules.num_actions
        while True:
            try:
                text = self._read("action: ").strip()
            except EOFError:
                text = _QUIT
            if text == _QUIT:
                raise _Quit
            if text.isdecimal() and len(text) < 10 and int(text) < count:
                return int(text)
            refusal = f"{text[:40]!r} is no action; " if text else ""
            asked = f"{refusal}type a number from 0 to {count - 1}, {_HELP} or {_QUIT}"
            self._show(self._rules if text == _HELP else asked)

    def observe(self, action, next_timestep):
        if next_timestep.last():
            verdict = "Right!" if next_timestep.reward > 0 else "Wrong."
            self._show(f"{verdict} The answer: {self._task.label_names[self._task.correct_answer]}.")


def play(
    domain: str,
    task: str,
    task_kwargs: Mapping[str, Any] | None = None,
    seed: int | None = None,
    view: bool = False,
    read: Callable[[str], str] = input,
    show: Callable[[str], None] = print,
) -> dict[str, Score]:
    """Plays until the player quits.

    Args:
      domain, task, task_kwargs: arguments of `suite.load`, without the seed.
      seed: seed of the environment; by default one from the operating system.
      view: show the scene in rerun's viewer as well.
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
    others, discount = _others(domain, task, kwargs, show)
    scores = {name: Score() for name in ("you", *others)}
    you = environment_loop.EnvironmentLoop(environment, _Person(environment.task, rules, read, show), observers)
    # The others play in an environment of their own, with the same instances.
    again = suite.load(domain, task, task_kwargs={**kwargs, "random": environment.task.options.random})
    while True:
        try:
            played = {"you": you.run_episode()}
        except _Quit:
            return scores
        for name, actor in others.items():
            again.task.next_episode = environment.task.episode
            played[name] = its = environment_loop.EnvironmentLoop(again, actor).run_episode()
            verdict, count = "right" if its["episode_return"] > 0 else "wrong", its["episode_length"] - 1
            show(f"  the {name} was {verdict} after {count} interaction{'' if count == 1 else 's'}")
        for name, its in played.items():
            scores[name].add(its["episode_length"], its["episode_return"], discount)
        show("\n".join(f"{name:20} {score}" for name, score in scores.items()) + "\n")


def _viewers(domain: str, task: str, kwargs: Mapping[str, Any]) -> list[environment_loop.Observer]:
    """Returns observers that show the scene in the viewer."""
    from physexp.analysis.replay import recording, viewing, writing  # The import takes a second.

    recorder = recording.EpisodeRecorder(domain, task, kwargs, agent="you")
    return [recorder, writing.Live(recorder, viewing.Viewer())]


def _others(domain: str, task: str, kwargs: dict[str, Any], show) -> tuple[dict[str, core.Actor], float]:
    """Returns the players to compare with, and the discount of the returns."""
    others: dict[str, core.Actor] = {}
    facts = domains.find(domain)
    discount, ideal = facts.discount, facts.ideal_with(kwargs)
    try:
        network, config, _ = finding.shipped_agent(domain, task, kwargs)
    except ValueError:
        trained = "".join(f" at {name} {agent_config.shown(value)}" for name, value in kwargs.items())
        show(f"There is no agent trained{trained} to compare you with.\n")
    else:
        discount = config.agent.discount
        others["trained agent"] = acting.RecurrentActor(network)
    if ideal is not None:
        with contextlib.suppress(ValueError):  # If it cannot play.
            others["ideal experimenter"] = ideal(task, kwargs, discount).actor()
    return others, discount


def _rules(environment: suite.Environment) -> str:
    """Returns the question, a legend of the drawings, the rewards and the actions."""
    task = environment.task
    legend = terminal.legend(environment.observation_spec(), task.observer.readings)
    actions = "\n".join(f"{number:3}  {name}" for number, name in enumerate(task.action_names))
    return (
        f"{task.question}\n\n{legend}\n\n"
        f"The right answer is worth 1, a wrong one or none in {task.rules.step_limit} steps -1. Each interaction\n"
        f"before it multiplies that by {task.discount:g}. Type a number:\n\n"
        f"{actions}\n  {_HELP}  show this again\n  {_QUIT}  quit\n"
    )
