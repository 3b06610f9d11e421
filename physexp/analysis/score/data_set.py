"""A data set of Minari (https://minari.farama.org): an episode is a group of arrays in an HDF5 file."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pyarrow

from physexp import extras
from physexp.analysis.score import log, steps

extras.require("minari")

import gymnasium  # noqa: E402
import minari  # noqa: E402
from minari.data_collector.episode_buffer import EpisodeBuffer  # noqa: E402
from minari.dataset.minari_storage import MinariStorage  # noqa: E402

from physexp.suite import gymnasium as environments  # noqa: E402

_OF_EPISODE = ("answer", "hidden")


class DataSet:
    """A data set that grows by tables of steps."""

    def __init__(self, folder: Path, of: steps.Steps, target: str):
        """Makes an empty one.

        Args:
          folder: the folder of all data sets.
          of: the steps of a task.
          target: the name of the player, one word.
        """
        question = of.question
        self._is_judged = of.is_judged
        self._observed = question.observation_spec
        name = f"{question.domain}-{question.task}"
        identity = f"physexp/{name}/{target}-v0"
        path = folder.resolve() / identity / "data"  # Minari finds no sizes below a relative path.
        path.mkdir(parents=True)
        self._storage = MinariStorage.new(
            path,
            observation_space=environments.observation_space(question.observation_spec),
            action_space=gymnasium.spaces.Discrete(question.num_actions),
            env_spec=gymnasium.spec(environments.environment_id(question.domain, question.task)),
            jpeg_encoding=False,  # It would change images.
        )
        self._storage.update_metadata(
            {
                "dataset_id": identity,
                "minari_version": minari.__version__,
                "algorithm_name": target,
                "description": f"{question.question} Episodes of {name}, played by {target}.",
                "requirements": ["physexp[minari]"],
            }
        )

    def add(self, table: pyarrow.Table) -> None:
        """Adds the whole episodes of a table of steps."""
        columns = {name: steps.array(table[name]) for name in table.column_names}
        starts = np.flatnonzero(columns["step"] == 0)
        first = self._storage.total_episodes
        self._storage.update_episodes(map(self._episode, log.split(columns)))
        facts = [{name: columns[name][start] for name in _OF_EPISODE} for start in starts]
        self._storage.update_episode_metadata(facts, range(first, first + len(starts)))

    def _episode(self, columns: Mapping[str, np.ndarray]) -> EpisodeBuffer:
        """Returns an episode of T actions, of its columns [T, ...]."""

        def at_all_times(name: str) -> np.ndarray:
            """Returns the values before each action and at the end, [T + 1, ...]."""
            return np.concatenate([columns[name], columns[f"{steps.NEXT}{name}"][-1:]])

        infos = None
        if self._is_judged:
            at_the_end = np.full((1, columns["values"].shape[1]), np.nan)  # There is no action left.
            infos = {"belief": at_all_times("belief"), "values": np.concatenate([columns["values"], at_the_end])}
        return EpisodeBuffer(
            seed=int(columns["seed"][0]),  # With the options, `reset` starts the episode again.
            options={"episode": int(columns["episode"][0])},
            observations={
                name: at_all_times(f"{steps.OBSERVED}{name}").reshape(-1, *spec.shape)
                for name, spec in self._observed.items()
            },
            actions=columns["action"].astype(np.int64),
            rewards=columns["reward"],
            terminations=columns["terminated"],
            truncations=columns["truncated"],
            infos=infos,
        )
