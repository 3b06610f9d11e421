"""The parts of an experiment: its conditions, trials, stored results, claims and figure."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
import contextlib
import dataclasses
import json
from pathlib import Path
from typing import Any

import filelock
import pandas
import pyarrow

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
        computed.json                  returns of the ideal experimenters, and of rules without training
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

    def append(self, table: str, rows: pyarrow.Table) -> None:
        """Adds rows of one run to a table; see `data.results.append`. Other processes may add rows, too."""
        folder = self.path / results_lib.TABLES
        folder.mkdir(parents=True, exist_ok=True)
        with filelock.FileLock(folder / ".lock"):
            results_lib.append(self.path, table, rows)

    def played(self) -> set[tuple[str, str, int]]:
        """Returns condition, trial and training seed of everything that has been played."""
        rows = self.load("evaluations", ["condition", "trial", "training_seed"])
        return set(rows.itertuples(index=False, name=None))

    def episodes(
        self, trials: Sequence[Trial], wanted: Sequence[conditions_lib.Condition], columns: Sequence[str] = ()
    ) -> pandas.DataFrame:
        """Returns the episodes of agents that have played all of some trials, with the label of their condition.

        `columns` are wanted beside those that identify the agent and the trial, as `records.completed` takes them.

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
                frames.append(frame.assign(condition=condition.label, player=condition.player, trial=trial.name))
        return self._joined(frames, "episodes")

    def agents(
        self, trials: Sequence[Trial], wanted: Sequence[conditions_lib.Condition], columns: Sequence[str]
    ) -> Iterator[tuple[dict[str, Any], conditions_lib.Condition, pandas.DataFrame]]:
        """Yields the episodes of each agent that has played all of some trials, trial by trial; see `episodes`.

        Before them come the names `condition`, `player`, `training_seed` and `trial`, and the condition itself.
        """
        for condition in wanted:
            if self._seeds(trials, condition):
                keys = ["condition", "player", "training_seed", "trial"]
                for names, episodes in self.episodes(trials, [condition], columns).groupby(keys):
                    yield dict(zip(keys, names, strict=True)), condition, episodes

    def frame(self, rows: Iterable[Mapping[str, Any]]) -> pandas.DataFrame:
        """Returns rows of agents as a DataFrame.

        Raises:
          ValueError: if there are none.
        """
        if not (rows := list(rows)):
            raise self.lacks("episodes")
        return pandas.DataFrame(rows)

    def curves(self, wanted: Sequence[conditions_lib.Condition]) -> pandas.DataFrame:
        """Returns the learning curves of all runs of some conditions, with the labels and players of these.

        Raises:
          ValueError: if there are none.
        """
        finished = set(self.load("runs", ["condition"]).condition)
        frames = []
        for condition in wanted:
            if condition.id in finished:
                filters = [("condition", "==", condition.id)]
                rows = results_lib.read(self.path, "curves", ["training_seed", *records.METRICS], filters)
                names = {"task": condition.task, "player": condition.player, "condition": condition.label}
                frames.append(records.curves(rows).assign(**names))
        return self._joined(frames, "finished runs")

    def with_player(self, frame: pandas.DataFrame, players: Iterable[str]) -> pandas.DataFrame:
        """Returns the rows of the conditions in which there is one of these players.

        Raises:
          ValueError: if there are none.
        """
        there = frame.condition[frame.player.isin(players)]
        return self._joined([frame[frame.condition.isin(there)]] if len(there) else [], "finished runs")

    def _joined(self, frames: list[pandas.DataFrame], kind: str) -> pandas.DataFrame:
        """Returns the frames as one, or raises ValueError if there are none; `kind` are their rows in words."""
        if not frames:
            raise self.lacks(kind)
        return pandas.concat(frames, ignore_index=True)

    def _seeds(self, trials: Sequence[Trial], condition: conditions_lib.Condition) -> list[int]:
        """Returns the training seeds of a condition that have played all of the trials."""
        rows = self.load("evaluations", ["trial", "training_seed"], [("condition", "==", condition.id)])
        played = [set(rows.training_seed[rows.trial == trial.name]) for trial in trials]
        return sorted(int(seed) for seed in set.intersection(*played))

    def made(self, name: str, otherwise: Any = None) -> Any:
        """Returns the value that `keep` has stored under a name, or else another one.

        Raises:
          ValueError: if there is neither, or the file is damaged.
        """
        found = self._computed().get(name, otherwise)
        if found is None:
            raise self.lacks(name)
        return found

    def keep(self, name: str, made: Any) -> None:
        """Stores the result of an experiment's preparation under a name."""
        computed = dict(sorted({**self._computed(), name: made}.items()))
        self.path.mkdir(parents=True, exist_ok=True)
        files.write_atomically(self._path_of_computed, (json.dumps(computed, indent=1) + "\n").encode())

    def make(self, name: str, report: Callable[[str], None], words: str, compute: Callable[[], Any]) -> None:
        """Stores the result of a slow function under a name, unless it is there; `report` is told the words before."""
        if name not in self._computed():
            report(words)
            self.keep(name, compute())

    def _computed(self) -> dict[str, Any]:
        """Returns all stored results by name."""
        return files.read_json(self._path_of_computed) if self._path_of_computed.exists() else {}

    @property
    def _path_of_computed(self) -> Path:
        return self.path / "computed.json"


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
      load: reads the data from the results: a DataFrame with a row for each episode, agent or step of a learning curve;
        its `attrs` may hold more for the figure, such as the behaviour of the ideal experimenter.
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
        found = []
        for claim in self.claims:
            for condition in claim.on:
                with contextlib.suppress(claims_lib.NoRows):
                    found.append(claim.tested(condition, self.statistics[claim.id](data, condition)))
        return found

    def figure(self, data) -> Any:
        """Draws the figure in the style of all figures."""
        with plots.style():
            return self.draw(data)
