"""Ideal experimenters of domains."""

from physexp.analysis import domains


def of(domain: str, task: str = "features", **task_kwargs):
    """Returns the ideal experimenter of a task at its domain's discount."""
    return domains.find(domain).ideal(task, task_kwargs, domains.find(domain).discount)
