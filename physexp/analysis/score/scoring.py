"""Scores a target: plays the protocol, judges what was played, and keeps both in a folder."""

from collections.abc import Callable, Mapping, Sequence
import json
from pathlib import Path
import time
from typing import Any

import pyarrow

from physexp.agents import files
from physexp.analysis.data import provenance
from physexp.analysis.score import judging, log, player, protocol, scores, targets

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

    Whole episodes that were played are kept, also where the actor fails or the user ends it.

    Args:
      target, greedy: as for `targets.maker`.
      questions: the tasks.
      num_episodes: of each of them.
      folder: where everything goes; it is made, or is empty.
      timeout: for each call of the actor, s.
      made: what else is to be said of how it was made: `algorithm`, `frames`, `seconds`.
      show: called with how many episodes have been played.

    Raises:
      OSError: if it cannot be written.
      player.PlayerError: if the actor fails.
      ValueError: if there is something in the folder, no ideal experimenter is known, or a number makes no sense.
    """
    check(num_episodes, timeout, folder)
    judges = [judging.Judge(protocol.ideal(asked)) for asked in questions]
    agent = {**targets.facts(target, [asked.name for asked in questions]), **(made or {})}
    folder.mkdir(parents=True, exist_ok=True)
    begun, played, problem = time.monotonic(), [], "it was ended early"
    try:
        with player.Player(target, greedy, timeout) as actor:
            for asked, judge in zip(questions, judges, strict=True):
                for number, episode in enumerate(actor.play(asked, num_episodes)):
                    played.append(log.rows(asked, protocol.ENVIRONMENT_SEED, number, episode, judge))
                    show(len(played))
        problem = ""
    except player.PlayerError as error:
        problem = str(error)
        kept = f"; the {len(played):,} episodes before are in {folder}" if played else ""
        raise player.PlayerError(f"{problem}{kept}") from None
    finally:
        if played:
            facts = {
                "version": protocol.VERSION,
                "target": target,
                "greedy": greedy,
                "complete": not problem,
                "problem": problem,
                "protocol": {
                    "seed": protocol.SEED,
                    "episodes": num_episodes,
                    "tasks": [asked.name for asked in questions],
                },
                "agent": agent,
                "seconds": round(time.monotonic() - begun, 1),
            }
            written = _write(folder, log.table(played), questions, facts)
    return written


def _write(
    folder: Path, found: pyarrow.Table, questions: Sequence[protocol.Question], facts: dict[str, Any]
) -> dict[str, Any]:
    """Writes the log, first, and its figures beside facts; returns the latter two."""
    log.write(folder, found)
    made_by = {"commit": provenance.commit(), "versions": provenance.versions()}
    written = {**facts, **made_by, **figures(found, questions)}
    files.write_atomically(folder / FILE, (json.dumps(written, indent=1) + "\n").encode())
    return written


def figures(found: pyarrow.Table, questions: Sequence[protocol.Question]) -> dict[str, Any]:
    """Returns the figures of a log, of those of the tasks that were played."""
    return scores.summary(played(found, questions))


def played(found: pyarrow.Table, questions: Sequence[protocol.Question]) -> list[scores.TaskScore]:
    """Returns the scores of those of the tasks that are in a log."""
    parts = [(asked, log.of_task(found, asked)) for asked in questions]
    return [scores.of_task(asked, columns) for asked, columns in parts if len(columns["step"])]


def read(folder: Path) -> dict[str, Any]:
    """Returns what `score.json` holds, of this version of the protocol.

    Raises:
      OSError: if there is none.
      ValueError: if it is not what was written.
    """
    path = folder / FILE
    found = files.read_json(path)
    version = found.get("version") if isinstance(found, dict) else None
    if version != protocol.VERSION:
        raise ValueError(f"{path} is of protocol {version!r}; this version of physexp plays {protocol.VERSION}")
    dicts = dict.fromkeys(("agent", "protocol", "tasks", "domains", "whole"), dict)
    kinds = {"target": str, "complete": bool, **dicts}
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
