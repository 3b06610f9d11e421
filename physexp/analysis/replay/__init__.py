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
    """Plays episodes with trained agents and writes them for the viewer; returns the path of the file.

    Args:
      targets: folders of runs or `domain/task`; several agents are shown side by side, on the first one's instances.
      count: number of episodes.
      output: the file.
      interaction, select, seed: see `selection.select`.
      tell: called with lines about the progress.
      task_kwargs: options of the agents' tasks, see `finding.find_agent`.

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
    chosen = selection.select(network, config, count, select, interaction, seed, tell)
    if len(chosen) < count:
        tell(f"only {len(chosen)} episodes are {select}")
    titles = [targets[0] if interaction == "learned" else f"{targets[0]}, {interaction} interaction", *targets[1:]]

    def group(seed: int, index: int, actions: Sequence[int]) -> list[Film]:
        """Repeats the first agent's episode; the others play it."""
        return [
            recording.reenact(agent.network, agent.config, seed, index, None if number else actions, title)
            for number, (agent, title) in enumerate(zip(agents, titles, strict=True))
        ]

    return writing.write(output, [functools.partial(group, *instance) for instance in chosen], tell)


def _played(config: config_lib.TrainConfig) -> tuple[str, str, suite.Options]:
    """Returns domain, task and all options but the seed of an agent."""
    return config.domain, config.task, suite.options(config.domain)(**{**config.task_kwargs, "random": 0})
