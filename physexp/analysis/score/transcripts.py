"""Runs in words: the episodes of a player, such as a language model, in a folder.

`transcript.jsonl` has a line for the player, one for each event of an episode, and one for each report of the client,
as it comes. `records.jsonl` has a line for each episode that is over: with seed and index, the actions rebuild it.
"""

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
import contextlib
import functools
import json
from pathlib import Path
import time
from typing import IO, Any

import numpy as np

from physexp import checks, suite
from physexp.agents import files
from physexp.analysis.data import lock, provenance
from physexp.analysis.score import instances as instances_lib
from physexp.analysis.score import playing, protocol
from physexp.suite import words

TRANSCRIPT, RECORDS = "transcript.jsonl", "records.jsonl"

EPISODES = 50
"""The number of episodes of each task for players that are dear."""


class Run:
    """The episodes of a player."""

    def __init__(
        self,
        file: IO[bytes],
        kept: Mapping[tuple[str, int], list[dict[str, Any]]],
        instances: instances_lib.Instances,
        last: Mapping[str, Any],
    ):
        self._file, self._kept, self._instances = file, kept, instances
        self._last = last  # The task and the index of the episode that was played last; empty if none was.

    def episodes(
        self,
        name: str,
        count: int = EPISODES,
        *,
        level: str = "named",
        digits: int | None = None,
    ) -> Iterator[words.Episode]:
        """Yields the first episodes of a task in words, those alone that are not over; one goes on where it broke off.

        An episode is played before the next one is asked for.

        Args:
          name: the task, with options, as in `strings/features,difficulty=2`.
          count: the number of episodes.
          level, digits: as for `words.Episode`.

        Raises:
          ValueError: for a value that is not allowed, or an episode that was begun with others.
        """
        (question,) = protocol.named([name])
        with contextlib.closing(protocol.load(question)) as environment:
            for index in range(count):
                episode = self.begin(question, environment, index, level, digits)
                if not episode.is_over:
                    yield episode

    def begin(
        self,
        question: protocol.Question,
        environment: suite.Environment,
        index: int,
        level: str = "named",
        digits: int | None = None,
    ) -> words.Episode:
        """Returns the episode of an index in a task, in an environment of the task; one that was begun goes on."""
        kept = self._kept.get((question.name, index), ())
        keep = functools.partial(self._write, task=question.name, episode=index)
        environment.task.reseed(self._instances.seed_of(question.name, index))
        secret = self._instances.facts if isinstance(self._instances, instances_lib.Private) else None
        return words.Episode(environment, index, level, digits, kept, keep, secret)

    def tell(self, **amounts: float) -> None:
        """Keeps amounts that the client has spent since the last report, in the episode that was played last.

        They may be its tokens and their cost, for instance; the record of an episode has their sums. The run that
        played it may be over: another one in its folder tells as well. Raises ValueError for an amount that is no
        number, and if no episode was played.
        """
        if not self._last:
            raise ValueError(f"no episode of {self._file.name} was played; tell its amounts after one")
        for name, amount in amounts.items():
            checks.at_least(0)(name, amount)
        self._write({"time": time.time(), "told": amounts}, **self._last)

    def _write(self, event: Mapping[str, Any], **where: Any) -> None:
        self._last = where
        self._file.write(json.dumps({**where, **event}, default=np.generic.item).encode() + b"\n")
        self._file.flush()


@contextlib.contextmanager
def run(
    folder: Path,
    *,
    model: str,
    harness: str,
    tools: str,
    budget: str,
    instances: instances_lib.Instances = protocol.PUBLIC,
) -> Iterator[Run]:
    """Returns a context for the run of a player, which alone writes into a folder; a run that broke off goes on.

    Args:
      folder: the folder, which is made if need be.
      model: the name and the version of the model, or of any other player.
      harness: the program that leads it, with its version.
      tools: the tools that it has besides those of an episode; `none`, for instance.
      budget: its limits, such as tokens or replies for each episode.
      instances: those that are played; files and replies tell neither a key nor the seeds that follow from it.

    Raises:
      ValueError: if the folder holds a run of another player or of other instances, or another process writes into it.
    """
    player = {"model": model, "harness": harness, "tools": tools, "budget": budget}
    first = {"player": player, "instances": instances.facts}
    with lock.locked(folder, f"{folder} is in use by another process; give another folder"):
        path = folder / TRANSCRIPT
        with path.open("a+b") as file:
            lines = _lines(file)
            if not lines:
                file.write(json.dumps({**first, "versions": provenance.versions()}).encode() + b"\n")
            begun = {name: lines[0][name] for name in first} if lines else first
            for (_, name), theirs, ours in playing.differences(begun, first):
                raise ValueError(
                    f"{path} has the {name} {theirs!r} instead of {ours!r}; give the same, or another folder"
                )
            kept: dict[tuple[str, int], list[dict[str, Any]]] = {}
            last: dict[str, Any] = {}
            for line in lines[1:]:
                last = {name: line.pop(name) for name in ("task", "episode")}
                if "told" not in line:
                    kept.setdefault((last["task"], last["episode"]), []).append(line)
            try:
                yield Run(file, kept, instances, last)
            finally:
                found = "".join(json.dumps(record) + "\n" for record in records(path))
                files.write_atomically(folder / RECORDS, found.encode())


def records(transcript: Path) -> list[dict[str, Any]]:
    """Returns the records of the episodes in a transcript that are over; see `words.Episode.record`.

    Each has the facts about the player, too, the `task` with its options, and in `told` the sums of the amounts that
    `Run.tell` has kept about the episode.
    """
    with transcript.open("rb") as file:
        first, *lines = _lines(file)
    model, *others = first["player"].items()
    facts = {"player": model[1], **dict(others)}
    told: dict[Any, Counter[str]] = defaultdict(Counter)
    for line in lines:
        told[line.get("task"), line.get("episode")].update(line.get("told", {}))
    return [
        {**facts, "task": line["task"], **line["ended"], "told": dict(told[line["task"], line["episode"]])}
        for line in lines
        if "ended" in line
    ]


def _lines(file: IO[bytes]) -> list[dict[str, Any]]:
    """Returns the content of all whole lines of an open file; cuts off a last one that was not written whole."""
    file.seek(0)
    whole = [line for line in file.read().splitlines(keepends=True) if line.endswith(b"\n")]
    if file.writable():
        file.truncate(sum(map(len, whole)))
    return [json.loads(line) for line in whole]
