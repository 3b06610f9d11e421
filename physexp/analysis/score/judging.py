"""What an ideal experimenter says of the actions of episodes, each that comes again asked once.

The tasks are judged in processes of their own while others are played: to find out what actions were worth can take
longer than to take them.
"""

from collections.abc import Sequence
from concurrent import futures
import dataclasses
import functools
import multiprocessing
import os

import numpy as np

from physexp.agents import processes
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import episodes, protocol, reference

_KEPT = 8192  # Judgements; of a finite question, the same episode comes often.


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
    """Judge tasks, one on each processor core; a context that leaves no process behind."""

    def __init__(self, num_tasks: int):
        """Prepares to judge so many tasks; a single one is judged in this process."""
        self._pool = None
        if num_tasks > 1:
            cores = len(os.sched_getaffinity(0))
            context = multiprocessing.get_context("spawn")
            self._pool = futures.ProcessPoolExecutor(min(cores, num_tasks), context, initializer=processes.begin)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)

    def begin(self, asked: protocol.Question, played: Sequence[episodes.Episode]) -> "futures.Future[Judged]":
        """Begins to judge the episodes of a task, by what is hidden and was done; returns what will be said."""
        if self._pool is not None:
            with processes.inherited_by_workers():
                return self._pool.submit(_judged, asked.name, played)
        done: futures.Future[Judged] = futures.Future()
        done.set_result(_judged(asked.name, played))
        return done


def _judged(name: str, played: Sequence[episodes.Episode]) -> Judged:
    """Judges episodes; a name, since a question is the same only within a process."""
    (asked,) = protocol.named([name])
    judge = Judge(protocol.ideal(asked))
    return Judged([judge(episode) for episode in played], reference.of(asked, len(played)))
