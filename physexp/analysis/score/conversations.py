"""Conversations to learn from: episodes in words, with the best possible belief before each action.

A file has a line for each episode, JSON with its `messages`, each with its `role` and `content`, as programs that tune
language models read them.
"""

from collections.abc import Iterable
import json
from pathlib import Path

from physexp.analysis.data import episodes
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.score import protocol
from physexp.suite import words

_DIGITS = 4  # Decimals of probabilities.


class Writer:
    """Writes the conversations of a task into a file."""

    def __init__(self, path: Path, question: protocol.Question, seed: int):
        """Takes the seed of the environments in which the episodes were played; raises ValueError for images."""
        if "pixels" in question.observation_spec:
            raise ValueError(
                f"{question.name} observes images, which no conversation holds; choose tasks with features"
            )
        self._path, self._question = path, question
        self._environment = protocol.load(question, seed)

    def add(self, played: Iterable[tuple[episodes.Episode, ideal_base.Judgement | None]]) -> None:
        """Adds episodes of the task, with their judgements where they are known."""
        self._path.parent.mkdir(exist_ok=True)
        with self._path.open("a", encoding="utf-8") as file:
            for episode, judged in played:
                found = {"task": self._question.name, "episode": episode.index, "messages": self._told(episode, judged)}
                file.write(json.dumps(found) + "\n")

    def _told(self, episode: episodes.Episode, judged: ideal_base.Judgement | None) -> list[dict[str, str]]:
        """Returns the messages up to the last action."""
        told, count = words.Episode(self._environment, episode.index), self._question.num_interactions
        for step, action in enumerate(episode.actions):
            call = f"experiment({action})" if action < count else f"answer({action - count})"
            if judged is not None:
                call = f"believe({judged.beliefs[step].round(_DIGITS).tolist()})\n{call}"
            told.say(call)
        return told.messages()[:-1]
