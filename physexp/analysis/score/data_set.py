"""A data set of Minari (https://minari.farama.org): an episode is a group of arrays in an HDF5 file."""

from collections.abc import Sequence
import dataclasses
import functools
from pathlib import Path

import numpy as np

from physexp import extras
from physexp.analysis.data import episodes
from physexp.analysis.ideal import base as ideal_base
from physexp.analysis.score import protocol, steps

extras.require("minari")

import gymnasium  # noqa: E402
import minari  # noqa: E402
from minari.data_collector.episode_buffer import EpisodeBuffer  # noqa: E402
from minari.dataset.minari_storage import MinariStorage  # noqa: E402

from physexp.suite import gymnasium as environments  # noqa: E402


def create(folder: Path, question: protocol.Question, target: str) -> MinariStorage:
    """Makes an empty data set of a task in the folder of all data sets; `target` names the player, one word."""
    spec = gymnasium.spec(environments.environment_id(question.domain, question.task))
    identity = f"physexp/{question.file_name}/{target}-v0"
    path = folder.resolve() / identity / "data"  # Minari finds no sizes below a relative path.
    path.mkdir(parents=True)
    storage = MinariStorage.new(
        path,
        observation_space=environments.observation_space(question.observation_spec),
        action_space=gymnasium.spaces.Discrete(question.num_actions),
        env_spec=dataclasses.replace(spec, kwargs={**spec.kwargs, **question.options}),
        jpeg_encoding=False,  # It would change images.
    )
    storage.update_metadata(
        {
            "dataset_id": identity,
            "minari_version": minari.__version__,
            "algorithm_name": target,
            "description": f"{question.question} Episodes of {question.name}, played by {target}.",
            "requirements": ["physexp[minari]"],
        }
    )
    return storage


def add(
    storage: MinariStorage,
    question: protocol.Question,
    played: Sequence[episodes.Episode],
    judged: Sequence[ideal_base.Judgement | None],
) -> None:
    """Adds episodes of a task and, where they are known, their judgements to a data set."""
    first = storage.total_episodes
    storage.update_episodes(map(functools.partial(_buffer, question), played, judged))
    facts = [{"answers": episode.answers, "hidden": episode.hidden.ravel()} for episode in played]
    storage.update_episode_metadata(facts, range(first, first + len(played)))


def _buffer(
    question: protocol.Question, episode: episodes.Episode, judged: ideal_base.Judgement | None
) -> EpisodeBuffer:
    """Returns an episode of T actions, with beliefs and values before each action and at the end."""
    infos = None
    if judged is not None:
        at_the_end = np.full((1, judged.values.shape[1]), np.nan)  # There is no action left.
        infos = {"belief": judged.beliefs, "values": np.concatenate([judged.values, at_the_end])}
    ends = steps.ends(question, episode)
    return EpisodeBuffer(
        seed=episode.seed,  # With the options, `reset` starts the episode again.
        options={"episode": episode.index},
        observations=episode.observations,
        actions=episode.actions,
        rewards=episode.rewards,
        terminations=ends["terminated"],
        truncations=ends["truncated"],
        infos=infos,
    )
