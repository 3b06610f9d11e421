"""Plays a target and writes whole trajectories, as tables of steps and as data sets of Minari."""

from collections.abc import Callable, Sequence
import itertools
from pathlib import Path
import shutil
from typing import Any

import numpy as np

from physexp import extras, suite
from physexp.analysis.data import provenance, tables
from physexp.analysis.score import episodes, playing, protocol, scoring, steps, targets

FILE = "export.json"
TABLE = "steps.parquet"
"""The folder of a task's tables."""

MINARI = "minari"
"""The folder among the exported files for `MINARI_DATASETS_PATH`."""

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
    show: Callable[[int], None] = lambda done: None,
) -> dict[str, Any]:
    """Plays episodes of some tasks and writes them; returns the content of `export.json`.

    Episodes are kept as they end. After an interruption the same call goes on with the others; if an agent fails, the
    episodes until then are written, too.

    Args:
      target, questions, num_episodes, folder, timeout: as for `scoring.score`.
      seed: of the environments; not the score's.
      as_minari: write a data set of Minari for each task, too.
      show: called with the number of episodes that have been played.

    Raises:
      MissingExtraError: if Minari is wanted and not installed.
      OSError, player.PlayerError, ValueError: as `scoring.score`.
    """
    if as_minari:
        extras.require("minari")
    scoring.check(num_episodes, _MAX_EPISODES, timeout)
    if seed == protocol.SEED:
        raise ValueError(f"seed is {seed}, whose episodes are scored; give another one")
    minari_name = targets.file_name(target.name) if as_minari else None
    writers = {question: _Writer(folder, question, seed, minari_name) for question in questions}
    names = [question.name for question in questions]
    facts = {"target": target.name, "greedy": target.greedy, "seed": seed, "episodes": num_episodes}
    facts["agent"] = target.describe(names)
    defining = {**facts, "tasks": names, "versions": provenance.versions()}
    with playing.session(folder, target, timeout, defining) as session:
        shutil.rmtree(folder / MINARI, ignore_errors=True)  # Of an interrupted session.
        for question, its in itertools.groupby(session.play(questions, num_episodes, seed), lambda one: one[0]):
            for _, episode in its:
                writers[question].add(episode)
                show(session.num_played)
            writers[question].write()
        tasks = {writer.question.name: writer.facts() for writer in writers.values() if writer.num_episodes}
        return session.write(FILE, facts, {"tasks": tasks})


class _Writer:
    """Writes the episodes of a task, part by part."""

    def __init__(self, folder: Path, question: protocol.Question, seed: int, minari_name: str | None):
        self.question, self.num_episodes = question, 0
        self._steps = steps.Steps(question, suite.environment_seed(seed, 0))
        self._folder = folder / f"{question.domain}-{question.task}" / TABLE
        self._pending: list[dict[str, np.ndarray]] = []
        self._num_pending, self._num_parts = 0, 0
        self._num_right, self._num_steps, self._return = 0, 0, 0.0
        self._minari_folder, self._minari_name = folder / MINARI, minari_name
        self._data_set: Any = None

    def add(self, episode: episodes.Episode) -> None:
        """Adds the next episode."""
        count = len(episode.actions)
        self._pending.append(self._steps.rows(self.num_episodes, episode))
        self._num_pending += count
        self.num_episodes += 1
        self._num_steps += count
        self._num_right += bool(episode.rewards[-1] > 0)
        self._return += float(self.question.discount ** np.arange(count) @ episode.rewards)
        if self._num_pending >= _ROWS:
            self.write()

    def write(self) -> None:
        """Writes the pending episodes as a part."""
        if not self._pending:
            return
        table = self._steps.table(self._pending)
        if not self._num_parts:
            shutil.rmtree(self._folder, ignore_errors=True)  # Of an interrupted session.
            self._folder.mkdir(parents=True)
        tables.write(self._folder / f"part-{self._num_parts:05d}.parquet", table, compression="zstd")
        self._pending, self._num_pending = [], 0
        self._num_parts += 1
        if self._minari_name is not None:
            from physexp.analysis.score import data_set

            self._data_set = self._data_set or data_set.DataSet(self._minari_folder, self._steps, self._minari_name)
            self._data_set.add(table)

    def facts(self) -> dict[str, Any]:
        """Returns the task's question, the meanings of its columns, and means of its episodes."""
        question = self.question
        names = ("question", "discount", "step_limit", "num_interactions", "action_names", "label_names")
        return {
            "episodes": self.num_episodes,
            "steps": self._num_steps,
            "success_rate": self._num_right / self.num_episodes,
            "mean_return": self._return / self.num_episodes,
            "judged": self._steps.is_judged,
            **{name: getattr(question, name) for name in names},
            "observations": {
                name: {"shape": list(spec.shape), "dtype": spec.dtype.name}
                for name, spec in question.observation_spec.items()
            },
        }
