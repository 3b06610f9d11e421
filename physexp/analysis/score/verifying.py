"""Verifies a score: plays the logged actions again and compares everything that follows from them."""

from collections import defaultdict
from collections.abc import Callable, Mapping
import contextlib
import functools
import hashlib
import math
import os
from pathlib import Path
from typing import Any

import numpy as np

import physexp
from physexp.agents import environment_loop
from physexp.analysis.data import episodes, provenance, tables
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import beliefs, instances, judging, log, playing, protocol, scores, scoring

_TOLERANCE = 1e-9  # Of floating-point numbers, on any machine.


def verify(
    folder: Path, show: Callable[[int], None] = lambda done: None, private: Path | None = None
) -> dict[str, Any]:
    """Plays the log of a folder again; returns its numbers of episodes and actions, target, scores and instances.

    `show` is called with the number of episodes that have been played. Private instances are those of the file
    `private`, by default of `instances.json` in the folder. Raises OSError if a file is missing, and ValueError if
    anything differs; the line names it.
    """
    written, found = scoring.read(folder), log.read(folder)
    path, each = folder / log.FILE, written["protocol"]["episodes"]
    which = _instances(folder, written, private)
    logged, questions = log.split(log.as_columns(found)), protocol.named(written["protocol"]["tasks"])
    expected = each * len(questions)
    if not 0 < len(logged) <= expected or (len(logged) < expected and written["complete"]):
        raise ValueError(f"{path} has {len(logged)} episodes instead of {expected}")
    ideals, stated = {}, beliefs.read(folder, questions, each)
    answers: dict[protocol.Question, list[np.ndarray]] = defaultdict(list)
    for first, question in zip(range(0, len(logged), each), questions, strict=False):  # The last ones may be missing.
        its, judge = logged[first : first + each], judging.Judge(question)
        with contextlib.closing(protocol.load(question)) as environment:
            for index, columns in enumerate(its):
                place = f"{path}: {question.name}, episode {index}"
                repeat, seed = environment_loop.Repeat(columns["action"].tolist()), which.seed_of(question.name, index)
                try:
                    episode = episodes.play(environment, repeat, index, seed)
                except ValueError as error:
                    raise ValueError(f"{place}: {error}") from None
                judged = mistakes.actions(judge(episode.hidden, episode.actions), episode.actions)
                again = {**log.played(question, episode), **log.judged(question, episode.actions, judged)}
                _compare(place, columns, again)
                if stated:
                    answers[question].append(beliefs.judged(question, episode, stated[question][index]))
                show(first + index + 1)
        ideals[question] = scores.reference(question, len(its), which)
    version = written["version"]
    scored = scores.of_log(found, ideals, version, written["protocol"]["agents"])
    metrics = scores.summary(beliefs.added(scored, answers) if stated else scored, version)
    for names, theirs, ours in playing.differences({name: written[name] for name in metrics}, metrics, _are_close):
        raise ValueError(
            f"{folder / scoring.FILE}: {', '.join(names)} is {theirs}, and {ours} by the log; score again, elsewhere"
        )
    return {
        "episodes": len(logged),
        "actions": len(found),
        "target": written["target"],
        "scores": {name: figures["score"] for name, figures in scores.headlines(written).items()},
        **which.facts,
    }


def _instances(folder: Path, written: Mapping[str, Any], private: Path | None) -> instances.Instances:
    """Returns the instances that a score names; raises ValueError if they are others than those at hand."""
    extent = written["protocol"]
    which: instances.Instances = protocol.PUBLIC
    if "key_hash" in extent:
        private = private or folder / instances.FILE
        if not private.exists():
            raise ValueError(
                f"{folder} is of private instances, whose key has the hash {extent['key_hash']}; put their file, which "
                f"its author publishes when the scores are made, there as {instances.FILE}, or give --instances FILE"
            )
        which = instances.read(private, written["version"])
    elif private is not None:
        raise ValueError(f"{folder} is of the public instances; leave out --instances {private}")
    for name, value in which.facts.items():
        if extent[name] != value:
            raise ValueError(
                f"{folder / scoring.FILE}: {name} is {extent[name]} instead of {value}, as of the instances at "
                "hand; give those of the score"
            )
    return which


def verify_once(folder: Path) -> None:
    """Verifies a folder, unless this user has verified the same files with the same sources before.

    An empty file in `~/.cache/physexp/verified` (or below `$XDG_CACHE_HOME`) stands for verified files. It lies outside
    the results, so that it cannot come with a row.
    """
    known = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "physexp" / "verified"
    known.mkdir(parents=True, exist_ok=True)
    paths = [path for name in (scoring.FILE, log.FILE, beliefs.FILE) if (path := folder / name).exists()]
    for path in paths:
        tables.check(path, tables.MAX_TABLE)
    parts = [_sources(), *(path.read_bytes() for path in paths)]
    mark = known / hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()
    if not mark.exists():
        verify(folder)
        mark.touch()


@functools.cache
def _sources() -> bytes:
    """Returns all that decides whether a folder is verified: the package's sources and the versions."""
    paths = sorted(Path(physexp.__file__).parent.rglob("*.py"))
    return repr((provenance.versions(), [path.read_bytes() for path in paths])).encode()


def _compare(place: str, logged: Mapping[str, np.ndarray], again: Mapping[str, np.ndarray]) -> None:
    """Raises ValueError if a value of an episode differs; the line names the place, the step and the column."""
    for name in log.SCHEMA.names:
        theirs, ours = logged[name], again[name]
        is_close = name in log.JUDGED.names and ours.dtype.kind == "f"
        differs = ~np.isclose(theirs, ours, rtol=0, atol=_TOLERANCE) if is_close else theirs != ours
        if differs.any():
            step = int(differs.argmax())
            raise ValueError(
                f"{place}, step {step}: {name} is {theirs[step]}, and {ours[step]} when it is played again; the log "
                "was changed, or another version made it"
            )


def _are_close(theirs: Any, ours: Any) -> bool:
    if isinstance(ours, list):
        return isinstance(theirs, list) and len(theirs) == len(ours) and all(map(_are_close, theirs, ours))
    if ours is None or isinstance(theirs, bool) or not isinstance(theirs, (int, float)):
        return theirs is None and ours is None
    return math.isclose(theirs, ours, rel_tol=0, abs_tol=_TOLERANCE)
