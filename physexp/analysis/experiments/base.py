"""The parts of an experiment: its conditions, trials, stored results, claims and figure."""

from collections.abc import Callable, Iterator, Mapping, Sequence
import dataclasses
import json
from pathlib import Path
from typing import Any

import pandas

from physexp.agents import files
from physexp.analysis.data import plots
from physexp.analysis.data import results as results_lib
from physexp.analysis.experiments import claims as claims_lib
from physexp.analysis.experiments import conditions as conditions_lib
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import records
from physexp.analysis.training import run as run_lib


@dataclasses.dataclass(frozen=True, kw_only=True)
class Trial:
    """A test that trained agents play; experiments with the same trial share its episodes.

    Attributes:
      name: the name in the stored rows.
      interaction: learned, or random for the paper's randomized interaction.
      num_episodes: the least number of episodes.
      num_steps: the least number of environment steps, in whole episodes.
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

        tables/                        runs, learning curves, evaluations and episodes: see `data.results`
        agents/                        trained agents of some conditions
        runs/NAME/                     the folder of a run that is being trained, or was trained here
        ideal/, generalization/, timing/, noise/
                                       returns of the ideal experimenters, and of rules without training
        figures/EXPERIMENT.png
        report.md
    """

    path: Path

    def run(self, config: config_lib.TrainConfig) -> run_lib.Run:
        """Returns the folder of a run, in which there need be nothing."""
        return run_lib.Run(self.path / "runs" / config.name)

    def lacks(self, kind: str) -> ValueError:
        """Returns the error of an experiment without stored data of a kind, such as `episodes`."""
        return ValueError(f"{self.path} holds no {kind} of this experiment; `physexp reproduce EXPERIMENT` makes them")

    def load(self, table: str, columns: Sequence[str], filters: results_lib.Filters = ()) -> pandas.DataFrame:
        """Returns rows of a table as `data.results.load`; none if the table does not exist yet."""
        try:
            return results_lib.load(self.path, table, columns, filters)
        except FileNotFoundError:
            return pandas.DataFrame(columns=list(columns))

    def played(self) -> set[tuple[str, str, int]]:
        """Returns condition, trial and training seed of everything that has been played."""
        rows = self.load("evaluations", ["condition", "trial", "training_seed"])
        return set(rows.itertuples(index=False, name=None))

    def has_played(self, trial: Trial, condition: conditions_lib.Condition) -> bool:
        """Returns whether an agent of a condition has played a trial."""
        return bool(self._seeds([trial], condition))

    def has_finished(self, condition: conditions_lib.Condition) -> bool:
        """Returns whether an agent of a condition has been trained."""
        return bool(len(self.load("runs", ["run"], [("condition", "==", condition.id)])))

    def episodes(
        self, trials: Sequence[Trial], wanted: Sequence[conditions_lib.Condition], columns: Sequence[str] = ()
    ) -> pandas.DataFrame:
        """Returns the episodes of agents that have played all of some trials, with the label of their condition.

        `columns` are wanted beside those that identify the condition and the trial, as `records.completed` takes them.

        Raises:
          ValueError: if there are none.
        """
        always = ["domain", "task", "difficulty", "discount", "training_seed", "interaction", "control_timestep"]
        frames = []
        for condition in wanted:
            if not (seeds := self._seeds(trials, condition)):
                continue
            of_seeds = [("condition", "==", condition.id), ("training_seed", "in", seeds)]
            for trial in trials:
                rows = results_lib.read(self.path, "episodes", records.STORED, [*of_seeds, ("trial", "==", trial.name)])
                frame = records.completed(rows, condition, [*always, *columns], trial.interaction, trial.task_kwargs)
                frames.append(frame.assign(condition=condition.label))
        if not frames:
            raise self.lacks("episodes")
        return pandas.concat(frames, ignore_index=True)

    def agents(
        self, trial: Trial, wanted: Sequence[conditions_lib.Condition], columns: Sequence[str]
    ) -> Iterator[tuple[conditions_lib.Condition, int, pandas.DataFrame]]:
        """Yields the condition, training seed and episodes of each agent that has played a trial; see `episodes`."""
        for condition in wanted:
            if self.has_played(trial, condition):
                for seed, episodes in self.episodes([trial], [condition], columns).groupby("training_seed"):
                    yield condition, seed, episodes

    def curves(self, wanted: Sequence[conditions_lib.Condition]) -> pandas.DataFrame:
        """Returns the learning curves of all runs of some conditions, with the label of their condition in `condition`.

        Raises:
          ValueError: if there are none.
        """
        frames = []
        for condition in wanted:
            if self.has_finished(condition):
                filters = [("condition", "==", condition.id)]
                rows = results_lib.read(self.path, "curves", ["training_seed", *records.METRICS], filters)
                named = {"task": condition.task, "algorithm": condition.agent.title, "condition": condition.label}
                frames.append(records.curves(rows).assign(**named))
        if not frames:
            raise self.lacks("finished runs")
        return pandas.concat(frames, ignore_index=True)

    def _seeds(self, trials: Sequence[Trial], condition: conditions_lib.Condition) -> list[int]:
        """Returns the training seeds of a condition that have played all of the trials."""
        rows = self.load("evaluations", ["trial", "training_seed"], [("condition", "==", condition.id)])
        played = [set(rows.training_seed[rows.trial == trial.name]) for trial in trials]
        return sorted(int(seed) for seed in set.intersection(*played))


def keep_made(path: Path, made: Any) -> None:
    """Writes the outcome of an experiment's preparation into a JSON file, for `read_made`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    files.write_atomically(path, (json.dumps(made, indent=1) + "\n").encode())


def read_made(path: Path, experiment: str) -> Any:
    """Returns the results that the preparation of an experiment stored in a JSON file.

    Raises:
      ValueError: if the file is missing or damaged.
    """
    if not path.exists():
        raise ValueError(f"{path} is missing; `physexp reproduce {experiment}` makes it")
    return files.read_json(path)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Experiment:
    """An experiment.

    Attributes:
      name: as in `physexp reproduce NAME`.
      title: of the figure.
      section: of the paper.
      caption: of the figure.
      claims: the claims it tests.
      conditions: the agents it needs; several seeds of each are trained.
      trials: the episodes that each agent plays.
      prepare: computes slow results that need no agent, stores them with the results, and reports lines of progress;
        None without such results.
      load: reads the data from the results.
      statistics: the estimates of the claims from the data, by the ids of the claims.
      draw: draws a matplotlib figure of the data.
      table: returns a header and rows of words, shown below the figure; None for none.
    """

    name: str
    title: str
    section: str
    caption: str
    claims: tuple[claims_lib.Claim, ...]
    conditions: tuple[conditions_lib.Condition, ...] = ()
    trials: tuple[Trial, ...] = ()
    prepare: Callable[[Results, Callable[[str], None]], None] | None = None
    load: Callable[[Results], Any]
    statistics: Mapping[str, claims_lib.Statistic]
    draw: Callable[[Any], Any]
    table: Callable[[Any], list[tuple[str, ...]]] | None = None

    def test(self, data) -> list[claims_lib.Tested]:
        """Returns the claims under each of their conditions that has data."""
        return claims_lib.test(self.claims, self.statistics, data)

    def figure(self, data) -> Any:
        """Draws the figure in the style of all figures."""
        with plots.style():
            return self.draw(data)
