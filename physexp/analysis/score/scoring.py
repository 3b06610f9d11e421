"""Scores a target: plays the protocol, judges the episodes, and writes both into a folder."""

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from physexp import checks
from physexp.agents import files
from physexp.analysis.data import provenance, tables
from physexp.analysis.score import beliefs, instances, judging, log, playing, protocol, scores, targets

FILE = "score.json"
_TRAINED = {
    **dict.fromkeys(("algorithm", "command", "commit"), str | None),
    **dict.fromkeys(("frames", "seed"), int | None),  # The first version has one seed.
    **dict.fromkeys(("seconds", "gamma"), int | float | None),
    "seeds": list | None,
    "answers_revealed": bool | None,
    "agents": dict | None,
    **dict.fromkeys(("player", "harness", "tools", "budget", "level"), str | None),  # Of the player of records.
    "digits": int | None,
    "told": dict | None,
}
_KINDS = {
    **dict.fromkeys(("target", "problem", "commit"), str),
    **dict.fromkeys(("greedy", "complete"), bool),
    "seconds": int | float,
    **dict.fromkeys(("protocol", "agent", "versions", "tasks"), dict),
}
"""The types of the fields of `score.json`, which may come from strangers."""
_OVER_TASKS = {
    protocol.FIRST_VERSION: dict.fromkeys(("domains", "whole"), dict),
    protocol.VERSION: {"tracks": dict},
}
"""The same of the fields that a version has for several tasks."""

_MAX_SECONDS = 1e6  # Of a call; the system's own limit is little larger.


def score(
    target: targets.Target,
    questions: Sequence[protocol.Question],
    num_episodes: int,
    folder: Path,
    *,
    which: instances.Instances = protocol.PUBLIC,
    timeout: float = 60.0,
    made: Mapping[str, Any] | None = None,
    show: Callable[[int], None] = lambda done: None,
    finish: Callable[[Path], None] = lambda folder: None,
) -> dict[str, Any]:
    """Plays the protocol with a target, judges its actions and writes both; returns the content of `score.json`.

    Episodes are kept as they end. After an interruption the same call goes on with the others; if an agent fails, the
    episodes until then are judged and written, too.

    Args:
      target: as `targets.find` returns it.
      questions: the tasks.
      num_episodes: of each of them.
      folder: for all files; it is made, is empty, or holds some of these very episodes.
      which: the instances that are played.
      timeout: for each call of a user's function, s.
      made: further facts of how the target was made: `algorithm`, `frames`, `seconds`.
      show: called with the number of episodes that are done; one that was played, but not yet judged, counts half.
      finish: called with the folder once the score is written; until it returns, the folder is not complete.

    Raises:
      OSError: if it cannot be written.
      player.PlayerError: if an agent fails.
      ValueError: if the folder holds something else, no ideal experimenter is known, or a number makes no sense.
    """
    check(num_episodes, protocol.MAX_EPISODES, timeout)
    if num_episodes < target.num_agents:
        raise ValueError(f"episodes is {num_episodes}; give at least {target.num_agents}, one for each agent of a task")
    for question in questions:
        protocol.ideal(question)  # Refuses a task without one before anything is played.
    names = [question.name for question in questions]
    extent = {**which.facts, "episodes": num_episodes, "tasks": names, "agents": target.num_agents}
    facts = {"version": protocol.VERSION, "target": target.name, "greedy": target.greedy, "protocol": extent}
    agent = target.describe(questions)
    defining = {**facts, "agent": agent, "versions": provenance.versions()}
    rows, moves, answers = defaultdict(list), defaultdict(list), defaultdict(list)
    with playing.session(folder, target, timeout, defining) as session:
        for question, episode in session.play(questions, num_episodes, which):
            rows[question].append(log.played(question, episode))
            moves[question].append((episode.hidden, episode.actions))  # Images of many episodes are large.
            if target.stated:
                stated = target.stated[question][episode.index]
                answers[question].append(beliefs.judged(question, episode, stated))
            show(session.num_played // 2)
        judged = judging.judge(moves, lambda done: show((session.num_played + done) // 2), which)
        found = log.table(
            log.SCHEMA,
            [
                {**columns, **log.judged(question, columns["action"], actions)}
                for question, its in rows.items()
                for columns, actions in zip(its, judged[question].actions, strict=True)
            ],
        )
        log.write(folder, found)
        ideals = {question: one.ideal for question, one in judged.items()}
        scored = scores.of_log(found, ideals, num_agents=target.num_agents)
        if target.stated:
            beliefs.write(folder, {question: target.stated[question] for question in rows})
            scored = beliefs.added(scored, answers)
        metrics = scores.summary(scored)
        written = session.write(FILE, {**facts, "agent": {**agent, **(made or {})}}, metrics)
        finish(folder)
    return written


def read(folder: Path) -> dict[str, Any]:
    """Returns the content of `score.json`, of this version of the protocol or the first one.

    Raises:
      OSError: if it cannot be read.
      ValueError: if there is none, or it is faulty.
    """
    path = folder / FILE
    if (folder / playing.FILE).exists() and not path.exists():
        raise ValueError(f"{folder} is not complete; the same `physexp score` goes on in it")
    if not path.exists():
        raise ValueError(f"{folder} holds no score ({FILE}); give a folder that `physexp score` has written")
    tables.check(path, tables.MAX_TEXT)
    found = files.read_json(path)
    version = found.get("version") if isinstance(found, dict) else None
    if version not in _OVER_TASKS:
        known = " and ".join(_OVER_TASKS)
        raise ValueError(f"{path} is of protocol {version!r}; this version of physexp reads {known}")
    _check_kinds(path, found, {**_KINDS, **_OVER_TASKS[version]})
    found["protocol"].setdefault("agents", 1)  # The first version has no rows of several.
    of_instances = {"key_hash": str} if "key_hash" in found["protocol"] else {"seed": int}
    _check_kinds(path, found["protocol"], {**of_instances, "episodes": int, "tasks": list, "agents": int})
    _check_kinds(path, found["agent"], _TRAINED)
    told = found["agent"].get("told") or {}
    _check_kinds(path, told, dict.fromkeys(told, int | float))
    members = found["agent"].get("agents") or {}
    _check_kinds(path, members, dict.fromkeys(members, dict))
    for member in members.values():
        _check_kinds(path, member, _TRAINED)
    if not all(isinstance(name, str) for name in found["protocol"]["tasks"]):
        raise ValueError(f"{path} is faulty: tasks is {found['protocol']['tasks']!r}; score again")
    return found


def _check_kinds(path: Path, fields: Mapping[str, Any], kinds: Mapping[str, Any]) -> None:
    """Refuses a field of another type."""
    for name, kind in kinds.items():
        if not isinstance(value := fields.get(name), kind):
            raise ValueError(f"{path} is faulty: {name} is {value!r}; score again")


def check(num_episodes: int, maximum: int, timeout: float) -> None:
    """Raises ValueError for numbers that make no sense."""
    if not 1 <= num_episodes <= maximum:
        raise ValueError(f"episodes is {num_episodes}; give a number from 1 to {maximum:,}")
    checks.within(0, _MAX_SECONDS, "s", without=0)("timeout", timeout)
