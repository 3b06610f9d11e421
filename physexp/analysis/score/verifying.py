"""Verifies a score: plays the logged actions again and compares everything that follows from them."""

from collections.abc import Callable, Mapping, Sequence
import functools
import hashlib
import math
import os
from pathlib import Path
from typing import Any

import numpy as np

import physexp
from physexp.analysis.data import provenance
from physexp.analysis.score import episodes, judging, log, protocol, scores, scoring

_TOLERANCE = 1e-9  # Of floating-point numbers, on any machine.


def verify(folder: Path, show: Callable[[int], None] = lambda done: None) -> dict[str, Any]:
    """Plays the log of a folder again; returns the numbers of episodes and actions, the target and the score.

    Args:
      folder: a folder that `scoring.score` has written.
      show: called with the number of episodes that have been played.

    Raises:
      OSError: if a file is missing.
      ValueError: if anything differs; the line names it.
    """
    written, found = scoring.read(folder), log.read(folder)
    path = folder / log.FILE
    if written["protocol"]["seed"] != protocol.SEED:
        raise ValueError(f"{folder / scoring.FILE}: seed is {written['protocol']['seed']} instead of {protocol.SEED}")
    logged = log.split(log.as_columns(found))
    questions = protocol.named(written["protocol"]["tasks"])
    counts = _counts(path, len(logged), written, len(questions))
    left = enumerate(logged, 1)
    for question, count in zip(questions, counts, strict=True):
        environment, judge = protocol.load(question), judging.Judge(protocol.ideal(question))
        for number, (done, columns) in zip(range(count), left, strict=False):
            place = f"{path}: {question.name}, episode {number}"
            try:
                episode = episodes.replay(environment, columns["action"].tolist(), number)
            except ValueError as error:
                raise ValueError(f"{place}: {error}") from None
            judged = log.judged(question, episode.actions, judge(episode))
            _compare(place, columns, {**log.played(question, number, episode), **judged})
            show(done)
        environment.close()
    ideals = {
        question.name: scores.reference(question, count)
        for question, count in zip(questions, counts, strict=True)
        if count
    }
    again = scores.summary(scores.of_log(found, questions, ideals))
    _compare_metrics(folder / scoring.FILE, {name: written[name] for name in again}, again)
    return {
        "episodes": len(logged),
        "actions": len(found),
        "target": written["target"],
        "score": written["whole"]["score"],
    }


def verify_once(folder: Path) -> None:
    """Verifies a folder, unless this user has verified the same files with the same sources before.

    An empty file in `~/.cache/physexp/verified` (or below `$XDG_CACHE_HOME`) stands for verified files. It lies outside
    the results, so that it cannot come with a row.
    """
    known = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "physexp" / "verified"
    known.mkdir(parents=True, exist_ok=True)
    mark = known / _digest([*_sources(), *((folder / name).read_bytes() for name in (scoring.FILE, log.FILE))])
    if not mark.exists():
        verify(folder)
        mark.touch()


@functools.cache
def _sources() -> list[bytes]:
    """Returns all that decides whether a folder is verified: the package's sources and the versions."""
    paths = sorted(Path(physexp.__file__).parent.rglob("*.py"))
    return [repr(provenance.versions()).encode(), *(path.read_bytes() for path in paths)]


def _digest(parts: Sequence[bytes]) -> str:
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


def _counts(path: Path, num_episodes: int, written: Mapping[str, Any], num_tasks: int) -> list[int]:
    """Returns the number of episodes of each task; after an early end, the last ones are missing."""
    each = written["protocol"]["episodes"]
    expected = num_tasks * each
    if not 0 < num_episodes <= expected or (num_episodes < expected and written["complete"]):
        raise ValueError(f"{path} has {num_episodes} episodes instead of {expected}")
    return [min(each, max(0, num_episodes - task * each)) for task in range(num_tasks)]


def _compare(place: str, logged: Mapping[str, np.ndarray], again: Mapping[str, np.ndarray]) -> None:
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


def _compare_metrics(path: Path, written: Any, again: Mapping[str, Any], place: str = "") -> None:
    if not isinstance(written, dict) or set(written) - set(again):
        raise ValueError(f"{path}: {place or 'it '}has other metrics than {', '.join(again)}; score again, elsewhere")
    for name, ours in again.items():
        theirs = written.get(name)
        if isinstance(ours, dict):
            _compare_metrics(path, theirs, ours, f"{place}{name}, ")
        elif not _are_close(theirs, ours):
            raise ValueError(f"{path}: {place}{name} is {theirs}, and {ours} by the log; score again, elsewhere")


def _are_close(theirs: Any, ours: Any) -> bool:
    if isinstance(ours, list):
        return isinstance(theirs, list) and len(theirs) == len(ours) and all(map(_are_close, theirs, ours))
    if ours is None or isinstance(theirs, bool) or not isinstance(theirs, (int, float)):
        return theirs is None and ours is None
    return math.isclose(theirs, ours, rel_tol=0, abs_tol=_TOLERANCE)
