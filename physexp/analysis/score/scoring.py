"""Scores a target: plays the protocol, judges what was played, and keeps both in a folder."""

from collections.abc import Callable, Mapping, Sequence
from concurrent import futures
import contextlib
import dataclasses
import json
from pathlib import Path
import time
import types
from typing import Any

import pyarrow

from physexp.agents import files
from physexp.analysis.data import provenance
from physexp.analysis.score import episodes, judging, log, player, protocol, reference, scores, targets

FILE = "score.json"


def score(
    target: str,
    questions: Sequence[protocol.Question],
    num_episodes: int,
    folder: Path,
    *,
    greedy: bool = False,
    timeout: float = 60.0,
    made: Mapping[str, Any] | None = None,
    show: Callable[[int], None] = lambda done: None,
) -> dict[str, Any]:
    """Plays the protocol with a target; returns what `score.json` holds.

    Whole episodes that were played are kept, also where the actor fails or the user ends it, once they have been
    judged; where the user does not wait for that and ends it again, it leaves nothing.

    Args:
      target, greedy: as for `targets.maker`.
      questions: the tasks.
      num_episodes: of each of them.
      folder: where everything goes; it is made, or is empty.
      timeout: for each call of the actor, s.
      made: what else is to be said of how it was made: `algorithm`, `frames`, `seconds`.
      show: called with how many episodes are done; one that has been played, but not been judged, counts half.

    Raises:
      OSError: if it cannot be written.
      player.PlayerError: if the actor fails.
      ValueError: if there is something in the folder, no ideal experimenter is known, or a number makes no sense.
    """
    check(num_episodes, timeout, folder)
    for asked in questions:
        protocol.ideal(asked)  # Where none is known, that is told before anything is played.
    agent = {**targets.facts(target, [asked.name for asked in questions]), **(made or {})}
    folder.mkdir(parents=True, exist_ok=True)
    facts = {
        "version": protocol.VERSION,
        "target": target,
        "greedy": greedy,
        "protocol": {
            "seed": protocol.SEED,
            "episodes": num_episodes,
            "tasks": [asked.name for asked in questions],
        },
        "agent": agent,
    }
    begun, problem = time.monotonic(), "it was ended early"
    parts: list[_Part] = []
    num_played = 0

    def show_done(new: int = 0) -> None:
        nonlocal num_played
        num_played += new
        show((num_played + judges.count) // 2)

    with judging.Judges(len(questions), show_done) as judges:
        try:
            with player.Player(target, greedy, timeout) as actor:
                for asked in questions:
                    _play(actor, asked, num_episodes, judges, parts, lambda: show_done(1))
            problem = ""
            judges.wait([part.judged for part in parts])  # Ended here, it goes on to wait below: a second time ends it.
        except player.PlayerError as error:
            problem = str(error)
            count = sum(len(part.rows) for part in parts)
            kept = f"; the {count:,} episodes before are in {folder}" if parts else ""
            raise player.PlayerError(f"{problem}{kept}") from None
        finally:
            if parts:
                judges.wait([part.judged for part in parts])
                ended = {"complete": not problem, "problem": problem}
                said = {part.asked.name: judges.judged(part.asked, part.played, part.judged) for part in parts}
                written = _write(folder, parts, said, begun, {**facts, **ended})
            else:
                with contextlib.suppress(OSError):  # Somebody else has put something there.
                    folder.rmdir()
    return written


@dataclasses.dataclass(frozen=True)
class _Part:
    """What was played of a task, a dictionary of columns for each episode, and what is going to be said of it."""

    asked: protocol.Question
    played: list[episodes.Episode]
    rows: list[dict[str, Any]]
    judged: "futures.Future[judging.Judged]"


def _play(
    actor: player.Player,
    asked: protocol.Question,
    num_episodes: int,
    judges: judging.Judges,
    parts: list[_Part],
    show: Callable[[], None],
) -> None:
    """Plays a task and has it judged; adds whole episodes to the parts, also where it is ended early."""
    rows: list[dict[str, Any]] = []
    played: list[episodes.Episode] = []
    try:
        for number, episode in enumerate(actor.play(asked, num_episodes)):
            rows.append(log.played(asked, protocol.ENVIRONMENT_SEED, number, episode))
            played.append(dataclasses.replace(episode, timesteps=[]))  # Images of many episodes are large.
            show()
    finally:
        if played:
            parts.append(_Part(asked, played, rows[: len(played)], judges.begin(asked, played)))


def _write(
    folder: Path, parts: Sequence[_Part], said: Mapping[str, judging.Judged], begun: float, facts: dict[str, Any]
) -> dict[str, Any]:
    """Writes the log, first, and its figures beside facts; returns the latter two."""
    rows = [
        {**row, **log.said(part.asked, row["action"], judged)}
        for part in parts
        for row, judged in zip(part.rows, said[part.asked.name].actions, strict=True)
    ]
    found, questions = log.table(rows), [part.asked for part in parts]
    log.write(folder, found)
    ideals = {name: one.ideal for name, one in said.items()}
    written = {**facts, **provenance.made_since(begun), **figures(found, questions, ideals)}
    files.write_atomically(folder / FILE, (json.dumps(written, indent=1) + "\n").encode())
    return written


def figures(
    found: pyarrow.Table, questions: Sequence[protocol.Question], ideals: Mapping[str, reference.Reference | None]
) -> dict[str, Any]:
    """Returns the figures of a log, of those of the tasks that were played; for the `ideals` see `played`."""
    return scores.summary(played(found, questions, ideals))


def played(
    found: pyarrow.Table,
    questions: Sequence[protocol.Question],
    ideals: Mapping[str, reference.Reference | None] = types.MappingProxyType({}),
) -> list[scores.TaskScore]:
    """Returns the scores of those of the tasks that are in a log.

    Args:
      found: the log.
      questions: the tasks.
      ideals: how the ideal experimenter fares, by task, where that is known.
    """
    parts = [(asked, log.of_task(found, asked)) for asked in questions]
    return [scores.of_task(asked, columns, ideals.get(asked.name)) for asked, columns in parts if len(columns["step"])]


def read(folder: Path) -> dict[str, Any]:
    """Returns what `score.json` holds, of this version of the protocol.

    Raises:
      OSError: if it cannot be read.
      ValueError: if there is none, or it is not what was written.
    """
    path = folder / FILE
    if not path.exists():
        raise ValueError(f"{folder} holds no score ({FILE}); give a folder that `physexp score` has written")
    found = files.read_json(path)
    version = found.get("version") if isinstance(found, dict) else None
    if version != protocol.VERSION:
        raise ValueError(f"{path} is of protocol {version!r}; this version of physexp plays {protocol.VERSION}")
    kinds: dict[str, Any] = {
        "target": str,
        "greedy": bool,
        "complete": bool,
        "problem": str,
        "seconds": (int, float),
        "commit": str,
        **dict.fromkeys(("versions", "agent", "protocol", "tasks", "domains", "whole"), dict),
    }
    asked = {"seed": int, "episodes": int, "tasks": list}
    for fields, wanted in ((found, kinds), (found.get("protocol"), asked)):
        for name, kind in wanted.items():
            if not isinstance(fields.get(name), kind):
                raise ValueError(f"{path} is not what was written: {name} is {fields.get(name)!r}; score again")
    if not all(isinstance(name, str) for name in found["protocol"]["tasks"]):
        raise ValueError(f"{path} is not what was written: tasks is {found['protocol']['tasks']!r}; score again")
    return found


def check(num_episodes: int, timeout: float, folder: Path) -> None:
    """Refuses numbers that make no sense, and a folder with something in it: raises ValueError."""
    if not 1 <= num_episodes <= protocol.MOST_EPISODES:
        raise ValueError(f"episodes is {num_episodes}; give a number from 1 to {protocol.MOST_EPISODES:,}")
    if not 0 < timeout < float("inf"):
        raise ValueError(f"timeout is {timeout:g}; give seconds > 0")
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ValueError(f"{folder} exists and is not empty; give another --output")
