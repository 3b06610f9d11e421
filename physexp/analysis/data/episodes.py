"""Played episodes: one of a single environment, and a table of many with one row each.

Stored files are selections of the table's columns.
"""

from collections.abc import Sequence
import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow

from physexp import suite
from physexp.agents import core, environment_loop
from physexp.analysis.data import estimates
from physexp.suite.engine import rules as rules_lib

if TYPE_CHECKING:
    from physexp.agents import rounds  # Imports torch, without which tables are read in no time.


@dataclasses.dataclass(frozen=True, kw_only=True)
class Episode:
    """A played episode of T actions.

    Attributes:
      seed, index: seed of the environment and index of the episode: they rebuild its instance.
      hidden: the hidden property, which no actor observes, [...].
      answers: the right labels of its K questions, int64 [K].
      observations: arrays by name, before each action and at the end, [T + 1, ...].
      actions: int64 [T].
      rewards: float64 [T].
    """

    seed: int
    index: int
    hidden: np.ndarray
    answers: np.ndarray
    observations: dict[str, np.ndarray]
    actions: np.ndarray
    rewards: np.ndarray

    @property
    def answer(self) -> int:
        """The right label of its last question."""
        return int(self.answers[-1])

    def asked(self, num_interactions: int) -> np.ndarray:
        """Returns the index of the question before each action, int64 [T]; labels follow interactions."""
        are_answers = self.actions >= num_interactions
        return np.cumsum(are_answers) - are_answers


class Recorder(environment_loop.Observer):
    """Records an episode of a single environment of the suite."""

    def observe_first(self, environment, timestep) -> None:
        self._task = environment.task
        self._seen = [timestep.observation]
        self._actions: list[int] = []
        self._rewards: list[float] = []

    def observe(self, environment, timestep, action) -> None:
        self._seen.append(timestep.observation)
        self._actions.append(int(action))
        self._rewards.append(float(timestep.reward))

    @property
    def episode(self) -> Episode:
        """The episode so far, until the environment begins another one."""
        return Episode(
            seed=self._task.options.random,
            index=self._task.episode,
            hidden=self._task.hidden,
            answers=self._task.ledger.answers[0].copy(),
            observations={name: np.stack([seen[name] for seen in self._seen]) for name in self._seen[0]},
            actions=np.array(self._actions, np.int64),
            rewards=np.array(self._rewards),
        )


def play(environment: suite.Environment, actor: core.Actor, index: int, seed: int | None = None) -> Episode:
    """Returns the episode of an index, played by an actor; by default with the environment's seed."""
    if seed is not None:
        environment.task.reseed(seed)
    environment.task.next_episode = index
    recorder = Recorder()
    environment_loop.EnvironmentLoop(environment, actor, [recorder]).run_episode()
    return recorder.episode


@dataclasses.dataclass(frozen=True)
class Episodes:
    """N episodes of at most T actions.

    Attributes:
      seed: seeds of the environments, int64 [N].
      episode: indices of the episodes, int64 [N]: seed and index together rebuild an episode.
      hidden: the hidden property, [N, ...]; [N, 0] where it is not recorded.
      answer: the right labels of the last questions, int64 [N].
      label: the last labels given, -1 where time ran out, int64 [N].
      reward: sums of the rewards, float64 [N].
      length: actions in each episode, labels among them, int64 [N].
      interactions: interaction actions in each episode, int64 [N].
      num_questions: questions in each episode, int64 [N].
      actions, rewards: the actions and the rewards after them, -1 and 0 after the end of an episode, int64 and float64
        [N, T].
    """

    seed: np.ndarray
    episode: np.ndarray
    hidden: np.ndarray
    answer: np.ndarray
    label: np.ndarray
    reward: np.ndarray
    length: np.ndarray
    interactions: np.ndarray
    num_questions: np.ndarray
    actions: np.ndarray
    rewards: np.ndarray

    def __len__(self) -> int:
        return len(self.length)

    @classmethod
    def of_round(
        cls,
        played: "rounds.Round",
        rules: rules_lib.Rules,
        seed: np.ndarray,
        episode: int,
        hidden: np.ndarray | None = None,
    ) -> "Episodes":
        """Returns the episodes of a round in N environments, which all have the index `episode`.

        The rules are those of the task; `seed` and `hidden` are as in `Episodes`.
        """
        num_episodes, num_interactions = len(played.lengths), rules.num_interactions
        is_played = np.arange(len(played.actions)) < played.lengths[:, None]
        actions = np.where(is_played, played.actions.T, -1)
        last = actions[np.arange(num_episodes), played.lengths - 1]
        return cls(
            seed=seed,
            episode=np.full(num_episodes, episode),
            hidden=np.zeros((num_episodes, 0)) if hidden is None else hidden,
            answer=played.answers,
            label=np.where(last >= num_interactions, last - num_interactions, -1),
            reward=played.rewards.sum(axis=0, dtype=np.float64),
            length=played.lengths,
            interactions=(is_played & (actions < num_interactions)).sum(axis=1),
            num_questions=np.full(num_episodes, rules.num_questions),
            actions=actions,
            rewards=played.rewards.T.astype(np.float64),
        )

    @classmethod
    def joined(cls, parts: "Sequence[Episodes]") -> "Episodes":
        """Returns the episodes of all parts, one after the other."""
        longest = max(part.actions.shape[1] for part in parts)
        columns = {name: [vars(part)[name] for part in parts] for name in vars(parts[0])}
        for name, filler in (("actions", -1), ("rewards", 0)):
            columns[name] = [
                np.pad(each, ((0, 0), (0, longest - each.shape[1])), constant_values=filler) for each in columns[name]
            ]
        return cls(**{name: np.concatenate(values) for name, values in columns.items()})

    def first(self, count: int) -> "Episodes":
        """Returns the first episodes."""
        return Episodes(**{name: values[:count] for name, values in vars(self).items()})

    def actions_of(self, index: int) -> np.ndarray:
        """Returns the actions of one episode, int64 [length]."""
        return self.actions[index, : self.length[index]]

    def returns(self, discount: float) -> np.ndarray:
        """Returns discounted returns, float64 [N]: the rewards, each discounted once for each action before it."""
        returns: np.ndarray = (self.rewards * discount ** np.arange(self.rewards.shape[1])).sum(axis=1)
        return returns

    @property
    def right(self) -> np.ndarray:
        """The share of right answers to the questions of each episode, float64 [N]."""
        right = (self.reward + self.num_questions) // 2  # The others, given or not, have cost 1 each.
        return right / self.num_questions

    def summary(self, discount: float) -> dict:
        """Returns the metrics that `physexp evaluate` prints; the interval is Wilson's, at 95 %."""
        right, asked = round((self.right * self.num_questions).sum()), int(self.num_questions.sum())
        return {
            "episodes": len(self),
            "success_rate": right / asked,
            "success_interval": list(estimates.wilson_interval(right, asked)),
            "mean_return": float(self.returns(discount).mean()),
            "mean_interactions": float(self.interactions.mean()),
            "median_interactions": float(np.median(self.interactions)),
            "timeouts": int(self.is_timeout.sum()),
        }

    @property
    def is_timeout(self) -> np.ndarray:
        """Whether each episode ran out of time, bool [N]."""
        return self.length - self.interactions < self.num_questions

    def table(self, schema: pyarrow.Schema, **others: Any) -> pyarrow.Table:
        """Returns the columns of a schema, a row an episode; `others` has those that this table lacks.

        Each of these is an array of length N, or one value for all rows.
        """
        ends = np.cumsum([0, *self.length]).astype(np.int32)
        lists = pyarrow.ListArray.from_arrays(ends, self.actions[self.actions >= 0])
        columns: dict[str, Any] = {**vars(self), "actions": lists}
        for name, value in others.items():
            columns[name] = value if isinstance(value, (np.ndarray, pyarrow.Array)) else [value] * len(self)
        return pyarrow.table({name: columns[name] for name in schema.names}, schema)
