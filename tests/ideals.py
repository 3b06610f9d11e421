"""Ideal experimenters of domains, each made once: a search takes long."""

import functools

from physexp.analysis import domains
from physexp.analysis.score import protocol


@functools.cache
def of(domain: str, task: str = "features", **task_kwargs):
    """Returns the ideal experimenter of a task at its domain's discount."""
    known = domains.find(domain)
    if not task_kwargs:
        return protocol.ideal(protocol.question(domain, task))  # Which tests of the score use as well.
    return known.ideal(task, task_kwargs, known.discount)
