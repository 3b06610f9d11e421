"""Scores a target: plays the protocol, judges the episodes, and writes both into a folder."""

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
import dataclasses
import json
from pathlib import Path
import time
import types
from typing import Any

import pyarrow

from physexp import checks
from physexp.agents import files
from physexp.analysis.data import provenance
from physexp.analysis.score import episodes, judging, log, player, playing, protocol, reference, scores, targets

FILE = "score.json"
_KINDS = {
    "target": str,
    "greedy": bool,
    "complete": bool,
    "problem": str,
    "seconds": int | float,
    "commit": str,
    **dict.fromkeys(("versions", "agent", "protocol", "tasks", "domains", "whole"), dict),
}
_KINDS_OF_AGENT = {
    **dict.fromkeys(("algorithm", "command", "commit"), str | None),
    **dict.fromkeys(("frames", "seed"), int | None),
    "seconds": int | float | None,
    "agents": dict | None,
}
_MOST_SECONDS = 1e6  # Of a call; the system's own limit is little larger.


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
    finish: Callable[[Path], None] = lambda folder: None,
) -> dict[str, Any]:
    """Plays the protocol with a target, judges its actions and writes both; returns the content of `score.json`.

    Episodes are kept as they end. After an interruption the same call goes on with the others; if the actor fails, the
    episodes until then are judged and written, too.

    Args:
      target, greedy: as for `targets.find`.
      questions: the tasks.
      num_episodes: of each of them.
      folder: where everything goes; it is made, is empty, or holds some of these very episodes.
      timeout: for each call of a user's function, s.
      made: further facts of how the target was made: `algorithm`, `frames`, `seconds`.
      show: called with how many episodes are done; one that has been played, but not been judged, counts half.
      finish: called with the folder once the score is written; until it returns, the folder is not complete.

    Raises:
      OSError: if it cannot be written.
      player.PlayerError: if the actor fails.
      ValueError: if the folder holds something else, no ideal experimenter is known, or a number makes no sense.
    """
    check(num_episodes, protocol.MOST_EPISODES, timeout)
    for asked in questions:
        protocol.ideal(asked)  # Refuses a task without one before anything is played.
    found = targets.find(target, greedy)
    names = [asked.name for asked in questions]
    asked_for = {"seed": protocol.SEED, "episodes": num_episodes, "tasks": names}
    facts = {"version": protocol.VERSION, "target": target, "greedy": greedy, "protocol": asked_for}
    agent, begun = found.facts(names), time.monotonic()
    of_all = {**facts, "agent": agent, "versions": provenance.versions()}
    with playing.session(folder, found, timeout, of_all) as session:
        rows, played, problem = _play(session, questions, num_episodes, lambda: show(session.num_played // 2))
        if played:
            judged = judging.judge(played, lambda done: show((session.num_played + done) // 2))
            facts |= {"agent": {**agent, **(made or {})}, "complete": not problem, "problem": problem}
            written = _write(folder, rows, judged, begun, facts)
        if problem:
            raise player.PlayerError(f"{problem}{session.kept_in(folder)}")
        finish(folder)
    return written


def _play(
    session: playing.Session,
    questions: Sequence[protocol.Question],
    num_episodes: int,
    show: Callable[[], None],
) -> tuple[dict[protocol.Question, list[dict[str, Any]]], dict[protocol.Question, list[episodes.Episode]], str]:
    """Plays tasks; returns the log's columns and the episodes by task, and the problem if the actor fails."""
    rows, played = defaultdict(list), defaultdict(list)
    try:
        for asked in questions:
            for number, episode in enumerate(session.play(asked, num_episodes, protocol.SEED)):
                rows[asked].append(log.played(asked, protocol.ENVIRONMENT_SEED, number, episode))
                played[asked].append(dataclasses.replace(episode, timesteps=[]))  # Images of many episodes are large.
                show()
    except player.PlayerError as error:
        return rows, played, str(error)
    return rows, played, ""


def _write(
    folder: Path,
    rows: Mapping[protocol.Question, Sequence[Mapping[str, Any]]],
    judged: Mapping[str, judging.Judged],
    begun: float,
    facts: Mapping[str, Any],
) -> dict[str, Any]:
    """Writes the log, first, and its figures beside facts; returns the latter two."""
    found = log.table(
        {**row, **log.said(asked, row["action"], actions)}
        for asked, its in rows.items()
        for row, actions in zip(its, judged[asked.name].actions, strict=True)
    )
    log.write(folder, found)
    ideals = {name: one.ideal for name, one in judged.items()}
    written = {**facts, **provenance.made_since(begun), **figures(found, list(rows), ideals)}
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
    """Returns the content of `score.json`, of this version of the protocol.

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
    _check_kinds(path, found, _KINDS)
    _check_kinds(path, found["protocol"], {"seed": int, "episodes": int, "tasks": list})
    if not all(isinstance(name, str) for name in found["protocol"]["tasks"]):
        raise ValueError(f"{path} is not what was written: tasks is {found['protocol']['tasks']!r}; score again")
    _check_kinds(path, found["agent"], _KINDS_OF_AGENT)
    for name, agent in (found["agent"].get("agents") or {}).items():
        _check_kinds(path, {name: agent}, {name: dict})
        _check_kinds(path, agent, _KINDS_OF_AGENT)
    return found


def _check_kinds(path: Path, fields: Mapping[str, Any], kinds: Mapping[str, Any]) -> None:
    """Refuses a field of another type: raises ValueError."""
    for name, kind in kinds.items():
        if not isinstance(fields.get(name), kind):
            raise ValueError(f"{path} is not what was written: {name} is {fields.get(name)!r}; score again")


def check(num_episodes: int, most: int, timeout: float) -> None:
    """Refuses numbers that make no sense: raises ValueError."""
    if not 1 <= num_episodes <= most:
        raise ValueError(f"episodes is {num_episodes}; give a number from 1 to {most:,}")
    checks.between("timeout", timeout, 0, _MOST_SECONDS, "s", without=0)
