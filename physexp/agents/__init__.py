"""Acme-style agents, and the trained ones that come with the package (see `load_pretrained`)."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from physexp.agents import acting


def load_pretrained(
    domain_name: str, task_name: str, *, agent: str | None = None, seed: int = 0, greedy: bool = False, **options: Any
) -> "acting.RecurrentActor":
    """Returns the trained agent of a task: an `Actor` that plays its environment.

    Args:
      domain_name, task_name: as for `suite.load`.
      agent: the learner that trained it, as `a3c`; by default the best agent.
      seed: of the actions that are drawn.
      greedy: take the likeliest action instead of drawing one.
      options: the options that the task had in training, as `difficulty=3`; by default the task's own.

    Raises:
      ValueError: if there is no such agent; it lists the agents that there are.
    """
    from physexp.agents import pretrained  # Imports torch, which takes a second.

    return pretrained.load(domain_name, task_name, agent=agent, **options).actor(seed, greedy)
