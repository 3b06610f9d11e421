"""What an ideal experimenter says of the actions of episodes, each that comes again asked once.

Several tasks are judged in processes of their own, while others are played: to find out what actions were worth can
take longer than to take them. A single one is judged in a thread, which is there at once.
"""

from collections.abc import Callable, Sequence
from concurrent import futures
import dataclasses
import functools
import multiprocessing
from typing import Any

import numpy as np

from physexp.agents import processes
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import episodes, protocol, reference

_KEPT = 8192  # Judgements; of a finite question, the same episode comes often.
_WAIT_SECONDS = 0.2  # Between two looks at how far the judges are.
_counter: Any = None  # In a worker's process, of the episodes that all workers have judged.


class Judge:
    """Judges episodes by what is hidden and what was done, from which a judgement follows."""

    def __init__(self, solution: ideal_base.Solution):
        """Takes the ideal experimenter."""
        self._solution = solution
        self._judged = functools.lru_cache(_KEPT)(self._judge)

    def __call__(self, episode: episodes.Episode) -> mistakes.Actions:
        """Returns what is said of the actions of an episode.

        Raises:
          ValueError: if it cannot be known.
        """
        return mistakes.actions(self.judgement(episode), episode.actions)

    def judgement(self, episode: episodes.Episode) -> ideal_base.Judgement:
        """Returns what could be known in an episode, and what its actions were worth.

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
    """What is said of all episodes of a task.

    Attributes:
      actions: of each episode.
      ideal: how the ideal experimenter fares in as many; None where it cannot play.
    """

    actions: list[mistakes.Actions]
    ideal: reference.Reference | None


class Judges:
    """Judge tasks, one on each processor core; a context that leaves no process and no thread behind."""

    def __init__(self, num_tasks: int, show: Callable[[], None] = lambda: None):
        """Prepares to judge.

        Args:
          num_tasks: how many tasks.
          show: called again and again while episodes are judged that others wait for.
        """
        self._show, self._are_needed = show, True
        self._workers: set[multiprocessing.process.BaseProcess] = set()
        context = multiprocessing.get_context("spawn")
        self._counter = context.Value("q", 0)
        self._pool: futures.Executor = futures.ThreadPoolExecutor(1)
        if num_tasks > 1:
            self._pool = futures.ProcessPoolExecutor(
                min(processes.num_cores(), num_tasks), context, initializer=_begin, initargs=(self._counter,)
            )

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind is not None:  # Nobody waits any more for what is being judged.
            self._are_needed = False
            for worker in self._workers:
                processes.kill(worker)
        self._pool.shutdown(cancel_futures=True)

    @property
    def count(self) -> int:
        """How many episodes have been judged so far."""
        return self._counter.get_obj().value  # Without its lock, which a worker that was killed may hold.

    def wait(self, judged: "Sequence[futures.Future[Judged]]") -> None:
        """Waits until tasks are judged."""
        while futures.wait(judged, _WAIT_SECONDS).not_done:
            self._show()
        self._show()

    def begin(self, asked: protocol.Question, played: Sequence[episodes.Episode]) -> "futures.Future[Judged]":
        """Begins to judge the episodes of a task, by what is hidden and was done; returns what will be said."""
        if isinstance(self._pool, futures.ThreadPoolExecutor):
            return self._pool.submit(_judged, asked, played, self._count_if_needed)
        others = set(multiprocessing.active_children())
        with processes.inherited_by_workers():
            judged = self._pool.submit(_judged_by_worker, asked.name, played)
        self._workers |= set(multiprocessing.active_children()) - others
        return judged

    def judged(
        self, asked: protocol.Question, played: Sequence[episodes.Episode], begun: "futures.Future[Judged]"
    ) -> Judged:
        """Returns what is said of a task that `begin` was given; judges it anew where a process was killed over it."""
        try:
            return begun.result()
        except futures.BrokenExecutor:
            return _judged(asked, played, self._show)

    def _count_if_needed(self) -> None:
        """Counts an episode; ends the thread that judges where nobody waits for it any more."""
        if not self._are_needed:
            raise futures.CancelledError
        _count(self._counter)


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
