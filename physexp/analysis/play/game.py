"""A person's game in a terminal, beside the ideal experimenter and a trained agent on the same instances."""

from collections.abc import Callable, Mapping
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
    """Score of a player.

    Attributes:
      episodes, right: number of episodes, and of right answers.
      total: sum of the discounted returns.
    """

    episodes: int = 0
    right: int = 0
    total: float = 0.0

    def add(self, length: int, reward: float, discount: float) -> None:
        """Adds an episode of `length` actions."""
        self.episodes += 1
        self.right += reward > 0
        self.total += reward * discount ** (length - 1)

    def __str__(self) -> str:
        return f"{self.right} of {self.episodes} right, mean return {self.total / max(1, self.episodes):.3f}"


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
    observers = _viewers(environment, domain, task, kwargs) if view else []
    rules = _rules(environment)
    show(rules)
    others, discount = _others(domain, task, kwargs, show)
    scores = {"you": Score(), **{name: Score() for name in others}}
    while True:
        outcome = _play_episode(environment, rules, observers, read, show)
        if outcome is None:
            return scores
        scores["you"].add(*outcome, discount)
        for name, actor in others.items():
            length, reward = _replay(environment, domain, task, kwargs, actor)
            scores[name].add(length, reward, discount)
            count = f"{length - 1} interaction{'' if length == 2 else 's'}"
            show(f"  the {name} was {'right' if reward > 0 else 'wrong'} after {count}")
        show("\n".join(f"{name:20} {score}" for name, score in scores.items()) + "\n")


def _viewers(environment: suite.Environment, domain, task, kwargs) -> list[environment_loop.Observer]:
    """Returns observers that show the scene in the viewer."""
    from physexp.analysis.replay import live, recording, viewing  # The import takes a second.

    recorder = recording.EpisodeRecorder(environment, domain, task, kwargs, agent="you")
    return [recorder, live.Live(recorder, viewing.Viewer())]


def _others(domain: str, task: str, kwargs: dict[str, Any], show) -> tuple[dict[str, core.Actor], float]:
    """Returns the players to compare with, and the discount of the returns."""
    others: dict[str, core.Actor] = {}
    discount = domains.find(domain).discount
    try:
        network, config, _ = finding.shipped_agent(domain, task, kwargs)
    except ValueError:
        trained = "".join(f" at {name} {agent_config.shown(value)}" for name, value in kwargs.items())
        show(f"There is no agent trained{trained} to compare you with.\n")
    else:
        discount = config.agent.discount
        others["trained agent"] = acting.RecurrentActor(network)
    ideal = _ideal(domain, task, kwargs, discount)
    if ideal is not None:
        others["ideal experimenter"] = ideal
    return others, discount


def _ideal(domain: str, task: str, kwargs: dict[str, Any], discount: float) -> core.Actor | None:
    """Returns the ideal experimenter, or None if none can play."""
    find = domains.find(domain).ideal_with(kwargs)
    try:
        return None if find is None else find(task, kwargs, discount).actor()
    except ValueError:
        return None


def _rules(environment: suite.Environment) -> str:
    """Returns the question, a legend of the drawings, the rewards and the actions."""
    task = environment.task
    actions = [f"{number:3}  {name}" for number, name in enumerate(task.action_names)]
    return "\n".join(
        [
            task.question,
            "",
            terminal.legend(environment.observation_spec(), task.observer.readings),
            "",
            f"The right answer is worth 1, a wrong one or none in {task.rules.step_limit} steps -1. Each interaction",
            f"before it multiplies that by {task.discount:g}. Type a number:",
            "",
            *actions,
            f"  {_HELP}  show this again",
            f"  {_QUIT}  quit",
            "",
        ]
    )


def _play_episode(environment: suite.Environment, rules: str, observers, read, show) -> tuple[int, float] | None:
    """Plays one episode; returns its length and reward, or None if the player quits."""
    timestep, length = environment.reset(), 0
    for observer in observers:
        observer.observe_first(environment, timestep)
    while not timestep.last():
        show(terminal.drawing(timestep.observation, environment.task.observer.readings, *shutil.get_terminal_size()))
        action = _ask(environment, rules, read, show)
        if action is None:
            return None
        timestep, length = environment.step(action), length + 1
        for observer in observers:
            observer.observe(environment, timestep, action)
    verdict = "Right!" if timestep.reward > 0 else "Wrong."
    show(f"{verdict} The answer: {environment.task.label_names[environment.task.correct_answer]}.")
    return length, float(timestep.reward)


def _ask(environment: suite.Environment, rules: str, read, show) -> int | None:
    """Returns the number of an action; None to quit."""
    count = environment.action_spec().num_values
    while True:
        try:
            text = read("action: ").strip()
        except EOFError:
            return None
        if text == _QUIT:
            return None
        if text == _HELP:
            show(rules)
            continue
        if text.isdecimal() and len(text) < 10 and int(text) < count:
            return int(text)
        refusal = f"{text[:40]!r} is no action; " if text else ""
        show(f"{refusal}type a number from 0 to {count - 1}, {_HELP} or {_QUIT}")


def _replay(environment: suite.Environment, domain, task, kwargs, actor: core.Actor) -> tuple[int, float]:
    """Returns length and return of another player on the current instance."""
    seed = environment.task.options.random
    again = suite.load(domain, task, task_kwargs={**kwargs, "random": seed})
    again.task.next_episode = environment.task.episode
    metrics = environment_loop.EnvironmentLoop(again, actor).run_episode()
    again.close()
    return metrics["episode_length"], metrics["episode_return"]
