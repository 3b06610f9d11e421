"""Parses the arguments of a command. Heavy libraries are imported by the command that needs them: `--help` is quick."""

from collections.abc import Sequence
import difflib
import os
from typing import Any

from physexp.cli import printing
from physexp.cli.arguments import Group, Parser
from physexp.cli.commands import COMMANDS

_HELP = ("-h", "--help")


def parse(arguments: Sequence[str]) -> Any:
    """Returns the command that the arguments describe; raises ValueError, with one line, if they describe none."""
    if "" in arguments:
        raise ValueError("an argument is empty, as an unset variable of the shell is; give a value or leave it out")
    name, *others = map(_tidied, arguments or [""])
    if name in _HELP:
        printing.tell(*_overview())
        raise SystemExit(0)
    if name not in COMMANDS:
        given = f"{name!r} is no command; choose from" if name else "give a command:"
        raise ValueError(f"{given} {', '.join(COMMANDS)}; see physexp --help")
    kind = COMMANDS[name]
    has_words = any(not argument.startswith("-") for argument in others)
    if has_words:
        others = _with_tasks_joined(others)
    groups: list[Group] = []
    flags_of_all: list[str] = []
    if hasattr(kind, "groups"):
        # The options of all domains and learners first, to find the domain and the learner among the arguments.
        scan = Parser(name, kind, kind.groups(["any"] if has_words else [], None), is_strict=False)
        found, _ = scan.parse_known_intermixed_args(others)
        flags_of_all = scan.flags
        groups = kind.groups(getattr(found, scan.words[0]), getattr(found, "agent", getattr(kind, "agent", None)))
    parser = Parser(name, kind, groups)
    namespace, unknown = parser.parse_known_intermixed_args(others)
    if unknown:
        parser.error(_problem(unknown, parser, groups, flags_of_all))
    values = {key: tuple(value) if isinstance(value, list) else value for key, value in vars(namespace).items()}
    for group in groups:
        values[group.name] = {option: values.pop(option) for option in group.options() if option in values}
    return kind(**{key: value for key, value in values.items() if value not in (None, ())})


def _tidied(argument: str) -> str:
    """Returns an argument with dashes for underscores in an option, and the home folder for `~`."""
    option, equals, value = argument.partition("=") if argument.startswith("--") else ("", "", argument)
    home = os.path.expanduser(value)  # noqa: PTH111, it changes no other letter. Shells leave `--option=~/path`.
    return option.replace("_", "-") + equals + home


def _with_tasks_joined(arguments: Sequence[str]) -> list[str]:
    """Returns the arguments with DOMAIN/TASK for DOMAIN TASK."""
    from physexp import suite

    found: list[str] = []
    for argument in arguments:
        if found and argument in suite.TASKS_BY_DOMAIN.get(found[-1], ()):
            found[-1] += f"/{argument}"
        else:
            found.append(argument)
    return found


def _problem(unknown: Sequence[str], parser: Parser, groups: Sequence[Group], flags_of_all: Sequence[str]) -> str:
    """Returns the fault in arguments that a command does not take."""
    given = next((argument.partition("=")[0] for argument in unknown if argument.startswith("-")), None)
    if given is None:
        return f"{unknown[0]!r} is one argument too many"
    if given in flags_of_all:
        return f"{given} is not an option of {' nor of '.join(group.title for group in groups)}; leave it out"
    close = difflib.get_close_matches(given, parser.flags, n=1)
    return f"{given} is no option" + (f"; perhaps {close[0]}" if close else "")


def _overview() -> list[str]:
    """Returns the lines of `physexp --help`."""
    width = max(map(len, COMMANDS))
    return [
        "usage: physexp COMMAND [arguments]",
        "",
        "Environments in which an agent must experiment, and agents that learn to.",
        "",
        *(f"  {name:{width}}  {(kind.__doc__ or '').partition(chr(10))[0]}" for name, kind in COMMANDS.items()),
        "",
        "`physexp COMMAND --help` lists the arguments of a command, `physexp --version` prints the version.",
    ]
