"""Judges episodes: the ideal experimenter's values of their actions, each episode that comes again asked for once.

Several tasks are judged side by side, in processes of their own: to find out the worth of actions can take longer than
to take them.
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent import futures
import dataclasses
import functools
import itertools
import multiprocessing
from typing import Any

import numpy as np

from physexp.agents import processes
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import episodes, protocol, reference

_KEPT = 8192  # Judgements; of a finite question, the same episode comes often.
_WAIT_SECONDS = 0.2  # Between two looks at how far the judges are.
_counter: Any = None  # In a worker's process: counts the episodes that all workers have judged.


class Judge:
    """Judges episodes by their hidden properties and actions, from which a judgement follows."""

    def __init__(self, solution: ideal_base.Solution):
        """Takes the ideal experimenter."""
        self._solution = solution
        self._judged = functools.lru_cache(_KEPT)(self._judge)

    def __call__(self, episode: episodes.Episode) -> mistakes.Actions:
        """Returns the judgement of each action of an episode.

        Raises:
          ValueError: if it cannot be known.
        """
        return mistakes.actions(self.judgement(episode), episode.actions)

    def judgement(self, episode: episodes.Episode) -> ideal_base.Judgement:
        """Returns the beliefs that were possible in an episode, and the values of all actions.

        Raises:
          ValueError: if it cannot be known.
        """
        hidden = np.asarray(episode.hidden)
        return self._judged(hidden.dtype.str, hidden.shape, hidden.tobytes(), tuple(episode.actions.tolist()))

    def _judge(self, dtype: str, shape: tuple[int, ...], hidden: bytes, actions: tuple[int, ...]):
        taken = np.array(actions, np.int64)
        episode = episodes.Episode(np.frombuffer(hidden, dtype).reshape(shape), taken, np.zeros(len(taken)), [])
        return self._solution.judge(episode)


@dataclasses.dataclass(frozen=True)
class Judged:
    """The judgement of all episodes of a task.

    Attributes:
      actions: the judgements of the actions of each episode.
      ideal: means of the ideal experimenter over as many episodes; None if it cannot play.
    """

    actions: list[mistakes.Actions]
    ideal: reference.Reference | None


def judge(
    played: Mapping[protocol.Question, Sequence[episodes.Episode]], show: Callable[[int], None] = lambda done: None
) -> dict[str, Judged]:
    """Judges the episodes of tasks by their hidden properties and actions; leaves no process behind.

    Args:
      played: the episodes of each task.
      show: called with how many of them have been judged.

    Returns:
      The judgements by the tasks' names.

    Raises:
      BrokenExecutor: if a process was killed.
    """
    if len(played) == 1:
        ((asked, its),) = played.items()
        done = itertools.count(1)
        return {asked.name: _judged(asked, its, lambda: show(next(done)))}
    context, others = processes.spawning(), set(multiprocessing.active_children())
    counter = context.Value("q", 0)
    num_workers = min(processes.num_cores(), len(played))
    pool = futures.ProcessPoolExecutor(num_workers, context, initializer=_begin, initargs=(counter,))
    try:
        with processes.without_script(), processes.inherited_by_workers():
            begun = {asked.name: pool.submit(_judged_by_worker, asked.name, its) for asked, its in played.items()}
        while futures.wait(begun.values(), _WAIT_SECONDS).not_done:
            show(counter.get_obj().value)  # Without its lock, which a worker that was killed may hold.
        show(counter.get_obj().value)
        return {name: judged.result() for name, judged in begun.items()}
    except BaseException:
        for worker in set(multiprocessing.active_children()) - others:
            processes.kill(worker)
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _judged(asked: protocol.Question, played: Sequence[episodes.Episode], count: Callable[[], None]) -> Judged:
    """Judges episodes; calls `count` after each of them."""
    judge, found = Judge(protocol.ideal(asked)), []
    for episode in played:
        found.append(judge(episode))
        count()
    return Judged(found, reference.of(asked, len(played)))


def _begin(counter) -> None:
    """Begins a worker's process, which counts the episodes that it judges."""
    global _counter
    processes.begin()
    _counter = counter


def _judged_by_worker(name: str, played: Sequence[episodes.Episode]) -> Judged:
    """Judges episodes in a worker's process; a name, since a question is the same only within a process."""
    (asked,) = protocol.named([name])
    return _judged(asked, played, functools.partial(_count, _counter))


def _count(counter) -> None:
    with counter.get_lock():
        counter.value += 1
