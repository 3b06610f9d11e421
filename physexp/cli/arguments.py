"""Makes parsers of `argparse` from dataclasses: from commands, from a domain's options and from a learner's.

The fields of a dataclass are the arguments; a command's own are declared with `option` and `word`.
"""

import argparse
from collections.abc import Callable, Mapping, Sequence
import dataclasses
from pathlib import Path
import re
from typing import Any, Literal, NamedTuple, NoReturn, get_args, get_origin, get_type_hints

from physexp import checks
from physexp.agents import config as agent_config

_METAVARS = {int: "INT", float: "FLOAT", str: "TEXT", Path: "PATH"}
_NOT_OFFERED = ("random", "visualize_reward")  # Commands have --seed, and a terminal shows no floor.

AGENT = (
    "a trained agent: the folder of a run, the file of a published agent (NAME.safetensors), or DOMAIN/TASK for the "
    "agent of the package; --help after it lists the options of its domain"
)
TASK = "the task, also as DOMAIN/TASK; `physexp tasks` lists them, and --help after it lists its options"

CLUSTER = "train on a cluster of Ray: the address of its head; auto for the one that runs here"
RESULTS_DIR = "the folder of all results"


def option(default: Any = dataclasses.MISSING, help: str = "", metavar: str | None = None) -> Any:
    """Returns a field of a command that is typed as `--name VALUE`; without a default it is required."""
    return dataclasses.field(default=default, metadata={"help": help, "metavar": metavar}, kw_only=True)


def word(metavar: str, help: str, nargs: str | None = None, default: Any = dataclasses.MISSING) -> Any:
    """Returns a field of a command that is typed without its name; for `nargs` see argparse."""
    return dataclasses.field(default=default, metadata={"help": help, "metavar": metavar, "nargs": nargs})


class Group(NamedTuple):
    """Options that a command has beside its own. Their values are one dictionary.

    Attributes:
      name: the command's field for this dictionary.
      title: the domain or the learner that has them.
      holders: dataclasses with these options, or instances whose values are the defaults.
      default: the default of all options, in words; None for the holders' own.
    """

    name: str
    title: str
    holders: Sequence[Any]
    default: str | None = None

    def options(self) -> dict[str, Any]:
        """Returns the first holder of each option by the option's name."""
        found: dict[str, Any] = {}
        for holder in self.holders:
            for field in dataclasses.fields(holder):
                if field.name not in _NOT_OFFERED:
                    found.setdefault(field.name, holder)
        return found


class Parser(argparse.ArgumentParser):
    """The parser of a command. An error is a ValueError of one line.

    Without `is_strict`, required arguments may be missing, and `--help` is an argument as any other.

    Attributes:
      words: the names of the arguments that are typed without a name.
      flags: the options as they are typed.
    """

    def __init__(self, name: str, kind: type, groups: Sequence[Group] = (), is_strict: bool = True):
        super().__init__(prog=f"physexp {name}", description=kind.__doc__, allow_abbrev=False, add_help=is_strict)
        self._negative_number_matcher = re.compile(r"-(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$", re.IGNORECASE)  # Also -1e-05.
        self.flags: list[str] = []
        self._is_strict = is_strict
        own = [field for field in dataclasses.fields(kind) if field.metadata]
        self.words = [field.name for field in own if "nargs" in field.metadata]
        shown = [field.metadata["metavar"] for field in own[: len(self.words)]]
        self.usage = " ".join(["%(prog)s", *shown, "[options]"])
        kinds = get_type_hints(kind)
        for field in own:
            if field.name in self.words:
                settings = _of_value(kinds[field.name]) | dict(field.metadata) | {"default": None}
                self.add_argument(field.name, **settings | ({} if is_strict else {"nargs": "*"}))
            else:
                self._add_option(self, field.name, kinds[field.name], field.metadata, field.default)
        for group in groups:
            section = self.add_argument_group(f"options of {group.title}")
            for option_name, holder in group.options().items():
                of_holder = holder if isinstance(holder, type) else type(holder)
                kinds = get_type_hints(of_holder)
                metadata = {"help": checks.help_of(of_holder).get(option_name, "")}
                is_pair = of_holder is not holder or not is_strict  # Presets may have set a flag of a learner.
                default = getattr(holder, option_name, None) if group.default is None else group.default
                self._add_option(section, option_name, kinds[option_name], metadata, default, is_pair)

    def error(self, message: str) -> NoReturn:
        """Raises the message, with the command that lists the allowed arguments."""
        raise ValueError(f"{message.removeprefix('argument ')}; see {self.prog} --help")

    def _add_option(
        self, section: Any, name: str, kind: Any, metadata: Mapping[str, Any], default: Any, is_pair: bool = False
    ) -> None:
        """Adds an option that is left out if it is not given; a flag that `is_pair` has a `--no-` form too."""
        settings = _of_value(kind) | {"dest": name, "default": argparse.SUPPRESS, "help": metadata["help"]}
        if metadata.get("metavar"):
            settings["metavar"] = metadata["metavar"]
        if default is dataclasses.MISSING:
            settings["required"] = self._is_strict
        elif default not in (None, ()) and default is not False:
            settings["help"] += f" (default: {_shown(default)})"
        settings["help"] = settings["help"].replace("%", "%%")
        if kind is bool and not is_pair:
            settings["action"] = "store_true"
        self.flags.append(f"--{name.replace('_', '-')}")
        section.add_argument(self.flags[-1], **settings)


def _of_value(kind: Any) -> dict[str, Any]:
    """Returns the settings of argparse for values of a type."""
    if get_origin(kind) is tuple:
        return _of_value(get_args(kind)[0]) | {"nargs": "*", "action": "extend"}
    if get_origin(kind) is Literal:
        return {"choices": get_args(kind)}
    if type(None) in get_args(kind):
        (kind,) = set(get_args(kind)) - {type(None)}
        return _of_value(kind)
    if kind is bool:
        return {"action": argparse.BooleanOptionalAction}
    return {"type": kind, "metavar": _METAVARS[kind]}


def _shown(value: Any) -> str:
    return " ".join(map(_shown, value)) if isinstance(value, tuple) else agent_config.shown(value)


# The options of domains, made from their `Options` classes.


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
    if not words:
        return Group("task_kwargs", "the domain", [])
    from physexp import suite

    names = domains_of(words)
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
