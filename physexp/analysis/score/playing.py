"""Plays a target's episodes and keeps each as it ends, so that a command that was ended goes on after it.

As long as a folder is not complete, its `played.jsonl` has a line with the facts that define its episodes, and then a
line for each episode, with the task and the actions. An episode follows from its actions: those that are there are
simulated again, and the target is asked for the others alone.
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
import contextlib
import itertools
import json
import os
from pathlib import Path
import time
from typing import IO, Any

from physexp.agents import files
from physexp.analysis.data import lock
from physexp.analysis.score import episodes, player, protocol, targets

FILE = "played.jsonl"
_SYNC_SECONDS = 1.0  # So many seconds of play may be lost when the power fails.


class Session:
    """The episodes of a folder, played by one target.

    Attributes:
      num_played: how many episodes there are, of all tasks.
      num_kept: how many of them an earlier session has played.
    """

    def __init__(self, file: IO[bytes], kept: Mapping[str, Sequence[Sequence[int]]], actors: "player.Player | _Here"):
        self._file, self._kept, self._actors = file, kept, actors
        self._synced = time.monotonic()
        self.num_played = self.num_kept = sum(map(len, kept.values()))

    def play(self, asked: protocol.Question, num_episodes: int, seed: int) -> Iterator[episodes.Episode]:
        """Yields the first episodes of a task; those that nobody has played yet are played, and kept.

        Args:
          asked: the task.
          num_episodes: how many.
          seed: of the environments.

        Raises:
          OSError: if an episode cannot be kept.
          player.PlayerError: if the actor fails.
          ValueError: if an episode that was kept differs by now.
        """
        environment, kept = protocol.load(asked, seed), self._kept.get(asked.name, ())
        for number, actions in enumerate(kept[:num_episodes]):
            try:
                yield episodes.again(environment, number, actions)
            except ValueError as error:
                raise ValueError(
                    f"{self._file.name}: {asked.name}, {error}; another version has played it, so remove the folder"
                ) from None
        if len(kept) < num_episodes:
            act = self._actors.begin(asked, len(kept))
            for number in range(len(kept), num_episodes):
                played = episodes.play(environment, act, number)
                self._actors.end(played.timesteps[-1])
                self._keep([asked.name, played.actions.tolist()])
                self.num_played += 1
                yield played
        environment.close()

    def kept_in(self, folder: Path) -> str:
        """Returns the end of an error's message: where the episodes until then are."""
        if not self.num_played:
            return ""
        return f"; the episodes before it are in {folder}, and the same command goes on after them"

    def _keep(self, line: Any) -> None:
        self._file.write(json.dumps(line).encode() + b"\n")
        self._file.flush()
        if time.monotonic() - self._synced > _SYNC_SECONDS:
            os.fsync(self._file.fileno())
            self._synced = time.monotonic()


class _Here(contextlib.nullcontext):
    """Our own actors, in this process."""

    def __init__(self, target: targets.Target):
        super().__init__(self)
        self._make = target.make

    def begin(self, asked: protocol.Question, first: int) -> episodes.Act:
        return episodes.chosen_by(self._make(asked, first))

    def end(self, timestep) -> None:
        """Does nothing: they learn nothing from the end of an episode."""


@contextlib.contextmanager
def session(folder: Path, target: targets.Target, timeout: float, facts: Mapping[str, Any]) -> Iterator[Session]:
    """Returns a context that alone writes into a folder; `played.jsonl` is removed at its end unless it raises.

    A folder in which nothing was played in the end is left as it was found.

    Args:
      folder: it is made, is empty, or holds some of these very episodes.
      target: the player of the episodes.
      timeout: for each call of a user's function, s.
      facts: all that the episodes depend on, as JSON has it.

    Raises:
      OSError: if it cannot be written.
      ValueError: if another process is at work in the folder, or it holds something else.
    """
    player.check_place()
    with contextlib.ExitStack() as stack:
        stack.enter_context(lock.locked(folder, f"{folder} is in use by another process; give another --output"))
        path = folder / FILE
        if not path.exists() and any(one.name != ".lock" for one in folder.iterdir()):
            raise ValueError(f"{folder} exists and is not empty; give another --output")
        file = stack.enter_context(files.open_plain(path, "a+b"))
        kept = _read(file, folder, json.loads(json.dumps(facts)))
        actors = player.Player(target.name, timeout) if target.is_function else _Here(target)
        found = Session(file, kept, stack.enter_context(actors))
        try:
            yield found
        except BaseException:
            if not found.num_played:
                path.unlink()
            raise
        path.unlink()


def _read(file: IO[bytes], folder: Path, facts: Mapping[str, Any]) -> dict[str, list[list[int]]]:
    """Returns the actions of the episodes in an open file, by task; begins it with the facts if it is new.

    Raises:
      ValueError: if it begins with other facts, or a line is no episode.
    """
    file.seek(0)
    lines, size = [], 0
    for line in file.read().splitlines(keepends=True):
        try:
            lines.append(json.loads(line if line.endswith(b"\n") else b""))
        except ValueError:  # The writer was killed, or the power failed.
            break
        size += len(line)
    if len(lines) < 2:
        lines, size = [facts], 0
    file.truncate(size)
    if not size:
        file.write(json.dumps(facts).encode() + b"\n")
    elif difference := _difference(lines[0], facts):
        raise ValueError(f"{folder} was begun with {difference}; give the same, or another --output")
    kept = defaultdict(list)
    for number, line in enumerate(lines[1:], 2):
        match line:
            case [str(task), [*actions]] if all(type(action) is int for action in actions):
                kept[task].append(actions)
            case _:
                raise ValueError(f"{file.name}: line {number} is no episode; remove the folder to play everything anew")
    return kept


def _difference(theirs: Any, ours: Any) -> str:
    """Returns in words where two facts differ first; nothing where they do not."""
    if not (isinstance(theirs, dict) and isinstance(ours, dict)):
        return "" if theirs == ours else f"{json.dumps(theirs)} instead of {json.dumps(ours)}"
    for name in {**ours, **theirs}:
        if difference := _difference(theirs.get(name), ours.get(name)):
            return f"{name} {difference}"
    return ""


def unfinished(folder: Path) -> Path:
    """Returns the first of a folder, `FOLDER-2`, `FOLDER-3` and so on that is not complete."""
    for number in itertools.count(1):
        numbered = folder if number == 1 else folder.with_name(f"{folder.name}-{number}")
        if not numbered.exists() or (numbered / FILE).exists() or not any(numbered.iterdir()):
            return numbered
    raise AssertionError
