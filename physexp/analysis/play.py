"""A person plays in a terminal, beside the ideal experimenter and a trained agent on the same instances."""

from collections.abc import Callable, Mapping
import dataclasses
from typing import Any

import numpy as np

from physexp import suite
from physexp.agents import core, environment_loop, pretrained
from physexp.analysis.ideal import playing, towers, which_is_heavier

_WIDTH, _HEIGHT = 48, 14  # Characters of a drawing.
_ROOM = 0.6  # m, from the middle to the side of a drawing of the towers
_QUIT = "q"


@dataclasses.dataclass
class Score:
    """How a player has done so far.

    Attributes:
      episodes, right: how many were played, and answered right.
      total: sum of the discounted returns.
    """

    episodes: int = 0
    right: int = 0
    total: float = 0.0

    def add(self, length: int, reward: float, discount: float) -> None:
        """Counts an episode of so many actions."""
        self.episodes += 1
        self.right += reward > 0
        self.total += reward * discount ** (length - 1)

    def __str__(self) -> str:
        return f"{self.right} of {self.episodes} right, mean return {self.total / max(1, self.episodes):.3f}"


def play(domain: str, task: str, difficulty: float | None = None, seed: int | None = None, view: bool = False,
         read: Callable[[str], str] = input, show: Callable[[str], None] = print) -> dict[str, Score]:  # fmt: skip
    """Plays until the player quits.

    Args:
      domain, task, difficulty: what is played.
      seed: of the environment; by default one from the operating system.
      view: show the scene in rerun's viewer as well.
      read: asks the player; an end of file quits.
      show: shows a text.

    Returns:
      Scores by player: `you`, `ideal experimenter`, `trained agent`.

    Raises:
      ValueError: for an unknown name, or where the scene is to be shown and there is no display.
    """
    kwargs: dict[str, Any] = {} if difficulty is None else {"difficulty": difficulty}
    environment = suite.load(domain, task, task_kwargs={**kwargs, "random": seed})
    observers = _viewers(environment, domain, task, kwargs) if view else []
    others, discount = _others(environment, domain, task)
    scores = {"you": Score(), **{name: Score() for name in others}}
    show(_rules(environment))
    while True:
        outcome = _play_episode(environment, observers, read, show)
        if outcome is None:
            return scores
        scores["you"].add(*outcome, discount)
        for name, actor in others.items():
            length, reward = _replay(environment, domain, task, kwargs, actor)
            scores[name].add(length, reward, discount)
            show(f"  the {name} was {'right' if reward > 0 else 'wrong'} after {length - 1} interactions")
        show("\n".join(f"{name:20} {score}" for name, score in scores.items()) + "\n")


def _viewers(environment: suite.Environment, domain, task, kwargs) -> list[environment_loop.Observer]:
    """What shows the scene in the viewer."""
    from physexp.analysis.replay import recording, writing  # Takes a second, and most play without.

    recorder = recording.EpisodeRecorder(environment, domain, task, kwargs, agent="you")
    return [recorder, writing.Live(recorder, writing.open_viewer)]


def _others(environment: suite.Environment, domain: str, task: str) -> tuple[dict[str, core.Actor], float]:
    """The players to compare with, and the discount that the trained one knows."""
    agent = pretrained.load(domain, task)
    discount = agent.card["agent"]["discount"]
    others: dict[str, core.Actor] = {"trained agent": agent.actor()}
    if domain == "towers":
        others["ideal experimenter"] = towers.IdealExperimenter(towers.solve(task, 0.0, discount))
    elif task == "features":
        solution = which_is_heavier.solve(environment.task.options.difficulty, discount)
        others["ideal experimenter"] = playing.IdealExperimenter(solution)
    return others, discount


def _rules(environment: suite.Environment) -> str:
    task = environment.task
    lines = [f"{number:3}  {name}" for number, name in enumerate(task.action_names)]
    return "\n".join(["Every interaction costs time; the answer ends the episode. Type a number:", "", *lines,
                      f"  {_QUIT}  quit", ""])  # fmt: skip


def _play_episode(environment: suite.Environment, observers, read, show) -> tuple[int, float] | None:
    """One episode: its length and reward, or None if the player quits."""
    timestep, length = environment.reset(), 0
    for observer in observers:
        observer.observe_first(environment, timestep)
    while not timestep.last():
        show(drawing(timestep.observation))
        action = _ask(environment, read, show)
        if action is None:
            return None
        timestep, length = environment.step(action), length + 1
        for observer in observers:
            observer.observe(environment, timestep, action)
    verdict = "Right!" if timestep.reward > 0 else "Wrong."
    show(f"{verdict} The answer: {environment.task.label_names[environment.task.correct_answer]}.")
    return length, float(timestep.reward)


def _ask(environment: suite.Environment, read, show) -> int | None:
    """The number of an action; None to quit."""
    count = environment.action_spec().num_values
    while True:
        try:
            text = read("action: ").strip()
        except EOFError:
            return None
        if text == _QUIT:
            return None
        if text.isdecimal() and int(text) < count:
            return int(text)
        show(f"{text!r} is no action; type a number from 0 to {count - 1}, or {_QUIT}")


def _replay(environment: suite.Environment, domain, task, kwargs, actor: core.Actor) -> tuple[int, float]:
    """How another player does on the instance that has just been played."""
    seed = environment.task.options.random
    again = suite.load(domain, task, task_kwargs={**kwargs, "random": seed})
    again.task.next_episode = environment.task.episode
    metrics = environment_loop.EnvironmentLoop(again, actor).run_episode()
    again.close()
    return metrics["episode_length"], metrics["episode_return"]


def drawing(observation: Mapping[str, np.ndarray]) -> str:
    """An observation as text: bars of heights, the towers from the side, or an image in coloured half blocks."""
    if "pixels" in observation:
        return _image(observation["pixels"])
    if "heights" in observation:
        return "\n".join(f"block {k} {'#' * round(100 * height):40} {100 * height:5.1f} cm"
                         for k, height in enumerate(observation["heights"]))  # fmt: skip
    canvas = np.full((_HEIGHT, _WIDTH), " ")
    things = {str(k): position for k, position in enumerate(observation["positions"])}
    if "fist_position" in observation:
        things["O"] = observation["fist_position"]
    for name, (x, _, z) in things.items():
        column = round((x + _ROOM) / (2 * _ROOM) * (_WIDTH - 1))
        row = _HEIGHT - 1 - round(z / 0.55 * (_HEIGHT - 1))
        if 0 <= column < _WIDTH and 0 <= row < _HEIGHT:
            canvas[row, column] = name
    floor = "-" * _WIDTH
    aside = "  ".join(f"{name}: y {100 * y:+.1f} cm" for name, (_, y, _) in things.items())
    return "\n".join(["".join(row).rstrip() for row in canvas] + [floor, aside])


def _image(pixels: np.ndarray) -> str:
    """Two rows of pixels in each line of text, by 24-bit colours."""
    lines = []
    for upper, lower in zip(pixels[::2], pixels[1::2], strict=True):
        cells = (
            f"\x1b[38;2;{a[0]};{a[1]};{a[2]};48;2;{b[0]};{b[1]};{b[2]}m▀" for a, b in zip(upper, lower, strict=True)
        )
        lines.append("".join(cells) + "\x1b[0m")
    return "\n".join(lines)
