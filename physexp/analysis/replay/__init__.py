"""Replays: recorded episodes with observations, beliefs and actions, written for the rerun viewer."""

from collections.abc import Mapping, Sequence
import functools
from pathlib import Path
from typing import Any

from physexp import suite
from physexp.analysis.replay import recording, selection, words, writing
from physexp.analysis.replay.recording import EpisodeRecorder, Film
from physexp.analysis.replay.viewing import check_display, view
from physexp.analysis.training import callbacks, finding, playing
from physexp.analysis.training import config as config_lib

__all__ = ["EpisodeRecorder", "Film", "check_display", "replay", "view"]


def replay(
    targets: Sequence[str],
    count: int,
    output: Path,
    interaction: str = "learned",
    select: selection.Selection = "any",
    seed: int = playing.SEED,
    tell: callbacks.Tell = callbacks.ignore,
    task_kwargs: Mapping[str, Any] | None = None,
) -> Path:
    """Plays episodes with trained agents and writes them for the viewer.

    Args:
      targets: folders of runs or `domain/task`; several agents are shown side by side, on the first one's instances.
      count: number of episodes.
      output: the file.
      interaction, select, seed: see `selection.select`.
      tell: called with lines about the progress.
      task_kwargs: options of the agents' tasks, see `finding.find_agent`.

    Returns:
      The path of the file.

    Raises:
      OSError: if the file cannot be written.
      ValueError: if a target is no agent, agents play different tasks, or `output` is no path for a replay.
    """
    writing.check_output(output)
    agents = [finding.find_agent(target, task_kwargs) for target in targets]
    network, config, _ = agents[0]
    for target, other in zip(targets[1:], agents[1:], strict=True):
        if _played(other.config) != _played(config):
            raise ValueError(
                f"{targets[0]} plays {words.task_name(config)}, and {target} plays {words.task_name(other.config)}; "
                "compare agents that play the same"
            )
    chosen = list(selection.select(network, config, count, select, interaction, seed, tell))
    if len(chosen) < count:
        tell(f"only {len(chosen)} episodes are {select}")
    groups = [functools.partial(_episodes, targets, agents, instance, interaction) for instance in chosen]
    return writing.write(output, groups, tell)


def _played(config: config_lib.TrainConfig) -> tuple[str, str, suite.Options]:
    """Returns domain, task and all options but the seed of an agent."""
    return config.domain, config.task, suite.options(config.domain)(**{**config.task_kwargs, "random": 0})


def _episodes(
    targets: Sequence[str], agents: Sequence[finding.Agent], instance: selection.Instance, interaction: str
) -> list[Film]:
    """Returns the episodes of all agents on one instance; the first agent's is repeated, the others play it."""
    seed, episode, actions = instance
    titles = [targets[0] if interaction == "learned" else f"{targets[0]}, {interaction} interaction", *targets[1:]]
    return [
        recording.reenact(agent.network, agent.config, seed, episode, None if number else actions, title)
        for number, (agent, title) in enumerate(zip(agents, titles, strict=True))
    ]
