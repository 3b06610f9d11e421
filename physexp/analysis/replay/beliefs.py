"""Beliefs of an agent, and of the ideal experimenter after the same observations."""

import functools

import numpy as np

from physexp.analysis import domains
from physexp.analysis.replay import recording


def of_agent(episode: recording.Film) -> np.ndarray:
    """Returns the agent's belief before each of T actions, float64 [T, L].

    For an agent with a policy alone this is the policy restricted to the labels and renormalized.
    """
    if len(episode.beliefs):
        return episode.beliefs
    answers = episode.policies[:, episode.declared.num_interactions :]
    return answers / answers.sum(axis=1, keepdims=True)


def of_ideal(episode: recording.Film) -> np.ndarray | None:
    """Returns the ideal experimenter's belief in an episode of T actions, [T + 1, L]; None where it is unknown."""
    solution = _ideal(episode.domain, episode.task, tuple(sorted(episode.task_kwargs.items())))
    return None if solution is None else solution.beliefs(episode.hidden, episode.actions)


@functools.lru_cache(maxsize=4)
def _ideal(domain_name: str, task: str, task_kwargs: tuple):
    """Returns the ideal experimenter of a task."""
    domain = domains.find(domain_name)
    find = domain.ideal_with(dict(task_kwargs))
    return None if find is None else find(task, dict(task_kwargs), domain.discount)
