"""Plays a target's episodes and keeps each as it ends, so that an interrupted command continues with the others.

Until a folder is complete, its `played.jsonl` has a line with the facts that define its episodes, and then a line for
each episode: the task and the actions. An episode follows from its actions: stored ones are simulated again, and the
target plays the others alone.
"""

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
import contextlib
import itertools
import json
import operator
from pathlib import Path
import time
from typing import IO, Any

from physexp.agents import environment_loop, files
from physexp.analysis.data import episodes, lock, provenance
from physexp.analysis.score import actors, instances, player, protocol, targets, user_agent

FILE = "played.jsonl"


class Session:
    """The episodes of a folder, played by one target.

    Attributes:
      num_played: the number of episodes, of all tasks.
      problem: the error of an agent that failed; empty if none did.
    """

    def __init__(self, file: IO[bytes], kept: Mapping[str, Sequence[Sequence[int]]], make: actors.Make):
        self._file, self._kept, self._make, self._begun = file, kept, make, time.monotonic()
        self.num_played = sum(map(len, kept.values()))
        self.problem = ""

    def play(
        self, questions: Sequence[protocol.Question], num_episodes: int, which: instances.Instances
    ) -> Iterator[tuple[protocol.Question, episodes.Episode]]:
        """Yields the first episodes of each task, of some instances; stops at the first failure of an agent.

        Raises PlayerError if it fails before any episode is over, and ValueError if a stored episode does not follow
        from its actions.
        """
        for question in questions:
            kept = self._kept.get(question.name, ())
            with contextlib.closing(protocol.load(question)) as environment:
                for index, actions in enumerate(kept):
                    seed = which.seed_of(question.name, index)
                    try:
                        episode = episodes.play(environment, environment_loop.Repeat(actions), index, seed)
                    except ValueError as error:
                        raise ValueError(
                            f"{self._file.name}: {question.name}, episode {index}: {error}; another version has played "
                            "it, so remove the folder"
                        ) from None
                    yield question, episode
                for index in range(len(kept), num_episodes):
                    seed = which.seed_of(question.name, index)
                    try:
                        episode = episodes.play(environment, self._make(question, index), index, seed)
                    except player.PlayerError as error:
                        if not self.num_played:
                            raise
                        self.problem = str(error)
                        return
                    self._file.write(json.dumps([question.name, episode.actions.tolist()]).encode() + b"\n")
                    self._file.flush()
                    self.num_played += 1
                    yield question, episode

    def write(self, name: str, facts: Mapping[str, Any], results: Mapping[str, Any]) -> dict[str, Any]:
        """Writes facts, the outcome, the provenance and results into a file of the folder; returns all of them.

        Raises PlayerError if an agent has failed; the message says where the episodes before it are.
        """
        folder, outcome = Path(self._file.name).parent, {"complete": not self.problem, "problem": self.problem}
        written = {**facts, **outcome, **provenance.made_since(self._begun), **results}
        files.write_atomically(folder / name, (json.dumps(written, indent=1) + "\n").encode())
        if self.problem:
            raise player.PlayerError(
                f"{self.problem}; the episodes before it are in {folder}, and the same command goes on after them"
            )
        return written


@contextlib.contextmanager
def session(folder: Path, target: targets.Target, timeout: float, facts: Mapping[str, Any]) -> Iterator[Session]:
    """Returns a context that alone writes into a folder; `played.jsonl` is removed at its end unless it raises.

    A folder without any episode at the end is left as it was found. Raises ValueError for a folder that holds anything
    but episodes with the same `facts`, which are all that they depend on, or in which another process is at work.
    """
    user_agent.refuse_here()
    with contextlib.ExitStack() as stack:
        stack.enter_context(lock.locked(folder, f"{folder} is in use by another process; give another --output"))
        path = folder / FILE
        if not path.exists() and any(one.name != ".lock" for one in folder.iterdir()):
            raise ValueError(f"{folder} exists and is not empty; give another --output")
        file = stack.enter_context(path.open("a+b"))
        kept = _kept(file, folder, facts)
        make = target.make or stack.enter_context(contextlib.closing(player.Player(target.name, timeout))).actor
        found = Session(file, kept, make)
        try:
            yield found
        except BaseException:
            if not found.num_played:
                path.unlink()
            raise
        path.unlink()


def _kept(file: IO[bytes], folder: Path, facts: Mapping[str, Any]) -> dict[str, list[list[int]]]:
    """Returns the actions of the episodes in an open file, by task; begins it with the facts if it has none."""
    file.seek(0)
    lines, size = [], 0
    for line in file.read().splitlines(keepends=True):
        try:
            lines.append(json.loads(line if line.endswith(b"\n") else b""))
        except ValueError:  # The writer was killed, or the power failed.
            break
        size += len(line)
    if len(lines) < 2:
        file.truncate(0)
        file.write(json.dumps(facts).encode() + b"\n")
        return {}
    file.truncate(size)
    for place, theirs, ours in differences(lines[0], json.loads(json.dumps(facts))):
        raise ValueError(
            f"{folder} was begun with {' '.join(place)} {json.dumps(theirs)} instead of {json.dumps(ours)}; give the "
            "same, or another --output"
        )
    kept = defaultdict(list)
    for task, actions in lines[1:]:
        kept[task].append(actions)
    return kept


def differences(
    theirs: Any, ours: Any, are_equal: Callable[[Any, Any], bool] = operator.eq, place: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], Any, Any]]:
    """Yields the names, one inside the other, and both values where dictionaries of dictionaries differ."""
    if isinstance(theirs, dict) and isinstance(ours, dict):
        for name in {**ours, **theirs}:
            yield from differences(theirs.get(name), ours.get(name), are_equal, (*place, name))
    elif not are_equal(theirs, ours):
        yield place, theirs, ours


def unfinished(folder: Path) -> Path:
    """Returns the first of a folder, `FOLDER-2`, `FOLDER-3` and so on that is not complete."""
    others = (folder.with_name(f"{folder.name}-{number}") for number in itertools.count(2))
    names = itertools.chain([folder], others)
    return next(one for one in names if not one.exists() or (one / FILE).exists() or not any(one.iterdir()))
