"""Verifies a score: plays the logged actions again and compares everything that follows from them."""

from collections.abc import Callable, Mapping, Sequence
import functools
import hashlib
import math
import os
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
from pyarrow import compute

import physexp
from physexp.analysis.data import provenance
from physexp.analysis.score import episodes, judging, log, protocol, reference, scoring

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
    questions = protocol.named(written["protocol"]["tasks"])
    path = folder / log.FILE
    _check_order(path, found, [asked.name for asked in questions])
    columns = {asked.name: log.of_task(found, asked) for asked in questions}
    counts = [int((columns[asked.name]["step"] == 0).sum()) for asked in questions]
    _check_counts(folder, written, questions, counts)
    done = 0
    for asked in questions:
        environment, judge = protocol.load(asked), judging.Judge(protocol.ideal(asked))
        for number, logged in enumerate(log.split(columns[asked.name])):
            place = f"{path}: {asked.name}, episode {number}"
            try:
                episode = episodes.replay(environment, logged["action"].tolist(), number)
            except ValueError as error:
                raise ValueError(f"{place}: {error}") from None
            _compare(place, logged, log.rows(asked, protocol.ENVIRONMENT_SEED, number, episode, judge(episode)))
            done += 1
            show(done)
        environment.close()
    ideals = {asked.name: reference.of(asked, count) for asked, count in zip(questions, counts, strict=True) if count}
    again = scoring.metrics(found, questions, ideals)
    _compare_metrics(folder / scoring.FILE, {name: written[name] for name in again}, again)
    return {"episodes": done, "actions": len(found), "target": written["target"], "score": written["whole"]["score"]}


def verify_once(folder: Path) -> None:
    """Verifies a folder, unless this user has verified the same files with the same sources before.

    An empty file in `~/.cache/physexp/verified` (or below `$XDG_CACHE_HOME`) stands for verified files. It lies outside
    the results, so that it cannot come with a row.

    Raises:
      OSError, ValueError: as `verify`.
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


def _check_order(path: Path, found: pyarrow.Table, wanted: Sequence[str]) -> None:
    """Refuses rows of other tasks, and tasks in another order."""
    names = compute.binary_join_element_wise(found["domain"], found["task"], "/").combine_chunks()
    runs = compute.run_end_encode(names)
    starts = [0, *runs.run_ends.to_pylist()]
    for start, its, name in zip(starts, runs.values, [*wanted, "no further task"], strict=False):
        if its.as_py() != name:
            raise ValueError(f"{path}: row {start} is of {its}, where {name} is expected; put back what was played")


def _check_counts(
    folder: Path, written: Mapping[str, Any], questions: Sequence[protocol.Question], counts: Sequence[int]
) -> None:
    """Refuses another number of episodes than the score declares; after an early end, the last ones may be missing."""
    asked_for = written["protocol"]["episodes"]
    if written["protocol"]["seed"] != protocol.SEED:
        raise ValueError(f"{folder / scoring.FILE}: seed is {written['protocol']['seed']} instead of {protocol.SEED}")
    reached = max((number for number, count in enumerate(counts) if count), default=0)
    for number, (asked, count) in enumerate(zip(questions, counts, strict=True)):
        may_be_less = not written["complete"] and number >= reached
        if count > asked_for or (count < asked_for and not may_be_less):
            raise ValueError(f"{folder / log.FILE}: {asked.name} has {count} episodes instead of {asked_for}")


def _compare(place: str, logged: Mapping[str, np.ndarray], again: Mapping[str, np.ndarray]) -> None:
    """Refuses rows that differ from those of playing again."""
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
    """Refuses metrics that do not follow from the log."""
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
