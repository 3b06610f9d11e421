"""The texts of a task in words."""

from collections.abc import Mapping, Sequence
import itertools
import math
import re
from typing import Any

import numpy as np

from physexp import checks

LEVELS = ("named", "neutral", "anonymous")
"""How much is told: names as they are, names that mean nothing, or numbers alone."""

Observation = Mapping[str, np.ndarray]

_WORD = re.compile(r"[A-Za-z_]+")
_SYLLABLES = ["".join(pair) for pair in itertools.product("bdfgklmnprstvz", "aeiou")]


class Teller:
    """Tells a task, and the episode that an environment plays."""

    def __init__(self, task: Any, level: str, digits: int | None):
        """Takes the task of an environment, of `composer_task.ComposerTask`; the others are as for `Episode`."""
        self._task = task
        self._level = checks.word(*LEVELS)("level", level)
        self._digits = checks.optional(checks.whole(0, 9))("digits", digits)
        words = _WORD.findall(" ".join([*task.action_names, *task.observation_spec()]))
        self._neutral = {word: _syllables(number) for number, word in enumerate(dict.fromkeys(words))}

    def rules(self) -> str:
        """Returns the question, the experiments and the answers, the readings, and the price."""
        task, several = self._task, self._task.rules.num_questions
        asked = [task.question, task.description] if self._level == "named" else []
        if several > 1:
            asked.append(f"There are {several} questions about the same thing, and the next one follows an answer.")
        rewards = (
            "You experiment, and then you answer. Exactly one answer to a question is right: it earns 1. A wrong one "
            f"earns -1, and so does none within {task.rules.step_limit} actions, experiments and answers together. "
            f"Each action before an answer multiplies what it earns by {task.discount:g}."
        )
        lists = {
            "Experiments": self._listed([interaction.name for interaction in task.interactions]),
            "Answers": self._listed(task.label_names),
            "Readings": self._meanings(),
        }
        return "\n\n".join([*filter(None, asked), rewards, *(f"{name}:\n{text}" for name, text in lists.items())])

    def told(self, seen: Observation) -> str:
        """Returns the price of an answer now, and the readings, arrays by name."""
        task = self._task
        done, limit, several = task.steps, task.rules.step_limit, task.rules.num_questions
        asked = f"This is question {task.ledger.num_answered[0] + 1} of {several}. " if several > 1 else ""
        last = " Only one action is left: answer now." if done == limit - 1 else ""
        worth = f"The right answer is worth {task.discount**done:.4f} now."
        return f"{asked}You have done {done} of {limit} actions. {worth}{last}\n{self._readings(seen)}"

    def label(self, number: int) -> str:
        """Returns the number of an answer, and its name."""
        return f"{number}" if self._level == "anonymous" else f"{number}, {self._named(self._task.label_names[number])}"

    def _readings(self, seen: Observation) -> str:
        if "pixels" in seen:
            return "You see the image."
        if self._level == "anonymous":
            return self._numbers(np.concatenate([values.ravel() for values in seen.values()]))
        readings = self._task.observer.readings
        units = {name: readings[name].unit if self._level == "named" else "" for name in seen}
        return "\n".join(f"{self._named(name)} = {self._numbers(seen[name])} {units[name]}".rstrip() for name in seen)

    def _numbers(self, values: Any) -> str:
        if np.ndim(values):
            return f"[{', '.join(map(self._numbers, values))}]"
        if self._digits is None:
            return str(values).removesuffix(".0")
        return np.format_float_positional(values, precision=self._digits, trim="-")

    def _meanings(self) -> str:
        specs, named = self._task.observation_spec(), self._task.observation_meanings
        if self._level == "anonymous" and not self._task.pixels:
            return f"  {sum(math.prod(spec.shape) for spec in specs.values())} numbers"
        shapes = {name: " x ".join(map(str, spec.shape)) for name, spec in specs.items()}
        counts = {name: f"{shape} number{'' if shape == '1' else 's'}" for name, shape in shapes.items()}
        meanings = {
            name: f"{named[name]} ({count})" if self._level == "named" else count for name, count in counts.items()
        }
        return "\n".join(f"  {self._named(name)}: {meaning}" for name, meaning in meanings.items())

    def _listed(self, names: Sequence[str]) -> str:
        if self._level == "anonymous":
            return f"  0 to {len(names) - 1}"
        return "\n".join(f"  {number}: {self._named(name)}" for number, name in enumerate(names))

    def _named(self, text: str) -> str:
        """Returns a text with the names that the level allows."""
        return text if self._level == "named" else _WORD.sub(lambda found: self._neutral[found[0]], text)


def _syllables(number: int) -> str:
    """Returns the neutral name of a number."""
    return _SYLLABLES[number % len(_SYLLABLES)] * (1 + number // len(_SYLLABLES))
