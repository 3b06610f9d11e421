"""Ideal experimenters of domains; each is solved once in a session, because a search takes long."""

import functools

from physexp.analysis import domains
from physexp.analysis.score import protocol

QUICK = {"strike": {"time_limit": 0.5}}
"""Options of domains where the search takes half a minute at the usual time limit."""


@functools.cache
def of(domain: str, task: str = "features", **task_kwargs):
    """Returns the ideal experimenter of a task at its domain's discount."""
    known = domains.find(domain)
    if not task_kwargs:
        return protocol.ideal(protocol.question(domain, task))  # Shared with the tests of the score.
    return known.ideal(task, task_kwargs, known.discount)
