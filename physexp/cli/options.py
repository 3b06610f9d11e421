"""The options of a domain on the command line, made from its `Options` class as an agent's are from its configuration.

The domain, and with it the suite, is imported only where the arguments name one.
"""

from collections.abc import Callable, Sequence
import dataclasses
import inspect
import re
from typing import Annotated, Any, TypeVar, get_args, get_type_hints

import tyro

from physexp import checks
from physexp.agents import config as agent_config
from physexp.cli import arguments

_NOT_OFFERED = ("random", "visualize_reward")  # The seed is an option of commands; a terminal shows no floor.
SWITCHES = ("reveal",)
"""The options that have no value; the command line is read by them before a domain, which would say so, is known."""

_METAVARS = {float: "FLOAT", int: "INT", str: "TEXT"}


@dataclasses.dataclass
class NoOptions:
    """What is chosen where no domain is named."""


Options = TypeVar("Options")


def of_domain(words: Sequence[str]) -> list[str]:
    """Returns the domains whose options go with a command's words, of which the first is a domain."""
    return list(words[:1])


def of_agent(words: Sequence[str]) -> list[str]:
    """Returns the domains whose options go with a command's words, of which the first is a trained agent.

    A run's folder does not say what it holds before it is read: any domain's options go with it, and are compared with
    its own when it is.
    """
    if not words:
        return []
    from physexp import suite

    domain = words[0].partition("/")[0]
    return [domain] if domain in suite.TASKS_BY_DOMAIN else list(suite.TASKS_BY_DOMAIN)


def of_task(domain_name: str) -> type:
    """Returns the class of a domain's options.

    Raises:
      ValueError: for an unknown domain; it lists those that there are.
    """
    from physexp import suite

    return suite.options(domain_name)


def offered(domain_names: Sequence[str], options_of: Callable[[str], type] = of_task) -> dict[str, dataclasses.Field]:
    """Returns the options that the command line has of some domains, by name: the field in the first that has it.

    Args:
      domain_names: the domains.
      options_of: returns the dataclass of a domain's options.

    Raises:
      ValueError: for an unknown domain; it lists those that there are.
    """
    found: dict[str, dataclasses.Field] = {}
    for domain_name in domain_names:
        for field in dataclasses.fields(options_of(domain_name)):
            if field.name not in _NOT_OFFERED:
                found.setdefault(field.name, field)
    return found


def make(domain_names: Sequence[str], default: str | None = None, options_of: Callable[[str], type] = of_task) -> type:
    """Returns a dataclass of the options of some domains, each None until it is chosen, or False.

    Args:
      domain_names: the domains.
      default: what holds where nothing is chosen, in words; None for the domain's own.
      options_of: as for `offered`.

    Raises:
      ValueError: as `offered`.
    """
    names = offered(domain_names, options_of)
    if not names:
        return NoOptions
    kinds: dict[str, Any] = {}
    texts: dict[str, str] = {}
    for domain_name in domain_names:
        options = options_of(domain_name)
        kinds |= get_type_hints(options)
        texts |= _descriptions(options) | checks.help_of(options)
    fields: list[tuple[str, Any, Any]] = []
    for name, field in names.items():
        shown = agent_config.shown(field.default) if default is None else default
        (kind,) = set(get_args(kinds[name]) or (kinds[name],)) - {type(None)}
        argument = tyro.conf.arg(
            metavar=_METAVARS.get(kind),
            help=texts.get(name, ""),
            help_behavior_hint="" if default is None and field.default is None else f"(default: {shown})",
        )
        if name in SWITCHES:
            fields.append((name, Annotated[arguments.Switch, argument], dataclasses.field(default=False)))
        else:
            fields.append((name, Annotated[kind | None, argument], dataclasses.field(default=None)))
    return dataclasses.make_dataclass("DomainOptions", fields)


def chosen(options: Any) -> dict[str, Any]:
    """Returns the `task_kwargs` that were chosen on the command line."""
    values = dataclasses.asdict(options)
    return {name: value for name, value in values.items() if value is not None and value is not False}


def _descriptions(kind: type) -> dict[str, str]:
    """Returns what the docstrings of a dataclass and of its bases say of their attributes."""
    found = {}
    for base in reversed(kind.__mro__):
        _, _, section = inspect.cleandoc(base.__doc__ or "").partition("Attributes:\n")
        for name, text in re.findall(r"^  (\w+): (.*(?:\n    .*)*)", section, re.MULTILINE):
            found[name] = " ".join(text.split())
    return found
