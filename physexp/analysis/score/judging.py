"""Evaluates actions against the ideal experimenter; episodes that come again are evaluated once.

Tasks are judged side by side, in processes of their own: the search for values can take longer than the play.
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent import futures
import dataclasses
import multiprocessing

from physexp.agents import processes
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.ideal import mistakes
from physexp.analysis.score import episodes, protocol, scores

_CACHED = 8192  # Judgements.


class Judge:
    """Judges episodes by their hidden properties and actions."""

    def __init__(self, solution: ideal_base.Solution):
        self._solution = solution
        self._cache: dict[tuple[bytes, bytes], ideal_base.Judgement] = {}

    def __call__(self, episode: episodes.Episode) -> mistakes.Actions:
        """Returns the judgement of each action of an episode; raises ValueError if it cannot be known."""
        return mistakes.actions(self.judgement(episode), episode.actions)

    def judgement(self, episode: episodes.Episode) -> ideal_base.Judgement:
        """Returns the beliefs in an episode and the values of all actions; raises ValueError if they are unknown."""
        key = episode.hidden.tobytes(), episode.actions.tobytes()
        if key not in self._cache:
            if len(self._cache) == _CACHED:
                self._cache.clear()
            self._cache[key] = self._solution.judge(episode)
        return self._cache[key]


@dataclasses.dataclass(frozen=True)
class Judged:
    """The judgement of all episodes of a task.

    Attributes:
      actions: the judgements of the actions of each episode.
      ideal: statistics of the ideal experimenter over the same number of episodes; None if it cannot play.
    """

    actions: list[mistakes.Actions]
    ideal: scores.Reference | None


def judge(
    played: Mapping[protocol.Question, Sequence[episodes.Episode]], show: Callable[[int], None] = lambda done: None
) -> dict[str, Judged]:
    """Judges the episodes of tasks; leaves no process behind.

    Args:
      played: the episodes of each task; a single task is judged in this process.
      show: called with the number of judged episodes, after each one of a single task, or else after each task.

    Returns:
      The judgements by the tasks' names.

    Raises:
      BrokenExecutor: if a process was killed.
    """
    if len(played) == 1:
        ((question, its),) = played.items()
        return {question.name: _judged(question, its, show)}
    context, others = processes.spawning(), set(multiprocessing.active_children())
    pool = futures.ProcessPoolExecutor(min(processes.num_cores(), len(played)), context, initializer=processes.begin)
    try:
        with processes.without_script(), processes.inherited_by_workers():
            begun = {pool.submit(_judged_by_worker, question.name, its): len(its) for question, its in played.items()}
        done = 0
        for future in futures.as_completed(begun):
            future.result()
            done += begun[future]
            show(done)
        return {question.name: future.result() for question, future in zip(played, begun, strict=True)}
    except BaseException:
        for worker in set(multiprocessing.active_children()) - others:
            processes.kill(worker)
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _judged(question: protocol.Question, played: Sequence[episodes.Episode], show: Callable[[int], None]) -> Judged:
    judge, found = Judge(protocol.ideal(question)), []
    for episode in played:
        found.append(judge(episode))
        show(len(found))
    return Judged(found, scores.reference(question, len(played)))


def _judged_by_worker(name: str, played: Sequence[episodes.Episode]) -> Judged:
    (question,) = protocol.named([name])  # A question equals itself alone, within one process.
    return _judged(question, played, lambda done: None)
