"""Plays a target and writes whole trajectories: tables of steps, data sets of Minari, and conversations in words."""

from collections.abc import Callable, Sequence
import itertools
from pathlib import Path
import shutil
from typing import Any

import numpy as np

from physexp import extras
from physexp.analysis.data import episodes, provenance, tables
from physexp.analysis.score import conversations, instances, judging, log, playing, protocol, scoring, steps, targets

FILE = "export.json"
TABLE = "steps.parquet"
"""The folder of a task's tables."""

MINARI = "minari"
"""The folder among the exported files for `MINARI_DATASETS_PATH`."""

WORDS = "words"
"""The folder of conversations, with a file for each task."""

SEED = 3_000_003  # Of the environments, apart from those of training, of evaluation and of the score.
_MAX_EPISODES = 100_000  # Of each task.
_ROWS = 2**12  # Of a part, but for the last; they are held in memory.


def export(
    target: targets.Target,
    questions: Sequence[protocol.Question],
    num_episodes: int,
    folder: Path,
    *,
    seed: int = SEED,
    timeout: float = 60.0,
    as_minari: bool = False,
    in_words: bool = False,
    show: Callable[[int], None] = lambda done: None,
) -> dict[str, Any]:
    """Plays episodes of some tasks and writes them; returns the content of `export.json`.

    Episodes are kept as they end. After an interruption the same call goes on with the others; if an agent fails, the
    episodes until then are written, too.

    Args:
      target, questions, num_episodes, folder, timeout: as for `scoring.score`, as the errors are.
      seed: of the environments; not the score's.
      as_minari: write a data set of Minari for each task, too; raises MissingExtraError if it is not installed.
      in_words: write the conversations of each task, too; raises ValueError for a task with images.
      show: called with the number of episodes that have been played.
    """
    if as_minari:
        extras.require("minari")
    scoring.check(num_episodes, _MAX_EPISODES, timeout)
    if seed == protocol.SEED:
        raise ValueError(f"seed is {seed}, whose episodes are scored; give another one")
    minari_name = targets.file_name(target.name) if as_minari else None
    writers = {question: _Writer(folder, question, minari_name) for question in questions}
    if in_words:
        for question, writer in writers.items():
            writer.words = conversations.Writer(folder / WORDS / f"{question.file_name}.jsonl", question, seed)
    names = [question.name for question in questions]
    facts = {"target": target.name, "greedy": target.greedy, "seed": seed, "episodes": num_episodes}
    facts["agent"] = target.describe(questions)
    defining = {**facts, "tasks": names, "versions": provenance.versions()}
    with playing.session(folder, target, timeout, defining) as session:
        for name in (MINARI, WORDS):
            shutil.rmtree(folder / name, ignore_errors=True)  # Of an interrupted session.
        played = session.play(questions, num_episodes, instances.Public(seed))
        for question, its in itertools.groupby(played, lambda one: one[0]):
            for _, episode in its:
                writers[question].add(episode)
                show(session.num_played)
            writers[question].write()
        tasks = {question.name: described for question, one in writers.items() if (described := one.facts())}
        return session.write(FILE, facts, {"tasks": tasks})


class _Writer:
    """Writes the episodes of a task, part by part.

    Attributes:
      question: the task.
      words: writes conversations, too; None if none are wanted.
    """

    def __init__(self, folder: Path, question: protocol.Question, minari_name: str | None):
        self.question = question
        self._folder = folder / question.file_name / TABLE
        self._schema = steps.schema(question)
        self._judge = judging.Judge(question) if protocol.is_judged(question) else None
        self._minari_folder, self._minari_name = folder / MINARI, minari_name
        self._data_set: Any = None
        self.words: conversations.Writer | None = None
        self._pending: list[episodes.Episode] = []
        self._num_pending = self._num_parts = 0
        self._played: list[tuple[int, float, float]] = []  # Actions, the share of right answers, and the return.

    def add(self, episode: episodes.Episode) -> None:
        """Adds the next episode."""
        count = len(episode.actions)
        returned = float(self.question.discount ** np.arange(count) @ episode.rewards)
        num_questions = self.question.num_questions
        right = float((episode.rewards.sum() + num_questions) // 2) / num_questions  # Missing answers cost 1 each, too.
        self._played.append((count, right, returned))
        self._pending.append(episode)
        self._num_pending += count
        if self._num_pending >= _ROWS:
            self.write()

    def write(self) -> None:
        """Writes the pending episodes as a part."""
        if not self._pending:
            return
        judged = [self._judge(one.hidden, one.actions) if self._judge else None for one in self._pending]
        rows = [steps.rows(self.question, *one) for one in zip(self._pending, judged, strict=True)]
        if not self._num_parts:
            shutil.rmtree(self._folder, ignore_errors=True)  # Of an interrupted session.
            self._folder.mkdir(parents=True)
        path = self._folder / f"part-{self._num_parts:05d}.parquet"
        tables.write(path, log.table(self._schema, rows), compression="zstd")
        if self._minari_name is not None:
            from physexp.analysis.score import data_set

            self._data_set = self._data_set or data_set.create(self._minari_folder, self.question, self._minari_name)
            data_set.add(self._data_set, self.question, self._pending, judged)
        if self.words:
            self.words.add(zip(self._pending, judged, strict=True))
        self._pending, self._num_pending = [], 0
        self._num_parts += 1

    def facts(self) -> dict[str, Any]:
        """Returns the task's question, the meanings of its columns, and means of its episodes; nothing without any."""
        if not self._played:
            return {}
        question, count = self.question, len(self._played)
        lengths, shares, returns = zip(*self._played, strict=True)
        names = (
            "options",
            "question",
            "discount",
            "num_questions",
            "step_limit",
            "num_interactions",
            "action_names",
            "label_names",
        )
        return {
            "episodes": count,
            "steps": sum(lengths),
            "success_rate": sum(shares) / count,
            "mean_return": sum(returns) / count,
            "judged": self._judge is not None,
            **{name: getattr(question, name) for name in names},
            "observations": {
                name: {"shape": list(spec.shape), "dtype": spec.dtype.name}
                for name, spec in question.observation_spec.items()
            },
        }
