"""The options of domains on the command line, made from their `Options` classes."""

from collections.abc import Callable, Sequence

from physexp.cli.arguments import Group


def domains_of(words: Sequence[str]) -> list[str]:
    """Returns the domains whose options go with a command's words, which begin with a domain or a trained agent.

    The folder of a run does not say what it holds before it is read: the options of all domains go with it, and are
    compared with its own when it is read.
    """
    if not words:
        return []
    from physexp import suite

    domain = words[0].partition("/")[0]
    return [domain] if domain in suite.TASKS_BY_DOMAIN else list(suite.TASKS_BY_DOMAIN)


def of_task(words: Sequence[str], more: Callable[[str], Sequence[type]] = lambda domain: ()) -> Group:
    """Returns the options of the domain that some words begin with, before `more` dataclasses of options."""
    names = domains_of(words)
    if not names:
        return Group("task_kwargs", "the domain", [])
    from physexp import suite

    holders = [holder for name in names for holder in (suite.options(name), *more(name))]
    return Group("task_kwargs", names[0] if len(names) == 1 else "the domain", holders)


def task_groups(words: Sequence[str], agent: str | None = None) -> list[Group]:
    """Returns the options of a command that begins with a task."""
    return [of_task(words)]


def agent_groups(words: Sequence[str], agent: str | None = None) -> list[Group]:
    """Returns the options of a command that begins with a trained agent; by default they are the agent's."""
    return [of_task(words)._replace(default="the agent's")]


def task_of(words: Sequence[str]) -> tuple[str, str]:
    """Returns the domain and the task of a command's words, DOMAIN TASK or DOMAIN/TASK; without a task, it is empty."""
    domain, _, task = "/".join(words).partition("/")
    return domain, task
