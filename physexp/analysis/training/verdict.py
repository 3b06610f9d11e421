"""The verdict on a run: whether its agent has learned anything."""

from collections.abc import Sequence

from physexp.analysis.data import estimates
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

_EPISODES = 1000  # The verdict is on at least that many of the last ones: their share of right answers is known to 3 %.


def verdict(rows: Sequence[dict[str, float]], num_labels: int) -> str | None:
    """Returns a sentence on an agent that has learned nothing, from the rows of its metrics; None for any other.

    An agent has learned nothing if more than half of its last episodes ended without an answer, or if chance, one of
    `num_labels`, lies in or above the 95 % interval of its share of right answers.
    """
    episodes = right = unanswered = 0.0
    for row, before in zip(reversed(rows), [*reversed(rows[:-1]), {"episodes": 0.0}], strict=False):
        count = row["episodes"] - before["episodes"]
        episodes += count
        right += count * row["success_rate"]
        unanswered += count * row["timeouts"]
        if episodes >= _EPISODES:
            break
    if not episodes:
        return None
    last, chance = f"its last {episodes:,.0f} episodes", f"chance is {1 / num_labels:.1%}"
    if unanswered > episodes / 2:
        return (
            f"the agent fell silent: {unanswered / episodes:.1%} of {last} ended without an answer, "
            f"{right / episodes:.1%} with the right one ({chance})"
        )
    low, _ = estimates.wilson_interval(round(right), round(episodes))
    if low <= 1 / num_labels:
        return f"the agent is no better than chance: {right / episodes:.1%} of {last} were answered right ({chance})"
    return None


def of_run(run: run_lib.Run) -> str | None:
    """Returns the verdict on a run's agent."""
    return verdict(run.metrics(), run.config.load_task().num_labels)


def advice(config: config_lib.TrainConfig) -> str:
    """Returns advice for an agent that has learned nothing."""
    agent = config.agent
    best = config_lib.DEFAULT_ALGORITHM
    other = "" if agent.algorithm == best else f"--agent {best}, "
    usual = config_lib.preset(config.domain, config.task, algorithm=agent.algorithm).frames
    return (
        f"train anew, in another --run-dir, with --frames {max(2 * agent.frames, usual)} or more "
        f"(rates decay over all frames, so --resume adds none), {other}or {agent.advice}"
    )
