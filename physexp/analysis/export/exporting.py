"""Plays a target and writes whole trajectories, as tables of steps and as data sets of Minari."""

from collections.abc import Callable, Iterator, Sequence
import contextlib
import dataclasses
import functools
import json
from pathlib import Path
import time
from typing import Any

import numpy as np

from physexp import suite
from physexp.agents import files
from physexp.analysis.data import provenance, tables
from physexp.analysis.export import steps
from physexp.analysis.score import episodes, player, protocol, scoring, targets

FILE = "export.json"
TABLE = "steps.parquet"
"""The folder of a task's tables."""

SEED = 3_000_003  # Of the environments, apart from those of training, of evaluation and of the score.
_ROWS = 2**12  # Of a part, at least, if it is not the last: so much is held in memory.


def export(
    target: str,
    questions: Sequence[protocol.Question],
    num_episodes: int,
    folder: Path,
    *,
    seed: int = SEED,
    greedy: bool = False,
    timeout: float = 60.0,
    as_minari: bool = False,
    show: Callable[[int], None] = lambda done: None,
) -> dict[str, Any]:
    """Plays episodes of some tasks and writes them; returns what `export.json` holds.

    Whole episodes that were played are kept, also where the actor fails or the user ends it.

    Args:
      target, greedy: as for `targets.maker`.
      questions: the tasks.
      num_episodes: of each of them.
      folder: where everything goes; it is made, or is empty.
      seed: of the environments; not the score's.
      timeout: for each call of an actor of anybody's, s.
      as_minari: write a data set of Minari for each task, too.
      show: called with how many episodes have been played.

    Raises:
      MissingExtraError: if Minari is wanted and not installed.
      OSError: if it cannot be written.
      player.PlayerError: if the actor fails.
      ValueError: if there is something in the folder, or a number makes no sense.
    """
    scoring.check(num_episodes, timeout, folder)
    if seed == protocol.SEED:
        raise ValueError(f"seed is {seed}, whose episodes are scored; give another one")
    minari_name = targets.file_name(target) if as_minari else None
    writers = [_Writer(folder, asked, seed, minari_name) for asked in questions]
    agent = targets.facts(target, [asked.name for asked in questions])
    folder.mkdir(parents=True, exist_ok=True)
    begun, done, problem = time.monotonic(), 0, "it was ended early"
    try:
        with _player(target, greedy, timeout) as play:
            for writer in writers:
                with writer:
                    for episode in play(writer.asked, num_episodes, seed):
                        writer.add(episode)
                        done += 1
                        show(done)
        problem = ""
    except player.PlayerError as error:
        problem = str(error)
        count = sum(writer.num_episodes for writer in writers)
        kept = f"; the {count:,} episodes before are in {folder}" if count else ""
        raise player.PlayerError(f"{problem}{kept}") from None
    finally:
        if any(writer.num_episodes for writer in writers):
            written = {
                "target": target,
                "greedy": greedy,
                "complete": not problem,
                "problem": problem,
                "seed": seed,
                "episodes": num_episodes,
                "agent": agent,
                **provenance.made_since(begun),
                "tasks": {writer.asked.name: writer.facts() for writer in writers if writer.num_episodes},
            }
            files.write_atomically(folder / FILE, (json.dumps(written, indent=1) + "\n").encode())
        else:
            with contextlib.suppress(OSError):  # Somebody else has put something there.
                folder.rmdir()
    return written


@contextlib.contextmanager
def _player(target: str, greedy: bool, timeout: float) -> Iterator[Callable[..., Iterator[episodes.Episode]]]:
    """Returns a context with what plays, as `Player.play`: ours in this process, faster, others in their own."""
    if targets.is_function(target):
        with player.Player(target, greedy, timeout) as elsewhere:
            yield elsewhere.play
    else:
        yield functools.partial(_play, targets.maker(target, greedy))


def _play(
    make: targets.MakeActor, asked: protocol.Question, num_episodes: int, seed: int
) -> Iterator[episodes.Episode]:
    act, environment = episodes.chosen_by(make(asked)), protocol.load(asked, seed)
    for number in range(num_episodes):
        yield episodes.play(environment, act, number)
    environment.close()


class _Writer:
    """Writes the episodes of a task, part by part; a context that writes the last part."""

    def __init__(self, folder: Path, asked: protocol.Question, seed: int, minari_name: str | None):
        """Prepares to write.

        Args:
          folder: of what is exported.
          asked: the task.
          seed: of the environments.
          minari_name: of the data set of Minari; None for none.
        """
        self.asked, self.num_episodes = asked, 0
        self._steps = steps.Steps(asked, suite.environment_seed(seed, 0))
        self._folder = folder / f"{asked.domain}-{asked.task}" / TABLE
        self._pending: list[tuple[dict[str, np.ndarray], episodes.Episode]] = []
        self._num_parts = 0
        self._num_right, self._num_steps, self._returned = 0, 0, 0.0
        self._open_data_set: Callable[[], Any] | None = None
        if minari_name is not None:
            from physexp.analysis.export import data_set

            self._open_data_set = functools.cache(functools.partial(data_set.DataSet, folder, self._steps, minari_name))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._write()

    def add(self, episode: episodes.Episode) -> None:
        """Adds the next episode."""
        rows = self._steps.rows(self.num_episodes + len(self._pending), episode)
        self._pending.append((rows, dataclasses.replace(episode, timesteps=[])))  # Images of many would be large.
        if sum(len(rows["step"]) for rows, _ in self._pending) >= _ROWS:
            self._write()

    def _write(self) -> None:
        """Writes what was added since as a part, and counts it; where that fails, it is still to be written."""
        if not self._pending:
            return
        table = self._steps.table([rows for rows, _ in self._pending])
        self._folder.mkdir(parents=True, exist_ok=True)
        tables.write(self._folder / f"part-{self._num_parts:05d}.parquet", table, compression="zstd")
        written, self._pending = self._pending, []
        self._num_parts += 1
        self.num_episodes += len(written)
        for _, episode in written:
            count = len(episode.actions)
            self._num_steps += count
            self._num_right += bool(episode.rewards[-1] > 0)
            self._returned += float(self.asked.discount ** np.arange(count) @ episode.rewards)
        if self._open_data_set is not None:
            self._open_data_set().add(table)

    def facts(self) -> dict[str, Any]:
        """Returns what the task asks, what its columns mean, and what was earned."""
        asked = self.asked
        return {
            "episodes": self.num_episodes,
            "steps": self._num_steps,
            "success_rate": self._num_right / self.num_episodes,
            "mean_return": self._returned / self.num_episodes,
            "judged": self._steps.judged_by is not None,
            "question": asked.question,
            "discount": asked.discount,
            "step_limit": asked.step_limit,
            "num_interactions": asked.num_interactions,
            "action_names": list(asked.action_names),
            "label_names": list(asked.label_names),
            "observations": {
                name: {"shape": list(spec.shape), "dtype": spec.dtype.name}
                for name, spec in asked.observation_spec.items()
            },
        }
