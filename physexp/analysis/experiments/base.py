"""The parts of an experiment: the agents it needs, the episodes they play, its claims and its figure."""

from collections.abc import Callable, Iterator, Mapping, Sequence
import dataclasses
import functools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from physexp.agents import files
from physexp.analysis.data import plots
from physexp.analysis.experiments import claims as claims_lib
from physexp.analysis.experiments import conditions
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import records
from physexp.analysis.training import run as run_lib


@dataclasses.dataclass(frozen=True, kw_only=True)
class Trial:
    """What a trained agent plays; experiments with the same trial share its episodes.

    Attributes:
      name: of the folder with the episodes.
      interaction: learned, or random for the paper's randomized interaction.
      num_episodes, num_steps: it plays until it has had at least so many of both, in whole episodes.
      task_kwargs: options of the task that differ from those of training.
    """

    name: str
    interaction: str = "learned"
    num_episodes: int = 1
    num_steps: int = 0
    task_kwargs: Mapping[str, Any] = dataclasses.field(default_factory=dict, hash=False)  # A dictionary has no hash.


LEARNED = Trial(name="learned", num_steps=10_000)
RANDOM = Trial(name="random", interaction="random", num_steps=10_000)
LONG = Trial(name="long", num_steps=100_000)
EVALUATION = Trial(name="evaluation", num_episodes=10_000)


@dataclasses.dataclass(frozen=True)
class Results:
    """The folder with the data of all experiments.

    It holds::

        runs/NAME/                     a run: configuration, metrics, the agent in half precision
        episodes/TRIAL/NAME.parquet    what the run's agent played, a row an episode
        ideal/, generalization/, timing/, noise/
                                       what experimenters earn that nobody trained
        figures/EXPERIMENT.{svg,png}
        report.md, report.html
    """

    path: Path

    def run(self, config: config_lib.TrainConfig) -> run_lib.Run:
        return run_lib.Run(self.path / "runs" / config.name)

    def episodes_path(self, trial: Trial, config: config_lib.TrainConfig) -> Path:
        return self.path / "episodes" / trial.name / f"{config.name}.parquet"

    def lacks(self, what: str) -> ValueError:
        """Returns the error of an experiment of whose data, as `episodes`, there are none yet."""
        return ValueError(f"{self.path} holds no {what} of this experiment; `physexp reproduce EXPERIMENT` makes them")

    def all_episodes(self, config: config_lib.TrainConfig) -> list[Path]:
        """The files of all that a run's agent played, of whichever trial."""
        return sorted(self.path.glob(f"episodes/*/{config.name}.parquet"))

    def episodes(
        self, trials: Sequence[Trial], configs: Sequence[config_lib.TrainConfig], columns: Sequence[str] = ()
    ) -> Any:
        """What agents of these conditions have played: a DataFrame with `condition` and columns that `records` reads.

        Args:
          trials: what was played; of every seed that has played all of it.
          configs: the conditions, whatever the seed in them.
          columns: those wanted beside the ones that tell what was played; few are quick to read.

        Raises:
          ValueError: if there are none.
        """
        always = ["domain", "task", "difficulty", "discount", "training_seed", "interaction", "control_timestep"]
        paths = [path for config in configs for path in self._complete(trials, config)]
        if not paths:
            raise self.lacks("episodes")
        frame = records.read(paths, [*always, *columns])
        return frame.assign(condition=_labels(frame))

    def has_played(self, trial: Trial, config: config_lib.TrainConfig) -> bool:
        """Returns whether an agent of a condition has played what is asked for, whatever its seed."""
        return bool(self._complete([trial], config))

    def has_finished(self, config: config_lib.TrainConfig) -> bool:
        """Returns whether an agent of a condition has been trained, whatever its seed."""
        return any(self._finished(config))

    def curves(self, configs: Sequence[config_lib.TrainConfig]) -> Any:
        """Learning curves: a DataFrame of the rows of `metrics.METRICS` of all seeds of these conditions."""
        import pandas

        frames = []
        for config in configs:
            for run in self._finished(config):
                frames.append(
                    pandas.DataFrame(run.metrics()).assign(
                        domain=config.domain,
                        task=config.task,
                        difficulty=config.task_kwargs.get("difficulty"),
                        discount=config.agent.discount,
                        training_seed=run.config.agent.seed,
                        algorithm=config.agent.title,
                    )
                )
        if not frames:
            raise self.lacks("finished runs")
        frame = pandas.concat(frames, ignore_index=True)
        return frame.assign(condition=_labels(frame))

    def _finished(self, config: config_lib.TrainConfig) -> Iterator[run_lib.Run]:
        """Yields the finished runs of a condition, in the order of their names."""
        for folder in sorted((self.path / "runs").glob(f"{_without_seed(config)}-seed*")):
            run = run_lib.Run(folder)
            if run.is_finished:
                yield run

    def _complete(self, trials: Sequence[Trial], config: config_lib.TrainConfig) -> list[Path]:
        """The episodes of the seeds of a condition that have played all of the trials."""
        pattern = f"{_without_seed(config)}-seed*.parquet"
        folders = [self.path / "episodes" / trial.name for trial in trials]
        names = set.intersection(*({path.name for path in folder.glob(pattern)} for folder in folders))
        return [folder / name for folder in folders for name in sorted(names)]


def _without_seed(config: config_lib.TrainConfig) -> str:
    return config.name.removesuffix(f"-seed{config.agent.seed}")


def _labels(frame) -> np.ndarray:
    """Returns the names of the conditions of rows, of which many have the same."""
    kinds = frame[["domain", "task", "difficulty"]].astype({"difficulty": float})
    numbers = kinds.groupby(list(kinds), dropna=False, sort=False, observed=True).ngroup().to_numpy()
    rows = kinds.iloc[np.unique(numbers, return_index=True)[1]].itertuples(index=False)
    labels = [_label(row.domain, row.task, None if math.isnan(row.difficulty) else row.difficulty) for row in rows]
    return np.array(labels, object)[numbers]


def keep_made(path: Path, made: Any) -> None:
    """Writes what the preparation of an experiment has made into a JSON file, for `read_made`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    files.write_atomically(path, (json.dumps(made, indent=1) + "\n").encode())


def read_made(path: Path, experiment: str, is_as_written: Callable[[Any], bool]) -> Any:
    """Returns what the preparation of an experiment has left in a JSON file.

    Args:
      path: the file.
      experiment: its name.
      is_as_written: tells whether this is something that it writes.

    Raises:
      ValueError: if the file is missing or damaged.
    """
    if not path.exists():
        raise ValueError(f"{path} is missing; `physexp reproduce {experiment}` makes it")
    found = files.read_json(path)
    if not is_as_written(found):
        raise ValueError(f"{path} is not what was written; remove it, and `physexp reproduce {experiment}` makes it")
    return found


@functools.cache
def _label(domain: str, task: str, difficulty: float | None) -> str:
    return conditions.label(domain, task, **({} if difficulty is None else {"difficulty": difficulty}))


@dataclasses.dataclass(frozen=True, kw_only=True)
class Experiment:
    """An experiment.

    Attributes:
      name: as in `physexp reproduce NAME`.
      title: of the figure.
      section: of the paper.
      caption: what the figure shows.
      conditions: the agents it needs, of each of which several seeds are trained.
      trials: what each of them plays.
      prepare: makes what needs no agent and takes time, keeps it with the results, and reports lines that tell how it
        goes; None where nothing does.
      load: from the results to a tidy DataFrame; pure reading.
      claims: from that to what holds.
      draw: from that to a matplotlib figure.
      table: from that to a header and rows of words, to stand below the figure; None for none.
    """

    name: str
    title: str
    section: str
    caption: str
    conditions: tuple[config_lib.TrainConfig, ...] = ()
    trials: tuple[Trial, ...] = ()
    prepare: Callable[[Results, Callable[[str], None]], None] | None = None
    load: Callable[[Results], Any]
    claims: Callable[[Any], list[claims_lib.Claim]]
    draw: Callable[[Any], Any]
    table: Callable[[Any], list[tuple[str, ...]]] | None = None

    def figure(self, frame) -> Any:
        """Draws the figure as it is to look."""
        with plots.style():
            return self.draw(frame)
