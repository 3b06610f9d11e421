"""Evaluates actions against the ideal experimenter; episodes that come again are evaluated once.

Tasks are judged side by side, in processes of their own: the search for values can take longer than the play.
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent import futures
import multiprocessing
from typing import NamedTuple

import numpy as np

from physexp.agents import processes
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import instances, protocol, scores

_CACHED = 8192  # Judgements.

Moves = tuple[np.ndarray, np.ndarray]
"""The hidden property of an episode, [...], and its T actions, int64 [T]."""


class Judged(NamedTuple):
    """The judgements of the actions of each episode of a task, and the ideal experimenter's play of as many."""

    actions: list[mistakes.Actions]
    ideal: scores.Reference | None


class Judge:
    """Judges episodes of a task by their hidden properties and actions."""

    def __init__(self, question: protocol.Question):
        self._solution = protocol.ideal(question)
        self._cache: dict[tuple[bytes, bytes], ideal_base.Judgement] = {}

    def __call__(self, hidden: np.ndarray, actions: np.ndarray) -> ideal_base.Judgement:
        """Returns the beliefs in an episode and the values of all actions; raises ValueError if they are unknown."""
        key = hidden.tobytes(), actions.tobytes()
        if key not in self._cache:
            if len(self._cache) == _CACHED:
                self._cache.clear()
            self._cache[key] = self._solution.judge(hidden, actions)
        return self._cache[key]


def judge(
    played: Mapping[protocol.Question, Sequence[Moves]],
    show: Callable[[int], None] = lambda done: None,
    which: instances.Instances = protocol.PUBLIC,
) -> dict[protocol.Question, Judged]:
    """Judges the episodes of tasks, of some instances; raises BrokenExecutor if a process was killed, and leaves none.

    `show` is called with the number of judged episodes: after each one of a single task, which is judged in this
    process, or else after each task.
    """
    if len(played) == 1:
        ((question, its),) = played.items()
        return {question: _judged(question, its, show, which)}
    context, others = processes.spawning(), set(multiprocessing.active_children())
    pool = futures.ProcessPoolExecutor(min(processes.num_cores(), len(played)), context, initializer=processes.begin)
    try:
        with processes.without_script(), processes.inherited_by_workers():
            begun = {
                pool.submit(_judged_by_worker, question.name, its, which): len(its) for question, its in played.items()
            }
        done = 0
        for future in futures.as_completed(begun):
            future.result()
            done += begun[future]
            show(done)
        return {question: future.result() for question, future in zip(played, begun, strict=True)}
    except BaseException:
        for worker in set(multiprocessing.active_children()) - others:
            processes.kill(worker)
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _judged(
    question: protocol.Question, played: Sequence[Moves], show: Callable[[int], None], which: instances.Instances
) -> Judged:
    judge, found = Judge(question), []
    for hidden, actions in played:
        found.append(mistakes.actions(judge(hidden, actions), actions))
        show(len(found))
    return Judged(found, scores.reference(question, len(played), which))


def _judged_by_worker(name: str, played: Sequence[Moves], which: instances.Instances) -> Judged:
    (question,) = protocol.named([name])  # A question equals itself alone, within one process.
    return _judged(question, played, lambda done: None, which)
